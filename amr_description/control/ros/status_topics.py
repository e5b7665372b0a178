# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``/diagnostics`` of a controller manager, as diagnostic_updater publishes it.

The period is one of the machine's clock: a simulation that runs as fast as it can, or is paused,
says once a second how it is, too.

``~/activity`` of a controller manager: states of all controllers and components, latched.

``~/introspection_data/…`` and ``~/statistics/…`` of a controller manager: numbers to be watched.

``full`` has name and number together, for people; ``names``, latched, and ``values`` are for
programs (PlotJuggler, rosbag2). Numbers are read and published after every cycle, and only while
somebody subscribes to them; otherwise a cycle does nothing for it at all.
"""

from array import array
from collections.abc import Callable, Sequence
from typing import NamedTuple

from controller_manager_msgs.msg import ControllerManagerActivity, NamedLifecycleState
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from pal_statistics_msgs.msg import Statistic, Statistics, StatisticsNames, StatisticsValues
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import ClockType
from std_msgs.msg import Header

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.diagnostics import HARDWARE_ID, Report, reports, take_measurements
from amr_description.control.introspection import interfaces_of, IntrospectionRegistry, statistics_of
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import LoopThread
from amr_description.control.ros.parameters import ManagerParameters
from amr_description.control.snapshot import ComponentSnapshot, ControllerSnapshot, ManagerSnapshot


class DiagnosticsTopic:
    """The topic and its timer; everything here runs on the ROS thread."""

    def __init__(self, node: Node, owner: LoopThread, parameters: ManagerParameters) -> None:
        """``parameters``: of which only those at the start count, but for the thresholds."""
        self.manager: ControllerManager | None = None
        """Set once there is hardware."""
        self.has_description = False
        """True once there should be."""
        self.thresholds = parameters.start.diagnostics
        """As they are now."""
        self._node = node
        self._owner = owner
        self._update_rate = parameters.update_rate
        updater = parameters.start.diagnostic_updater
        name = node.get_fully_qualified_name() if updater.use_fqn else node.get_name()
        self._prefix = f'{name}: '
        self._publisher = node.create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=1)
        )
        # A group of its own: while the owner is awaited, parameters go on being served.
        node.create_timer(
            updater.period,
            self._tell,
            callback_group=MutuallyExclusiveCallbackGroup(),
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    async def _tell(self) -> None:
        manager = self.manager
        measured = None
        if manager is not None:
            measured = await self._owner.submit(
                lambda: take_measurements(manager), self._node.executor
            )
        found = reports(
            measured,
            self.thresholds,
            self._update_rate,
            has_description=self.has_description,
        )
        message = DiagnosticArray(
            status=[_status(self._prefix + task, report) for task, report in found.items()]
        )
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)


def _status(name: str, report: Report) -> DiagnosticStatus:
    return DiagnosticStatus(
        level=bytes([report.level]),
        name=name,
        message=report.message,
        hardware_id=HARDWARE_ID,
        values=[KeyValue(key=key, value=value) for key, value in report.values],
    )


_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class ActivityTopic:
    """Told, on the owner's thread, of every new snapshot; publishes when a state has changed."""

    def __init__(self, node: Node) -> None:
        self._clock = node.get_clock()
        self._publisher = node.create_publisher(ControllerManagerActivity, '~/activity', _LATCHED)
        self._said: ControllerManagerActivity | None = None

    def tell(self, snapshot: ManagerSnapshot) -> None:
        """Publish at once, not with the turn's outbox: after the last turn, there is none."""
        controllers, components = _states(snapshot.controllers), _states(snapshot.components)
        said = self._said
        if said and (said.controllers, said.hardware_components) == (controllers, components):
            return
        self._said = ControllerManagerActivity(
            controllers=controllers, hardware_components=components
        )
        self._said.header.stamp = self._clock.now().to_msg()
        self._publisher.publish(self._said)


def _states(
    entries: Sequence[ControllerSnapshot] | Sequence[ComponentSnapshot],
) -> list[NamedLifecycleState]:
    states = []
    for each in entries:
        named = NamedLifecycleState(name=each.name)
        named.state.id, named.state.label = each.state, each.state.label
        states.append(named)
    return states


