# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules about the machine: what ROS needs of any, so that it can start and run at all."""

from collections.abc import Iterator
import re

from amr_description.doctor.findings import error, Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.environment import is_open, reaches_network
from amr_description.doctor.observations.machine import Interface

_MEGABYTE = 1_000_000
_FULL, _NEARLY_FULL = 10 * _MEGABYTE, 200 * _MEGABYTE
_SHARED_MEMORY = '/dev/shm'
_LEAST_MEMORY = 300 * _MEGABYTE
_LEAST_SHARE = 0.05
_MOST_STALLED = 0.2
_NEEDED_GLIBC = (2, 28)
"""Of the wheels on PyPI: manylinux_2_28."""
_HIGHEST_LOAD = 4.0
"""For each processor."""
_ARCHITECTURE = 'x86_64'
_SETUP = 'scripts/setup'

_MENDED = (2, 14, 6)
"""Of Fast DDS."""


def c_library(seen: Observations) -> Iterator[Finding]:
    """
    The wheels of ROS are compiled for glibc 2.28 or newer, on x86-64.

    Debian 10, Ubuntu 20.04, RHEL 8 and later have it. Alpine has musl, and a Raspberry Pi another
    processor: use a container.
    """
    machine = seen.machine
    if machine is None or not _has_wheels(seen):
        return
    name, _, version = machine.c_library.partition(' ')
    if name == 'glibc' and _numbers(version) >= _NEEDED_GLIBC:
        if machine.architecture == _ARCHITECTURE:
            return
        what = f'this machine is {machine.architecture}'
    else:
        what = f'this system has {machine.c_library or "no glibc, as Alpine"}'
    yield error(
        'c_library',
        what,
        'the ROS packages of PyPI are for x86-64 and glibc 2.28 or newer, and do not load',
        'use a system or container with them: docker run -it debian:12',
    )


def python_abi(seen: Observations) -> Iterator[Finding]:
    """
    Binary modules load only in the version of Python that they were compiled for.

    Another ``python3`` came first in ``PATH``, or the environment was copied. ``scripts/activate``
    in a new shell has the right one.
    """
    if seen.machine is None:
        return
    python = seen.machine.python
    if not python.rclpy_suffixes or python.extension_suffix in python.rclpy_suffixes:
        return
    yield error(
        'python_abi',
        f'{python.executable} is Python {python.version}, and rclpy in {python.rclpy_folder} is '
        f'compiled for {", ".join(map(_interpreter, python.rclpy_suffixes))}',
        "import rclpy fails with No module named '_rclpy_pybind11'",
        f'run it with that version, as python{_version_of(python.rclpy_suffixes[0])}, or make an '
        f'environment of its own: {_SETUP}',
    )


def rclpy_import(seen: Observations) -> Iterator[Finding]:
    """
    Whatever is of ROS imports rclpy.

    It is not installed for this Python, or one of its libraries cannot be loaded. Mostly another
    ROS or conda is sourced in this shell. The finding has the words of the loader.
    """
    if seen.machine is None or any(python_abi(seen)) or any(c_library(seen)):
        return
    python = seen.machine.python
    if python.rclpy_fault:
        yield error(
            'rclpy_import',
            f'rclpy cannot be imported by {python.executable}: {python.rclpy_fault}',
            'no node can be started',
            f'{_SETUP}, in a new shell without other ROS or conda; then source scripts/activate'
            if _has_wheels(seen)
            else 'source /opt/ros/jazzy/setup.bash in a new shell',
        )


