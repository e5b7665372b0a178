# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Events of a joystick -> the axes and buttons of ``sensor_msgs/Joy``, and when to publish them.

Pure: events and times are arguments. Which code of the kernel (``linux/input-event-codes.h``) is
which index is decided as by SDL, which the original ``joy_node`` reads joysticks with.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
import math

FIRST_JOYSTICK_BUTTON = 0x120
_FIRST_HAT, _END_OF_HATS = 0x10, 0x18
_FULL = 32767
"""SDL has axes of 16 bits, and ``deadzone`` is a share of that."""


@dataclass(frozen=True, slots=True)
class AxisRange:
    """What an axis reports at its two ends; of an axis of one value both are equal."""

    minimum: int
    maximum: int


class GamepadState:
    """
    The state of a joystick.

    Args:
        keys: the codes of its buttons.
        ranges: code of an axis -> its range.
        deadzone: the share of an axis around its centre that counts as 0, from 0 to 1.
        sticky: whether a press toggles a button.
    """

    def __init__(
        self,
        keys: Collection[int],
        ranges: Mapping[int, AxisRange],
        *,
        deadzone: float,
        sticky: bool = False,
    ) -> None:
        # Those of keyboards and mice, which some pads have as well, come last.
        in_order = sorted(keys, key=lambda code: (code < FIRST_JOYSTICK_BUTTON, code))
        self._button_of = {code: index for index, code in enumerate(in_order)}
        sticks = [code for code in sorted(ranges) if not _FIRST_HAT <= code < _END_OF_HATS]
        self._axis_of = {code: index for index, code in enumerate(sticks)}
        hats = sorted({code & ~1 for code in ranges if code not in self._axis_of})
        for code in hats:
            self._axis_of |= {code: len(self._axis_of), code + 1: len(self._axis_of) + 1}
        self._ranges = dict(ranges)
        self._deadzone = deadzone
        self._sticky = sticky
        self._down: set[int] = set()
        self.axes = [0.0] * len(self._axis_of)
        """From -1 to 1: left and forward are positive, as ROS has it; those of hats come last."""
        self.buttons = [0] * len(in_order)

    def press(self, code: int, is_down: bool) -> bool:
        """Take an event of a button; return whether there is something to publish."""
        index = self._button_of.get(code)
        if index is None or is_down == (code in self._down):
            return False
        self._down ^= {code}
        if self._sticky and not is_down:
            return False
        self.buttons[index] = 1 - self.buttons[index] if self._sticky else int(is_down)
        return True

    def move(self, code: int, value: int) -> bool:
        """Take an event of an axis or a hat; return whether there is something to publish."""
        index = self._axis_of.get(code)
        if index is None:
            return False
        is_hat = _FIRST_HAT <= code < _END_OF_HATS
        # 0.0 is added as a stick at rest is 0.0, not -0.0.
        position = (-float(_sign(value)) if is_hat else self._position(code, value)) + 0.0
        is_new = position != self.axes[index]
        self.axes[index] = position
        return is_new

    def _position(self, code: int, value: int) -> float:
        """Return where a stick is, from -1 to 1."""
        ends = self._ranges[code]
        if ends.maximum <= ends.minimum or self._deadzone >= 1.0:
            return 0.0
        share = (value - ends.minimum) / (ends.maximum - ends.minimum)
        raw = math.floor(share * (2 * _FULL + 1) - (_FULL + 1) + 0.5)
        raw = max(-_FULL, min(_FULL, raw))
        # The dead zone is taken off, so that the position grows from 0 where it ends.
        beyond = max(0.0, abs(raw) - self._deadzone * _FULL)
        return -_sign(raw) * beyond / (1.0 - self._deadzone) / _FULL


def _sign(value: int) -> int:
    return (value > 0) - (value < 0)


class PublishingPace:
    """
    When the state is to be published: after an event, and again while there is none.

    All times are ns of one monotonic clock.

    Args:
        repeat: the period of repetitions; 0: there are none.
        coalescing: how long after the move of an axis others are awaited.
    """

    def __init__(self, *, repeat: int, coalescing: int) -> None:
        self._repeat, self._coalescing = repeat, coalescing
        self._due: int | None = None
        self._last: int | None = None

    def start(self, now: int) -> None:
        """Begin with a joystick: the first repetition is due after one period."""
        self._due, self._last = None, now

    def after_button(self, now: int) -> None:
        """Have the state published at once."""
        self._due = now

    def after_axis(self, now: int) -> None:
        """Have the state published soon."""
        soon = now + self._coalescing
        self._due = soon if self._due is None else min(self._due, soon)

    def wait(self, now: int) -> int | None:
        """Return how long nothing has to be published, from 0 on; None: until an event."""
        times = [] if self._due is None else [self._due]
        if self._repeat and self._last is not None:
            times.append(self._last + self._repeat)
        return max(0, min(times) - now) if times else None

    def published(self, now: int) -> None:
        """Take note that the state was published."""
        self._due, self._last = None, now
