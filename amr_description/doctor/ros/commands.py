# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Velocity commands, the parameters of the drives that take them, and locks."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
import math
import time
from typing import Any

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool

from amr_description.doctor.observations.commands import (
    CommandSeen,
    ObservedCommands,
    ObservedCommandTopic,
    ObservedDrive,
    StopLock,
)
from amr_description.doctor.observations.graph import STAMPED_TWIST, TWIST, VELOCITY_TYPES
from amr_description.doctor.ros.probe_context import CLOCK_TOPIC, ProbeContext
from amr_description.doctor.ros.queries import GET_PARAMETERS, ParameterQuery
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.messages import nanoseconds

LISTEN = 2.5
"""s for which commands are awaited: three of once a second."""

ENOUGH, SHORTEST = 12, 1.0
"""So many commands on a topic, within s, are enough to tell how often they come, and of how
many publishers they are."""
_LOCK_PATIENCE = 0.7
"""s until the last message of a lock has come; of a lock that is volatile none may."""
_MOST = 2000
_LOCK, _BOOL = 'emergency_stop', 'std_msgs/msg/Bool'
_DEPTH = 50
"""Commands between two looks."""
_LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_TYPES: dict[str, type] = {TWIST: Twist, STAMPED_TWIST: TwistStamped}
_TIMEOUTS = ('cmd_vel_timeout', 'reference_timeout')
_REFERENCE = '/reference'
"""End of the topics to which ``reference_timeout`` applies."""
_COMPONENTS = ('linear.x', 'linear.y', 'angular.z')
_MILLISECOND = 1e-3


class CommandProbe:
    """Observes commands."""

    def begin(self, context: ProbeContext) -> None:
        """Listen to the topics of commands that are published, and ask who subscribes."""
        self._context, self._node = context, context.node
        node = context.node
        self._began = time.monotonic()
        self._is_simulated = node.count_publishers(CLOCK_TOPIC) > 0
        self._topics: list[_CommandTopic] = []
        self._locks: list[_Lock] = []
        for name, types in sorted(node.get_topic_names_and_types()):
            if {*types} & {*VELOCITY_TYPES}:
                self._add_topic(name)
            elif name.rpartition('/')[2] == _LOCK and _BOOL in types:
                self._add_lock(name)
        if self._is_simulated and any(each.publishers for each in self._topics):
            self._context.listen()
        self._queries = self._ask()

    @property
    def is_done(self) -> bool:
        """Whether enough was received, or long enough of all who publish."""
        self._take()
        waited = time.monotonic() - self._began
        answers = [q.response for found in self._queries.values() for q in found.values()]
        # On a busy machine to find each other may take as long as to listen.
        if None in answers or not all(each.is_connected for each in self._topics):
            return False
        if any(each.value is None for each in self._locks) and waited < _LOCK_PATIENCE:
            return False
        return waited >= LISTEN or all(
            not each.publishers or (each.is_received and waited >= SHORTEST)
            for each in self._topics
        )

    def observe(self) -> ObservedCommands:
        """Return what was received."""
        self._take()
        topics = tuple(
            ObservedCommandTopic(
                name=each.name,
                publishers=each.publishers,
                subscriptions=each.subscriptions,
                seen=tuple(self._commands(each)),
            )
            for each in self._topics
        )
        commands = ObservedCommands(
            topics=topics,
            drives=tuple(self._drives()),
            locks=tuple(
                StopLock(topic=each.name, holders=each.holders, is_locked=each.value is True)
                for each in self._locks
            ),
            seconds=time.monotonic() - self._began,
        )
        for probe in [*(t.probe for t in self._topics), *(k.probe for k in self._locks)]:
            if probe is not None:
                probe.destroy()
        return commands

    # --- topics -------------------------------------------------------------------------------

    def _add_topic(self, name: str) -> None:
        """Listen to a topic, with the type that is both published and subscribed to, if any is."""
        node = self._node
        publishers = node.get_publishers_info_by_topic(name)
        subscriptions = node.get_subscriptions_info_by_topic(name)
        found = _CommandTopic(name, _names(publishers), _names(subscriptions))
        self._topics.append(found)
        wanted = {each.topic_type for each in subscriptions}
        offered = sorted(
            {each.topic_type for each in publishers} & {*VELOCITY_TYPES},
            key=lambda kind: kind not in wanted,
        )
        if offered:
            found.probe = self._listen(_TYPES[offered[0]], name, None)

    def _add_lock(self, name: str) -> None:
        publishers = self._node.get_publishers_info_by_topic(name)
        are_latched = all(
            each.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL for each in publishers
        )
        if publishers:
            probe = self._listen(Bool, name, _LATCHED if are_latched else None)
            self._locks.append(_Lock(name, _names(publishers), probe))

    def _listen(self, kind: type, topic: str, qos: QoSProfile | None) -> TopicProbe | None:
        try:
            return TopicProbe(self._node, kind, topic, depth=_DEPTH, qos=qos)
        except RuntimeError:  # another type of it is used in this process
            return None

    def _take(self) -> None:
        self._context.receive()
        for topic in self._topics:
            if topic.probe is not None and len(topic.seen) < _MOST:
                topic.seen += topic.probe.messages()
        for lock in self._locks:
            for message, _, _ in lock.probe.messages() if lock.probe is not None else ():
                lock.value = message.data

    def _commands(self, topic: '_CommandTopic') -> Iterator[CommandSeen]:
        """Yield the commands that came on a topic."""
        publishers = topic.probe.publishers() if topic.probe is not None else {}
        for message, received, gid in topic.seen:
            age, twist = None, message
            if isinstance(message, TwistStamped):
                twist = message.twist
                stamp = nanoseconds(message.header.stamp)
                present = self._context.time_at(received) if self._is_simulated else received
                age = present - stamp if stamp and present is not None else None
            yield CommandSeen(
                received=received,
                publisher=publishers.get(gid, gid.hex()),
                age=age,
                is_simulated=self._is_simulated,
                linear=(twist.linear.x, twist.linear.y),
                angular=twist.angular.z,
            )

    # --- drives -------------------------------------------------------------------------------

    def _ask(self) -> dict[str, dict[str, ParameterQuery]]:
        """Ask who subscribes to commands; a parameter that is unknown would spoil the others."""
        services = {name for name, _ in self._node.get_service_names_and_types()}
        nodes = dict.fromkeys(node for each in self._topics for node in each.subscriptions)
        own = self._node.get_fully_qualified_name()
        return {
            node: {
                **{name: self._context.ask(node, [name]) for name in _TIMEOUTS},
                **{name: self._context.ask(node, _limits_of(name)) for name in _COMPONENTS},
                **{
                    _switch(name): self._context.ask(node, [_switch(name)]) for name in _COMPONENTS
                },
            }
            for node in nodes
            if f'{node}{GET_PARAMETERS}' in services and node != own
        }

    def _drives(self) -> Iterable[ObservedDrive]:
        """Yield the nodes that have a time-out or limits of commands."""
        for node, queries in self._queries.items():
            topics = tuple(each.name for each in self._topics if node in each.subscriptions)
            values: dict[str, object] = {}
            for query in queries.values():
                values |= query.values or {}
            drive = drive_of(node, topics, values)
            if drive is not None:
                yield drive


