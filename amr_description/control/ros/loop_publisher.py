# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a cycle of the control loop publishes, at its end: ``/clock`` first, then the controllers.

Nodes in the process that owns the time do not subscribe to ``/clock``: at 100 Hz that costs 14 %
of a core for three nodes. :class:`ClockedLoopPublisher` sets their clocks at the beginning of the
cycle instead.

It also acknowledges commands. Whoever commands a paused simulation has to know when a command has
arrived: DDS keeps no order between a topic and a service, so a step may overtake the command that
it was meant for; and controllers subscribe best effort, as in ros2_control, so DDS acknowledges
nothing. Above all, Fast DDS matches the endpoints of two participants in either direction by
itself: of 60 new publishers that had seen their subscriber, 29 lost their first message. So the
simulator publishes on

``~/received``  (``diagnostic_msgs/msg/KeyValue``, reliable)
    for every message that a controller has accepted: ``key``: the topic; ``value``: the
    publisher's own number of that message, from 1.

Once that has come, the next step acts on the command. Nothing is published without a subscriber.
"""

from collections.abc import Callable, Sequence
import threading
from typing import Any
from weakref import WeakKeyDictionary

from diagnostic_msgs.msg import KeyValue
from rclpy.clock import ROSClock
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import ClockType, Time
from rosgraph_msgs.msg import Clock

from amr_description.control.plugin_errors import describe
from amr_description.ros.messages import fill_stamp
from amr_description.ros.rclpy_internals import RcutilsLogger, set_clock_by_hand
from amr_description.ros.runtime import destroy_node

ACKNOWLEDGEMENT_TOPIC = '~/received'
ACKNOWLEDGEMENT_QOS = QoSProfile(depth=100)

CLOCK_QOS = QoSProfile(depth=10)
"""Reliable, as ros_gz_bridge publishes it; time sources that subscribe best effort match too."""


class LoopPublisher:
    """
    The ``Publisher`` port of the loop; it also makes the nodes whose clocks the loop may set.

    Here it sets none: they go by the system clock, or by the ``/clock`` of another process where
    ``use_sim_time`` says so. :class:`ClockedLoopPublisher` is for the process that owns the time.
    """

    _parameter_overrides: Sequence[Parameter] = ()

    def __init__(self, logger: RcutilsLogger) -> None:
        self.reporters: list[Callable[[int], None]] = []
        """Called at the end of a cycle with its time, ns; what they send goes out with it."""
        self._outbox: list[tuple[Callable[[Any, Any], None], Any, Any, Publisher]] = []
        self._is_latched: WeakKeyDictionary[Publisher, bool] = WeakKeyDictionary()
        """Of publishers that have been without a subscriber."""
        self._logger = logger

    def make_node(
        self, name: str, namespace: str, arguments: Sequence[str], **options: Any
    ) -> Node:
        """
        Make a node beside the first one of the process, with a logger service.

        Args:
            name: Of the node.
            namespace: Of the node.
            arguments: Its ROS arguments; the global ones of the process do not count.
            options: Further keywords of :class:`rclpy.node.Node`.
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
        """Take a node in; on the thread that made it, after its constructor."""

    def release(self, node: Node) -> None:
        """Let a node go, before it is destroyed."""

    def acknowledge(self, topic: str, number: int) -> None:
        """A controller accepted a publisher's message ``number``, from 1; on the ROS thread."""

    def send(
        self, fill: Callable[[Any, Any], None], sample: Any, message: Any, publisher: Publisher
    ) -> None:
        """
        Publish a sample at the end of this cycle; on the control thread.

        Args:
            fill: Writes ``sample`` into ``message``; called only if somebody subscribes.
            sample: What is published.
            message: May be sent many times.
            publisher: Of the topic.
        """
        self._outbox.append((fill, sample, message, publisher))

    def set_clocks(self, time: int) -> None:
        """Set the clock of every node in this process to ``time``, ns."""

    def publish(self, time: int) -> None:
        """Publish what was sent since the last call; ``time``: of this cycle, ns."""
        for report in self.reporters:
            report(time)
        for fill, sample, message, publisher in self._outbox:
            try:
                if self._is_wanted(publisher):
                    fill(sample, message)
                    publisher.publish(message)
            except InvalidHandle:  # a cleanup has removed the topic since
                continue
            except Exception as error:  # a third party's converter; the robot must go on
                self._logger.error(
                    f"Could not publish on '{publisher.topic_name}': {describe(error)}",
                    throttle_duration_sec=1.0,
                )
        self._outbox.clear()

    def _is_wanted(self, publisher: Publisher) -> bool:
        """Whether somebody subscribes, 1 µs, or may later get what is latched now."""
        if publisher.get_subscription_count():
            return True
        is_latched = self._is_latched.get(publisher)
        if is_latched is None:
            durability = publisher.qos_profile.durability
            is_latched = durability is not DurabilityPolicy.VOLATILE
            self._is_latched[publisher] = is_latched
        return is_latched


class ClockedLoopPublisher(LoopPublisher):
    """That of the process that owns the time: it publishes ``/clock`` and sets all clocks."""

    _parameter_overrides = (Parameter('use_sim_time', value=True),)

    def __init__(self, node: Node) -> None:
        """``node`` publishes ``/clock`` and ``~/received``, and lends its logger."""
        super().__init__(node.get_logger())
        self._clocks: list[ROSClock] = []
        self._changing_clocks = threading.Lock()
        self._message = Clock()
        self._publisher = node.create_publisher(Clock, '/clock', CLOCK_QOS)
        self._acknowledgements = CommandAcknowledgements(node)

    def adopt(self, node: Node) -> None:
        """
        Set the node's clock from now on; its parameter ``use_sim_time`` stays true.

        On the thread that made the node, after its constructor.
        """
        set_clock_by_hand(node)
        with self._changing_clocks:
            self._clocks = [*self._clocks, node.get_clock()]

    def release(self, node: Node) -> None:
        """Forget the node's clock."""
        with self._changing_clocks:
            self._clocks = [clock for clock in self._clocks if clock is not node.get_clock()]

    def acknowledge(self, topic: str, number: int) -> None:
        """Publish that a controller accepted a publisher's message ``number``, from 1."""
        self._acknowledgements.publish(topic, number)

    def set_clocks(self, time: int) -> None:
        """Set every clock to ``time``, ns."""
        now = Time(nanoseconds=time, clock_type=ClockType.ROS_TIME)
        for clock in self._clocks:
            clock.set_ros_time_override(now)

    def publish(self, time: int) -> None:
        """Publish ``/clock``, and then what was sent."""
        fill_stamp(time, self._message.clock)
        self._publisher.publish(self._message)
        super().publish(time)


class CommandAcknowledgements:
    """Publishes ``~/received``; on the ROS thread."""

    def __init__(self, node: Node) -> None:
        """``node`` has the topic."""
        self._publisher = node.create_publisher(
            KeyValue, ACKNOWLEDGEMENT_TOPIC, ACKNOWLEDGEMENT_QOS
        )

    def publish(self, topic: str, number: int) -> None:
        """Some publisher's message ``number`` on ``topic`` was accepted."""
        if self._publisher.get_subscription_count():
            self._publisher.publish(KeyValue(key=topic, value=str(number)))