def disk_full(seen: Observations) -> Iterator[Finding]:
    """
    Logs, bags and shared memory need some room.

    Below 200 MB where logs or the current folder are: a warning; below 10 MB: an error. Old logs
    are in ``~/.ros/log``, one folder a run.
    """
    for disk in seen.machine.disks if seen.machine else ():
        if not disk.total or disk.free >= _NEARLY_FULL:
            continue
        # Of a small /dev/shm, as containers have, 64 MB are all there is.
        if disk.folder == _SHARED_MEMORY and disk.free >= _FULL:
            continue
        make = error if disk.free < _FULL else warning
        mend = (
            'delete what killed programs left there: rm /dev/shm/fastrtps_* while no ROS runs'
            if disk.folder == _SHARED_MEMORY
            else f'delete what is not needed any more: du -xsh {disk.folder}/* | sort -h'
        )
        yield make(
            'disk_full',
            f'{disk.folder} ({disk.purpose}) has {_size(disk.free)} left of {_size(disk.total)}',
            'log files, bags and builds end in the middle when it is full',
            mend,
        )


def log_folder(seen: Observations) -> Iterator[Finding]:
    """
    A node that cannot make its log file does not start.

    A program once started by root leaves a folder that only root can write. ``ROS_LOG_DIR`` names
    another one.
    """
    for disk in seen.machine.disks if seen.machine else ():
        if disk.purpose == 'log files' and not disk.is_writable:
            yield error(
                'log_folder',
                f'{disk.folder} cannot be written by this user',
                'each node makes its log file there when it starts, and does not start without',
                'export ROS_LOG_DIR=/tmp/ros_log; or give the folder back: '
                f'sudo chown -R $USER {disk.folder}',
            )


def memory_short(seen: Observations) -> Iterator[Finding]:
    """
    Without memory programs wait for disks, or the kernel ends one.

    Less than 5 % of it is free, or programs wait for memory much of their time. Browsers, builds
    and a second simulator take the most.
    """
    machine = seen.machine
    if machine is None or not machine.memory:
        return
    is_short = machine.free_memory < min(_LEAST_MEMORY, _LEAST_SHARE * machine.memory)
    if is_short or machine.stalled_by_memory > _MOST_STALLED:
        stalled = (
            f'; programs waited for it in {machine.stalled_by_memory:.0%} of the last 10 s'
            if machine.stalled_by_memory > _MOST_STALLED
            else ''
        )
        yield warning(
            'memory_short',
            f'{_size(machine.free_memory)} of {_size(machine.memory)} memory are free{stalled}',
            'control cycles come late, and the kernel ends the largest program when none is left',
            'end what takes the most: ps -eo pid,rss,args --sort=-rss | head',
        )


def overloaded(seen: Observations) -> Iterator[Finding]:
    """
    A robot's programs get a processor when they want one.

    More than four programs a processor want to run, in the mean of the last minute. What comes
    late then, comes late because of that.
    """
    machine = seen.machine
    if machine and machine.load > _HIGHEST_LOAD * machine.processors:
        yield warning(
            'overloaded',
            f'{machine.load:.0f} programs want to run at once, and there are '
            f'{machine.processors} processors',
            'cycles, messages and answers come late, and simulated time is slow',
            'end what takes the most: ps -eo pid,pcpu,args --sort=-pcpu | head',
        )


def loopback_down(seen: Observations) -> Iterator[Finding]:
    """
    Nodes of one host talk by the loopback interface.

    Some containers and network namespaces have no interface ``lo``.
    """
    for each in seen.machine.interfaces if seen.machine else ():
        if each.is_loopback and not each.is_up:
            yield error(
                'loopback_down',
                f'the loopback interface {each.name} is down',
                'nodes of this host do not find each other',
                f'sudo ip link set {each.name} up',
            )


def open_network(seen: Observations) -> Iterator[Finding]:
    """
    Who is heard by other hosts should have a Fast DDS whose known holes are mended.

    Fast DDS before 2.14.6 has ten known holes. By one of them anybody in the network exhausts the
    memory of a node. DDS asks for no password in any case
    (docs/two_machines.md#what-listens-where-and-who-can-drive).
    """
    if seen.environment is None or not is_open(seen.environment):
        return
    version = tuple(int(each) for each in re.findall(r'\d+', seen.environment.fastdds_version))
    if (2, 14) <= version < _MENDED:
        yield warning(
            'open_network',
            f'other hosts reach the nodes of this one, by Fast DDS {_dotted(version)}',
            'anybody in the network can drive, and exhaust their memory: '
            f'{_dotted(_MENDED)} mends ten known holes',
            'use this host alone: export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST; or keep '
            'strangers off that network, by a firewall or a VPN',
        )


