# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The poses of one frame in its parent over the last seconds, as in tf2's ``TimeCache``.

Times are integer nanoseconds since the epoch of the clock that stamps the transforms. As in tf2,
time 0 asks for the latest.
"""

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from typing import TypeAlias

from amr_description.errors import ExtrapolationException
from amr_description.model.frames import Transform

LATEST = 0
"""ns: the time that stands for the latest."""

_RESTART = 3  # refused samples in a row, each later than the one before


@dataclass(frozen=True, slots=True)
class StampedTransform:
    """The pose of ``child`` in ``parent`` (``transform_child_to_parent``) at ``time``, ns."""

    parent: str
    child: str
    time: int
    transform: Transform


@dataclass(frozen=True, slots=True)
class TransformStorage:
    """What a cache keeps of a :class:`StampedTransform`: all but the name of its frame."""

    time: int
    parent: str
    transform: Transform


class StaticCache:
    """The pose of a frame that does not move; it is valid at every time."""

    is_static = True

    def __init__(self, sample: TransformStorage) -> None:
        self.latest = sample
        self.latest_time = self.oldest_time = LATEST

    def __len__(self) -> int:
        return 1

    def get_data(self, time: int) -> TransformStorage:
        """Return the pose, whatever the time."""
        return self.latest


class TimeCache:
    """
    The poses of a frame over the last ``duration`` ns before the latest; never empty.

    Samples may come in any order of time. A second one of the same time replaces the first.
    """

    is_static = False

    def __init__(self, sample: TransformStorage, duration: int) -> None:
        self._duration = duration
        self._samples = [sample]
        self._times = [sample.time]
        self._refused: list[TransformStorage] = []

    def __len__(self) -> int:
        return len(self._samples)

    @property
    def latest(self) -> TransformStorage:
        """The pose of the latest time."""
        return self._samples[-1]

    @property
    def latest_time(self) -> int:
        """Its time, ns."""
        return self._times[-1]

    @property
    def oldest_time(self) -> int:
        """The time of the oldest pose that is kept, ns."""
        return self._times[0]

    def insert_data(self, sample: TransformStorage) -> bool:
        """
        Add a sample; return False if it is older than what is kept and therefore ignored.

        When only old samples arrive, each later than the one before, time itself jumped back (a
        simulator or a recording was started again): the third of them replaces all that is kept.
        """
        if sample.time < self.latest_time - self._duration:
            return self._is_restart(sample)
        self._refused = []
        index = bisect_left(self._times, sample.time)
        if index < len(self._times) and self._times[index] == sample.time:
            self._samples[index] = sample
            return True
        self._samples.insert(index, sample)
        self._times.insert(index, sample.time)
        kept = bisect_left(self._times, self.latest_time - self._duration)
        del self._samples[:kept], self._times[:kept]
        return True

    def get_data(self, time: int) -> TransformStorage:
        """
        Return the pose at ``time``, interpolated between its neighbours.

        Between samples with different parents the earlier one is valid.

        Raises:
            ExtrapolationException: the time is outside of what is kept; the text is tf2's.
        """
        if time == LATEST or time == self.latest_time:
            return self.latest
        if not self.oldest_time <= time <= self.latest_time:
            raise ExtrapolationException(self._out_of_range(time))
        after = bisect_right(self._times, time)
        before = self._samples[after - 1]
        following = self._samples[after]
        if before.time == time or before.parent != following.parent:
            return before
        ratio = (time - before.time) / (following.time - before.time)
        between = before.transform.interpolate(following.transform, ratio)
        return TransformStorage(time, before.parent, between)

    def gap_to(self, time: int) -> int:
        """Return how far ``time`` lies outside of what is known, ns."""
        return max(time - self.latest_time, self.oldest_time - time, 0)

    def _out_of_range(self, time: int) -> str:
        if len(self._samples) == 1:
            return (
                f'Lookup would require extrapolation at time {seconds(time)}, '
                f'but only time {seconds(self.latest_time)} is in the buffer'
            )
        when, which, known = (
            ('future', 'latest', self.latest_time)
            if time > self.latest_time
            else ('past', 'earliest', self.oldest_time)
        )
        return (
            f'Lookup would require extrapolation into the {when}.  Requested time '
            f'{seconds(time)} but the {which} data is at time {seconds(known)}'
        )

    def _is_restart(self, sample: TransformStorage) -> bool:
        if self._refused and sample.time <= self._refused[-1].time:
            self._refused = []
        self._refused.append(sample)
        if len(self._refused) < _RESTART:
            return False
        self._samples, self._refused = self._refused, []
        self._times = [kept.time for kept in self._samples]
        return True


Frame: TypeAlias = StaticCache | TimeCache


def seconds(time: int) -> str:
    """Write a time of ns in s with six digits, as tf2 displays it."""
    micros = (abs(time) + 500) // 1000
    return f'{"-" if time < 0 else ""}{micros // 1_000_000}.{micros % 1_000_000:06d}'
