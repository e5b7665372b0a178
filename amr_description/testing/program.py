# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulator as a process of a test: it ends with the test, whatever becomes of that.

ROS domains that nobody else is in, as far as they ask here.

So several tests can run side by side: of several checkouts, or of one.
"""

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
from amr_description.errors import SimulationError
from amr_description.ros.signals import LIFELINE_VARIABLE

PATIENCE = 15.0
"""s from SIGINT to SIGKILL."""

_MODULE = 'amr_description.nodes.mujoco_sim'
_LINE = re.compile(r'^\[(?:ERROR|FATAL)\] (?:\[[^]]*\] ?)*:? ?(.*)', re.MULTILINE)


class SimulatorProcess:
    """The running process, and what it has said."""

    def __init__(self, process: subprocess.Popen[bytes], log: Path) -> None:
        self.process = process
        self._log = log

    @property
    def log(self) -> str:
        """What it has said so far."""
        return self._log.read_text(encoding='utf-8', errors='replace')

    def check(self) -> None:
        """Raises SimulationError, with its last error, if it has ended."""
        code = self.process.poll()
        if code is not None:
            raise SimulationError(self._ended(code))

    def _ended(self, code: int) -> str:
        if code < 0:
            return f'the simulator was killed by {signal.Signals(-code).name}'
        said = _LINE.findall(self.log) or self.log.split('\n') or ['']
        return f'the simulator ended with {code}: {said[-1].strip()}'

    def stop(self) -> None:
        """
        End it as Ctrl-C does, or else kill it.

        Raises SimulationError: it had ended already, did not end, or ended badly.
        """
        self.check()
        self.process.send_signal(signal.SIGINT)
        try:
            code = self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            raise SimulationError(
                f'the simulator has not ended within {PATIENCE:g} s of SIGINT; it is killed'
            ) from None
        if code:
            raise SimulationError(self._ended(code))


@contextmanager
def simulator(parameters: Mapping[str, Any]) -> Iterator[SimulatorProcess]:
    """
    Run ``mujoco_sim`` with these parameters while inside.

    It finds what this process can import. It ends with this process, even when that is killed:
    it holds the other end of a pipe. Raises SimulationError at the end if it did not end well.
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
                    start_new_session=True,  # Ctrl-C is for the test, which ends it then
                )
            program = SimulatorProcess(process, log)
            try:
                yield program
                program.stop()
            finally:
                _end(process)
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
    """In every way out: first as Ctrl-C does, so that its shared memory goes with it."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
    process.wait()


# Domains whose ports lie below the system's ephemeral ones; 0 is everybody's.
DOMAINS = range(1, 102)
LOCKS = Path(tempfile.gettempdir())

DOMAIN = 'ROS_DOMAIN_ID'
RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'


def take_domain() -> tuple[int, int]:
    """
    Return a domain that no other test holds, and the open file that holds it.

    Never the one of the shell: a robot may be listening there. Raises SimulationError.
    """
    forbidden = os.environ.get(DOMAIN)
    start = os.getpid() % len(DOMAINS)
    for domain in (*DOMAINS[start:], *DOMAINS[:start]):
        if str(domain) == forbidden:
            continue
        try:
            lock = os.open(LOCKS / f'ros_domain_{domain}.lock', os.O_CREAT | os.O_RDWR, 0o666)
        except PermissionError:  # another user's
            continue
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(lock)
            continue
        return domain, lock
    raise SimulationError(f'all ROS domains from {DOMAINS[0]} to {DOMAINS[-1]} are taken')


@contextmanager
def own_domain() -> Iterator[int]:
    """
    Be, with all that is started inside, in a free domain on this host; yield its number.

    Contexts of rclpy that are initialised inside are in it; those from before stay where they
    are. Raises SimulationError.
    """
    before = {name: os.environ.get(name) for name in (DOMAIN, RANGE)}
    domain, lock = take_domain()
    try:
        os.environ |= {DOMAIN: str(domain), RANGE: 'LOCALHOST'}
        yield domain
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        os.close(lock)
