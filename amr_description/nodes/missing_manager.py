# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What keeps a program from its controller manager, in words: no manager, no description, no clock.

What is seen of the graph comes from :mod:`amr_description.nodes.manager_search`; this module
imports no rclpy.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from amr_description.control.interfaces import NANOSECONDS


@dataclass(frozen=True)
class DescriptionSight:
    """What is seen of the robot description that a manager waits for."""

    topic: str
    publishers: int = 0
    latched: int = 0
    """How many of the publishers are TRANSIENT_LOCAL; the subscription demands it."""
    elsewhere: tuple[str, ...] = ()
    """Other topics of that kind which somebody publishes."""
    errors: tuple[str, ...] = ()
    """What the manager has logged as errors of late."""


@dataclass(frozen=True)
class ClockSight:
    """What is seen of ``/clock``; ``stamps``: what came from it in a while, ns."""

    publishers: int
    stamps: tuple[int, ...] = ()

    @property
    def runs(self) -> bool:
        """Whether time goes on."""
        return len(set(self.stamps)) > 1


@dataclass(frozen=True)
class ManagerSight:
    """What is seen by a program that waits for ``manager``, an absolute name."""

    manager: str
    domain: int = 0
    is_there: bool = False
    """There is a node of that name."""
    others: tuple[str, ...] = ()
    """The managers under other names."""
    simulators: tuple[str, ...] = ()
    """The nodes that robots can be spawned with."""
    description: DescriptionSight | None = None
    clock: ClockSight | None = None
    needs_clock: bool = False
    """``use_sim_time`` is true for the manager or for this program."""


def missing(sight: ManagerSight) -> str:
    """Say what is missing and what would do, in one line."""
    parts = _manager_parts(sight)
    fault = clock_fault(sight.clock, needed=sight.needs_clock) if sight.clock else ''
    return '; '.join([*parts, *([fault] if fault else [])])


def clock_fault(clock: ClockSight, *, needed: bool) -> str:
    """Say what is wrong with ``/clock``; empty: nothing, or it is not needed and not there."""
    if clock.runs:
        return ''
    if not clock.publishers:
        return (
            'there is no clock: use_sim_time is true, and nobody publishes /clock; start the '
            'simulation, or set use_sim_time to false'
            if needed
            else ''
        )
    if not clock.stamps:
        return 'nothing comes from /clock, which has a publisher: is the simulation paused?'
    now = clock.stamps[-1] / NANOSECONDS
    return f'/clock stands still at {now:.3f} s: is the simulation paused?'


def _manager_parts(sight: ManagerSight) -> Iterator[str]:
    if sight.is_there:
        yield _description_fault(sight.manager, sight.description)
        return
    if sight.others:
        yield (
            f'there is no node {sight.manager}, but {", ".join(sight.others)}; name it with '
            f'-c {sight.others[0]}, or its namespace with --ros-args -r __ns:=…'
        )
        return
    yield f'there is no controller manager in ROS domain {sight.domain}'
    if sight.simulators:
        yield (
            f'the simulator {", ".join(sight.simulators)} starts one as soon as a robot with a '
            '<ros2_control> block is spawned'
        )
    else:
        yield 'a simulator starts one for its robot, ros2_control_node for a real one'


def _description_fault(manager: str, description: DescriptionSight | None) -> str:
    """Say why a manager that is there has no services."""
    if description is None:
        return f'{manager} is there, but has no services yet'
    topic = description.topic
    waits = f'{manager} is there, and waits for a robot description on {topic}'
    if not description.publishers:
        elsewhere = ', '.join(description.elsewhere)
        return (
            f'{waits}, which nobody publishes; there is {elsewhere}: remap one of the two'
            if elsewhere
            else f'{waits}, which nobody publishes: start robot_state_publisher'
        )
    if not description.latched:
        return f'{waits}, whose publisher is VOLATILE: it must be TRANSIENT_LOCAL to reach it'
    number = description.publishers
    offered = f'{waits}, which has {number} publisher{"s" if number > 1 else ""}'
    if description.errors:
        return f'{offered}; its log says: {" ".join(description.errors)}'
    return f'{offered}: see its log for what keeps it from using that'
