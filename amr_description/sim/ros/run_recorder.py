# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Records a run of the simulator, in its process, to a bag.

Every message is written that this process publishes, but for those that depend on the wall clock
(``/diagnostics``, the statistics, ``/rosout``), and the commands that controllers take. Its time
is the simulated time at which it is published, that of a command the time of the update which acts
on it. So equal runs have equal files, byte for byte, however they were stepped.

Messages of cycles are recorded when controllers tick, not while time stands still.

Where time waits (in a step, or at real-time factor 0) it waits for the disk, too, and nothing is
lost. In real time a thread writes; what has no room in memory is counted and said. A disk that is
full ends the recording, not the simulation.
"""

from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
import math
from pathlib import Path
import re
import threading
import time as wall

from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.ros.qos_profiles import from_rclpy
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.bag.type_hashes import type_hash
from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Log, Severity
from amr_description.control.ros.tape import Sink
from amr_description.errors import BagError
from amr_description.ros.message_types import type_name

MOST_QUEUED = 100_000_000
"""Bytes of messages that wait for the disk in real time; what comes then is lost."""
_LOG_PERIOD = 10.0
"""s of the wall clock between two lines of what is lost."""
_LATCHED = QosProfile(depth=1, durability='transient_local')


@dataclass(frozen=True)
class RunOptions:
    """What is recorded."""

    regex: re.Pattern[str] | None = None
    """Of the names of topics, each as a whole; None: all."""
    exclude_regex: re.Pattern[str] | None = None
    """Likewise, of those that are left out."""
    most_queued: int = MOST_QUEUED

    def wants(self, topic: str) -> bool:
        """Return whether a topic is recorded."""
        if self.exclude_regex is not None and self.exclude_regex.fullmatch(topic):
            return False
        return self.regex is None or self.regex.fullmatch(topic) is not None


@dataclass(frozen=True)
class _Jump:
    """Time has gone back: a new file."""


type _Item = BagMessage | TopicMetadata | _Jump


class RunRecorder:
    """The ``Tape`` of the loop's publisher; made and closed on the ROS thread."""

    def __init__(
        self,
        folder: Path,
        options: RunOptions,
        *,
        time: int,
        has_ticked: Callable[[int], bool],
        is_paced: Callable[[], bool],
        log: Log,
    ) -> None:
        """
        Make the bag.

        Args:
            folder: of the bag, which must not be there.
            options: what is recorded.
            time: the present simulated time, ns.
            has_ticked: whether the cycle of a time, ns, is one in which controllers tick.
            is_paced: whether cycles wait for the wall clock, so that none must wait for the disk.
            log: gets a line when something is lost, or cannot be written.

        Raises:
            BagError: the folder is there, or cannot be made.
        """
        self.folder = folder
        self._writer = BagWriter(folder)
        self._options, self._log = options, log
        self._has_ticked, self._is_paced = has_ticked, is_paced
        self._time, self._is_in_tick = time, False
        self.commands: frozenset[str] = frozenset()
        """Topics of commands."""
        self.on_commands: Callable[[], None] = lambda: None
        """Called when there is another one; on any thread."""
        self._topics: dict[str, TopicMetadata] = {}
        self._latched: dict[str, bytes] = {}
        self._batch: list[_Item] = []
        self._is_closed = False
        self._adding = threading.Lock()
        self._scribe = _Scribe(self._writer, options.most_queued, log)

    # --- tape ---------------------------------------------------------------------------------

    def set_time(self, time: int) -> None:
        """Give what follows a time, ns; begin a file if it has jumped back."""
        with self._adding:
            has_jumped, self._time = time < self._time, time
            if has_jumped:
                self._batch.append(_Jump())
                for topic, data in self._latched.items():
                    self._batch.append(BagMessage(topic, data, time, time))

    def begin_cycle(self, time: int) -> None:
        """Begin the messages of a cycle: they are recorded if it is a tick."""
        self._is_in_tick = self._has_ticked(time)

    def end_cycle(self) -> None:
        """Write what has come, or have it written if cycles must not wait."""
        if self._batch:
            with self._adding:
                items, self._batch = self._batch, []
            if self._is_paced():
                self._scribe.put(items)
            else:
                self._scribe.write(items)

    def forget(self, publisher: Publisher) -> None:
        """Keep nothing that a publisher has latched, for it is destroyed."""
        with suppress(InvalidHandle):
            self.unlatch(publisher.topic_name)

    def samples_of(self, publisher: Publisher) -> Sink | None:
        """Return what takes the samples of cycles; None: this topic is not wanted."""
        topic = self._topic_of(publisher)
        if topic is None:
            return None

        def take(data: bytes) -> None:
            if self._is_in_tick:
                self._add(topic, data)

        return take

    def messages_of(self, publisher: Publisher) -> Sink | None:
        """Return what takes messages that are published now and then, likewise."""
        topic = self._topic_of(publisher)
        if topic is None:
            return None
        is_latched = _is_latched(self._topics[topic])
        return lambda data: self._add(topic, data, is_latched=is_latched)

    def commands_of(self, subscription: Subscription) -> Sink | None:
        """Return what takes the messages that a controller acts on, likewise."""
        try:
            name, kind = subscription.topic_name, type_name(subscription.msg_type)
        except InvalidHandle:
            return None
        if not self._declare(name, kind, QosProfile()):
            return None
        if name not in self.commands:
            self.commands = self.commands | {name}
            self.on_commands()
        return lambda data: self._add(name, data)

    # --- what the simulator adds --------------------------------------------------------------

    def latch(self, topic: str, type_name: str, data: bytes) -> None:
        """Record a message that is there from now on, and at the beginning of each file."""
        if self._declare(topic, type_name, _LATCHED) and self._latched.get(topic) != data:
            self._add(topic, data, is_latched=True)

    def add_sample(self, topic: str, type_name: str, data: bytes) -> None:
        """Record a message of a cycle, if that is a tick."""
        if self._is_in_tick and self._declare(topic, type_name, QosProfile()):
            self._add(topic, data)

    def unlatch(self, topic: str) -> None:
        """Have files that begin later without the message of a topic."""
        with self._adding:
            self._latched.pop(topic, None)

    def close(self) -> int:
        """
        Write the rest; nothing is added any more. Return the number of messages.

        Raises BagError: not all could be written, which may have been said before.
        """
        with self._adding:
            items, self._batch, self._is_closed = self._batch, [], True
        self._scribe.write(items)
        self._scribe.end()
        return self._writer.close().message_count

    def _topic_of(self, publisher: Publisher) -> str | None:
        try:
            name = publisher.topic_name
            profile = from_rclpy(publisher.qos_profile)
        except InvalidHandle:  # its robot has been removed
            return None
        return name if self._declare(name, type_name(publisher.msg_type), profile) else None

    def _declare(self, name: str, kind: str, profile: QosProfile) -> bool:
        """Take in a topic, unless it is not wanted."""
        if not self._options.wants(name):
            return False
        with self._adding:
            if name not in self._topics:
                topic = TopicMetadata(name, kind, 'cdr', (profile,), type_hash(kind))
                self._topics[name] = topic
                self._batch.append(topic)
        return self._topics[name].type == kind

    def _add(self, topic: str, data: bytes, *, is_latched: bool = False) -> None:
        with self._adding:
            if is_latched:
                self._latched[topic] = data
            if not self._is_closed:
                self._batch.append(BagMessage(topic, data, self._time, self._time))


