# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was when: rows of numbers, and other values, by the times (ns) at which they came. Pure."""

from array import array
from bisect import bisect_right
from collections.abc import Sequence
from typing import Generic, TypeVar

import numpy as np

Value = TypeVar('Value')

NOTHING = -1
"""The index of no row."""


class Times:
    """Times in their order, ns."""

    def __init__(self) -> None:
        self._times = array('q')

    def __len__(self) -> int:
        return len(self._times)

    def add(self, time: int) -> None:
        """Add a time, not before the last one."""
        self._times.append(time)

    def time(self, index: int) -> int:
        """Return one of the times, ns."""
        return self._times[index]

    def index(self, time: int) -> int:
        """Return the index of the last one at a time or before; :data:`NOTHING`: there is none."""
        return bisect_right(self._times, time) - 1

    def rate(self, index: int, span: int) -> float | None:
        """Return how many a second came in the ``span`` ns until then; None: not known."""
        if index == NOTHING:
            return None
        last = self._times[index]
        first = max(0, self.index(last - span) + 1)
        elapsed = last - self._times[first]
        return (index - first) * 1e9 / elapsed if elapsed > 0 else None


class Track:
    """Rows of a fixed number of float32 values."""

    def __init__(self, width: int) -> None:
        self._width = width
        self._times = Times()
        self._values = array('f')

    def __len__(self) -> int:
        return len(self._times)

    def add(self, time: int, row: Sequence[float]) -> None:
        """Add a row; what is too large for float32 becomes infinite."""
        self._times.add(time)
        try:
            self._values.extend(row)
        except OverflowError:
            del self._values[self._width * (len(self._times) - 1) :]
            with np.errstate(over='ignore'):
                self._values.frombytes(np.asarray(row).astype(np.float32).tobytes())

    @property
    def begin(self) -> int | None:
        """When the first row came, ns; None: there is none."""
        return self._times.time(0) if len(self._times) else None

    def at(
        self, time: int, *, or_first: bool = False, within: int | None = None
    ) -> 'array[float] | None':
        """
        Return the last row at a time or before; None: there is none.

        Args:
            time: ns.
            or_first: return the first one before there was any, as of what was latched.
            within: ns after which a row does not count any more; None: it always does.
        """
        index = self._times.index(time)
        if index == NOTHING:
            if not or_first or not len(self):
                return None
            index = 0
        if within is not None and time - self._times.time(index) > within:
            return None
        return self._values[self._width * index : self._width * (index + 1)]


class Changes(Generic[Value]):
    """Values that change seldom; one that is equal to the last is left out."""

    def __init__(self) -> None:
        self._times = Times()
        self._values: list[Value] = []

    def __len__(self) -> int:
        return len(self._values)

    def add(self, time: int, value: Value) -> None:
        """Add a value."""
        if not self._values or self._values[-1] != value:
            self._times.add(time)
            self._values.append(value)

    def at(self, time: int) -> Value | None:
        """Return the value then, before the first the first; None: there is none."""
        if not self._values:
            return None
        return self._values[max(0, self._times.index(time))]


def thinned(stamps: np.ndarray, values: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """
    Return about ``most`` values at most: the least and the greatest of those in a row.

    Args:
        stamps: s, float64.
        values: of the same length; NaN is not known, and stays only where all in a row are.
        most: how many there may be.
    """
    count = len(values)
    if count <= most:
        return stamps, values
    size = -(-2 * count // most)
    begins = np.arange(0, count, size)
    kept: list[int] = []
    for begin in begins:
        part = values[begin : begin + size]
        if np.isnan(part).all():
            kept.append(int(begin))
        else:
            kept += sorted({int(begin + np.nanargmin(part)), int(begin + np.nanargmax(part))})
    places = np.array(kept)
    return stamps[places], values[places]
