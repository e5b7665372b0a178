# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Environment variables, and the files and servers that they name."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from importlib import metadata
import importlib.util
import os
import re
import sys
from xml.etree import ElementTree

from amr_description.doctor.observations.environment import Environment, PROFILES
from amr_description.ros.transport import OWN_PROFILES
from amr_description.ros.udp_sockets import udp_sockets
from amr_description.text import one_line

_PREFIXES = (
    'ROS_',
    'RMW_',
    'RCUTILS_',
    'FASTRTPS_',
    'FASTDDS_',
    'AMENT_',
    'COLCON_',
    'PYTHONPATH',
    'LD_LIBRARY_PATH',
    'CONDA_PREFIX',
    'VIRTUAL_ENV',
)
_KEYSTORE = 'ROS_SECURITY_KEYSTORE'
_SERVER = 'ROS_DISCOVERY_SERVER'
_SERVER_PORT = 11811
_THIS_HOST = ('localhost', '127.0.0.1')
_LISTS = ('AMENT_PREFIX_PATH',)
_LIBRARY = re.compile(r'lib(rmw_\w+?)\.so$')
_MIDDLEWARES = ('fastrtps', 'fastrtps_dynamic', 'cyclonedds', 'connextdds', 'zenoh', 'gurumdds')


def read_environment(variables: Mapping[str, str]) -> Environment:
    """Observe environment variables, those of this process or of another one."""
    # Others may be secret; profiles that this package sets for itself are no user's choice.
    kept = {
        name: value
        for name, value in variables.items()
        if name.startswith(_PREFIXES)
        and (name not in PROFILES or os.path.realpath(value) not in OWN_PROFILES)
    }
    return Environment(
        variables=kept,
        file_faults=dict(_file_faults(kept)),
        missing_folders={name: _missing(kept.get(name, '')) for name in _LISTS},
        rmw_implementations=_rmw_implementations(kept),
        is_from_wheels=_is_from_wheels(),
        fastdds_version=_version_of('ros-fastrtps'),
        python_version=f'{sys.version_info.major}.{sys.version_info.minor}',
        unheard_servers=tuple(_unheard_servers(kept.get(_SERVER, ''))),
    )


def _file_faults(variables: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    for name in PROFILES:
        if variables.get(name) and (fault := _xml_fault(variables[name])):
            yield name, fault
    is_enforced = (
        variables.get('ROS_SECURITY_ENABLE') == 'true'
        and variables.get('ROS_SECURITY_STRATEGY') == 'Enforce'
    )
    if is_enforced and not variables.get(_KEYSTORE):
        yield _KEYSTORE, 'is not set'
    elif is_enforced and not os.path.isdir(variables[_KEYSTORE]):
        yield _KEYSTORE, f'names no folder: {variables[_KEYSTORE]}'


def _xml_fault(file: str) -> str:
    """Return why a file cannot be read as XML; empty: it can be."""
    try:
        ElementTree.parse(file)
    except FileNotFoundError:
        return 'is not there'
    except OSError as error:
        return f'cannot be read: {error.strerror}'
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        return f'is no XML: {one_line(str(error))}'
    return ''


def _missing(folders: str) -> tuple[str, ...]:
    return tuple(each for each in folders.split(':') if each and not os.path.isdir(each))


def _rmw_implementations(variables: Mapping[str, str]) -> frozenset[str]:
    """Return the middlewares whose library is beside rclpy, or where libraries are looked for."""
    found = set()
    for name in _MIDDLEWARES:
        with suppress(ImportError, ValueError):
            if importlib.util.find_spec(f'rmw_{name}_cpp'):
                found.add(f'rmw_{name}_cpp')
    for folder in variables.get('LD_LIBRARY_PATH', '').split(':'):
        with suppress(OSError):
            found |= {m[1] for name in os.listdir(folder or '.') if (m := _LIBRARY.match(name))}
    return frozenset(
        name for name in found if name.removeprefix('rmw_').rpartition('_cpp')[0] in _MIDDLEWARES
    )


def _version_of(wheel: str) -> str:
    try:
        return metadata.version(wheel)
    except metadata.PackageNotFoundError:  # of /opt/ros
        return ''


def _is_from_wheels() -> bool:
    spec = importlib.util.find_spec('rclpy')
    return spec is None or not (spec.origin or '').startswith('/opt/ros/')


def _unheard_servers(text: str) -> Iterator[str]:
    """Yield the servers of this host at whose port no socket is."""
    try:
        sockets = udp_sockets() if text else {}
    except OSError:
        return
    for server in filter(None, text.split(';')):
        host, _, port = server.partition(':')
        number = int(port) if port.isdecimal() else _SERVER_PORT
        if host in _THIS_HOST and number not in sockets:
            yield server
