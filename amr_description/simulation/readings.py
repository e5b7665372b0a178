# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is read of a simulated robot, in SI units."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from amr_description.errors import SimulationError
from amr_description.model.frames import rpy_from_quaternion, Transform, Vector
from amr_description.png import png
from amr_description.text import did_you_mean


@dataclass(frozen=True, slots=True)
class Motion:
    """Pose and velocity of a robot: ground truth, or its odometry."""

    time: float
    """s, simulated."""
    pose: Transform
    """From the robot's base to the world, or to the frame of odometry."""
    linear: Vector
    """m/s, in the robot's own axes: forward, left, up."""
    angular: Vector
    """rad/s, about the same axes."""

    @property
    def x(self) -> float:
        """m."""
        return self.pose.translation[0]

    @property
    def y(self) -> float:
        """m."""
        return self.pose.translation[1]

    @property
    def z(self) -> float:
        """m."""
        return self.pose.translation[2]

    @property
    def roll(self) -> float:
        """rad, about x."""
        return rpy_from_quaternion(self.pose.rotation)[0]

    @property
    def pitch(self) -> float:
        """rad, about y."""
        return rpy_from_quaternion(self.pose.rotation)[1]

    @property
    def yaw(self) -> float:
        """rad, about z, from -π to π."""
        return rpy_from_quaternion(self.pose.rotation)[2]


@dataclass(frozen=True, slots=True)
class Joint:
    """The state of a joint: rad, rad/s and N·m, or m, m/s and N."""

    position: float
    velocity: float
    effort: float


class Joints(dict[str, Joint]):
    """Joint → its state; a name that is not there is told those that are."""

    def __missing__(self, name: str) -> Joint:
        """Raise SimulationError."""
        raise SimulationError(
            f"no joint '{name}' has a state{did_you_mean(name, [*self])}; there are: "
            + ', '.join(self)
            + '; <ros2_control> gives a joint one, by <state_interface name="position"/>'
        )


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """What a lidar sees; of several rings the middle one."""

    time: float
    """s, simulated."""
    frame: str
    ranges: np.ndarray
    """m; inf: nothing within reach, -inf: something too near (REP 117)."""
    angles: np.ndarray
    """rad, of each range, about the z axis of the frame from x to y."""
    range_min: float
    range_max: float


@dataclass(frozen=True, slots=True, eq=False)
class Image:
    """What a camera sees."""

    time: float
    """s, simulated."""
    frame: str
    pixels: np.ndarray
    """Rows from above: colours, (height, width, 3) of 0 to 255 red, green, blue; grey, (height,
    width); or depths along the optical axis, m, with inf and -inf beyond what it sees."""

    def save(self, path: str | Path) -> None:
        """Write a PNG file. Raises SimulationError: these are depths."""
        Path(path).write_bytes(self._png())

    def _repr_png_(self) -> bytes | None:
        """Return what a notebook shows; None: depths, which it shows as text."""
        return None if self.pixels.dtype != np.uint8 else self._png()

    def _png(self) -> bytes:
        if self.pixels.dtype != np.uint8:
            raise SimulationError('depths are in m, and a PNG file has colours or greys')
        return png(self.pixels)


@dataclass(frozen=True, slots=True, eq=False)
class Points:
    """A cloud: of a camera, or of a lidar."""

    time: float
    """s, simulated."""
    frame: str
    xyz: np.ndarray
    """m in the frame: (height, width, 3), of a lidar (rings, samples, 3)."""


@dataclass(frozen=True, slots=True)
class Contact:
    """Two collision shapes that touch, by the names that the message gives them."""

    first: str
    second: str
