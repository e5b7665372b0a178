# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What parameter files tell a differential drive controller of the robot that it drives."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from amr_description.model.findings import Finding


class Place(NamedTuple):
    """A line of a file."""

    source: str
    line: int


@dataclass(frozen=True, slots=True)
class DriveSettings:
    """
    One diff_drive_controller of some parameter files; lengths in m.

    ``place`` is where the controller's parameters begin, ``places`` where each of them stands, by
    its name.
    """

    name: str
    place: Place
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
    places: Mapping[str, Place] = field(default_factory=dict)

    def place_of(self, parameter: str) -> Place:
        """Return where a parameter stands, or the controller when no file sets it."""
        return self.places.get(parameter, self.place)

    def error(self, parameter: str, what: str, **details: str) -> Finding:
        """Return an error at a parameter; ``details`` as in Finding.error."""
        return Finding.error(*self.place_of(parameter), f'{self.name}: {what}', **details)

    def warning(self, parameter: str, what: str, **details: str) -> Finding:
        """Return a warning at a parameter; ``details`` as in Finding.warning."""
        return Finding.warning(*self.place_of(parameter), f'{self.name}: {what}', **details)
