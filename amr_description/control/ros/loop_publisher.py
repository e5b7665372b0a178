# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Receipts: who commands a simulation that stands still has to know when the command has arrived.

Between a topic and a service DDS keeps no order, so a step may overtake the command that it was
meant for; and as controllers subscribe best effort, as in ros2_control, DDS acknowledges nothing.
Above all, Fast DDS finds the endpoints of two participants in either direction by itself: of 60
new publishers that had seen their subscriber, 29 lost their first message. So the simulator says
on

``~/received``  (``diagnostic_msgs/msg/KeyValue``, reliable)
    for every message that a controller has accepted: ``key``: the topic; ``value``: the
    publisher's own number of that message, from 1.

Once that is heard, the next step acts on the command. Nothing is said while nobody listens.

What leaves the owner's turn: what the controllers said at that instant; before it, where this
process owns the time, ``/clock``.

Nodes in the process that owns the time do not subscribe to ``/clock``: at 100 Hz that costs 14 %
of a core for three nodes. Their clocks are set here, before anything is published.
"""

from collections.abc import Callable, Sequence
import threading
from typing import Any
from weakref import WeakKeyDictionary

from diagnostic_msgs.msg import KeyValue
from rclpy.clock import ROSClock
from rclpy.exceptions import InvalidHandle
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import ClockType, Time
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.control.plugin_errors import describe
from amr_description.ros.runtime import destroy_node

TOPIC = '~/received'
QOS = QoSProfile(depth=100)


class CommandAcknowledgements:
    """Says them, on the ROS thread."""

    def __init__(self, node: Node) -> None:
        """``node`` has the topic."""
        self._publisher = node.create_publisher(KeyValue, TOPIC, QOS)

    def confirm(self, topic: str, number: int) -> None:
        """The message ``number`` of some publisher on ``topic`` is accepted."""
        if self._publisher.get_subscription_count():
            self._publisher.publish(KeyValue(key=topic, value=str(number)))


CLOCK_QOS = QoSProfile(depth=10)
"""Reliable, as ros_gz_bridge publishes it; time sources that subscribe best effort match too."""


class LoopPublisher:
    """
    The ``Publisher`` port of the loop, and who sets the clocks of the nodes in this process.

    Here nobody does: they go by the machine, or by the ``/clock`` of another process where
    ``use_sim_time`` says so. :class:`ClockedLoopPublisher` is for the process that owns the time.
    """

    _parameter_overrides: Sequence[Parameter] = ()

    def __init__(self, logger: RcutilsLogger) -> None:
        self.reporters: list[Callable[[int], None]] = []
        """Called at the end of a turn with its time, ns; what they send goes out with it."""
        self._outbox: list[tuple[Callable[[Any, Any], None], Any, Any, Publisher]] = []
        self._keeps: WeakKeyDictionary[Publisher, bool] = WeakKeyDictionary()
        """Of topics that nobody listened to: whether they keep what is said for who comes."""
        self._logger = logger

    def make_node(
        self, name: str, namespace: str, arguments: Sequence[str], **options: Any
    ) -> Node:
        """
        Make a node beside the first one of the process, with a logger service.

        ``arguments``: its ROS arguments, the global ones do not count. ``options``: further
        keywords of :class:`rclpy.node.Node`.
        """
        node = Node(
            name,
            namespace=namespace,
            use_global_arguments=False,
            cli_args=['--ros-args', *arguments],
            parameter_overrides=self._parameter_overrides,
            enable_logger_service=True,
            **options,
        )
        self.adopt(node)
        return node

    def destroy_node(self, node: Node) -> None:
        """Remove a node that was adopted."""
        self.release(node)
        destroy_node(node)

    def adopt(self, node: Node) -> None:
        """Take in a node; on the thread that made it, after its constructor."""

    def release(self, node: Node) -> None:
        """Let a node go, before it is destroyed."""

    def confirm(self, topic: str, number: int) -> None:
        """A controller accepted a publisher's message ``number``, from 1; on the ROS thread."""

    def send(
        self, fill: Callable[[Any, Any], None], sample: Any, message: Any, publisher: Publisher
    ) -> None:
        """Publish ``sample`` at the end of this turn; ``message`` is filled and sent then."""
        self._outbox.append((fill, sample, message, publisher))

    def set_clocks(self, time: int) -> None:
        """Set the clock of every node in this process to ``time``, ns."""

    def publish(self, time: int) -> None:
        """Publish what waits; ``time``: of this turn, ns."""
        for report in self.reporters:
            report(time)
        for fill, sample, message, publisher in self._outbox:
            try:
                if self._is_wanted(publisher):
                    fill(sample, message)
                    publisher.publish(message)
            except InvalidHandle:  # the topic went with a cleanup since it was said
                continue
            except Exception as error:  # a stranger's converter; the robot must go on
                self._logger.error(
                    f"Could not publish on '{publisher.topic_name}': {describe(error)}",
                    throttle_duration_sec=1.0,
                )
        self._outbox.clear()

    def _is_wanted(self, publisher: Publisher) -> bool:
        """Whether somebody listens, 1 µs, or may come later for what was said now."""
        if publisher.get_subscription_count():
            return True
        keeps = self._keeps.get(publisher)
        if keeps is None:
            durability = publisher.qos_profile.durability
            keeps = self._keeps[publisher] = durability is not DurabilityPolicy.VOLATILE
        return keeps


class ClockedLoopPublisher(LoopPublisher):
    """Of the process that owns the time: ``/clock`` goes first, and every clock shows it."""

    _parameter_overrides = (Parameter('use_sim_time', value=True),)

    def __init__(self, node: Node) -> None:
        """``node`` publishes ``/clock`` and lends its logger."""
        super().__init__(node.get_logger())
        self._clocks: list[ROSClock] = []
        self._changing_clocks = threading.Lock()
        self._message = Clock()
        self._publisher = node.create_publisher(Clock, '/clock', CLOCK_QOS)
        self._receipts = CommandAcknowledgements(node)

    def adopt(self, node: Node) -> None:
        """
        Set the node's clock from now on; it keeps saying ``use_sim_time: true``.

        Call it on the thread that made the node, after its constructor.
        """
        source = node._time_source
        source.ros_time_is_active = True
        node.destroy_subscription(source._clock_sub)
        source._clock_sub = None
        with self._changing_clocks:
            self._clocks = [*self._clocks, node.get_clock()]

    def release(self, node: Node) -> None:
        """Forget the node's clock."""
        with self._changing_clocks:
            self._clocks = [clock for clock in self._clocks if clock is not node.get_clock()]

    def confirm(self, topic: str, number: int) -> None:
        """Say so, to whoever drives in lock-step."""
        self._receipts.confirm(topic, number)

    def set_clocks(self, time: int) -> None:
        """Set every clock to ``time``, ns."""
        now = Time(nanoseconds=time, clock_type=ClockType.ROS_TIME)
        for clock in self._clocks:
            clock.set_ros_time_override(now)

    def publish(self, time: int) -> None:
        """Publish ``/clock``, and then what waits."""
        clock = self._message.clock
        clock.sec, clock.nanosec = divmod(time, NANOSECONDS)
        self._publisher.publish(self._message)
        super().publish(time)
