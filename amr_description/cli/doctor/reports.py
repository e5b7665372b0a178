# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The reports of ``ros2 doctor --report``, under the names that they have in the original."""

from collections.abc import Collection, Iterable, Iterator
from pathlib import Path
import platform
import re
from typing import TypeAlias

from amr_description.doctor.observations import Observations
from amr_description.doctor.rules.qos import faults, QosFault

Items: TypeAlias = list[tuple[str, object]]

_VERSION = re.compile(r'<version[^>]*>\s*([^<\s]+)\s*</version>')
_NARROWEST = 8
_OF_FAMILIES: dict[str, set[str]] = {
    'NETWORK CONFIGURATION': {'machine', 'environment'},
    'PACKAGE VERSIONS': set(),
    'PLATFORM INFORMATION': {'machine'},
    'PROCESSES': {'processes'},
    'QOS COMPATIBILITY LIST': {'qos'},
    'RMW MIDDLEWARE': {'environment', 'processes'},
    'ROS 2 INFORMATION': {'environment'},
    'ROS ENVIRONMENT': {'environment'},
}
"""Which families of rules a report is of; what is not here, is of all others."""


def print_reports(
    seen: Observations, families: Collection[str] | None = None, *, packages: bool
) -> None:
    """
    Print reports.

    Args:
        seen: what was observed.
        families: of rules, whose reports are wanted; None: all.
        packages: whether to print the versions of packages.
    """
    for name, items in _reports(seen, packages):
        if families is None or _is_wanted(name, families):
            print(f'\n   {name}')
            longest = max((len(key) for key, _ in items), default=0)
            width = longest + 4 if longest >= _NARROWEST else _NARROWEST
            for key, value in items:
                print(f'{key:{width}}: {value}')


def _is_wanted(name: str, families: Collection[str]) -> bool:
    known = {each for named in _OF_FAMILIES.values() for each in named}
    return not _OF_FAMILIES.get(name, {*families} - known).isdisjoint(families)


def _reports(seen: Observations, packages: bool) -> Iterator[tuple[str, Items]]:
    yield 'NETWORK CONFIGURATION', [*_network(seen)]
    if packages:
        yield 'PACKAGE VERSIONS', [*_packages()]
    yield 'PLATFORM INFORMATION', _platform(seen)
    yield 'PROCESSES', [*_processes(seen)]
    yield 'QOS COMPATIBILITY LIST', [*_qos(seen)]
    yield 'RMW MIDDLEWARE', [('middleware name', _value(seen, 'RMW_IMPLEMENTATION'))]
    yield 'ROS 2 INFORMATION', [('distribution name', 'jazzy'), ('distribution type', 'ros2')]
    yield 'ROS ENVIRONMENT', [*_environment(seen)]
    yield 'TOPIC LIST', [*_topics(seen)]


def _network(seen: Observations) -> Iterator[tuple[str, object]]:
    for each in seen.machine.interfaces if seen.machine else ():
        flags = {
            'UP': each.is_up,
            'LOOPBACK': each.is_loopback,
            'MULTICAST': each.has_multicast,
            'POINTOPOINT': each.is_tunnel,
        }
        for address in each.addresses:
            yield 'inet', address
        yield 'device', each.name
        yield 'flags', ','.join(name for name, is_set in flags.items() if is_set)


def _packages() -> Iterable[tuple[str, object]]:
    """Return the versions of packages; which is the latest is not asked on the network."""
    from amr_description.ament_index import package_prefix, packages

    for name in sorted(packages()):
        file = Path(package_prefix(name), 'share', name, 'package.xml')
        text = file.read_text(errors='replace') if file.is_file() else ''
        match = _VERSION.search(text)
        yield name, f'local={match[1] if match else "N/A"}'


def _platform(seen: Observations) -> Items:
    items: Items = [
        ('system', platform.system()),
        ('platform info', platform.platform()),
        ('release', platform.release()),
        ('processor', platform.machine()),
    ]
    if seen.machine:
        python = seen.machine.python
        synchronised = {True: 'yes', False: 'no', None: 'not known'}
        items += [
            ('c library', seen.machine.c_library),
            ('python', f'{python.version} ({python.executable})'),
            ('rclpy', f'{python.rclpy_version} ({python.rclpy_folder})'),
            ('memory', f'{seen.machine.free_memory} of {seen.machine.memory} bytes free'),
            ('clock synchronised', synchronised[seen.machine.is_clock_synchronised]),
        ]
        items += [
            (each.purpose, f'{each.folder}: {each.free} of {each.total} bytes free')
            for each in seen.machine.disks
        ]
    return items


def _processes(seen: Observations) -> Iterator[tuple[str, object]]:
    for each in seen.processes.processes if seen.processes else ():
        yield f'pid {each.pid}', f'domain {each.domain}, state {each.state}: {each.command}'


def _qos(seen: Observations) -> Iterator[tuple[str, object]]:
    found = False
    for topic in seen.graph.topics if seen.graph else ():
        for publisher in topic.publishers:
            for subscription in topic.subscriptions:
                found = True
                wrong = faults(publisher.qos, subscription.qos)
                yield 'topic [type]', f'{topic.name} [{publisher.type_name}]'
                yield 'publisher node', publisher.node
                yield 'subscriber node', subscription.node
                yield 'compatibility status', '; '.join(map(_incompatible, wrong)) or 'OK'
    if not found:
        yield 'compatibility status', 'No publisher/subscriber pairs found'


def _incompatible(fault: QosFault) -> str:
    return f'ERROR: {fault.policy}: {fault.offered} is offered, {fault.requested} requested'


def _topics(seen: Observations) -> Iterator[tuple[str, object]]:
    topics = seen.graph.topics if seen.graph else ()
    if not topics:
        yield 'topic', 'none'
    for each in topics:
        yield 'topic', each.name
        yield 'publisher count', len(each.publishers)
        yield 'subscriber count', len(each.subscriptions)


def _environment(seen: Observations) -> Iterator[tuple[str, object]]:
    if seen.environment:
        yield from sorted(seen.environment.variables.items())


def _value(seen: Observations, name: str) -> str:
    return (seen.environment.value(name) if seen.environment else '') or 'rmw_fastrtps_cpp'
