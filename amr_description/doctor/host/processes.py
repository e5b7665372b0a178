# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The processes of ROS on this host, by the sockets of DDS and the runs of bring-ups.

Seen are those of this user: ``/proc/PID/fd`` and ``environ`` of others are closed.
"""

from collections.abc import Iterator, Mapping
from contextlib import suppress
import fcntl
import os
from pathlib import Path
import re
import time

from amr_description.bringup.guardian import RUN_VARIABLE
from amr_description.bringup.process_usage import start_time
from amr_description.doctor.observations.processes import ObservedProcess, Processes, SharedMemory
from amr_description.ros.local_participants import local_participants
from amr_description.ros.udp_sockets import udp_sockets
from amr_description.text import one_line, shorten

_DOMAINS = range(233)
_FIRST_PORT, _LAST_PORT = 7400, 65535
_GAIN = 250
_PREFIXES = ('ROS_', 'RMW_', 'FASTRTPS_', 'FASTDDS_', 'AMR_')
_SOCKET = re.compile(r'socket:\[(\d+)\]')
_LOCK_END = '_el'
_LOCK = re.compile(rf'fastrtps_[0-9a-f]+{_LOCK_END}')  # of segments; those of ports have a name
_SETTLED = 5.0  # s
_LONGEST_DOMAIN = 9  # digits; of thousands int() makes none
_MEMORY = Path('/dev/shm')
_PYTHON = re.compile(r'python[\d.]*$')


def read_processes(variables: Mapping[str, str]) -> Processes:
    """Observe the processes that take part in any domain, or belong to a bring-up."""
    owners = _domains_by_socket()
    found = list(_processes(owners))
    text = variables.get('ROS_DOMAIN_ID', '')
    return Processes(
        domain=int(text) if text.isdecimal() and len(text) < _LONGEST_DOMAIN else 0,
        processes=tuple(found),
        runs=frozenset(each.run for each in found if each.run and _is_supervised(each)),
        left_memory=_left_memory(),
    )


def _domains_by_socket() -> dict[int, int]:
    """Return the inodes of discovery sockets of participants → their domain."""
    try:
        ports = udp_sockets()
    except OSError:
        return {}
    domains = {(port - _FIRST_PORT) // _GAIN for port in ports if port >= _FIRST_PORT}
    return {
        inode: domain
        for domain in sorted(domains.intersection(_DOMAINS))
        for _, inode in local_participants(domain)
    }


def _processes(owners: Mapping[int, int]) -> Iterator[ObservedProcess]:
    own = os.getpid()
    for folder in sorted(Path('/proc').glob('[0-9]*'), key=lambda each: int(each.name)):
        with suppress(OSError, ValueError):
            if int(folder.name) == own or folder.stat().st_uid != os.getuid():
                continue
            if found := _process(folder, owners):
                yield found


def _process(folder: Path, owners: Mapping[int, int]) -> ObservedProcess | None:
    """Return a process if it is of ROS. Raises OSError: it has gone."""
    variables = _variables(folder)
    run = variables.get(RUN_VARIABLE, '')
    files = [_link(each) for each in os.scandir(folder / 'fd')]
    inodes = [int(match[1]) for each in files if (match := _SOCKET.fullmatch(each))]
    domain = next((owners[inode] for inode in inodes if inode in owners), None)
    if domain is None and not run:
        return None
    state = (folder / 'stat').read_bytes().rpartition(b')')[2].split()[0].decode()
    if state in 'ZX':
        return None
    return ObservedProcess(
        pid=int(folder.name),
        command=_command(folder),
        domain=domain,
        state=state,
        variables=variables,
        run=run,
        open_files=len(files),
        most_open_files=_limit(folder),
    )


def _is_supervised(process: ObservedProcess) -> bool:
    """Return whether the supervisor of its run lives, by whose pid the name of a run ends."""
    pid = process.run.rpartition('-')[2]
    started, supervisor = start_time(process.pid), start_time(int(pid) if pid.isdecimal() else 0)
    # A later process may have got the pid.
    return started is None or (supervisor is not None and supervisor <= started)


def _link(entry: 'os.DirEntry[str]') -> str:
    try:
        return os.readlink(entry.path)
    except OSError:
        return ''


def _variables(folder: Path) -> dict[str, str]:
    pairs = (folder / 'environ').read_bytes().decode(errors='replace').split('\0')
    found = (each.partition('=') for each in pairs if each.startswith(_PREFIXES))
    return {name: value for name, _, value in found}


def _command(folder: Path) -> str:
    """Return the words of a process, without the interpreter and the folder of its program."""
    words = (folder / 'cmdline').read_bytes().decode(errors='replace').split('\0')[:-1]
    if words and _PYTHON.search(words[0]) and len(words) > 1 and not words[1].startswith('-'):
        words = words[1:]
    for last in ('-c', '--ros-args'):
        if last in words:
            del words[words.index(last) + (last == '-c') :]
    if words:
        words[0] = words[0].rpartition('/')[2]
    return shorten(one_line(' '.join(words).strip()))


def _limit(folder: Path) -> int:
    for line in (folder / 'limits').read_text().splitlines():
        if line.startswith('Max open files'):
            soft = line.split()[3]
            return int(soft) if soft.isdecimal() else 0
    return 0


def _left_memory() -> SharedMemory:
    """
    Return the segments of Fast DDS of this user whose owner is gone.

    The owner of a segment holds a lock (flock) on ``<segment>_el``, by which ``fastdds shm clean``
    knows, too. Here it is tried for an instant, and shared, so that nobody else's check is misled.
    """
    names, size = [], 0
    with suppress(OSError):
        for entry in os.scandir(_MEMORY):
            with suppress(OSError):
                if _LOCK.fullmatch(entry.name) and _is_left(entry):
                    segment = Path(entry.path.removesuffix(_LOCK_END))
                    names.append(segment.name)
                    size += segment.stat().st_blocks * 512
    return SharedMemory(files=tuple(sorted(names)), size=size)


def _is_left(entry: 'os.DirEntry[str]') -> bool:
    """Return whether nobody holds a lock file that is ours, and older than a start takes."""
    state = entry.stat()
    if state.st_uid != os.getuid() or time.time() - state.st_mtime < _SETTLED:
        return False
    with open(entry.path, 'rb') as file:
        try:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
    return True
