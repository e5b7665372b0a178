# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulator as a process of a test, in a ROS domain of its own.

The process ends with the test, in whatever way that ends. Domains are taken by lock files, so that
several tests can run side by side: of one checkout, or of several. One with a participant on this
host is never taken, and nobody of another host is heard in it. Who starts something in it later,
on this host, is noticed: by :func:`require_alone` at the start, then by
:class:`~amr_description.testing.lock_step.LockStep`.
"""

from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
import fcntl
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import tempfile
from typing import Any

import amr_description
from amr_description.bringup.command_line import yaml_text
from amr_description.entry import LIFELINE_VARIABLE
from amr_description.errors import SimulationError
from amr_description.ros.local_participants import discovery_sockets, foreign_sockets, owner_of
from amr_description.ros.transport import UDP_LOOPBACK
from amr_description.simulation.tracebacks import is_for_the_test

__tracebackhide__ = is_for_the_test

STOP_TIMEOUT = 15.0
"""s from SIGINT to SIGKILL."""

_SELDOM = range(215, 232)
"""
ROS domains that people seldom choose: above the ephemeral ports of Linux. Domain 232, the last
one, has ports for 63 participants only: those of others would exceed 65535.
"""
DOMAINS = (*_SELDOM, *range(1, 101))
"""In this order; the ports of the others are below the ephemeral ones; 0 is the default one."""
LOCKS = Path('/tmp')
"""The folder of the lock files, one for each domain; TMPDIR makes no other domains of them."""
WAYS_TO_OTHERS = (
    'ROS_LOCALHOST_ONLY',
    'ROS_STATIC_PEERS',
    'ROS_DISCOVERY_SERVER',
    'ROS_SUPER_CLIENT',
    'FASTDDS_DEFAULT_PROFILES_FILE',
    'FASTDDS_BUILTIN_TRANSPORTS',
)
"""Environment variables by which a shell finds others; a robot may be among them."""

_MODULE = 'amr_description.nodes.mujoco_sim'
_LINE = re.compile(r'^\[(?:ERROR|FATAL)\] (?:\[[^]]*\] ?)*:? ?(.*)', re.MULTILINE)
DOMAIN = 'ROS_DOMAIN_ID'
_THIS_HOST_ONLY = {
    'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    'FASTRTPS_DEFAULT_PROFILES_FILE': str(UDP_LOOPBACK),
}


class SimulatorProcess:
    """The running process and its log."""

    def __init__(self, process: subprocess.Popen[bytes], log: Path) -> None:
        self.process = process
        self._log = log
        self._last_log: str | None = None

    @property
    def log(self) -> str:
        """Its output so far."""
        if self._last_log is not None:
            return self._last_log
        return self._log.read_text(encoding='utf-8', errors='replace')

    @property
    def has_ended(self) -> bool:
        """Whether it was ended, or ended by itself."""
        return self.process.poll() is not None

    def keep_log(self) -> None:
        """Read the log for the last time: the file will be removed."""
        self._last_log = self.log

    def check(self) -> None:
        """Raise SimulationError, with its last error, if it has ended."""
        code = self.process.poll()
        if code is not None:
            raise SimulationError(self._describe_end(code))

    def _describe_end(self, code: int) -> str:
        if code < 0:
            return f'the simulator was killed by {signal.Signals(-code).name}'
        lines = _LINE.findall(self.log) or self.log.strip().splitlines() or ['without a word']
        return f'the simulator ended with {code}: {lines[-1].strip()}'

    def stop(self) -> None:
        """
        Send SIGINT and wait for the end.

        Raises SimulationError: it had ended already, does not end, or ends with an error.
        """
        self.check()
        self.process.send_signal(signal.SIGINT)
        try:
            code = self.process.wait(STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            raise SimulationError(
                f'the simulator has not ended within {STOP_TIMEOUT:g} s of SIGINT; it is killed'
            ) from None
        if code:
            raise SimulationError(self._describe_end(code))


started: deque[SimulatorProcess] = deque(maxlen=20)
"""The last simulators of this process, for the logs of a test that fails."""


@contextmanager
def simulator(parameters: Mapping[str, Any]) -> Iterator[SimulatorProcess]:
    """
    Run ``mujoco_sim`` with parameters, while inside.

    It can import what this process can. It ends with this process, even when that is killed: it
    watches the other end of a pipe. Raises SimulationError at the end if it ended with an error.
    """
    reader, writer = os.pipe()
    with tempfile.TemporaryDirectory(prefix='amr-simulation-') as folder:
        log, file = Path(folder) / 'mujoco_sim.log', Path(folder) / 'parameters.yaml'
        file.write_text(yaml_text('mujoco_sim', parameters), encoding='utf-8')
        try:
            with log.open('wb') as stream:
                process = subprocess.Popen(
                    [sys.executable, '-m', _MODULE, '--ros-args', '--params-file', str(file)],
                    stdin=subprocess.DEVNULL,
                    stdout=stream,
                    stderr=stream,
                    env=_environment(reader, folder),
                    pass_fds=(reader,),
                    start_new_session=True,  # Ctrl-C is for the test, which then ends it
                )
            simulator_process = SimulatorProcess(process, log)
            started.append(simulator_process)
            try:
                yield simulator_process
                simulator_process.stop()
            finally:
                _end(process)
                simulator_process.keep_log()
        finally:
            os.close(reader)
            os.close(writer)


def _environment(lifeline: int, folder: str) -> dict[str, str]:
    source = str(Path(amr_description.__file__).parents[1])
    path = dict.fromkeys(entry or os.getcwd() for entry in (source, *sys.path))
    return os.environ | {
        'PYTHONPATH': os.pathsep.join(path),
        'PYTHONUNBUFFERED': '1',
        'ROS_LOG_DIR': folder,
        LIFELINE_VARIABLE: str(lifeline),
    }


def _end(process: subprocess.Popen[bytes]) -> None:
    """End it, first by SIGINT, so that its shared memory is removed."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
    process.wait()


