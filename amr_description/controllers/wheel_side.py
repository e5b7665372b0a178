# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The wheels of one side of a differential drive, which turn as one."""

from collections.abc import Sequence
import math
import sys

from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.errors import ControllerError

_GREATEST = sys.float_info.max


class WheelSide:
    """Any number of wheels with one radius, m; without ``states`` they are driven blindly."""

    def __init__(
        self,
        radius: float,
        commands: Sequence[CommandInterface] = (),
        states: Sequence[StateInterface] = (),
    ) -> None:
        self._radius = radius
        self._commands = commands
        self._states = states

    def drive(self, speed: float) -> None:
        """
        Command the speed of the side over the ground, m/s: speed / radius on every wheel.

        A quotient beyond all numbers becomes the greatest one: no wheel is told infinity.
        """
        turning = min(max(speed / self._radius, -_GREATEST), _GREATEST)
        for wheel in self._commands:
            wheel.value = turning

    def travel(self) -> float:
        """
        Return mean reading · radius: m since the wheels' zero from positions, m/s from velocities.

        Raises ControllerError when a reading is not a finite number.
        """
        total = 0.0
        for index, state in enumerate(self._states):
            if not math.isfinite(state.value):
                raise ControllerError(
                    f'Either the left or right wheel {state.interface} is invalid for index '
                    f'[{index}]: {state.name} is {state.value}'
                )
            total += state.value
        return total / len(self._states) * self._radius
