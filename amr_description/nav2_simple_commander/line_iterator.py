# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The points of a line from cell to cell, as nav2_util has them in C++."""

# ruff: noqa: N802

import math


class LineIterator:
    """
    A place on a line, which goes on by steps along x, or along y where the line is upright.

    The last step is shorter, so that the line ends where it ends.
    """

    def __init__(self, x0: float, y0: float, x1: float, y1: float, step_size: float = 1.0) -> None:
        """
        Begin at the first point.

        Raises:
            TypeError: an argument is no number.
            ValueError: the step is not above 0, or the line has no length.
        """
        for value in (x0, y0, x1, y1, step_size):
            if not isinstance(value, int | float):
                raise TypeError(
                    f'{value!r} is {type(value).__name__}; an int or a float is needed'
                )
        if step_size <= 0:
            raise ValueError(f'step_size is {step_size}; it must be above 0')
        if (x0, y0) == (x1, y1):
            raise ValueError(f'the line from ({x0}, {y0}) to ({x1}, {y1}) has no length')
        self.x0_, self.y0_, self.x1_, self.y1_ = x0, y0, x1, y1
        self.x_, self.y_ = x0, y0
        self.step_size_ = step_size
        self.valid_ = True

    def isValid(self) -> bool:
        """Return whether the end has not been passed."""
        return self.valid_

    def advance(self) -> None:
        """Go on by a step."""
        along_x = self.x0_ != self.x1_
        here, end = (self.x_, self.x1_) if along_x else (self.y_, self.y1_)
        if here == end:
            self.valid_ = False
            return
        step = min(self.step_size_, abs(end - here))
        here += step if end > here else -step
        if along_x:
            slope = (self.y1_ - self.y0_) / (self.x1_ - self.x0_)
            self.x_, self.y_ = here, round(self.y0_ + slope * (here - self.x0_), 5)
        else:
            self.y_ = here

    def getX(self) -> float:
        """Return x of the place."""
        return self.x_

    def getY(self) -> float:
        """Return y of the place."""
        return self.y_

    def getX0(self) -> float:
        """Return x of the first point."""
        return self.x0_

    def getY0(self) -> float:
        """Return y of the first point."""
        return self.y0_

    def getX1(self) -> float:
        """Return x of the last point."""
        return self.x1_

    def getY1(self) -> float:
        """Return y of the last point."""
        return self.y1_

    def get_line_length(self) -> float:
        """Return the length of the line."""
        return math.hypot(self.x1_ - self.x0_, self.y1_ - self.y0_)