@dataclass(slots=True)
class _CommandTopic:
    name: str
    publishers: tuple[str, ...]
    subscriptions: tuple[str, ...]
    probe: TopicProbe | None = None
    seen: list[tuple[Any, int, bytes]] = field(default_factory=list)
    """Messages, when they were received, and the gids of their publishers."""

    @property
    def is_connected(self) -> bool:
        """Whether all who publish can be received."""
        return self.probe is None or self.probe.is_connected

    @property
    def is_received(self) -> bool:
        """Whether enough has come, and of every publisher: one may be connected later."""
        publishers = {gid for _, _, gid in self.seen}
        return len(self.seen) >= ENOUGH and len(publishers) >= len(self.publishers)


@dataclass(slots=True)
class _Lock:
    name: str
    holders: tuple[str, ...]
    probe: TopicProbe | None
    value: bool | None = None


def drive_of(
    node: str, topics: tuple[str, ...], values: dict[str, object]
) -> ObservedDrive | None:
    """Return the drive that a node is, by its parameters; None: it is none."""
    name = next((each for each in _TIMEOUTS if each in values), '')
    timeout = values.get(name)
    if name == 'reference_timeout' and not any(each.endswith(_REFERENCE) for each in topics):
        name, timeout = '', None  # as of Gazebo's plugins, which have none
    limits = []
    for component in _COMPONENTS:
        most, least = (_number(values, key) for key in _limits_of(component))
        has_limits = values.get(_switch(component), True) is not False
        if has_limits and not math.isnan(most):
            limits.append((component, -most if math.isnan(least) else least, most))
    if not isinstance(timeout, int | float) and not limits:
        return None
    seconds: float | None = None
    if isinstance(timeout, int | float):
        # That of tricycle_controller is in milliseconds, and an integer.
        seconds = timeout * _MILLISECOND if isinstance(timeout, int) else timeout
    return ObservedDrive(
        node=node,
        topics=topics,
        timeout=seconds,
        timeout_parameter=name or _TIMEOUTS[0],
        limits=tuple(limits),
    )


def _limits_of(component: str) -> tuple[str, str]:
    return f'{component}.max_velocity', f'{component}.min_velocity'


def _switch(component: str) -> str:
    """Return the parameter, deprecated by now, that switches the limits off."""
    return f'{component}.has_velocity_limits'


def _number(values: dict[str, object], name: str) -> float:
    value = values.get(name)
    return float(value) if isinstance(value, int | float) else math.nan


def _names(found: Iterable[Any]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(endpoint_node(each) or 'a node' for each in found))
