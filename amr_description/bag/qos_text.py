# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
QoS profiles as YAML: in bags, and in files of overrides.

Bags of version 9 name the policies, those before have the numbers of rmw.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from typing import Any

from amr_description.bag import yaml_text
from amr_description.bag.yaml_text import shown
from amr_description.errors import BagError
from amr_description.text import did_you_mean, quote, shorten

_LARGEST = 2**64 - 1  # size_t of C++
INFINITE = 2**63 - 1
"""Nanoseconds."""
_SECOND = 10**9
# What Fast DDS of older distributions meant by infinite, in s and ns.
_OTHER_INFINITES = {(2147483647, 4294967295), (2147483647, 0)}
POLICIES: dict[str, tuple[str, ...]] = {
    'history': ('system_default', 'keep_last', 'keep_all', 'unknown'),
    'reliability': ('system_default', 'reliable', 'best_effort', 'unknown', 'best_available'),
    'durability': ('system_default', 'transient_local', 'volatile', 'unknown', 'best_available'),
    'liveliness': (
        'system_default',
        'automatic',
        'manual_by_node',
        'manual_by_topic',
        'unknown',
        'best_available',
    ),
}
"""The names of rmw, each at the place of its number."""
_DURATIONS = ('deadline', 'lifespan', 'liveliness_lease_duration')


@dataclass(frozen=True)
class QosProfile:
    """A profile; by default that of rclpy with a depth of 10. Durations are ns."""

    history: str = 'keep_last'
    depth: int = 10
    reliability: str = 'reliable'
    durability: str = 'volatile'
    deadline: int = INFINITE
    lifespan: int = INFINITE
    liveliness: str = 'automatic'
    liveliness_lease_duration: int = INFINITE
    avoid_ros_namespace_conventions: bool = False


def to_node(profile: QosProfile, *, named: bool = True) -> dict[str, Any]:
    """Return what YAML has of a profile; ``named``: policies by name, as version 9 has them."""
    node: dict[str, Any] = {}
    for field in fields(profile):
        value = getattr(profile, field.name)
        if field.name in _DURATIONS:
            node[field.name] = dict(zip(('sec', 'nsec'), divmod(value, _SECOND), strict=True))
        elif field.name in POLICIES and not named:
            node[field.name] = POLICIES[field.name].index(value)
        else:
            node[field.name] = value
    return node


def to_text(profiles: Iterable[QosProfile], *, named: bool = True) -> str:
    """Return the YAML of a list of profiles; of none the empty text."""
    nodes = [to_node(profile, named=named) for profile in profiles]
    return yaml_text.dump(nodes).rstrip('\n') if nodes else ''


def from_node(node: Any, what: str = 'QoS profile') -> QosProfile:
    """
    Return the profile of a mapping with any of the fields; the others are as by default.

    Raises BagError, which begins with ``what``.
    """
    if not isinstance(node, Mapping):
        raise BagError(
            f'{what}: want a mapping as {{reliability: best_effort}}, not {shown(node)}'
        )
    known = [field.name for field in fields(QosProfile)]
    values = {}
    for name, value in node.items():
        if name not in known:
            suggestion = did_you_mean(str(name), known)
            raise BagError(f'{what}: there is no policy {quote(str(name))}{suggestion}')
        values[name] = _value(name, value, f'{what}: {name}')
    return QosProfile(**values)


def from_text(text: str, what: str = 'offered_qos_profiles') -> tuple[QosProfile, ...]:
    """Return the profiles of a YAML text, which may be empty. Raises BagError."""
    return from_nodes(yaml_text.load(text, what), what)


def from_nodes(nodes: Any, what: str = 'offered_qos_profiles') -> tuple[QosProfile, ...]:
    """Return the profiles of a list of mappings, or of nothing. Raises BagError."""
    if not nodes:
        return ()
    if not isinstance(nodes, list):
        raise BagError(f'{what}: want a list of QoS profiles, not {shown(nodes)}')
    return tuple(from_node(node, what) for node in nodes)


def overrides_from_text(text: str, path: str) -> dict[str, QosProfile]:
    """
    Return the profile of each topic of a file of overrides, by its full name.

    Raises BagError, which begins with ``path``.
    """
    nodes = yaml_text.load(text, path)
    if not isinstance(nodes, Mapping):
        raise BagError(f'{path}: want a QoS profile for each topic, not {shown(nodes)}')
    return {
        str(topic): from_node(node, f'{path}: {shorten(str(topic))}')
        for topic, node in nodes.items()
    }


def _value(name: str, value: Any, what: str) -> Any:
    if name in POLICIES:
        return _policy(POLICIES[name], value, what)
    if name in _DURATIONS:
        return _duration(value, what)
    wanted = bool if name == 'avoid_ros_namespace_conventions' else int
    if type(value) is not wanted or value < 0:
        raise BagError(
            f'{what}: want {"true or false" if wanted is bool else "a number from 0 on"}, '
            f'not {shown(value)}'
        )
    return value if wanted is bool else min(value, _LARGEST)


def _policy(names: tuple[str, ...], value: Any, what: str) -> str:
    if type(value) is int and 0 <= value < len(names):
        return names[value]
    if isinstance(value, str) and value in names:
        return value
    raise BagError(f'{what}: want one of {", ".join(names)}, not {shown(value)}')


def _duration(value: Any, what: str) -> int:
    sec, nsec = (
        (value.get('sec'), value.get('nsec')) if isinstance(value, Mapping) else (None, None)
    )
    if type(sec) is not int or type(nsec) is not int:
        raise BagError(f'{what}: want {{sec: S, nsec: N}}, not {shown(value)}')
    if sec < 0 or nsec < 0:
        raise BagError(f'{what}: a duration must not be negative: {shown(value)}')
    return INFINITE if (sec, nsec) in _OTHER_INFINITES else min(sec * _SECOND + nsec, INFINITE)
