# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of a window of times: their mean, and how they scatter."""

from collections.abc import Collection
from dataclasses import dataclass
from math import sqrt
from typing import Self


@dataclass(frozen=True)
class Spread:
    """
    Times of a window, s.

    ``deviation`` = sqrt(mean((time - mean)²)), that of the whole window and not an estimate from
    a sample.
    """

    mean: float
    shortest: float
    longest: float
    deviation: float
    window: int

    @classmethod
    def of(cls, times: Collection[int]) -> Self:
        """Describe times, ns, of which there is at least one."""
        mean = sum(times) / len(times)
        variance = sum((time - mean) ** 2 for time in times) / len(times)
        return cls(
            mean=mean * 1e-9,
            shortest=min(times) * 1e-9,
            longest=max(times) * 1e-9,
            deviation=sqrt(variance) * 1e-9,
            window=len(times),
        )

    def __str__(self) -> str:
        """Return the second line of what ``ros2 topic hz`` and ``delay`` print."""
        return (
            f'\tmin: {self.shortest:.3f}s max: {self.longest:.3f}s '
            f'std dev: {self.deviation:.5f}s window: {self.window}'
        )