def _dotted(version: tuple[int, ...]) -> str:
    return '.'.join(map(str, version))


def multicast(seen: Observations) -> Iterator[Finding]:
    """
    Nodes of other hosts are found by multicast, unless peers or a server are named.

    Tunnels of a VPN and some interfaces do not carry it. Name the hosts on both sides
    (docs/two_machines.md).
    """
    if seen.machine is None or seen.environment is None:
        return
    if not reaches_network(seen.environment):
        return
    others = [each for each in seen.machine.interfaces if each.is_up and not each.is_loopback]
    usable = [each for each in others if each.addresses]
    if usable and not any(_carries_multicast(each) for each in usable):
        names = ', '.join(f'{each.name} ({_kind(each)})' for each in usable)
        yield warning(
            'multicast',
            f'no network interface carries multicast: {names}',
            'the discovery range is SUBNET, and nodes of other hosts are looked for by multicast',
            'name the other hosts: export ROS_STATIC_PEERS=ADDRESS on both sides; or use this '
            'host alone: export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST',
        )


def clock_unsynchronised(seen: Observations) -> Iterator[Finding]:
    """
    Clocks of hosts that share transforms and scans agree.

    Nodes of another host are in the graph, and the kernel says that no service sets this clock.
    Some milliseconds apart, transforms and scans do not fit.
    """
    if seen.machine is None or seen.machine.is_clock_synchronised is not False:
        return
    hosts = sorted({each.host for each in seen.graph.nodes if each.host}) if seen.graph else []
    if hosts:
        yield warning(
            'clock_unsynchronised',
            f'nothing keeps the clock of this host right, and nodes of {_hosts(len(hosts))} are '
            'in the graph',
            'stamps of one host are in the future, or too old, for the other one: tf2 drops them',
            'sudo timedatectl set-ntp true; or sudo apt install chrony, on both',
        )


def encoding(seen: Observations) -> Iterator[Finding]:
    """
    URDFs, YAML files and messages are UTF-8.

    With another encoding, a ``µ`` is read wrongly. ``C.UTF-8`` is there on every Linux.
    """
    machine = seen.machine
    if machine and machine.encoding.lower().replace('-', '').replace('_', '') != 'utf8':
        yield warning(
            'encoding',
            f'text is read and written as {machine.encoding} here',
            'a file with an umlaut or a µ cannot be read, or is read wrongly',
            'export LANG=C.UTF-8 LC_ALL=C.UTF-8',
        )


RULES: tuple[Rule, ...] = (
    c_library,
    python_abi,
    rclpy_import,
    disk_full,
    log_folder,
    memory_short,
    overloaded,
    loopback_down,
    open_network,
    multicast,
    clock_unsynchronised,
    encoding,
)


def _hosts(number: int) -> str:
    return f'{number} others' if number > 1 else 'another one'


def _has_wheels(seen: Observations) -> bool:
    return seen.environment is None or seen.environment.is_from_wheels


def _carries_multicast(interface: Interface) -> bool:
    return interface.has_multicast and not interface.is_tunnel


def _kind(interface: Interface) -> str:
    return 'a tunnel, as of a VPN' if interface.is_tunnel else 'without the flag MULTICAST'


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(each) for each in version.split('.') if each.isdecimal())


def _interpreter(suffix: str) -> str:
    """Return ``.cpython-310-x86_64-linux-gnu.so`` as ``CPython 3.10``."""
    return f'CPython {_version_of(suffix)}'


def _version_of(suffix: str) -> str:
    digits = suffix.removeprefix('.cpython-').partition('-')[0]
    return f'{digits[:1]}.{digits[1:]}'


def _size(count: int) -> str:
    if count >= 1000 * _MEGABYTE:
        return f'{count / 1e9:.1f} GB'
    return f'{count / 1e6:.0f} MB'
