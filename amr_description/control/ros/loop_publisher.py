# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a cycle of the control loop publishes, at its end: ``/clock`` first, then the controllers.

Nodes in the process that owns the time do not subscribe to ``/clock``: at 100 Hz that costs 14 %
of a core for three nodes. They share one clock instead, which :class:`ClockedLoopPublisher` sets
at the beginning of the cycle: 2 µs, however many they are.

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

Without subscribers no message is made, which is most of the cost of a sample: 15 µs of 20. To
look whether somebody subscribes costs 1.5 µs a topic, so that is done once in :data:`LOOK_PERIOD`
of the wall clock (with many topics less often), and in each cycle before and after which time
stands still. A topic that keeps its last message for who subscribes later
(:attr:`LoopTopic.keeps_last`; Fast DDS does so for controllers, whose topics leave it the choice)
gets its newest sample at these looks: who subscribes finds one that is no older than that, and
while time stands still the newest there is.
"""

from collections.abc import Callable, Sequence
import threading
import time as wall
from typing import Any, Final

from diagnostic_msgs.msg import KeyValue
from rclpy.exceptions import InvalidHandle, InvalidTopicNameException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from rclpy.subscription import Subscription
from rclpy.time import ClockType, Time
from rosgraph_msgs.msg import Clock

from amr_description.control.contracts import Input
from amr_description.control.ros.encoders import encoder_of
from amr_description.control.ros.message_recorder import (
    MessageRecorder,
    RecordedInput,
    RecordedMessagePublisher,
    Sink,
)
from amr_description.errors import SimulationError
from amr_description.messages.encoders import Encoder
from amr_description.plugin_errors import describe
from amr_description.ros.firewall import guard
from amr_description.ros.layouts import serialize
from amr_description.ros.message_types import message_type, type_name
from amr_description.ros.messages import fill_stamp
from amr_description.ros.rclpy_internals import (
    bytes_publisher,
    manual_clock,
    publisher_without_lock,
    RCLError,
    RcutilsLogger,
    share_clock,
)

ACKNOWLEDGEMENT_TOPIC = '~/received'
ACKNOWLEDGEMENT_QOS = QoSProfile(depth=100)

CLOCK_QOS = QoSProfile(depth=10)
"""Reliable, as ros_gz_bridge publishes it; time sources that subscribe best effort match too."""

LOOK_PERIOD = 5_000_000
"""ns of the wall clock between two looks at who subscribes, with so many topics:"""

TOPICS_A_LOOK = 24
"""With more topics the period is as much longer. One robot has some 12; 20 robots are looked at
each 45 ms, at 0.6 ms: 13 % of a core with each 5 ms, now 1.4 %."""

_NOTHING: Final = object()


class LoopTopic:
    """A topic on which samples go out at the end of a cycle; :meth:`LoopPublisher.topic`."""

    __slots__ = (
        'publisher', 'has_subscribers', 'keeps_last', 'newest', 'sink', '_is_latched', '_latest',
        '_keeps_many', '_encode', '_publish_bytes', '_publish_without_lock', '_outbox',
    )  # fmt: skip

    def __init__(
        self, publisher: Publisher, encode: Encoder, outbox: 'list[tuple[LoopTopic, Any]]'
    ) -> None:
        self.publisher = publisher
        self._keeps_many = _keeps_many(publisher.qos_profile)
        self.has_subscribers = self._keeps_many
        """Whether somebody subscribed at the last look, or may later get each of the samples."""
        self.keeps_last = publisher.qos_profile.durability is not DurabilityPolicy.VOLATILE
        """Whether who subscribes later gets the last message."""
        self.newest: Any = _NOTHING
        """The sample that has still to be kept for those."""
        self.sink: Sink | None = None
        """Records what is published, if anybody does; such a topic counts as subscribed."""
        self._is_latched = _is_latched(publisher)
        self._latest: Any = _NOTHING
        self._encode, self._publish_bytes = encode, bytes_publisher(publisher)
        self._publish_without_lock = publisher_without_lock(publisher)
        self._outbox = outbox

    @property
    def type_name(self) -> str:
        """Of its messages."""
        return type_name(self.publisher.msg_type)

    def send(self, sample: Any) -> None:
        """Publish a sample at the end of this cycle; on the control thread."""
        if self._is_latched:
            self._latest = sample
        self._outbox.append((self, sample))

    def write(self, sample: Any) -> None:
        """Publish a sample now. Raises InvalidHandle: the topic is gone."""
        made, sink = self._encode(sample), self.sink
        if sink is not None:
            made = made if isinstance(made, bytes) else serialize(made)
            sink(made)
        if isinstance(made, bytes):
            self._publish_bytes(made)
        else:
            self.publisher.publish(made)

    def write_aside(self, sample: Any) -> None:
        """
        Publish a big sample now, while other threads go on: the control thread, above all.

        Its encoder makes bytes. Where the topic is gone, it has no subscribers any more.
        """
        made = self._encode(sample)
        sink = self.sink  # which the control thread may take away
        if sink is not None:
            sink(made)
        try:
            self._publish_without_lock(made)
        except InvalidHandle:  # its robot has been removed meanwhile
            self.has_subscribers = False

    def look(self) -> None:
        """Look whether somebody subscribes, 0.9 µs. Raises InvalidHandle: the topic is gone."""
        has_subscribers = self.publisher.get_subscription_count() > 0
        self.has_subscribers = has_subscribers or self._keeps_many or self.sink is not None

    def attach(self, recorder: MessageRecorder | None) -> None:
        """Record from now on, what is latched first; None: no more, as the next look finds."""
        sink = self.sink = None if recorder is None else recorder.samples_of(self.publisher)
        self.has_subscribers = self.has_subscribers or sink is not None
        if sink is not None and self._latest is not _NOTHING:
            made = self._encode(self._latest)
            sink(made if isinstance(made, bytes) else serialize(made))


def _is_latched(publisher: Publisher) -> bool:
    """Whether the last message is always there for who subscribes later."""
    return bool(publisher.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL)


def _keeps_many(qos: QoSProfile) -> bool:
    """Whether who subscribes later gets more than the last message."""
    if qos.durability is DurabilityPolicy.VOLATILE:
        return False
    return qos.history is HistoryPolicy.KEEP_ALL or qos.depth > 1


class LoopPublisher:
    """
    The ``Publisher`` port of the loop; it also makes the nodes whose clocks the loop may set.

    Here it sets none: they go by the system clock, or by the ``/clock`` of another process where
    ``use_sim_time`` says so. :class:`ClockedLoopPublisher` is for the process that owns the time.
    """

    _parameter_overrides: Sequence[Parameter] = ()

    def __init__(
        self,
        logger: RcutilsLogger,
        *,
        clock: Callable[[], int] = wall.monotonic_ns,
        look_period: int = LOOK_PERIOD,
    ) -> None:
        """
        Publish nothing yet.

        Args:
            logger: Gets what goes wrong.
            clock: The wall clock, ns.
            look_period: ns of it between two looks at who subscribes.
        """
        self.reporters: list[Callable[[int], None]] = []
        """Called at the end of a cycle with its time, ns; what they send goes out with it."""
        self.followers: list[Callable[[], None]] = []
        """Called when all of a cycle has gone out; they may take as long as they take."""
        self._outbox: list[tuple[LoopTopic, Any]] = []
        self._topics: tuple[LoopTopic, ...] = ()
        self._changing_topics = threading.Lock()
        self._recorder: MessageRecorder | None = None
        self._recorded: tuple[LoopTopic | RecordedMessagePublisher | RecordedInput, ...] = ()
        self._wall_clock, self._look_period = clock, look_period
        self._next_look = 0
        """ns of the wall clock."""
        self._latest: int | None = None
        """Time of the last cycle, ns."""
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
        guard(node)
        self.adopt(node)
        return node

    def adopt(self, node: Node) -> None:
        """Take a node in; on the thread that made it, after its constructor."""

    def acknowledge(self, topic: str, number: int) -> None:
        """A controller accepted a publisher's message ``number``, from 1; on any thread."""

    def topic(
        self, publisher: Publisher, encode: Encoder, *, is_recorded: bool = True
    ) -> LoopTopic:
        """
        Take in a topic, until its publisher is destroyed.

        Args:
            publisher: Of the topic.
            encode: Called for each sample that has subscribers.
            is_recorded: Whether it is recorded; not so what depends on the wall clock.
        """
        topic = LoopTopic(publisher, encode, self._outbox)
        with self._changing_topics:
            self._topics = (*self._topics, topic)
        if is_recorded:
            self._add_recorded(topic)
        self._next_look = 0
        return topic

    # --- recording ----------------------------------------------------------------------------

    def recorded(self, publisher: Publisher) -> RecordedMessagePublisher:
        """Return what publishes at once, and is recorded, until the publisher is destroyed."""
        recorded = RecordedMessagePublisher(publisher, is_latched=_is_latched(publisher))
        self._add_recorded(recorded)
        return recorded

    def input(self, port: Input[Any], subscription: Subscription) -> None:
        """Have the commands of an input recorded, until :meth:`forget`."""
        self._add_recorded(RecordedInput(port, subscription))

    def forget(self, ports: Sequence[Input[Any]], publishers: Sequence[Publisher] = ()) -> None:
        """Record nothing of these inputs and publishers, which are destroyed."""

        def is_gone(each: LoopTopic | RecordedMessagePublisher | RecordedInput) -> bool:
            if isinstance(each, RecordedInput):
                return any(each.port is port for port in ports)
            return any(each.publisher is publisher for publisher in publishers)

        with self._changing_topics:
            self._recorded = tuple(each for each in self._recorded if not is_gone(each))
            if self._recorder is not None:
                for publisher in publishers:
                    self._recorder.forget(publisher)

    @property
    def message_types(self) -> set[str]:
        """Names of the types of what is recorded now."""
        return {each.type_name for each in self._recorded}

    def set_recorder(self, recorder: MessageRecorder | None) -> None:
        """Record with a recorder from now on; None: no more. On the control thread."""
        with self._changing_topics:
            self._recorder = recorder
            for each in self._recorded:
                if isinstance(each, LoopTopic) and each.newest is not _NOTHING:
                    self._write(each, each.newest)  # it was sent before the recording began
                    each.newest = _NOTHING
                each.attach(recorder)

    def _add_recorded(self, each: LoopTopic | RecordedMessagePublisher | RecordedInput) -> None:
        recorder = self._recorder
        if recorder is not None:
            recorder.prepare(each.type_name)  # before the lock, for which the control thread waits
        with self._changing_topics:
            self._recorded = (*self._recorded, each)
            each.attach(self._recorder)

    def set_clocks(self, time: int) -> None:
        """Set the clock of every node in this process to ``time``, ns."""

    def publish(self, time: int) -> None:
        """Publish what was sent since the last call; ``time``: of this cycle, ns."""
        recorder = self._recorder
        if recorder is not None:
            recorder.begin_cycle(time)
        is_looking = self._must_look(time)
        if is_looking:
            self._look()
        for report in self.reporters:
            report(time)
        for topic, sample in self._outbox:
            if topic.has_subscribers:
                self._write(topic, sample)
            elif topic.keeps_last:
                topic.newest = sample
        self._outbox.clear()
        if is_looking:
            for topic in self._topics:
                if topic.newest is not _NOTHING:
                    self._write(topic, topic.newest)
                    topic.newest = _NOTHING
        if self.followers:
            self.follow()
        if recorder is not None:
            recorder.end_cycle()

    def follow(self) -> None:
        """Have done what waits for the end of a cycle, such as pictures that time waits for."""
        for follow in self.followers:
            follow()

    def _must_look(self, time: int) -> bool:
        """Whether it is time to look who subscribes; always, where time stands still."""
        stands_still, self._latest = time == self._latest, time
        now = self._wall_clock()
        if now < self._next_look and not stands_still:
            return False
        # Somebody may subscribe while time stands still, and then have a single cycle made.
        period = self._look_period * (1 + len(self._topics) // TOPICS_A_LOOK)
        self._next_look = 0 if stands_still else now + period
        return True

    def _look(self) -> None:
        """Look who subscribes, and forget the topics that are gone."""
        gone = []
        for topic in self._topics:
            try:
                topic.look()
            except InvalidHandle:  # a cleanup has removed it
                topic.has_subscribers = topic.keeps_last = False
                gone.append(topic)
                continue
            if topic.has_subscribers and topic.newest is not _NOTHING:
                self._outbox.insert(0, (topic, topic.newest))
                topic.newest = _NOTHING
        if gone:
            with self._changing_topics:
                self._topics = tuple(topic for topic in self._topics if topic not in gone)
                self._recorded = tuple(each for each in self._recorded if each not in gone)

    def _write(self, topic: LoopTopic, sample: Any) -> None:
        try:
            topic.write(sample)
        except InvalidHandle:  # a cleanup has removed the topic since
            topic.has_subscribers = topic.keeps_last = False
        except Exception as error:  # a third party's converter; the robot must go on
            self._logger.error(
                f"Could not publish on '{topic.publisher.topic_name}': {describe(error)}",
                throttle_duration_sec=1.0,
            )


class ClockedLoopPublisher(LoopPublisher):
    """That of the process that owns the time: it publishes ``/clock`` and sets every clock."""

    _parameter_overrides = (Parameter('use_sim_time', value=True),)

    def __init__(self, node: Node, **options: Any) -> None:
        """
        Take the time over.

        Args:
            node: Publishes ``/clock`` and ``~/received``, and lends its logger.
            options: Further keywords of :class:`LoopPublisher`.
        """
        super().__init__(node.get_logger(), **options)
        self._clock = manual_clock()
        publisher = node.create_publisher(Clock, '/clock', CLOCK_QOS)
        encode = encoder_of(int, 'rosgraph_msgs/msg/Clock', _fill_clock, Clock)
        self._clock_topic = self.topic(publisher, encode)
        self._acknowledgements = CommandAcknowledgements(node)

    def adopt(self, node: Node) -> None:
        """
        Have the node go by our clock from now on; its parameter ``use_sim_time`` stays true.

        On the thread that made the node, after its constructor.
        """
        share_clock(node, self._clock)

    def acknowledge(self, topic: str, number: int) -> None:
        """Publish that a controller accepted a publisher's message ``number``, from 1."""
        self._acknowledgements.publish(topic, number)

    def set_clocks(self, time: int) -> None:
        """Set the clock of every node in this process to ``time``, ns."""
        self._clock.set_ros_time_override(Time(nanoseconds=time, clock_type=ClockType.ROS_TIME))
        if self._recorder is not None:
            self._recorder.set_time(time)

    def publish(self, time: int) -> None:
        """Publish ``/clock``, and then what was sent."""
        self._outbox.insert(0, (self._clock_topic, time))
        super().publish(time)


def _fill_clock(time: int, message: Clock) -> None:
    fill_stamp(time, message.clock)


class CommandAcknowledgements:
    """Publishes ``~/received``; from any thread."""

    def __init__(self, node: Node) -> None:
        """``node`` has the topic."""
        self._publisher = node.create_publisher(
            KeyValue, ACKNOWLEDGEMENT_TOPIC, ACKNOWLEDGEMENT_QOS
        )

    def publish(self, topic: str, number: int) -> None:
        """Some publisher's message ``number`` on ``topic`` was accepted."""
        if self._publisher.get_subscription_count():
            self._publisher.publish(KeyValue(key=topic, value=str(number)))


QOS = QoSProfile(depth=10)
"""Reliable: who subscribes best effort, as SensorDataQoS does, is served as well."""


class NodeTopics:
    """
    Topics of a node on which bytes go out at the end of a cycle; the ROS thread makes them.

    They are the :class:`~amr_description.simulation.topics.advertising.Topics` of ROS.
    """

    def __init__(self, node: Node, publisher: LoopPublisher) -> None:
        """
        Make no topic yet.

        Args:
            node: Has the publishers.
            publisher: Publishes at the end of a cycle.
        """
        self._node, self._publisher = node, publisher
        self.reporters, self.followers = publisher.reporters, publisher.followers

    def advertise(self, name: str, message: str, encode: Callable[[Any], bytes]) -> LoopTopic:
        """Make a topic. Raises AmrError: its name or type is no good."""
        kind = message_type(message)
        try:
            publisher = self._node.create_publisher(kind, name, QOS)
        except (RCLError, InvalidTopicNameException) as error:
            raise SimulationError(_reason(error)) from error
        return self._publisher.topic(publisher, encode)

    def withdraw(self, topic: LoopTopic) -> None:
        """Remove a topic."""
        self._node.destroy_publisher(topic.publisher)


def _reason(error: Exception) -> str:
    """Say why there is no such topic, without the line of C that rcl names, and what would do."""
    what = ' '.join(map(str.strip, str(error).splitlines()[:2])).partition(', at ')[0]
    return f'{what}; give it another <topic>, or its robot a namespace'