_QUEUED = QoSProfile(depth=10)
_ATTENTION = 1.0  # s of the machine's clock, between two looks at who subscribes


class _Sample(NamedTuple):
    time: int
    names: tuple[str, ...]
    version: int
    values: list[float]


class RegistryTopics:
    """``full``, ``names`` and ``values`` of one registry; made on the ROS thread."""

    def __init__(
        self,
        node: Node,
        name: str,
        registry_of: Callable[[ControllerManager], IntrospectionRegistry],
        outgoing: LoopPublisher,
    ) -> None:
        self._registry_of = registry_of
        self._registry = IntrospectionRegistry((), list)
        self._version = 0
        self._clock = node.get_clock()
        self._outgoing = outgoing
        self._names = node.create_publisher(StatisticsNames, f'{name}/names', _LATCHED)
        self._full = node.create_publisher(Statistics, f'{name}/full', _QUEUED)
        self._values = node.create_publisher(StatisticsValues, f'{name}/values', _QUEUED)
        self._full_message, self._values_message = Statistics(), StatisticsValues()
        self._listed: tuple[str, ...] = ()
        self._wants_full = self._wants_values = False

    def look(self) -> bool:
        """See who subscribes; return whether anybody does. On the ROS thread."""
        self._wants_full = self._full.get_subscription_count() > 0
        self._wants_values = self._values.get_subscription_count() > 0
        return self._wants_full or self._wants_values

    def change(self, manager: ControllerManager) -> None:
        """Something about the manager has changed; on the owner's thread, as all that follows."""
        before, self._registry = self._registry, self._registry_of(manager)
        if self._registry.names != before.names:
            self._version += 1
            self._names.publish(
                StatisticsNames(
                    header=Header(stamp=self._clock.now().to_msg()),
                    names=self._registry.names,
                    names_version=self._version,
                )
            )

    def send(self, time: int) -> None:
        """Read the numbers as they are at ``time``, ns, and publish them after this turn."""
        names, read = self._registry.names, self._registry.read
        sample = _Sample(time, names, self._version, read())
        if self._wants_full:
            self._outgoing.send(self._fill_full, sample, self._full_message, self._full)
        if self._wants_values:
            self._outgoing.send(_fill_values, sample, self._values_message, self._values)

    def _fill_full(self, sample: _Sample, message: Statistics) -> None:
        _set_stamp(message.header, sample.time)
        if sample.names is not self._listed:
            message.statistics = [Statistic(name=name) for name in sample.names]
            self._listed = sample.names
        for statistic, value in zip(message.statistics, sample.values, strict=True):
            statistic.value = value


class Introspection:
    """Both registries of a manager, and who is interested in them."""

    def __init__(self, node: Node, owner: LoopThread, outgoing: LoopPublisher) -> None:
        self._owner = owner
        self._manager: ControllerManager | None = None
        self._topics = (
            RegistryTopics(node, '~/introspection_data', interfaces_of, outgoing),
            RegistryTopics(node, '~/statistics', statistics_of, outgoing),
        )
        self._wanted: list[RegistryTopics] = []
        node.create_timer(_ATTENTION, self._look, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def watch(self, manager: ControllerManager) -> None:
        """Take up a manager, or a change of it; on the owner's thread."""
        self._manager = manager
        for each in self._topics:
            each.change(manager)

    def _look(self) -> None:
        wanted = [each for each in self._topics if each.look()]
        if self._manager is not None and wanted != self._wanted:
            self._wanted = wanted
            self._owner.submit(lambda: self._listen_to(wanted))

    def _listen_to(self, wanted: list[RegistryTopics]) -> None:
        def send(time: int) -> None:
            for each in wanted:
                each.send(time)

        self._manager.on_tick = send if wanted else None


def _fill_values(sample: _Sample, message: StatisticsValues) -> None:
    _set_stamp(message.header, sample.time)
    message.values = array('d', sample.values)
    message.names_version = sample.version


def _set_stamp(header: Header, time: int) -> None:
    header.stamp.sec, header.stamp.nanosec = divmod(time, NANOSECONDS)
