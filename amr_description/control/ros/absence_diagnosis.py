# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Why a controller manager does not come: what a program that waits for one observes, in words.

:class:`ManagerProbe` looks at the ROS graph and returns observations; :func:`explain` makes one
line of them: what is missing, and what to do about it. Timeouts are in s.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import time
from typing import TypeVar

from rcl_interfaces.msg import Log
from rcl_interfaces.srv import GetParameters
from rclpy.event_handler import QoSSubscriptionMatchedInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.errors import NoAnswerError
from amr_description.plugin_errors import is_traceback
from amr_description.ros.messages import nanoseconds
from amr_description.ros.qos import CLOCK
from amr_description.ros.rclpy_internals import NodeNameNonExistentError
from amr_description.ros.service_calls import call, wait_until

Message = TypeVar('Message')

_ROSOUT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_DISCOVERY_TIME = 1.0
"""s: how long to look around before it is concluded that nobody is there."""
_REPLY_TIMEOUT = 1.0
"""s: for what comes at once, if it comes."""
_MATCH_TIMEOUT = 5.0
"""s: for a subscription to match the publishers that are known."""
_CLOCK_TIMEOUT = 2.0
"""s: for two messages on ``/clock``."""
_BURST = 0.1
"""s: for the log lines behind the first, which are on their way with it."""

_LIST_CONTROLLERS = 'controller_manager_msgs/srv/ListControllers'
_SPAWN_ENTITY = 'simulation_interfaces/srv/SpawnEntity'
_STRING = 'std_msgs/msg/String'
_DESCRIPTION = 'robot_description'


@dataclass(frozen=True)
class DescriptionObservation:
    """The robot description that a manager waits for."""

    topic: str
    publishers: int = 0
    latched: int = 0
    """How many of the publishers are TRANSIENT_LOCAL; the subscription requires it."""
    elsewhere: tuple[str, ...] = ()
    """Other topics of that name and type which somebody publishes."""
    errors: tuple[str, ...] = ()
    """The latest errors in the manager's log."""


@dataclass(frozen=True)
class ClockObservation:
    """``/clock``; ``stamps``: of the messages that came in a while, ns."""

    publishers: int
    stamps: tuple[int, ...] = ()

    @property
    def runs(self) -> bool:
        """Whether time goes on."""
        return len(set(self.stamps)) > 1


@dataclass(frozen=True)
class ManagerObservation:
    """What a program that waits for ``manager``, an absolute name, finds in the graph."""

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


def explain(observation: ManagerObservation) -> str:
    """Return what is missing and what to do about it, in one line."""
    parts = [_explain_manager(observation)]
    if observation.clock is not None:
        parts.append(explain_clock(observation.clock, needed=observation.needs_clock))
    return '; '.join(filter(None, parts))


def explain_clock(clock: ClockObservation, *, needed: bool) -> str:
    """Return what is wrong with ``/clock``; empty: nothing, or it is neither needed nor there."""
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


def _explain_manager(observation: ManagerObservation) -> str:
    if observation.is_there:
        return _explain_description(observation.manager, observation.description)
    if observation.others:
        return (
            f'there is no node {observation.manager}, but {", ".join(observation.others)}; name '
            f'it with -c {observation.others[0]}, or its namespace with --ros-args -r __ns:=…'
        )
    remedy = (
        f'the simulator {", ".join(observation.simulators)} starts one as soon as a robot with a '
        '<ros2_control> block is spawned'
        if observation.simulators
        else 'a simulator starts one for its robot, ros2_control_node for a real one'
    )
    return f'there is no controller manager in ROS domain {observation.domain}; {remedy}'


def _explain_description(manager: str, description: DescriptionObservation | None) -> str:
    """Return why a manager that is there has no services."""
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


