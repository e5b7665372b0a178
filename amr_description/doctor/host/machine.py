# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""System, Python, memory, disks, network, as the kernel and the interpreter say."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
import ctypes
import fcntl
import importlib.machinery
import importlib.metadata
import importlib.util
import locale
import os
from pathlib import Path
import platform
import re
import socket
import struct
import sys

from amr_description.bringup.run_log import log_base
from amr_description.doctor.observations.machine import Disk, Interface, Machine, Python

_UP, _LOOPBACK, _POINT_TO_POINT, _MULTICAST = 0x1, 0x8, 0x10, 0x1000  # netdevice(7)
_ETHERNET, _LOOPBACK_TYPE = 1, 772  # ARPHRD_ETHER, ARPHRD_LOOPBACK
_SIOCGIFADDR = 0x8915
_REQUEST = struct.Struct('16s24x')  # ifreq: the name, and room for an address
_ADDRESS = slice(20, 24)
_UNSYNCHRONISED = 5  # TIME_ERROR of adjtimex(2)
_UFW_IS_ON = re.compile(r'^ENABLED=yes', re.MULTILINE)
_STALL = re.compile(r'^full avg10=([\d.]+)', re.MULTILINE)
_MODULE = '_rclpy_pybind11'


def read_machine(variables: Mapping[str, str]) -> Machine:
    """Observe the machine; ``variables`` say where log files go."""
    memory = _memory()
    return Machine(
        system=f'{platform.system()} {platform.release()}',
        architecture=platform.machine(),
        c_library=' '.join(platform.libc_ver()).strip(),
        processors=len(os.sched_getaffinity(0)),
        load=os.getloadavg()[0],
        python=read_python(),
        encoding=locale.getencoding() if not sys.flags.utf8_mode else 'UTF-8',
        memory=memory.get('MemTotal', 0),
        free_memory=memory.get('MemAvailable', 0),
        stalled_by_memory=_stalled(),
        disks=tuple(_disks(variables)),
        interfaces=tuple(_interfaces()),
        firewall=_firewall(),
        is_clock_synchronised=_is_clock_synchronised(),
    )


def read_python() -> Python:
    """Observe this interpreter, and which rclpy it finds; none is imported."""
    spec = importlib.util.find_spec('rclpy')
    folder = Path(spec.origin).parent if spec and spec.origin else None
    modules = sorted(folder.glob(f'{_MODULE}.*')) if folder else []
    version = ''
    with suppress(importlib.metadata.PackageNotFoundError):
        version = importlib.metadata.version('rclpy')
    return Python(
        version=platform.python_version(),
        executable=sys.executable,
        extension_suffix=importlib.machinery.EXTENSION_SUFFIXES[0],
        rclpy_folder=str(folder or ''),
        rclpy_suffixes=tuple(each.name.removeprefix(_MODULE) for each in modules),
        rclpy_version=version,
    )


def _memory() -> dict[str, int]:
    """Return the lines of /proc/meminfo that are sizes, bytes."""
    found = {}
    with suppress(OSError):
        for line in Path('/proc/meminfo').read_text().splitlines():
            name, _, rest = line.partition(':')
            words = rest.split()
            if words[1:] == ['kB']:
                found[name] = int(words[0]) * 1024
    return found


def _stalled() -> float:
    with suppress(OSError):
        if match := _STALL.search(Path('/proc/pressure/memory').read_text()):
            return float(match[1]) / 100.0
    return 0.0


def _disks(variables: Mapping[str, str]) -> Iterator[Disk]:
    folders: dict[str, Path] = {}
    with suppress(RuntimeError):  # this user has no home
        folders['log files'] = log_base(variables)
    with suppress(OSError):  # it was deleted meanwhile
        folders['the current folder'] = Path.cwd()
    folders['shared memory'] = Path('/dev/shm')
    for purpose, folder in folders.items():
        # Path.exists raises where a folder may not be entered.
        there = next((each for each in (folder, *folder.parents) if os.path.exists(each)), None)
        if there is None:
            continue
        with suppress(OSError):
            size = os.statvfs(there)
            yield Disk(
                purpose=purpose,
                folder=str(folder),
                free=size.f_bavail * size.f_frsize,
                total=size.f_blocks * size.f_frsize,
                is_writable=there.is_dir() and os.access(there, os.W_OK | os.X_OK),
            )


def _interfaces() -> Iterator[Interface]:
    for folder in sorted(Path('/sys/class/net').glob('*')):
        try:
            flags = int((folder / 'flags').read_text(), 16)
            kind = int((folder / 'type').read_text())
        except (OSError, ValueError):
            continue  # it has gone, or is a file, as bonding_masters
        is_loopback = bool(flags & _LOOPBACK) or kind == _LOOPBACK_TYPE
        yield Interface(
            name=folder.name,
            is_up=bool(flags & _UP),
            is_loopback=is_loopback,
            has_multicast=bool(flags & _MULTICAST),
            is_tunnel=kind != _ETHERNET and not is_loopback and bool(flags & _POINT_TO_POINT),
            addresses=_addresses(folder.name),
        )


def _addresses(name: str) -> tuple[str, ...]:
    """Return the first IPv4 address of an interface."""
    with suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        request = _REQUEST.pack(os.fsencode(name)[:15])
        answer = fcntl.ioctl(any_socket.fileno(), _SIOCGIFADDR, request)
        return (socket.inet_ntoa(answer[_ADDRESS]),)
    return ()


def _firewall() -> str:
    """Return the name of an active firewall, as far as a user may see one."""
    with suppress(OSError):
        if _UFW_IS_ON.search(Path('/etc/ufw/ufw.conf').read_text()):
            return 'ufw'
    return 'firewalld' if Path('/run/firewalld').is_dir() else ''


def _is_clock_synchronised() -> bool | None:
    """Ask adjtimex(2), with modes = 0, which changes nothing."""
    buffer = ctypes.create_string_buffer(512)  # struct timex is 208 bytes
    try:
        state = ctypes.CDLL(None).adjtimex(buffer)
    except (OSError, AttributeError):
        return None
    return None if state < 0 else bool(state != _UNSYNCHRONISED)
