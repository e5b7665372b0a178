# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When each message of a recording is due; neither a thread nor a clock of its own.

Whoever plays calls :meth:`BagPlayback.poll` until it returns nothing, and again after
:meth:`BagPlayback.wait_time`, or when something has changed.
"""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from amr_description.bag.playback_clock import PlaybackClock
from amr_description.bag.storage import BagMessage

UNLIMITED = -1


@dataclass(frozen=True)
class PlaybackOptions:
    """What is played, and how; times are ns."""

    rate: float = 1.0
    loop: bool = False
    start_paused: bool = False
    delay: int = 0
    """Of the first message, on the steady clock; a loop does not repeat it."""
    start_offset: int = 0
    """From the begin of the recording."""
    duration: int = UNLIMITED
    """Of recorded time, from the start offset on; negative: to the end."""
    until: int = UNLIMITED
    """The last time that is played; negative: to the end. The later of the two ends it."""
    read_ahead: int = 1000
    """Messages that may be read before they are due."""


class PlayedRecording(Protocol):
    """What is played."""

    @property
    def start(self) -> int:
        """The time of the first message, ns."""

    def messages(self, start: int) -> Iterator[BagMessage]:
        """Yield the messages from a time on, in the order of their times, run after run."""

    def latched_before(self, time: int) -> Sequence[BagMessage]:
        """Return the messages that a subscription which begins at that time would still get."""


class BagPlayback:
    """
    The state of playing a recording.

    What was latched before the begin, or before the place that is sought, is due at once, whether
    paused or not: robot descriptions and fixed transforms are published but once.
    """

    def __init__(
        self, recording: PlayedRecording, options: PlaybackOptions, steady: Callable[[], int]
    ) -> None:
        """
        Begin to play.

        Args:
            recording: whose messages are played.
            options: how.
            steady: returns the time of a clock that nobody sets, ns.
        """
        self._recording = recording
        self._steady = steady
        self.loops = 0
        """How often it has begun anew."""
        self.resets = 0
        """How often times began again since then, or since a place was sought: runs that ended."""
        self._begin(options)
        self.clock = PlaybackClock(
            self._start, steady, rate=options.rate, paused=options.start_paused
        )

    def _begin(self, options: PlaybackOptions) -> None:
        self._options = options
        self._start = self._recording.start + max(options.start_offset, 0)
        self._from = self._start
        self._until = _last_time(options, self._start)
        self._begins_at: int | None = self._steady() + options.delay
        self._latched: deque[BagMessage] = deque()
        self._queue: deque[BagMessage] = deque()
        self._rest: Iterator[BagMessage] = iter(())
        self._count = 0  # since it has begun the last time
        self._newest = 0
        self._finished = False

    @property
    def finished(self) -> bool:
        """Whether all has been played, or it was stopped."""
        return self._finished

    def now(self) -> int:
        """Return the time of the recording, ns; before the first message is due, its begin."""
        return self.clock.now() if self._begins_at is None else self._start

    @property
    def begin(self) -> int:
        """
        The place from which it plays, ns: what is older was latched, and comes at once.

        Where times begin again, it is that.
        """
        return self._from

    @property
    def is_at_end(self) -> bool:
        """Whether no message is left; also while paused, when somebody may still seek."""
        return self._finished or (self._begins_at is None and self._next() is None)

    def poll(self) -> BagMessage | None:
        """Take a message that is due; None: none is."""
        if self._finished or not self._has_begun():
            return None
        if self._latched:
            return self._latched.popleft()
        message = self._next()
        if message is None:
            return self._end_or_loop()
        if self.clock.paused or message.log_time > self.clock.now():
            return None
        return self._take()

    def wait_time(self) -> int | None:
        """Return how long there is nothing to take, ns; None: until something has changed."""
        if self._finished:
            return None
        if self._begins_at is not None:
            return max(0, self._begins_at - self._steady())
        if self._latched:
            return 0
        if self.clock.paused:
            return None
        message = self._next()
        return 0 if message is None else max(0, self.clock.until(message.log_time))

    def read_ahead(self) -> bool:
        """Read a message more, for later; return False if enough are there, or all."""
        if len(self._queue) >= self._options.read_ahead:
            return False
        message = next(self._rest, None)
        if message is not None:
            self._queue.append(message)
        return message is not None

    def play_next(self) -> BagMessage | None:
        """Take the next message while paused; None: it is not paused, or there is none."""
        if not self.clock.paused or self._finished:
            return None
        self._has_begun(at_once=True)
        message = self._next()
        if message is None:
            return None
        self.clock.jump(message.log_time)
        return self._take()

    def seek(self, time: int) -> None:
        """Go on with the first message from then on, ns; before the begin: from there."""
        if not self._finished:
            self._begins_at = None
            self._go_to(max(time, self._start))

    def stop(self) -> None:
        """End."""
        self._finished = True

    def play(self, options: PlaybackOptions) -> bool:
        """Begin again after the end; return False while it is played."""
        if not self._finished:
            return False
        self._begin(options)
        return True

    def _has_begun(self, *, at_once: bool = False) -> bool:
        if self._begins_at is not None:
            if self._steady() < self._begins_at and not at_once:
                return False
            self._begins_at = None
            self._go_to(self._start)
        return True

    def _go_to(self, time: int) -> None:
        self._from = time
        self._newest = self.resets = 0
        self._latched = deque(self._recording.latched_before(time))
        self._queue.clear()
        self._rest = self._recording.messages(time)
        self.clock.jump(time)

    def _end_or_loop(self) -> BagMessage | None:
        if self.clock.paused:  # somebody may still seek
            return None
        if not self._options.loop or not self._count:  # an empty one would loop without a pause
            self._finished = True
            return None
        self.loops += 1
        self._count = 0
        self._go_to(self._start)
        return self.poll()

    def _next(self) -> BagMessage | None:
        if not self._queue:
            message = next(self._rest, None)
            if message is None:
                return None
            self._queue.append(message)
        message = self._queue[0]
        if message.log_time < self._newest:
            self.resets += 1
            self._newest = self._from = message.log_time
            self.clock.jump(message.log_time)
        return message if self._until < 0 or message.log_time <= self._until else None

    def _take(self) -> BagMessage:
        self._count += 1
        message = self._queue.popleft()
        self._newest = message.log_time
        return message


def _last_time(options: PlaybackOptions, start: int) -> int:
    """Return the last time that is played, ns; negative: there is none. 0: play nothing."""
    if options.duration < 0 and options.until < 0:
        return UNLIMITED
    by_duration = start + options.duration if options.duration > 0 else options.duration
    return max(by_duration, options.until)