class _Scribe:
    """Writes items to a bag, at once or in a thread."""

    def __init__(self, writer: BagWriter, most_queued: int, log: Log) -> None:
        self._writer, self._most, self._log = writer, most_queued, log
        self._queue: deque[list[_Item]] = deque()
        self._size = 0
        self._lost = 0
        self._next_line = -math.inf
        self._is_writing = self._is_ending = False
        self._has_changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._error: BagError | None = None
        self._second: int | None = None

    def put(self, items: list[_Item]) -> None:
        """Have items written; messages for which there is no room are lost, and counted."""
        with self._has_changed:
            if self._size > self._most:
                kept: list[_Item] = [each for each in items if not isinstance(each, BagMessage)]
                self._lost += len(items) - len(kept)
                items = kept
            self._size += _size_of(items)
            self._queue.append(items)
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name='recording', daemon=True)
                self._thread.start()
            self._has_changed.notify_all()
        if self._lost:
            self._tell_lost()

    def write(self, items: list[_Item]) -> None:
        """Write items now, behind all that waits."""
        if self._thread is not None:
            with self._has_changed:
                self._has_changed.wait_for(lambda: not (self._queue or self._is_writing))
        self._write(items)

    def end(self) -> None:
        """End the thread, when all is written."""
        if self._thread is not None:
            with self._has_changed:
                self._is_ending = True
                self._has_changed.notify_all()
            self._thread.join()
        self._next_line = -math.inf
        if self._lost:
            self._tell_lost()

    def _run(self) -> None:
        while True:
            with self._has_changed:
                self._has_changed.wait_for(lambda: self._queue or self._is_ending)
                if not self._queue:
                    return
                items = self._queue.popleft()
                self._is_writing = True
            self._write(items)
            with self._has_changed:
                self._size -= _size_of(items)
                self._is_writing = False
                self._has_changed.notify_all()

    def _write(self, items: list[_Item]) -> None:
        if self._error is not None:
            return
        try:
            for item in items:
                self._write_one(item)
        except BagError as error:
            self._error = error
            self._log(Severity.ERROR, f'nothing is recorded any more: {error}')

    def _write_one(self, item: _Item) -> None:
        match item:
            case BagMessage():
                # By simulated time, so that the borders of chunks are the same in equal runs.
                second = item.log_time // NANOSECONDS
                if self._second not in (None, second):
                    self._writer.flush()
                self._second = second
                self._writer.write(item)
            case TopicMetadata():
                self._writer.add_topic(item)
            case _Jump():
                if self._second is not None:  # something was written
                    self._writer.split()

    def _tell_lost(self) -> None:
        now = wall.monotonic()
        if now >= self._next_line:
            self._next_line = now + _LOG_PERIOD
            self._log(
                Severity.WARN,
                f'{self._lost} messages were not recorded: the disk is too slow; leave topics out '
                'by record_exclude_regex, or record in lock-step, where time waits for it',
            )


def _size_of(items: list[_Item]) -> int:
    return sum(len(each.data) for each in items if isinstance(each, BagMessage))


def _is_latched(topic: TopicMetadata) -> bool:
    return any(each.durability == 'transient_local' for each in topic.offered_qos_profiles)
