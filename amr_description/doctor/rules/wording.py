# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes, types and times in the text of findings."""

from collections.abc import Iterable, Sequence
import re

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations.graph import ObservedEndpoint

_SHOWN = 4
_PROGRAM = '_ros2cli'
_PASSES_ON = re.compile(r'bridge|rosbag|record|relay|republish|throttle')
_PLAYER = 'rosbag2_player'


def names_of(endpoints: Iterable[ObservedEndpoint]) -> str:
    """Return the nodes of endpoints, each once, the first few."""
    return listed([each.node for each in endpoints])


def listed(names: Sequence[str]) -> str:
    """Return names, each once, the first few; a hidden node of the ``ros2`` command as that."""
    found = list(dict.fromkeys(named(name) for name in names))
    more = f' and {len(found) - _SHOWN} more' if len(found) > _SHOWN else ''
    return ', '.join(found[:_SHOWN]) + more


def named(node: str) -> str:
    """Return the name of a node."""
    return f'ros2 ({node})' if node.rpartition('/')[2].startswith(_PROGRAM) else node


def passes_on(node: str) -> bool:
    """Return whether a node passes on what it hears, as it is, and waits for none of it."""
    return _PASSES_ON.search(node.rpartition('/')[2]) is not None


def short_type(name: str, other: str) -> str:
    """Return a type without its package, if that tells it from another one."""
    short = name.rpartition('/')[2]
    return name if short == other.rpartition('/')[2] else short


def seconds(time: float) -> str:
    """Return a time, ns, as text."""
    return f'{time / NANOSECONDS:.3g} s'


def right_clock(publishers: Iterable[str]) -> str:
    """Return what mends stamps that are not of the system clock, where nobody simulates time."""
    if any(_PLAYER in each for each in publishers):
        return (
            'play the bag with --clock 100, and start what hears it with -p use_sim_time:=true: '
            'its stamps are of the time when it was recorded'
        )
    return (
        'see which machine is wrong (timedatectl on each), and synchronize its clock while the '
        'robot stands: sudo chronyc makestep'
    )
