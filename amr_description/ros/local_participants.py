# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The DDS participants on this host, from the UDP ports in use: nobody is asked, or disturbed.

By the port formula of the DDS standard (DDSI-RTPS 2.5, 9.6.2.3) a participant listens to discovery
messages at ``7400 + 250 * domain + 10 + 2 * participant``, of its own, and with the range SUBNET
at ``7400 + 250 * domain``, which it shares. Linux lists the ports in use, of all users.

The list is that of the network namespace. Those in another one (a container, unless it has the
network of the host) have addresses of their own and count as other hosts. Participants without
UDP (``FASTDDS_BUILTIN_TRANSPORTS=SHM``), and those whose profile sets ports, are not seen.

This module imports no rclpy.
"""

from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
import os
from pathlib import Path
import re

from amr_description.ros.udp_sockets import udp_sockets
from amr_description.text import one_line, quote

_PORT_BASE = 7400
_DOMAIN_GAIN = 250
_PARTICIPANT_GAIN = 2
_UNICAST_OFFSET = 10
_PARTICIPANTS = range(120)
_SOCKET = re.compile(r'socket:\[(\d+)\]')
_PROCESS = slice(4, 6)  # bytes of a gid: of the process that made the participant (Fast DDS 2.14)


def local_participants(domain: int) -> set[tuple[int, int]]:
    """
    Return the participants of a domain on this host, ours included.

    Each is its number and the inode of its discovery socket: another one that has the number later
    has another inode. The set is empty where the system shows no table of sockets.
    """
    try:
        sockets = udp_sockets()
    except OSError:
        return set()
    first = _discovery_ports(domain)[1]
    return {
        (each, inode)
        for each in participant_ids(sockets, domain)
        for inode in sockets[first + _PARTICIPANT_GAIN * each]
    }


def participant_ids(ports: Collection[int], domain: int) -> set[int]:
    """
    Return the participants of a domain, from the UDP ports in use.

    A participant has the port after that too, for its data; a lone port is some other program's:
    the ports of the highest domains lie among those that Linux gives to any socket.
    """
    own = dict(zip(_PARTICIPANTS, _discovery_ports(domain)[1:], strict=True))
    return {
        participant for participant, port in own.items() if port in ports and port + 1 in ports
    }


def discovery_sockets(domain: int) -> dict[int, set[int]]:
    """
    Return the sockets at which a participant of a domain may be listening: port → inodes.

    A lone port counts too: whoever looks for a domain of its own rather leaves one out. Raises
    OSError: the system shows no table of sockets.
    """
    sockets = udp_sockets()
    return {port: sockets[port] for port in _discovery_ports(domain) if port in sockets}


def is_on_the_network(domain: int) -> bool:
    """Return whether a participant of a domain on this host listens to other hosts (SUBNET)."""
    return _discovery_ports(domain)[0] in discovery_sockets(domain)


def foreign_sockets(domain: int, processes: Iterable[int]) -> dict[int, set[int]]:
    """Return those of :func:`discovery_sockets` that none of these processes has open."""
    found = discovery_sockets(domain)
    own = {inode for pid in processes for inode in _open_sockets(Path(f'/proc/{pid}'))}
    return {port: inodes - own for port, inodes in found.items() if inodes - own}


def owner_of(inodes: set[int]) -> str:
    """Return pid and command line of the process that has a socket open; '': another user's."""
    for process in Path('/proc').glob('[0-9]*'):
        if inodes.intersection(_open_sockets(process)):
            with suppress(OSError):
                words = (process / 'cmdline').read_text(errors='replace').split('\0')
                return f'pid {process.name} {quote(one_line(" ".join(words).strip()))}'
    return ''


def processes_of(prefix: bytes) -> list[int]:
    """
    Return the processes of this host that may have made a participant, by the prefix of its gid.

    The prefix has the last 16 bits of the process id: where ids are larger there may be several.
    """
    ends = int.from_bytes(prefix[_PROCESS], 'little')
    pids = (int(name) for name in os.listdir('/proc') if name.isdecimal())
    return [pid for pid in pids if pid & 0xFFFF == ends]


def may_have_made(prefix: bytes, participants: Iterable[tuple[int, int]]) -> bool:
    """
    Return whether one of :func:`local_participants` may have that prefix of its gid.

    It has not where no process that the prefix may name has its socket open. A process whose
    sockets the system does not show may have it.
    """
    inodes = {inode for _, inode in participants}
    for pid in processes_of(prefix):
        process = Path(f'/proc/{pid}')
        try:
            os.listdir(process / 'fd')
        except PermissionError:
            if not _has_ended(process):
                return True
        except OSError:
            continue
        if not inodes.isdisjoint(_open_sockets(process)):
            return True
    return False


def _has_ended(process: Path) -> bool:
    """Return whether it has, and perhaps waits for its parent to notice."""
    try:
        status = (process / 'stat').read_bytes()
    except OSError:
        return True
    return status.rpartition(b')')[2].split()[0] in {b'Z', b'X'}


def _open_sockets(process: Path) -> Iterator[int]:
    """Yield the inodes; none of a process that has ended, or is another user's."""
    with suppress(OSError):
        for descriptor in os.scandir(process / 'fd'):
            with suppress(OSError):
                if found := _SOCKET.fullmatch(os.readlink(descriptor.path)):
                    yield int(found[1])


def _discovery_ports(domain: int) -> tuple[int, ...]:
    """Return the port of all participants, then that of each."""
    first = _PORT_BASE + _DOMAIN_GAIN * domain
    own = (first + _UNICAST_OFFSET + _PARTICIPANT_GAIN * number for number in _PARTICIPANTS)
    return first, *own
