# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Records a run of the simulator, in its process, to a bag.

Every message is written that this process publishes, but for those that depend on the wall clock
(``/diagnostics``, the statistics, ``/rosout``) or on who calls (status and feedback of actions,
events of services, ``/parameter_events``, ``~/received``), and the commands that controllers take.
Its time is the simulated time at which it is published, that of a command the time of the update
which acts on it. So equal runs have equal files, byte for byte, however they were stepped.

Messages of cycles are recorded when controllers tick, not while time stands still.

After a jump back of time a new file begins with the first message of a tick; what was published
between the two, where time stands still, is in it.

Where time waits (in a step, or at real-time factor 0) it waits for the disk, too, and nothing is
lost. In real time a thread writes; what has no room in memory is counted and said, but for latched
messages, which are always kept. A disk that is full ends the recording, not the simulation.
"""

from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
import math
from pathlib import Path
import re
import threading
import time as wall
from typing import TypeAlias

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.schemas import compose, schema_text
from amr_description.bag.storage import BagMessage, OVERHEAD, TopicMetadata
from amr_description.bag.type_hashes import type_hash
from amr_description.clock import NANOSECONDS
from amr_description.errors import BagError
from amr_description.log import Log, Severity
from amr_description.messages.definitions import hashes, texts
from amr_description.streams import print_traceback
from amr_description.text import shorten

MOST_QUEUED = 100_000_000
"""Bytes of messages that wait for the disk in real time; what comes then is lost."""
LONGEST_DRAIN = 8.0
"""s of the wall clock for what waits at the end; what is left then is lost, and counted."""
LONGEST_END = 10.0
"""s of the wall clock for the whole end, below those after which a launch kills a process."""
_LOG_PERIOD = 10.0
"""s of the wall clock between two lines of what is lost."""
_LATCHED = QosProfile(depth=1, durability='transient_local')

Sink: TypeAlias = Callable[[bytes], None]
"""Takes a serialized message; on any thread."""


def hash_of(kind: str) -> str:
    """Return the hash of a type of messages, ``RIHS01_…``; empty: it is not known."""
    return hashes().get(kind) or type_hash(kind)


def schema_of(kind: str) -> str:
    """Return the text of a type of messages, and of those in it; empty: it is not known."""
    return compose(kind, texts().get) or schema_text(kind)


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


@dataclass(frozen=True)
class _Latched:
    """A message that is written however slow the disk is: later files begin with it, too."""

    message: BagMessage


_Item: TypeAlias = BagMessage | _Latched | TopicMetadata | _Jump


class RunRecorder:
    """Records what a publisher of a loop hands over; see the module."""

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
        self._options, self._log = options, log
        self._has_ticked, self._is_paced = has_ticked, is_paced
        self._time, self._is_in_tick = time, False
        self.commands: frozenset[str] = frozenset()
        """Topics of commands."""
        self.on_commands: Callable[[], None] = lambda: None
        """Called when there is another one; on any thread."""
        self._topics: dict[str, TopicMetadata] = {}
        self._latched: dict[str, bytes] = {}
        self.on_failure: Callable[[], None] = lambda: None
        """Called once on the control thread, when nothing can be recorded any more."""
        self._batch: list[_Item] = []
        self._after_jump: list[_Item] | None = None
        """What was published since time has jumped back; None: its file has begun."""
        self._is_closed = False
        self._adding = threading.Lock()
        self._writer = _WriterThread(BagWriter(folder), options.most_queued, log)

    def prepare(self, name: str) -> None:
        """Read the hash of a type of messages from its file, on a thread that has time."""
        hash_of(name)

    # --- messages -----------------------------------------------------------------------------

    def set_time(self, time: int) -> None:
        """Give what follows a time, ns; if it has jumped back, the next tick begins a file."""
        with self._adding:
            has_jumped, self._time = time < self._time, time
            if has_jumped:
                self._after_jump = [
                    _Latched(BagMessage(topic, data, time, time))
                    for topic, data in self._latched.items()
                ]

    def begin_cycle(self, time: int) -> None:
        """Begin the messages of a cycle: they are recorded if it is a tick."""
        self._is_in_tick = self._has_ticked(time)

    def end_cycle(self) -> None:
        """Write what has come, or have it written if cycles must not wait."""
        if self._batch:
            with self._adding:
                items, self._batch = self._batch, []
            if self._is_paced():
                self._writer.put(items)
            else:
                self._writer.write(items)
        if self._writer.error is not None and not self._is_closed:
            with self._adding:
                self._is_closed = True
            self.on_failure()

    def sink_of_samples(self, metadata: TopicMetadata) -> Sink | None:
        """Return what takes the samples of cycles; None: this topic is not wanted."""
        if not self._declare(metadata):
            return None
        topic = metadata.name

        def take(data: bytes) -> None:
            if self._is_in_tick:
                self._add(topic, data, begins_file=True)

        def take_latched(data: bytes) -> None:
            # Controllers are activated while time stands still, too.
            if self._is_in_tick or self._latched.get(topic) != data:
                self._add(topic, data, is_latched=True, begins_file=self._is_in_tick)

        return take_latched if _is_latched(self._topics[topic]) else take

    def sink_of_messages(self, metadata: TopicMetadata) -> Sink | None:
        """Return what takes messages that are published now and then, likewise."""
        if not self._declare(metadata):
            return None
        topic = metadata.name
        is_latched = _is_latched(self._topics[topic])
        return lambda data: self._add(topic, data, is_latched=is_latched)

    def sink_of_commands(self, name: str, kind: str) -> Sink | None:
        """Return what takes the messages that a controller acts on, likewise."""
        if not self._declare(TopicMetadata(name, kind, 'cdr', (QosProfile(),))):
            return None
        if name not in self.commands:
            self.commands = self.commands | {name}
            self.on_commands()
        return lambda data: self._add(name, data, begins_file=True)

    # --- what the simulator adds --------------------------------------------------------------

    def latch(self, topic: str, type_name: str, data: bytes) -> None:
        """Record a message that is there from now on, and at the beginning of each file."""
        metadata = TopicMetadata(topic, type_name, 'cdr', (_LATCHED,))
        if self._declare(metadata) and self._latched.get(topic) != data:
            self._add(topic, data, is_latched=True)

    def add_sample(self, topic: str, type_name: str, data: bytes) -> None:
        """Record a message of a cycle, if that is a tick."""
        metadata = TopicMetadata(topic, type_name, 'cdr', (QosProfile(),))
        if self._is_in_tick and self._declare(metadata):
            self._add(topic, data, begins_file=True)

    def unlatch(self, topic: str) -> None:
        """Have files that begin later without the message of a topic."""
        with self._adding:
            self._latched.pop(topic, None)

    def close(self) -> int:
        """
        Write the rest; nothing is added any more. Return the number of messages.

        It takes no longer than :data:`LONGEST_END`. Raises BagError: not all could be written,
        which may have been said before.
        """
        with self._adding:
            items, self._batch, self._is_closed = self._batch, [], True
        return self._writer.close(items)

    def _declare(self, metadata: TopicMetadata) -> bool:
        """Take in a topic, unless it is not wanted, or there with another type."""
        name, kind = metadata.name, metadata.type
        if not self._options.wants(name):
            return False
        with self._adding:
            if name not in self._topics:
                topic = replace(metadata, type_description_hash=hash_of(kind))
                self._topics[name] = topic
                self._batch.append(topic)
        return self._topics[name].type == kind

    def _add(
        self, topic: str, data: bytes, *, is_latched: bool = False, begins_file: bool = False
    ) -> None:
        with self._adding:
            if is_latched:
                self._latched[topic] = data
            if self._is_closed:
                return
            if self._after_jump is not None and begins_file:
                self._batch += [_Jump(), *self._after_jump]
                self._after_jump = None
            message = BagMessage(topic, data, self._time, self._time)
            items = self._batch if self._after_jump is None else self._after_jump
            items.append(_Latched(message) if is_latched else message)


class _WriterThread:
    """
    Writes items to a bag, at once or in a thread.

    One thread at a time uses the bag; the last one is always the thread, which completes it, so
    that nobody waits longer than :data:`LONGEST_END` for a disk that stands.
    """

    def __init__(self, bag: BagWriter, most_queued: int, log: Log) -> None:
        self.error: BagError | None = None
        """Why nothing is written any more."""
        self._bag, self._most, self._log = bag, most_queued, log
        self._writing = threading.Lock()
        self._queue: deque[list[_Item]] = deque()
        self._size = 0
        self._lost = 0
        self._next_line = -math.inf
        self._is_writing = False
        self._end_of_drain: float | None = None
        self._has_changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._second: int | None = None

    def put(self, items: list[_Item]) -> None:
        """Have items written; messages for which there is no room are lost, and counted."""
        with self._has_changed:
            if self._size > self._most:
                items = self._without_messages(items)
            self._enqueue(items)
        self._tell_lost()

    def write(self, items: list[_Item]) -> None:
        """Write items now, behind all that waits."""
        if self._thread is not None:
            with self._has_changed:
                self._has_changed.wait_for(
                    lambda: self._end_of_drain is not None or not (self._queue or self._is_writing)
                )
                if self._end_of_drain is not None:  # the disk stands, and the process ends
                    return
        self._write(items)

    def close(self, items: list[_Item]) -> int:
        """Write items, and complete the bag. Raises BagError."""
        with self._has_changed:
            self._end_of_drain = wall.monotonic() + LONGEST_DRAIN
            thread = self._enqueue(items)
        thread.join(LONGEST_END)
        self._next_line = -math.inf
        self._tell_lost()
        if thread.is_alive():
            raise BagError(f'the disk has not taken all within {LONGEST_END:g} s')
        if self.error is not None:
            raise self.error
        return self._bag.message_count

    def _enqueue(self, items: list[_Item]) -> threading.Thread:
        self._size += _size_of(items)
        self._queue.append(items)
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name='bag writer', daemon=True)
            self._thread.start()
        self._has_changed.notify_all()
        return self._thread

    def _run(self) -> None:
        while (items := self._next()) is not None:
            try:
                self._write(items)
            finally:
                with self._has_changed:
                    self._size -= _size_of(items)
                    self._is_writing = False
                    self._has_changed.notify_all()
        with self._failing(), self._writing:
            self._bag.close()

    def _next(self) -> list[_Item] | None:
        """Wait for items; None: the end."""
        with self._has_changed:
            self._has_changed.wait_for(lambda: self._queue or self._end_of_drain is not None)
            if not self._queue:
                return None
            items = self._queue.popleft()
            if self._end_of_drain is not None and wall.monotonic() > self._end_of_drain:
                self._size -= _size_of(items)
                items = self._without_messages(items)
            self._is_writing = True
            return items

    def _without_messages(self, items: list[_Item]) -> list[_Item]:
        """Count messages as lost, and return what must not be."""
        kept: list[_Item] = [each for each in items if not isinstance(each, BagMessage)]
        self._lost += len(items) - len(kept)
        return kept

    def _write(self, items: list[_Item]) -> None:
        with self._writing:
            if self.error is None:
                with self._failing():
                    for item in items:
                        self._write_one(item)

    @contextmanager
    def _failing(self) -> Iterator[None]:
        """Write nothing any more after an error."""
        try:
            yield
        except Exception as error:
            if isinstance(error, BagError):
                found = error
            else:  # a fault of this program ends the recording alone
                print_traceback()
                reason = shorten(f'{type(error).__name__}: {error}')
                found = BagError(f'the recorder failed: {reason}')
            if self.error is None:
                self.error = found
                self._log(Severity.ERROR, f'nothing is recorded any more: {found}')

    def _write_one(self, item: _Item) -> None:
        match item:
            case BagMessage():
                self._write_message(item)
            case _Latched():
                self._write_message(item.message)
            case TopicMetadata():
                self._bag.add_topic(item, schema_of(item.type))
            case _Jump():
                if self._second is not None:  # something was written
                    self._bag.split()

    def _write_message(self, message: BagMessage) -> None:
        # By simulated time, so that the borders of chunks are the same in equal runs.
        second = message.log_time // NANOSECONDS
        if self._second not in (None, second):
            self._bag.flush()
        self._second = second
        self._bag.write(message)

    def _tell_lost(self) -> None:
        now = wall.monotonic()
        if self._lost and now >= self._next_line:
            self._next_line = now + _LOG_PERIOD
            self._log(
                Severity.WARN,
                f'{self._lost} messages were not recorded: the disk is too slow; leave topics out '
                'by record_exclude_regex, or record in lock-step, where time waits for it',
            )


def _size_of(items: list[_Item]) -> int:
    """Return how many bytes of memory the messages take that may be lost."""
    return sum(len(each.data) + OVERHEAD for each in items if isinstance(each, BagMessage))


def _is_latched(topic: TopicMetadata) -> bool:
    return any(each.durability == 'transient_local' for each in topic.offered_qos_profiles)
