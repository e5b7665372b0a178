# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Environment variables: those that configure discovery, those of a child, those of the next shell.

Discovery is configured by options of ``bringup``, the same for every stack. Each option stands for
an environment variable that all ROS 2 nodes read, and overrides it; set the variable to configure
a whole shell. Both are checked before anything starts, since nodes with a wrong value find nobody
and log nothing about it.

================================ ================================================================
``--domain 5``                   ROS_DOMAIN_ID
``--discovery subnet``           ROS_AUTOMATIC_DISCOVERY_RANGE
``--peer 10.0.0.2``              ROS_STATIC_PEERS, joined by ``;``
``--discovery-server 10.0.0.9``  ROS_DISCOVERY_SERVER, with the port, joined by ``;``
================================ ================================================================
"""

from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
import os
from pathlib import Path
import re
import shutil
import socket
import sys

from amr_description.ament_index import package_prefix
from amr_description.errors import UsageError
from amr_description.ros_arguments import DOMAIN, is_domain, LAST_DOMAIN, OF_DOMAINS, RANGES

RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
PEERS = 'ROS_STATIC_PEERS'
SERVER = 'ROS_DISCOVERY_SERVER'
# The ROS wheels start each Python twice, to set LD_LIBRARY_PATH; this variable marks that as done.
# Children of the same virtual environment inherit both, which saves each of them 0.1 s.
WHEELS_GUARD = '_ROS_WHEELS_BOOTSTRAP_COMPLETE'

_SERVER_PORT = 11811  # Fast DDS's default
_OPTIONS = {
    DOMAIN: '--domain',
    RANGE: '--discovery',
    PEERS: '--peer',
    SERVER: '--discovery-server',
}
# host, host:port, or a locator of Fast DDS, UDPv4:[10.0.0.1]:11811
_ADDRESS = re.compile(
    r'(?:(?:UDP|TCP)v[46]:)?(?:\[(?P<locator>[^\]]+)\]|(?P<host>[^\[\]:;\s]+))(?::(?P<port>\d+))?'
)
# A script whose interpreter the kernel cannot start, as its path is long, has spaces, or is not
# known when the script is written, has the shell start it: pip, scripts/setup and our wheel write
# such a second line.
_EXEC_OF_SHELL = re.compile(rb"""'{3}exec' (?:"([^"]+)"|(\S+)) "\$0" "\$@"$""", re.MULTILINE)
_OWN_FOLDER = '${0%/*}'
_LONGEST_PATH = 4096


def add_options(parser: ArgumentParser) -> None:
    """Add the options to a command's parser."""
    group = parser.add_argument_group('who finds the nodes, and whom they find')
    group.add_argument('--domain', metavar='N', help=f'ROS domain, 0 to {LAST_DOMAIN} ({DOMAIN})')
    group.add_argument(
        '--discovery',
        metavar='RANGE',
        help=f'localhost: this host only; subnet: the network it is in ({RANGE})',
    )
    group.add_argument(
        '--peer',
        metavar='HOST',
        action='append',
        help=f'a host to look for nodes at, beyond the range; may be repeated ({PEERS})',
    )
    group.add_argument(
        '--discovery-server',
        metavar='HOST[:PORT]',
        action='append',
        help=f'a server that knows all nodes, in place of a range; port {_SERVER_PORT} if none '
        f'is given; may be repeated ({SERVER})',
    )


def as_arguments(options: Namespace) -> list[str]:
    """Return the given options as command-line arguments."""
    return [
        f'{option}={value}'
        for option, given in _given(options).items()
        for value in (given if isinstance(given, list) else [given])
    ]


def _given(options: Namespace) -> dict[str, str | list[str]]:
    pairs = {flag: getattr(options, flag[2:].replace('-', '_')) for flag in _OPTIONS.values()}
    return {flag: value for flag, value in pairs.items() if value is not None}


def variables(options: Namespace, environment: Mapping[str, str]) -> dict[str, str]:
    """
    Return the environment variables that the options stand for.

    Args:
        options: the parsed command line.
        environment: the variables as they are; those that no option overrides are checked.

    Raises:
        UsageError: an option or a variable has an invalid value.
    """
    given = _given(options)
    chosen = {}
    for variable, flag in _OPTIONS.items():
        if flag in given:
            value = given[flag]
            values = value if isinstance(value, list) else [value]
            checked = [_CHECKS[variable](value, f'{flag} {value}') for value in values]
            chosen[variable] = ';'.join(checked)
        elif environment.get(variable):
            _check_inherited(variable, environment[variable])
    return chosen


def _check_inherited(variable: str, text: str) -> None:
    """Check a variable of the shell; lists may have empty entries, whose position matters."""
    values = text.split(';') if variable in (PEERS, SERVER) else [text]
    for value in filter(None, values):
        checked = _CHECKS[variable](value, f'{variable}={text}')
        if variable == RANGE and checked != value:
            raise UsageError(f'{variable}={text}: rcl wants capital letters, {checked}')


def _checked_domain(value: str, source: str) -> str:
    if not is_domain(value):
        raise UsageError(f'{source}: {OF_DOMAINS}')
    return value


def _checked_range(value: str, source: str) -> str:
    if value.upper() not in RANGES:
        raise UsageError(f'{source}: a discovery range is one of {", ".join(RANGES)}')
    return value.upper()