class ManagerProbe:
    """Observes what there is of a controller manager, and of what it needs."""

    def __init__(self, node: Node, manager: str) -> None:
        """``manager``: its absolute name; ``node``: of the program that waits for it."""
        self._node = node
        self._manager = manager
        self._namespace, _, self._name = manager.rpartition('/')
        self._start = time.monotonic()

    def explain(self) -> str:
        """Return what keeps the manager from being there; takes up to three seconds."""
        return explain(self.observe())

    def explain_clock(self) -> str:
        """Return what is wrong with the clock of a manager that is there; empty: nothing."""
        return explain_clock(self._clock(), needed=self._needs_clock(is_there=True))

    def observe(self) -> ManagerObservation:
        """Return what the graph shows of it."""
        left = _DISCOVERY_TIME - (time.monotonic() - self._start)
        if left > 0.0:
            wait_until(self._node, self._is_anybody_there, timeout=left)
        is_there = self._manager in self._nodes()
        needs_clock = self._needs_clock(is_there=is_there)
        return ManagerObservation(
            manager=self._manager,
            domain=self._node.context.get_domain_id(),
            is_there=is_there,
            others=tuple(sorted(self._managers() - {self._manager})),
            simulators=tuple(self._servers(_SPAWN_ENTITY)),
            description=self._description() if is_there else None,
            clock=self._clock(),
            needs_clock=needs_clock,
        )

    def _is_anybody_there(self) -> bool | None:
        """Whether there is a manager or a simulator; None: neither yet."""
        found = self._managers() or self._servers(_SPAWN_ENTITY)
        return bool(found) or None

    def _nodes(self) -> set[str]:
        found = self._node.get_node_names_and_namespaces()
        return {f'{namespace.rstrip("/")}/{name}' for name, namespace in found}

    def _managers(self) -> set[str]:
        """Return the nodes that serve as a manager, and those that have the name of ours."""
        namesakes = {each for each in self._nodes() if each.rpartition('/')[2] == self._name}
        return namesakes | set(self._servers(_LIST_CONTROLLERS))

    def _servers(self, service_type: str) -> list[str]:
        """Return the nodes that offer such a service below their own names."""
        services = self._node.get_service_names_and_types()  # also those that have clients only
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
            values = call(
                self._node, GetParameters, service, request, timeout=_REPLY_TIMEOUT
            ).values
            return bool(values) and values[0].bool_value
        return False

    def _clock(self) -> ClockObservation:
        """Subscribe until time is seen to go on."""
        publishers = self._node.count_publishers('/clock')
        if not publishers:
            return ClockObservation(0)
        with _subscribed(self._node, Clock, '/clock', CLOCK) as messages:

            def observation() -> ClockObservation:
                stamps = (nanoseconds(message.clock) for message in messages)
                return ClockObservation(publishers, tuple(stamps))

            wait_until(self._node, lambda: observation().runs or None, timeout=_CLOCK_TIMEOUT)
            return observation()

    def _description(self) -> DescriptionObservation:
        """Look at the topic that the manager subscribes to; it may be remapped."""
        topic = f'{self._namespace}/{_DESCRIPTION}'
        with suppress(NodeNameNonExistentError):  # it has gone since
            subscribed = self._node.get_subscriber_names_and_types_by_node(
                self._name, self._namespace or '/'
            )
            topic = next((name for name, types in subscribed if _STRING in types), topic)
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

    Taken from ``/rosout``, which is latched.

    Args:
        node: Subscribes; it is spun here.
        names: Of the nodes, absolute.
        since: s, Unix time.
    """
    loggers = {name.strip('/').replace('/', '.') for name in names}
    matched = _Matched()
    with _subscribed(node, Log, '/rosout', _ROSOUT, matched) as messages:

        def lines() -> list[str]:
            return [
                message.msg
                for message in messages
                if message.level >= Log.ERROR
                and message.name in loggers
                and not is_traceback(message.msg)
                and nanoseconds(message.stamp) >= since * NANOSECONDS
            ]

        # What is latched comes as soon as a publisher has matched the subscription.
        wait_until(
            node,
            lambda: lines() or matched.count >= node.count_publishers('/rosout') or None,
            timeout=_MATCH_TIMEOUT,
        )
        if wait_until(node, lambda: lines() or None, timeout=_REPLY_TIMEOUT):
            wait_until(node, lambda: None, timeout=_BURST)
        return list(dict.fromkeys(lines()))


class _Matched(SubscriptionEventCallbacks):
    """Counts the publishers that a subscription has matched."""

    def __init__(self) -> None:
        super().__init__(matched=self._note)
        self.count = 0

    def _note(self, info: QoSSubscriptionMatchedInfo) -> None:
        self.count = info.current_count


@contextmanager
def _subscribed(
    node: Node,
    message_type: type[Message],
    topic: str,
    qos: QoSProfile,
    events: SubscriptionEventCallbacks | None = None,
) -> Iterator[list[Message]]:
    """Subscribe while inside; yields the list that fills."""
    messages: list[Message] = []
    subscription = node.create_subscription(
        message_type, topic, messages.append, qos, event_callbacks=events
    )
    try:
        yield messages
    finally:
        node.destroy_subscription(subscription)
