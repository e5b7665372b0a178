# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulated world as a hardware component sees it: its own robot, by the names of its URDF.

A part of the contracts (:mod:`amr_description.control.contracts`); used on the control thread.
``sim/`` implements it with MuJoCo; a fake for tests takes forty lines.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, TYPE_CHECKING

if TYPE_CHECKING:
    from amr_description.model.frames import Quaternion, Transform, Vector
    from amr_description.model.robot import Robot


class JointGroup(Protocol):
    """Some joints of one robot, in the requested order; cheap to call in every cycle."""

    def positions(self) -> list[float]:
        """Return the positions, rad or m."""

    def velocities(self) -> list[float]:
        """Return the velocities, rad/s or m/s."""

    def efforts(self) -> list[float]:
        """Return the generalised forces of the actuators, N·m or N."""

    def accelerations(self) -> list[float]:
        """Return the accelerations during the last physics step, rad/s² or m/s²."""

    def command(self, interface: str, values: Sequence[float]) -> None:
        """
        Let the joints follow one command interface, and no other, from now on.

        Changing the interface does not jerk the joints. Position and velocity servos keep the
        velocity and effort limits of the URDF; an overloaded joint that has slipped is brought
        back to its position by the next call.

        Args:
            interface: ``position`` (rad or m), ``velocity`` (rad/s or m/s) or ``effort`` (N·m or
                N).
            values: one for each joint, in force until the next call.

        Raises:
            SimulationError: a value is not finite, or the ``<ros2_control>`` block of a joint
                declares no such command.
        """

    def hold(self) -> None:
        """
        Stop the joints and hold them where they stop, within their effort limits; may be repeated.
        """

    def release(self) -> None:
        """Let the joints move freely: no actuator exerts a force."""


@dataclass(frozen=True, slots=True)
class ImuReading:
    """A measurement of an inertial measurement unit, in its own axes (REP 145)."""

    orientation: 'Quaternion'
    """x, y, z, w of the rotation from the unit's axes to the world's."""
    angular_velocity: 'Vector'
    """rad/s."""
    linear_acceleration: 'Vector'
    """m/s², gravity included: at rest it is +9.81 upwards, in free fall 0."""


@dataclass(frozen=True, slots=True)
class Wrench:
    """A force (N) and a torque (N·m), both in the axes of a frame and at its origin."""

    force: 'Vector'
    torque: 'Vector'


class World(Protocol):
    """One robot in a simulated world; stays valid when other robots are added and removed."""

    @property
    def time(self) -> int:
        """Simulated time, ns."""

    @property
    def description(self) -> 'Robot':
        """The URDF of the robot."""

    @property
    def seed(self) -> Sequence[int]:
        """The seed of its sensors' noise: numbers ≥ 0, different for every robot."""

    def joints(self, names: Sequence[str]) -> JointGroup:
        """Return these joints, in this order. Raises SimulationError: there is no such joint."""

    def pose(self, link: str) -> 'Transform':
        """Return the transform from ``link`` to the world frame: the true pose of the link."""

    def velocity(self, link: str) -> 'tuple[Vector, Vector]':
        """
        Return the linear (m/s) and angular (rad/s) velocity of a link's origin, in its own axes.
        """

    def move_base(self, x: float, y: float, yaw: float) -> None:
        """
        Move the root link over the ground, in its own axes, until the next call.

        Args:
            x: m/s, forward.
            y: m/s, to the left.
            yaw: rad/s, to the left.

        Raises:
            SimulationError: no hardware component of the robot moves its base.
        """

    def imu(self, link: str, mount_pose: 'Transform') -> ImuReading:
        """
        Return the measurement of an inertial measurement unit.

        Args:
            link: the link that it is mounted on.
            mount_pose: the transform from the unit to the link.

        Raises:
            SimulationError: there is no such link.
        """

    def wrench(self, link: str, mount_pose: 'Transform') -> Wrench:
        """
        Return what holds a link and all that hangs on it: the wrench of its parent on the link.

        Args:
            link: the link.
            mount_pose: the transform from the frame of the wrench to the link.

        Raises:
            SimulationError: there is no such link.
        """

    @property
    def magnetic_field(self) -> 'Vector':
        """The magnetic field of the world, T, in its axes."""

    def distances(
        self,
        link: str,
        mount_pose: 'Transform',
        directions: 'Sequence[Vector]',
        farthest: float,
    ) -> list[float]:
        """
        Return how far away something is seen, m, in each direction; inf where nothing is.

        The parts of the robot that cannot move against the link are not seen.

        Args:
            link: on which the observer is mounted.
            mount_pose: the transform from the observer to the link.
            directions: unit vectors in the axes of the observer.
            farthest: what is farther away, m, need not be seen.

        Raises:
            SimulationError: there is no such link.
        """