def _checked_peer(value: str, source: str) -> str:
    if not (match := _ADDRESS.fullmatch(value)) or match['port'] or not match['host']:
        raise UsageError(f'{source}: a peer is the address or the name of a host, without a port')
    _must_resolve(match['host'], source)
    return value


def _checked_server(value: str, source: str) -> str:
    match = _ADDRESS.fullmatch(value)
    port = int(match['port'] or _SERVER_PORT) if match else 0
    if match is None or not 0 < port < 65536:
        raise UsageError(f'{source}: a discovery server is HOST or HOST:PORT, as 10.0.0.9:11811')
    _must_resolve(match['host'] or match['locator'], source)
    return value if match['port'] else f'{value}:{_SERVER_PORT}'


def _must_resolve(host: str, source: str) -> None:
    try:
        socket.getaddrinfo(host, None)
    except (OSError, UnicodeError) as error:
        raise UsageError(
            f"{source}: no address is known for the host '{host}' ({error})"
        ) from None


_CHECKS = {
    DOMAIN: _checked_domain,
    RANGE: _checked_range,
    PEERS: _checked_peer,
    SERVER: _checked_server,
}
"""Each takes a value and the option or variable that it is from, and returns what to set."""


def discovery_text(environment: Mapping[str, str]) -> str:
    """Return in a few words who discovers the nodes: ``ROS domain 5, this host only``."""
    domain = f'ROS domain {environment.get(DOMAIN) or 0}'
    if server := environment.get(SERVER):
        return f'{domain}, found through the discovery server {server.strip(";")}'
    kinds = {'LOCALHOST': 'this host only', 'OFF': 'nobody is found'}
    reach = kinds.get(environment.get(RANGE) or 'LOCALHOST')
    peers = environment.get(PEERS)
    text = f'{domain}, {reach or "the whole network"}' + (f' and {peers}' if peers else '')
    return text if reach else f'{text}: whoever is in it can drive'


def exports(environment: Mapping[str, str]) -> list[str]:
    """Return the exports that another shell needs, after ``scripts/activate``, for discovery."""
    usual = {DOMAIN: '0', RANGE: 'LOCALHOST'}
    return [
        f"export {name}='{value}'" if ';' in value else f'export {name}={value}'
        for name in _OPTIONS
        if (value := environment.get(name, '')) and value != usual.get(name)
    ]


def child_environment(executable: Path, base: Mapping[str, str]) -> dict[str, str]:
    """
    Return the environment variables for an executable.

    Python's output is unbuffered, since it goes to a pipe and should appear at once. A Python of
    another virtual environment gets neither the ROS wheels' guard nor their libraries.

    Args:
        executable: its path.
        base: the variables of the bring-up.

    Raises:
        OSError: the executable cannot be read.
    """
    environment = {**base, 'PYTHONUNBUFFERED': '1'}
    if WHEELS_GUARD in base and not is_of_this_python(executable, base):
        del environment[WHEELS_GUARD]
        if interpreter_of(executable, base):
            _drop_wheels_libraries(environment)
    return environment


def is_of_this_python(executable: Path, base: Mapping[str, str] = os.environ) -> bool:
    """Return whether a file is a Python script for the interpreter of this process."""
    interpreter = interpreter_of(executable, base)
    return interpreter is not None and _same_folder(interpreter.parent, Path(sys.prefix) / 'bin')


def _same_folder(one: Path, other: Path) -> bool:
    return one.exists() and other.exists() and one.samefile(other)


def interpreter_of(executable: Path, base: Mapping[str, str]) -> Path | None:
    """Return the interpreter that a Python script names at its beginning; None: it is none."""
    with executable.open('rb') as file:
        first_line, second_line = file.readline(512), file.readline(_LONGEST_PATH)
    if by_shell := _EXEC_OF_SHELL.match(second_line):
        named = os.fsdecode(by_shell[1] or by_shell[2])
        return Path(
            os.path.normpath(named.replace(_OWN_FOLDER, str(executable.absolute().parent)))
        )
    if not first_line.startswith(b'#!'):
        return None
    words = os.fsdecode(first_line[2:]).split()
    if len(words) > 1 and Path(words[0]).name == 'env':
        words = [shutil.which(words[-1], path=base.get('PATH')) or words[-1]]
    if not words or not Path(words[0]).name.startswith('python'):
        return None
    return Path(words[0])


def _drop_wheels_libraries(environment: dict[str, str]) -> None:
    folders = environment.get('LD_LIBRARY_PATH', '').split(os.pathsep)
    kept = [folder for folder in folders if not folder.startswith(sys.prefix + os.sep)]
    environment['LD_LIBRARY_PATH'] = os.pathsep.join(kept)


def setup_command(package: str, base: Mapping[str, str]) -> str:
    """
    Return the command after which ROS commands of another shell reach the nodes of this one.

    Args:
        package: whose workspace to source.
        base: the environment variables of this shell.
    """
    prefix = package_prefix(package)
    install = prefix if (prefix / 'setup.bash').is_file() else prefix.parent
    candidates = [install.parent / 'scripts/activate', install / 'setup.bash']
    script = next((path for path in candidates if path.is_file()), None)
    steps = [f'source {_shortest(script)}'] if script else []
    return ' && '.join([*steps, *exports(base)])


def _shortest(path: Path) -> Path:
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
