# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Machines in networks, for tests: Linux namespaces of their own, joined by virtual cables.

A machine has its own network and its own ``/dev/shm``, by which Fast DDS tells hosts apart; files
and processes are everybody's. No root is needed where users may make namespaces of their own.
Nothing has to be taken away again: the kernel does it with the last process in a namespace.
"""

from collections.abc import Iterator
from contextlib import contextmanager, ExitStack
from pathlib import Path
import shutil
import subprocess
import sys
import time

from support.running_programs import PATIENCE

# Says that it is there, and holds its namespaces until its stdin is closed.
_HOLD = 'mount -t tmpfs tmpfs /dev/shm && ip link set lo up && echo up && read -r end'
_RADIO = Path(__file__).with_name('lossy_link.py')
TOOLS = ('unshare', 'nsenter', 'ip', 'mount')  # util-linux and iproute2


class Machine:
    """One machine, as long as the context lasts."""

    def __init__(self, like: 'Machine | None' = None) -> None:
        """``like``: one whose user it shares, so that a cable can join the two."""
        user = like.inside(keep_network=True) if like else ['unshare', '--map-root-user']
        self._holder = subprocess.Popen(
            [*user, *(['unshare'] if like else []), '--net', '--mount', 'sh', '-c', _HOLD],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> 'Machine':
        if self._holder.stdout.readline() != 'up\n':
            raise OSError(self._holder.communicate()[1].strip())
        return self

    def __exit__(self, *_error: object) -> None:
        self._holder.communicate()

    def inside(self, *, keep_network: bool = False) -> list[str]:
        """Return the words before a command that is to run on this machine."""
        spaces = [
            '--user',
            '--preserve-credentials',
            *([] if keep_network else ['--net', '--mount']),
        ]
        words = ['nsenter', f'--target={self._holder.pid}', *spaces, '--']
        return [*words, 'env', f'--chdir={Path.cwd()}']  # which the new /dev/shm made forget

    def do(self, *words: str) -> str:
        """Run a command on it; return what it prints."""
        command = [*self.inside(), *words]
        return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout

    def cable_to(self, other: 'Machine', address: str, other_address: str) -> None:
        """Join both by an Ethernet cable; addresses with prefix length, ``10.0.0.1/24``."""
        end, other_end = f'eth{address.split(".")[2]}', f'eth{other_address.split(".")[2]}'
        peer = ('peer', 'name', other_end, 'netns', str(other._holder.pid))
        self.do('ip', 'link', 'add', end, 'type', 'veth', *peer)
        _plug_in((self, end, address), (other, other_end, other_address))
        for machine, name in ((self, end), (other, other_end)):
            machine.wait_for_carrier(name)

    @contextmanager
    def radio_to(
        self, other: 'Machine', address: str, other_address: str, *, loss: float, delay: float
    ) -> Iterator[None]:
        """
        Join both by a link that loses frames, as wireless ones do, as long as the context lasts.

        :param loss: Of all frames in either direction, 0 to 1.
        :param delay: In either direction, s.
        """
        ends = (str(self._holder.pid), 'radio0', str(other._holder.pid), 'radio0')
        user = ('nsenter', f'--target={self._holder.pid}', '--user', '--preserve-credentials')
        with subprocess.Popen(
            [*user, '--', sys.executable, str(_RADIO), *ends, str(loss), str(delay)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        ) as radio:  # which closes its stdin at the end: it ends by that
            if radio.stdout.readline() != 'up\n':
                raise OSError('no TAP devices')
            _plug_in((self, 'radio0', address), (other, 'radio0', other_address))
            yield

    def wait_for_carrier(self, interface: str) -> None:
        """
        Wait until the kernel says that a cable is plugged in: seconds later, on a busy host.

        A participant of Fast DDS asks once, at its start, and would never use the interface.
        """
        show = [*self.inside(), 'ip', '-oneline', 'link', 'show', 'dev', interface]
        deadline = time.monotonic() + PATIENCE
        while ' state UP ' not in (state := subprocess.check_output(show, text=True)):
            if time.monotonic() > deadline:
                raise OSError(f'no carrier: {state.strip()}')


def _plug_in(*ends: tuple[Machine, str, str]) -> None:
    """Give interfaces their addresses."""
    for machine, name, address in ends:
        machine.do('ip', 'address', 'add', address, 'dev', name)
        machine.do('ip', 'link', 'set', name, 'up')


@contextmanager
def one_network() -> Iterator[tuple[Machine, Machine]]:
    """Yield two machines at one switch, 192.168.7.1 and 192.168.7.2: multicast reaches both."""
    with Machine() as robot, Machine(robot) as operator:
        robot.cable_to(operator, '192.168.7.1/24', '192.168.7.2/24')
        yield robot, operator


@contextmanager
def two_networks() -> Iterator[tuple[Machine, Machine]]:
    """
    Yield two machines with a router between them, which passes no multicast on.

    192.168.7.1 and 192.168.8.2; the router is 192.168.7.254 and 192.168.8.254.
    """
    with ExitStack() as stack:
        robot = stack.enter_context(Machine())
        router = stack.enter_context(Machine(robot))
        operator = stack.enter_context(Machine(robot))
        robot.cable_to(router, '192.168.7.1/24', '192.168.7.254/24')
        operator.cable_to(router, '192.168.8.2/24', '192.168.8.254/24')
        robot.do('ip', 'route', 'add', 'default', 'via', '192.168.7.254')
        operator.do('ip', 'route', 'add', 'default', 'via', '192.168.8.254')
        # By the file: `sysctl` is in /usr/sbin, which not every user has on the PATH.
        router.do('sh', '-c', 'echo 1 > /proc/sys/net/ipv4/ip_forward')
        yield robot, operator


def missing() -> str | None:
    """Return which program lacks for making machines, and what would do."""
    lacking = [tool for tool in TOOLS if not shutil.which(tool)]
    return f'no {", ".join(lacking)}; apt install iproute2 util-linux' if lacking else None


def refusal() -> str | None:
    """Return why the system lets this user make no machines, if so."""
    try:
        with one_network():
            return None
    except (OSError, subprocess.CalledProcessError) as error:
        return f'this user may make no network namespaces: {error}'
