# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a parameter file tells a differential drive controller of the robot that it drives."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class DriveSettings:
    """
    One diff_drive_controller of a parameter file; lengths in m.

    ``source`` is the file, ``line`` where the controller's parameters begin, ``lines`` where each
    of them stands, by its name.
    """

    name: str
    source: str
    line: int
    left_wheels: tuple[str, ...]
    right_wheels: tuple[str, ...]
    separation: float
    radius: float
    separation_multiplier: float
    base_frame: str
    odom_frame: str
    publishes_transform: bool
    position_feedback: bool
    open_loop: bool
    lines: Mapping[str, int] = field(default_factory=dict)

    def line_of(self, parameter: str) -> int:
        """Return the line of a parameter, or of the controller when the file does not set it."""
        return self.lines.get(parameter, self.line)
