# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a rule of the checker may look at."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from lxml import etree

from amr_description.model.findings import Finding
from amr_description.model.gazebo_tag import GazeboPlugin
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot


@dataclass(frozen=True, slots=True)
class Subject:
    """A description as far as it could be read; the robot's tree need not be sound."""

    robot: Robot
    hardware: tuple[HardwareInfo, ...]
    gazebo_plugins: tuple[GazeboPlugin, ...]
    xml: etree._Element

    def error(self, line: int, what: str, **details: str) -> Finding:
        """Return an error on a line of this description; ``details`` as in Finding.error."""
        return Finding.error(self.robot.source, line, what, **details)

    def warning(self, line: int, what: str, **details: str) -> Finding:
        """Return a warning on a line of this description; ``details`` as in Finding.warning."""
        return Finding.warning(self.robot.source, line, what, **details)


type Rule = Callable[[Subject], Iterator[Finding]]