def take_domain() -> tuple[int, int]:
    """
    Return a domain that nobody else uses, and the open file that reserves it.

    Nobody: no other test, and no participant on this host. Never the domain of the environment: a
    robot may be in it, here or elsewhere.

    Raises:
        SimulationError: None is free, or the system does not show who is there.
    """
    forbidden = os.environ.get(DOMAIN)
    occupied = 0
    for domain in _candidates():
        if str(domain) == forbidden:
            continue
        lock = _lock(domain)
        if lock is None:
            continue
        # Looked at with the lock, so that no other test can come in between.
        if not _is_occupied(domain):
            return domain, lock
        os.close(lock)
        occupied += 1
    raise SimulationError(
        f'all {len(DOMAINS)} ROS domains that tests use are taken: {occupied} by programs on this '
        f'host, {len(DOMAINS) - occupied} by other tests or this shell; end some of them'
    )


def _candidates() -> list[int]:
    """Return the domains as they are tried; tests that begin at once begin at different ones."""
    found: list[int] = []
    for group in (DOMAINS[: len(_SELDOM)], DOMAINS[len(_SELDOM) :]):
        start = os.getpid() % max(len(group), 1)
        found += (*group[start:], *group[:start])
    return found


def _lock(domain: int) -> int | None:
    """Return the open lock file of a domain; None: it is another test's."""
    path = LOCKS / f'ros_domain_{domain}.lock'
    try:
        try:
            lock = os.open(path, os.O_RDONLY)  # whoever made it: to lock it, one may only read it
        except FileNotFoundError:
            lock = os.open(path, os.O_RDONLY | os.O_CREAT, 0o644)
    except PermissionError:
        return None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(lock)
        return None
    return lock


def _is_occupied(domain: int) -> bool:
    try:
        return bool(discovery_sockets(domain))
    except OSError as error:
        raise SimulationError(
            f'a test needs a ROS domain without anybody in it, and who is there cannot be read: '
            f'{error.filename}: {error.strerror}'
        ) from None


def require_alone(domain: int, simulator: int) -> None:
    """
    Raise SimulationError if others than this process and the simulator are in a domain.

    Whoever has started there since the domain was taken is seen at once, before discovery.

    Args:
        domain: That of the test.
        simulator: Process id.
    """
    for port, inodes in foreign_sockets(domain, (os.getpid(), simulator)).items():
        who = owner_of(inodes) or 'a process of another user'
        raise SimulationError(
            f'ROS domain {domain} is that of this test, and {who} has come into it (UDP port '
            f'{port}); give that another ROS_DOMAIN_ID, and run the test again'
        )


@contextmanager
def own_domain() -> Iterator[int]:
    """
    Set a free domain, on this host only, in the environment while inside; yield its number.

    It applies to processes and rclpy contexts that are started inside. What the environment says
    of static peers, a discovery server, transports and profiles holds outside only. Raises
    SimulationError: no domain is free.
    """
    domain, lock = take_domain()
    changed = (DOMAIN, *_THIS_HOST_ONLY, *WAYS_TO_OTHERS)
    before = {name: os.environ.pop(name, None) for name in changed}
    try:
        os.environ |= {DOMAIN: str(domain), **_THIS_HOST_ONLY}
        yield domain
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        os.close(lock)
