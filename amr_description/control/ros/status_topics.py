# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics on which a controller manager publishes its own status.

``/diagnostics``
    as diagnostic_updater publishes it.
``~/activity``
    the states of all controllers and components, latched.
``~/introspection_data/…``, ``~/statistics/…``
    numbers: the values of interfaces, and how long cycles take. ``full`` has name and number
    together, for people; ``names``, latched, and ``values`` are for programs (PlotJuggler,
    rosbag2). They are read and published after every cycle, and only while somebody subscribes;
    otherwise a cycle does nothing for them at all.

Timers go by the steady clock of the machine: a simulation that runs as fast as it can, or is
paused, also publishes its diagnostics once a second.
"""

from array import array
from collections.abc import Callable
from typing import NamedTuple

from controller_manager_msgs.msg import ControllerManagerActivity
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from pal_statistics_msgs.msg import Statistic, Statistics, StatisticsNames, StatisticsValues
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import ClockType
from std_msgs.msg import Header

from amr_description.cdr.template import Template
from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.diagnostics import HARDWARE_ID, Report, reports, take_measurements
from amr_description.control.introspection import (
    interfaces_of,
    IntrospectionRegistry,
    statistics_of,
)
from amr_description.control.ros.encoders import RosForm
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import LoopContext, LoopThread
from amr_description.control.snapshot import ManagerSnapshot
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.messages.encoders import Encoding, filling, TemplateEncoder
from amr_description.messages.lifecycle import activity, States, states_of
from amr_description.messages.parts import fill_stamp
from amr_description.ros.qos import LATCHED

_QUEUED = QoSProfile(depth=10)
_SUBSCRIPTION_CHECK_PERIOD = 1.0
"""s: how often it is looked up whether somebody subscribes to the numbers."""


class DiagnosticsTopic:
    """``/diagnostics`` and its timer; everything here runs on the ROS thread."""

    def __init__(self, node: Node, loop_thread: LoopThread, parameters: ManagerParameters) -> None:
        """``parameters``: those at the start count, but for :attr:`thresholds`."""
        self.manager: ControllerManager | None = None
        """Set once there is hardware."""
        self.has_description = False
        """True once there should be hardware."""
        self.thresholds = parameters.start.diagnostics
        """As the parameters are now."""
        self._node = node
        self._loop_thread = loop_thread
        self._update_rate = parameters.update_rate
        updater = parameters.start.diagnostic_updater
        name = node.get_fully_qualified_name() if updater.use_fqn else node.get_name()
        self._prefix = f'{name}: '
        self._publisher = node.create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=1)
        )
        # A group of its own: parameters go on being served while the control thread is awaited.
        node.create_timer(
            updater.period,
            self._publish,
            callback_group=MutuallyExclusiveCallbackGroup(),
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    async def _publish(self) -> None:
        manager = self.manager
        measured = None
        if manager is not None:
            measured = await self._loop_thread.submit(
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


class ActivityTopic:
    """``~/activity``: published when a state has changed; on the control thread."""

    def __init__(self, node: Node, loop_publisher: LoopPublisher) -> None:
        self._clock = node.get_clock()
        self._publisher = loop_publisher.recorded(
            node.create_publisher(ControllerManagerActivity, '~/activity', LATCHED)
        )
        self._last: tuple[States, States] | None = None

    def publish(self, snapshot: ManagerSnapshot) -> None:
        """Publish at once, not at the end of the cycle: after the last cycle there is none."""
        states = states_of(snapshot)
        if states != self._last:
            self._last = states
            self._publisher.publish(activity(self._clock.now().nanoseconds, *states))


class RegistrySample(NamedTuple):
    """The numbers of a registry at an instant, ns."""

    time: int
    names: tuple[str, ...]
    version: int
    values: list[float]


class RegistryTopics:
    """``full``, ``names`` and ``values`` of one registry of numbers; made on the ROS thread."""

    def __init__(
        self,
        node: Node,
        name: str,
        registry_of: Callable[[ControllerManager], IntrospectionRegistry],
        loop_publisher: LoopPublisher,
    ) -> None:
        self._registry_of = registry_of
        self._registry = IntrospectionRegistry((), list)
        self._version = 0
        self._clock = node.get_clock()
        self._names = node.create_publisher(StatisticsNames, f'{name}/names', LATCHED)
        self._full = node.create_publisher(Statistics, f'{name}/full', _QUEUED)
        self._values = node.create_publisher(StatisticsValues, f'{name}/values', _QUEUED)
        self._send_full = loop_publisher.topic(
            self._full, filling(self._fill_full, Statistics()), is_recorded=False
        ).send
        self._send_values = loop_publisher.topic(
            self._values,
            TemplateEncoder(VALUES, fill_values, RosForm(StatisticsValues)),
            is_recorded=False,
        ).send
        self._full_names: tuple[str, ...] = ()
        self._wants_full = self._wants_values = False

    def check_subscriptions(self) -> bool:
        """Look up who subscribes; return whether anybody does. On the ROS thread."""
        self._wants_full = self._full.get_subscription_count() > 0
        self._wants_values = self._values.get_subscription_count() > 0
        return self._wants_full or self._wants_values

    def change(self, manager: ControllerManager) -> None:
        """Take up a manager, or a change of it; on the control thread, as all that follows."""
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
        """Read the numbers as they are at ``time``, ns, and publish them with this cycle."""
        names, read = self._registry.names, self._registry.read
        sample = RegistrySample(time, names, self._version, read())
        if self._wants_full:
            self._send_full(sample)
        if self._wants_values:
            self._send_values(sample)

    def _fill_full(self, sample: RegistrySample, message: Statistics) -> None:
        fill_stamp(sample.time, message.header.stamp)
        if sample.names is not self._full_names:
            message.statistics = [Statistic(name=name) for name in sample.names]
            self._full_names = sample.names
        for statistic, value in zip(message.statistics, sample.values, strict=True):
            statistic.value = value


class IntrospectionTopics:
    """Both registries of a manager; their numbers are read while somebody subscribes."""

    def __init__(self, node: Node, context: LoopContext) -> None:
        self._loop_thread = context.loop_thread
        self._manager: ControllerManager | None = None
        self._topics = (
            RegistryTopics(node, '~/introspection_data', interfaces_of, context.publisher),
            RegistryTopics(node, '~/statistics', statistics_of, context.publisher),
        )
        self._wanted: list[RegistryTopics] = []
        node.create_timer(
            _SUBSCRIPTION_CHECK_PERIOD,
            self._check_subscriptions,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    def watch(self, manager: ControllerManager) -> None:
        """Take up a manager, or a change of it; on the control thread."""
        self._manager = manager
        for each in self._topics:
            each.change(manager)

    def _check_subscriptions(self) -> None:
        wanted = [each for each in self._topics if each.check_subscriptions()]
        if self._manager is not None and wanted != self._wanted:
            self._wanted = wanted
            self._loop_thread.submit(lambda: self._publish_each_cycle(wanted))

    def _publish_each_cycle(self, wanted: list[RegistryTopics]) -> None:
        def send(time: int) -> None:
            for each in wanted:
                each.send(time)

        if self._manager is not None:
            self._manager.on_tick = send if wanted else None


def fill_values(sample: RegistrySample, message: StatisticsValues) -> None:
    """Write the numbers, without their names."""
    fill_stamp(sample.time, message.header.stamp)
    message.values = array('d', sample.values)
    message.names_version = sample.version


def _pack_values(template: Template) -> Callable[[RegistrySample], bytes]:
    pack = template.pack
    begin, before, behind, end = template.constants

    def encode(sample: RegistrySample) -> bytes:
        seconds, nanoseconds = divmod(sample.time, NANOSECONDS)
        return pack(
            begin, seconds, nanoseconds,
            before, *sample.values,
            behind, sample.version, end,
        )  # fmt: skip

    return encode


VALUES = Encoding(
    ('header.stamp', 'values', 'names_version'), lambda sample: sample.version, _pack_values
)
"""Of a :class:`RegistrySample` as StatisticsValues, which a page hears in every cycle."""
