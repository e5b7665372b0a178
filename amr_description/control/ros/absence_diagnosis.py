# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Looks for a controller manager that does not come: what is there of it, and what is not.

What keeps a program from its controller manager, in words: no manager, no description, no clock.

What is seen of the graph comes from :mod:`amr_description.control.ros.absence_diagnosis`; this module
imports no rclpy.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import time

from rcl_interfaces.msg import Log
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.ros.messages import nanoseconds
from amr_description.ros.qos import CLOCK
from amr_description.ros.rclpy_internals import NodeNameNonExistentError
from amr_description.ros.service_calls import call, NoAnswerError, wait_until


@dataclass(frozen=True)
class DescriptionObservation:
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
class ClockObservation:
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
    description: DescriptionObservation | None = None
    clock: ClockObservation | None = None
    needs_clock: bool = False
    """``use_sim_time`` is true for the manager or for this program."""


def missing(sight: ManagerSight) -> str:
    """Say what is missing and what would do, in one line."""
    parts = _manager_parts(sight)
    fault = clock_fault(sight.clock, needed=sight.needs_clock) if sight.clock else ''
    return '; '.join([*parts, *([fault] if fault else [])])


def clock_fault(clock: ClockObservation, *, needed: bool) -> str:
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


def _description_fault(manager: str, description: DescriptionObservation | None) -> str:
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


_ROSOUT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_DISCOVERY = 1.0
"""s: how long to look around before it is said that nobody is there."""
_PATIENCE = 1.0
"""s: for what comes at once, if it comes."""
_CLOCK_PATIENCE = 2.0
"""s: for two messages on ``/clock``."""

_BURST = 0.1
"""s: for the lines behind the first, which are on their way with it."""

_LISTS_CONTROLLERS = 'controller_manager_msgs/srv/ListControllers'
_SPAWNS_ENTITIES = 'simulation_interfaces/srv/SpawnEntity'
_STRING = 'std_msgs/msg/String'
_DESCRIPTION = 'robot_description'


class ManagerProbe:
    """Looks at the graph for ``manager``, an absolute name, by means of ``node``."""

    def __init__(self, node: Node, manager: str) -> None:
        self._node = node
        self._manager = manager
        self._namespace, _, self._name = manager.rpartition('/')
        self._start = time.monotonic()

    def missing(self) -> str:
        """Say what keeps the manager from being there; takes up to three seconds."""
        return missing(self.look())

    def clock_fault(self) -> str:
        """Say what is wrong with the clock that the manager goes by; empty: nothing."""
        return clock_fault(self._clock(), needed=self._needs_clock(is_there=True))

    def look(self) -> ManagerSight:
        """Return what is seen of it."""
        left = _DISCOVERY - (time.monotonic() - self._start)
        if left > 0.0:
            wait_until(self._node, self._anybody, timeout=left)
        is_there = self._manager in self._nodes()
        needs_clock = self._needs_clock(is_there=is_there)
        return ManagerSight(
            manager=self._manager,
            domain=self._node.context.get_domain_id(),
            is_there=is_there,
            others=tuple(sorted(self._managers() - {self._manager})),
            simulators=tuple(self._servers(_SPAWNS_ENTITIES)),
            description=self._description() if is_there else None,
            clock=self._clock(),
            needs_clock=needs_clock,
        )

    def _anybody(self) -> bool | None:
        """Tell whether there is something to say."""
        found = self._managers() or self._servers(_SPAWNS_ENTITIES)
        return bool(found) or None

    def _nodes(self) -> set[str]:
        found = self._node.get_node_names_and_namespaces()
        return {f'{namespace.rstrip("/")}/{name}' for name, namespace in found}

    def _managers(self) -> set[str]:
        """Return the nodes that serve as one, and those that have its name."""
        namesakes = {each for each in self._nodes() if each.rpartition('/')[2] == self._name}
        return namesakes | set(self._servers(_LISTS_CONTROLLERS))

    def _servers(self, service_type: str) -> list[str]:
        """Return the nodes that offer such a service below their own names."""
        services = self._node.get_service_names_and_types()  # also those that somebody waits for
        return sorted(
            name.rpartition('/')[0]
            for name, types in services
            if service_type in types and self._node.count_services(name)
        )

    def _needs_clock(self, *, is_there: bool) -> bool:
        if self._node.get_parameter('use_sim_time').value:
            return True
        if not is_there:
            return False
        request = GetParameters.Request(names=['use_sim_time'])
        with suppress(NoAnswerError):
            service = f'{self._manager}/get_parameters'
            values = call(self._node, GetParameters, service, request, timeout=_PATIENCE).values
            return bool(values) and values[0].bool_value
        return False

    def _clock(self) -> ClockObservation:
        """Listen until time is seen to go on."""
        publishers = self._node.count_publishers('/clock')
        if not publishers:
            return ClockObservation(0)
        with _listening(self._node, Clock, '/clock', CLOCK) as messages:

            def sight() -> ClockObservation:
                stamps = (nanoseconds(message.clock) for message in messages)
                return ClockObservation(publishers, tuple(stamps))

            wait_until(self._node, lambda: sight().runs or None, timeout=_CLOCK_PATIENCE)
            return sight()

    def _description(self) -> DescriptionObservation:
        """Look at the topic that the manager subscribes to; it may be remapped."""
        topic = f'{self._namespace}/{_DESCRIPTION}'
        with suppress(NodeNameNonExistentError):  # it has gone since
            heard = self._node.get_subscriber_names_and_types_by_node(
                self._name, self._namespace or '/'
            )
            topic = next((name for name, types in heard if _STRING in types), topic)
        offers = self._node.get_publishers_info_by_topic(topic)
        latched = [o for o in offers if o.qos_profile.durability != DurabilityPolicy.VOLATILE]
        return DescriptionObservation(
            topic,
            len(offers),
            len(latched),
            elsewhere=tuple(
                name
                for name, types in self._node.get_topic_names_and_types()
                if _STRING in types
                and name.rpartition('/')[2] == _DESCRIPTION
                and name != topic
                and self._node.count_publishers(name)
            ),
            errors=tuple(errors_of(self._node, [self._manager])[-2:] if latched else ()),
        )


def errors_of(node: Node, names: Sequence[str], since: float = 0.0) -> list[str]:
    """
    Return what nodes have logged as errors, each line once, in order.

    Taken from the latched ``/rosout``. ``names``: absolute; ``since``: s, Unix time.
    """
    loggers = {name.strip('/').replace('/', '.') for name in names}
    with _listening(node, Log, '/rosout', _ROSOUT) as messages:

        def lines() -> list[str]:
            return [
                message.msg
                for message in messages
                if message.level >= Log.ERROR
                and message.name in loggers
                and nanoseconds(message.stamp) >= since * NANOSECONDS
            ]

        if wait_until(node, lambda: lines() or None, timeout=_PATIENCE):
            wait_until(node, lambda: None, timeout=_BURST)
        return list(dict.fromkeys(lines()))


@contextmanager
def _listening[Message](
    node: Node, message_type: type[Message], topic: str, qos: QoSProfile
) -> Iterator[list[Message]]:
    """Subscribe while inside; yields the list that fills."""
    messages: list[Message] = []
    subscription = node.create_subscription(message_type, topic, messages.append, qos)
    try:
        yield messages
    finally:
        node.destroy_subscription(subscription)
