# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The node that records topics: it subscribes to what comes, and writes it as it is on the wire.

One thread takes messages, another one writes them; that of the executor looks for topics and
serves the services.
"""

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
import threading
import time

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.ros.message_cache import MessageCache
from amr_description.bag.ros.qos_profiles import from_rclpy, to_rclpy
from amr_description.bag.ros.topic_types import topic_class
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.bag.topic_filter import TopicFilter
from amr_description.errors import AmrError, BagError
from amr_description.ros.polled_topic import NeverCalled
from amr_description.ros.rclpy_internals import SubscriptionWaiter, take_with_info
from amr_description.streams import print_traceback
from amr_description.text import shorten

# Messages that DDS keeps of a topic while the thread that takes them does not run: a second of a
# fast one. It takes memory only then.
_DEPTH = 20_000
_AT_ONCE = 100  # messages of a topic that are taken before those of the next one
_FLUSH_PERIOD = 1.0  # s: no more than that is lost if the program is killed


@dataclass(frozen=True)
class RecorderOptions:
    """What is recorded, and how."""

    topics: TopicFilter = field(default_factory=TopicFilter)
    overrides: Mapping[str, QosProfile] = field(default_factory=dict)
    """The QoS to subscribe with, by topic."""
    use_sim_time: bool = False
    include_unpublished_topics: bool = False
    ignore_leaf_topics: bool = False
    start_paused: bool = False
    snapshot_mode: bool = False
    max_cache_size: int = 100 * 1024 * 1024
    """Bytes; 0: who takes a message writes it."""


class Recorder:
    """Records until :meth:`end`; its methods are called on the thread of the executor."""

    def __init__(self, node: Node, writer: BagWriter, options: RecorderOptions) -> None:
        """
        Begin without topics.

        Args:
            node: subscribes; an executor leaves its subscriptions alone (but EventsExecutor).
            writer: of the bag; nobody else calls it until the end.
            options: as above.
        """
        self.node = node
        self.options = options
        self.error: BagError | None = None
        """Why nothing is recorded any more."""
        self.bytes_received = 0
        self.messages_received = 0
        self.messages_skipped = 0
        """While it was paused, or before there was a simulated time."""
        self.is_paused = options.start_paused
        self._writer = writer
        self._writing = threading.Lock()
        self._cache = MessageCache(options.max_cache_size, keep_latest=options.snapshot_mode)
        self._profiles: dict[str, QoSProfile] = {}
        self._topics: dict[str, TopicMetadata] = {}
        self._subscriptions: dict[str, Subscription] = {}
        # A topic that is subscribed to anew: the thread that receives takes what waits in the
        # former subscription, and that of the executor then destroys it.
        self._retired: deque[tuple[str, Subscription]] = deque()
        self._drained: deque[Subscription] = deque()
        # What is to be added to the bag: this thread does not wait for the disk.
        self._found: deque[TopicMetadata] = deque()
        self._refused: set[str] = set()
        self._has_hidden = False  # and said so
        self._clock = node.get_clock()
        self._last_time = 0
        self._is_ending = False
        self._waiter = SubscriptionWaiter([], node.context)
        self._receiver = threading.Thread(target=self._receive, name='recorder: receive')
        self._writer_thread = threading.Thread(target=self._write_all, name='recorder: write')

    @property
    def topics(self) -> Mapping[str, TopicMetadata]:
        """What is recorded, by name."""
        return self._topics

    @property
    def lost(self) -> Mapping[str, int]:
        """How many messages of each topic there was no room for."""
        return {} if self.options.snapshot_mode else self._cache.lost

    @property
    def is_complete(self) -> bool:
        """Whether all topics that were asked for by name are there, and nothing else was."""
        wanted = self.options.topics
        is_replacing = bool(self._retired or self._drained)
        return wanted.names_all and wanted.names <= self._topics.keys() and not is_replacing

    def start(self) -> None:
        """Begin to record."""
        self._receiver.start()
        self._writer_thread.start()

    def end(self) -> None:
        """Record no more, and write what has come; the writer is left open."""
        self.end_receiving()
        self.complete()

    def end_receiving(self) -> None:
        """Record no more of what comes; what has come :meth:`complete` waits for."""
        self._is_ending = True
        self._waiter.wake()
        self._receiver.join()
        self._cache.close()
        self._destroy_drained()
        for subscription in self._subscriptions.values():
            self.node.destroy_subscription(subscription)
        self._waiter.destroy()

    def complete(self) -> None:
        """Wait until what has come is written, after :meth:`end_receiving`; on any thread."""
        self._writer_thread.join()
        with self._writing:
            self._try(self._add_topics)

    def discover(self) -> list[str]:
        """Subscribe to what is new; return the names of the topics."""
        self._destroy_drained()
        found = []
        for topic, types in self.node.get_topic_names_and_types():
            if topic not in self._refused and self._is_wanted(topic, types):
                publishers = self.node.get_publishers_info_by_topic(topic)
                if publishers or self.options.include_unpublished_topics:
                    found += self._subscribe(topic, types[0], publishers)
        return found

    def pause(self) -> None:
        """Drop what comes; on any thread."""
        self.is_paused = True
        self.node.get_logger().info('Pausing recording.')

    def resume(self) -> None:
        """Record what comes; on any thread."""
        self.is_paused = False
        self.node.get_logger().info('Resuming recording.')

    def toggle_paused(self) -> None:
        """Pause, or go on; on any thread."""
        if self.is_paused:
            self.resume()
        else:
            self.pause()

    def split(self) -> None:
        """Go on in a new file."""
        with self._writing:
            self._try(self._writer.split)

    def snapshot(self) -> bool:
        """Write what is in memory; return whether it was, as in snapshot mode."""
        if not self.options.snapshot_mode:
            return False
        self._write(self._cache.take())
        with self._writing:
            self._try(self._writer.flush)
        return self.error is None

    def _is_wanted(self, topic: str, types: list[str]) -> bool:
        if not any(self.options.topics.wants(topic, each) for each in types):
            if not self._has_hidden:
                self._has_hidden = any(self.options.topics.chooses(topic, each) for each in types)
                if self._has_hidden:
                    self.node.get_logger().warning(
                        'Hidden topics are not recorded. Enable them with --include-hidden-topics'
                    )
            return False
        if len(set(types)) > 1:
            self._refuse(
                topic,
                f"Topic '{topic}' has more than one type associated. Only topics with one type "
                'are supported',
            )
            return False
        leaf = self.options.ignore_leaf_topics
        return not (leaf and not self.node.count_subscribers(topic) and topic not in self._topics)

    def _refuse(self, topic: str, reason: str) -> None:
        self._refused.add(topic)
        self.node.get_logger().warning(reason)

    def _subscribe(
        self, topic: str, type_name: str, publishers: list[TopicEndpointInfo]
    ) -> list[str]:
        """Subscribe, or anew if a publisher has come that offers less; return what is new."""
        profile = self._profile(topic, [each.qos_profile for each in publishers])
        metadata = TopicMetadata(
            topic,
            type_name,
            'cdr',
            tuple(from_rclpy(each.qos_profile) for each in publishers),
            _type_hash(publishers),
        )
        is_new = topic not in self._topics
        if not is_new and (metadata == self._topics[topic] or not publishers):
            return []
        if is_new or profile != self._profiles[topic]:
            try:
                message_class = topic_class(type_name)
            except AmrError as error:
                self._refuse(
                    topic,
                    f"Topic '{topic}' has unknown type '{type_name}' . Only topics with known "
                    f"type are supported. Reason: '{error}'",
                )
                return []
        self._found.append(metadata)  # before a message of it can come
        self._topics[topic] = metadata
        if is_new or profile != self._profiles[topic]:
            self._profiles[topic] = profile
            former = self._subscriptions.get(topic)
            self._subscriptions[topic] = self.node.create_subscription(
                message_class,
                topic,
                _ignore,
                profile,
                callback_group=NeverCalled(),
                raw=True,
            )
            if former is not None:
                self._retired.append((topic, former))
            self._waiter.wake()
        return [topic] if is_new else []

    def _destroy_drained(self) -> None:
        while self._drained:
            self.node.destroy_subscription(self._drained.popleft())

    def _profile(self, topic: str, offered: list[QoSProfile]) -> QoSProfile:
        override = self.options.overrides.get(topic)
        return to_rclpy(override) if override else adapted(offered)

    def _receive(self) -> None:
        """Take messages, in a thread."""
        try:
            served: dict[str, Subscription] = {}
            while not self._is_ending:
                if served != self._subscriptions:
                    served = self._replace()
                if not any([self._take(name, each) for name, each in served.items()]):
                    with suppress(InvalidHandle):
                        self._waiter.wait()
            for name, each in self._replace().items():
                self._drain(name, each)
        except Exception as error:
            if not self._is_ending:
                self._fail(error)

    def _replace(self) -> dict[str, Subscription]:
        """Wait for the present subscriptions from now on, and return them by topic."""
        retired = [self._retired.popleft() for _ in range(len(self._retired))]
        served = dict(self._subscriptions)  # none of the retired: each was replaced before
        self._waiter.serve(list(served.values()))
        for topic, each in retired:
            self._drain(topic, each)
            self._drained.append(each)
        return served

    def _drain(self, topic: str, subscription: Subscription) -> None:
        """Take what waits now; not what comes all the time."""
        for _ in range(_DEPTH // _AT_ONCE):
            if not self._take(topic, subscription):
                break

    def _take(self, topic: str, subscription: Subscription) -> bool:
        """Take some messages of a topic; return whether there may be more."""
        use_sim_time = self.options.use_sim_time
        messages = []
        for _ in range(_AT_ONCE):
            taken = take_with_info(subscription)
            if taken is None:
                break
            data, info = taken
            received = info['received_timestamp'] or time.time_ns()
            log_time = self._clock.now().nanoseconds if use_sim_time else received
            if self.is_paused or log_time <= 0:
                self.messages_skipped += 1
                continue
            self.messages_received += 1
            self.bytes_received += len(data)
            sent = max(0, info['source_timestamp'])  # -1: the publisher's middleware has none
            messages.append(BagMessage(topic, data, log_time, sent))
        if messages and self.options.max_cache_size:
            self._cache.add(*messages)
        elif messages:
            self._write(messages)
        return taken is not None

    def _write_all(self) -> None:
        """Write what comes, in a thread; a second after it was written it is safe."""
        try:
            if not self.options.snapshot_mode:
                self._write_until_end()
        except Exception as error:
            self._fail(error)

    def _write_until_end(self) -> None:
        is_direct = not self.options.max_cache_size  # the thread that receives writes, too
        flushed, has_more = time.monotonic(), is_direct
        while (messages := self._cache.wait(_FLUSH_PERIOD if has_more else None)) is not None:
            self._write(messages)
            has_more = has_more or bool(messages)
            if has_more and time.monotonic() - flushed >= _FLUSH_PERIOD:
                with self._writing:
                    self._try(self._add_topics)
                    self._try(self._writer.flush)
                flushed, has_more = time.monotonic(), is_direct

    def _write(self, messages: Iterable[BagMessage]) -> None:
        with self._writing:
            if self.error is not None:
                return
            try:
                for message in messages:
                    self._write_one(message)
            except BagError as error:
                self.error = error

    def _write_one(self, message: BagMessage) -> None:
        # A simulation was reset: times never run backwards in one file.
        if self.options.use_sim_time and message.log_time < self._last_time:
            self._writer.split()
        self._last_time = message.log_time
        self._add_topics()
        self._writer.write(message)

    def _add_topics(self) -> None:
        while self._found:
            self._writer.add_topic(self._found.popleft())

    def _fail(self, error: Exception) -> None:
        """Record no more, because of a fault of the program."""
        print_traceback()
        if self.error is None:
            reason = shorten(f'{type(error).__name__}: {error}')
            self.error = BagError(f'the recorder failed: {reason}')

    def _try(self, write: Callable[[], object]) -> None:
        if self.error is None:
            try:
                write()
            except BagError as error:
                self.error = error


def adapted(offered: Iterable[QoSProfile]) -> QoSProfile:
    """Return the strongest QoS that hears all publishers."""
    profiles = list(offered)
    reliable = all(each.reliability == ReliabilityPolicy.RELIABLE for each in profiles)
    latched = all(each.durability == DurabilityPolicy.TRANSIENT_LOCAL for each in profiles)
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=_DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=(
            DurabilityPolicy.TRANSIENT_LOCAL if latched and profiles else DurabilityPolicy.VOLATILE
        ),
        liveliness=LivelinessPolicy.AUTOMATIC,
    )


def _type_hash(publishers: list[TopicEndpointInfo]) -> str:
    hashes = (str(each.topic_type_hash) for each in publishers)
    return next((text for text in hashes if text.startswith('RIHS')), '')


def _ignore(_: bytes) -> None:
    """Stand for the callback, which rclpy is not to call."""
