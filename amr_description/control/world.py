# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a simulated hardware component sees of the world: its own robot, by the names of its URDF.

A part of the contracts (:mod:`amr_description.control.contracts`). One thread, the owner, calls
everything. MuJoCo implements it in ``sim/``; a test's fake is forty lines.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, TYPE_CHECKING

if TYPE_CHECKING:
    from amr_description.model.frames import Quaternion, Transform, Vector
    from amr_description.model.robot import Robot


class JointGroup(Protocol):
    """
    Some joints of one robot, in the order in which they were asked for; cheap to call in the tick.
    """

    def positions(self) -> list[float]:
        """rad or m."""

    def velocities(self) -> list[float]:
        """rad/s or m/s."""

    def efforts(self) -> list[float]:
        """The actuators' generalised force, N·m or N."""

    def command(self, interface: str, values: Sequence[float]) -> None:
        """
        Let the joints follow ``interface`` from now on, and no other: ``position`` (rad or m),
        ``velocity`` (rad/s or m/s) or ``effort`` (N·m or N). One value a joint, kept until the
        next call.

        A change of the interface does not kick the joints. Position and velocity are servos
        within the velocity and effort limits of the URDF; an overloaded joint that has slipped is
        brought back to its position by the next call. Raises SimulationError if a value is not
        finite, or if a joint's ``<ros2_control>`` block declares no such command.
        """

    def hold(self) -> None:
        """
        Bring the joints to a stop and keep them where they stop, within their effort limits; may
        be called again at will.
        """

    def release(self) -> None:
        """Let the joints swing: no actuator exerts a force."""


@dataclass(frozen=True, slots=True)
class ImuReading:
    """What an inertial measurement unit measures, in its own axes (REP 145)."""

    orientation: 'Quaternion'
    """x, y, z, w of the rotation from the unit's axes to the world's."""
    angular_velocity: 'Vector'
    """rad/s."""
    linear_acceleration: 'Vector'
    """m/s², gravity included: at rest it is +9.81 upwards, in free fall 0."""


class World(Protocol):
    """
    What a simulated hardware component sees of the world: its own robot, by the names of its URDF.

    It stays valid when other robots come and go.
    """

    @property
    def time(self) -> int:
        """Simulated time, ns."""

    @property
    def description(self) -> 'Robot':
        """The robot, as its URDF has it."""

    @property
    def seed(self) -> Sequence[int]:
        """Numbers from 0 on that no other robot has; the noise of its sensors follows."""

    def joints(self, names: Sequence[str]) -> JointGroup:
        """
        These joints, in this order. Raises SimulationError naming what is missing and what there
        is.
        """

    def pose(self, link: str) -> 'Transform':
        """The transform from ``link`` to the world frame: the true pose of the link."""

    def velocity(self, link: str) -> 'tuple[Vector, Vector]':
        """
        Linear (m/s) and angular (rad/s) velocity of the link's origin, both in the link's own
        axes.
        """

    def imu(self, link: str, place: 'Transform') -> ImuReading:
        """
        What an inertial measurement unit on ``link`` measures; ``place``: the transform from the
        unit to the link. Raises SimulationError naming the links there are.
        """
