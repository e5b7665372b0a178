# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Load and slip of the wheels of a robot: ground truth that no sensor of a robot measures.

Odometry assumes that wheels roll without slip; its error is the slip measured here.
"""

from collections.abc import Sequence
import math
from typing import NamedTuple

import mujoco
import numpy as np

from amr_description.model.frames import cross, dot, Vector
from amr_description.sim.engine import Engine
from amr_description.sim.gazebo_physics import wheel_geom_name
from amr_description.sim.robot_view import RobotView

_NO_CONTACT = -1


class WheelSlip(NamedTuple):
    """The load and the slip of one wheel; zero where it touches nothing."""

    normal_force: float = 0.0
    """N, the sum over all contacts of the wheel."""
    along: float = 0.0
    """
    m/s: velocity of the wheel's surface over the ground, v - w r, in the direction in which the
    wheel rolls when its joint turns forward. Negative where it spins, positive where it is braked.
    """
    across: float = 0.0
    """m/s: the same along the joint's axis: the sideways scrub."""

    @property
    def is_touching(self) -> bool:
        """Whether the wheel bears on anything."""
        return self.normal_force > 0.0


class WheelSlipReader:
    """Reads load and slip of one robot's wheels; valid as long as its :class:`RobotView` is."""

    def __init__(self, engine: Engine, robot: RobotView) -> None:
        self.joints = tuple(wheel.joint for wheel in robot.wheels)
        """The joint of each wheel, in the order of :meth:`read`."""
        self._engine = engine
        self._robot = robot
        self._generation = -1
        self._wheel_of: dict[int, int] = {}
        self._joint_ids: list[int] = []
        self._body_of: list[int] = []
        self._force, self._motion = np.empty(6), np.empty(6)

    def read(self) -> tuple[WheelSlip, ...]:
        """
        Return load and slip of each wheel, now; forces are those of the last physics step.

        The slip of a wheel with several contacts is that of the most loaded one.
        """
        self._bind()
        self._engine.refresh_kinematics()
        model, data = self._engine.model, self._engine.data
        count = len(self.joints)
        loads, heaviest, contacts = [0.0] * count, [0.0] * count, [_NO_CONTACT] * count
        force, wheel_of = self._force, self._wheel_of
        # Each list is read once as a whole: one element of a MuJoCo array costs 0.3 µs.
        touching = data.contact
        geoms = touching.geom.tolist() if data.ncon else ()
        for contact, (first, second) in enumerate(geoms):
            wheel = wheel_of.get(first, wheel_of.get(second))
            if wheel is None:
                continue
            mujoco.mj_contactForce(model, data, contact, force)
            normal = float(force[0])
            loads[wheel] += normal
            if normal > heaviest[wheel]:
                heaviest[wheel], contacts[wheel] = normal, contact
        if not any(loads):
            return (WheelSlip(),) * count
        points, frames = touching.pos.tolist(), touching.frame.tolist()
        return tuple(
            WheelSlip(
                load, *self._slip(wheel, geoms[contact], points[contact], frames[contact][:3])
            )
            if load > 0.0
            else WheelSlip()
            for wheel, (load, contact) in enumerate(zip(loads, contacts, strict=True))
        )

    def _slip(
        self, wheel: int, geoms: Sequence[int], point: Sequence[float], axis: Sequence[float]
    ) -> tuple[float, float]:
        """
        Return the slip along and across at a contact, m/s.

        Args:
            wheel: Its number.
            geoms: Both geoms of the contact.
            point: Of the contact, in the world, m.
            axis: From the first geom to the second, a unit vector.
        """
        of_wheel, surface = geoms
        normal = (-axis[0], -axis[1], -axis[2])
        if of_wheel not in self._wheel_of:
            of_wheel, surface = surface, of_wheel
            normal = (axis[0], axis[1], axis[2])
        slip = self._velocity_at(of_wheel, point)
        if self._body_of[surface]:
            its = self._velocity_at(surface, point)
            slip = (slip[0] - its[0], slip[1] - its[1], slip[2] - its[2])
        x, y, z = self._axes[self._joint_ids[wheel]].tolist()
        forward = cross((x, y, z), normal)
        length = math.hypot(*forward)
        if length == 0.0:  # the wheel lies on its side
            return 0.0, 0.0
        sideways = cross(normal, forward)
        return dot(slip, forward) / length, dot(slip, sideways) / length

    def _velocity_at(self, geom: int, point: Sequence[float]) -> Vector:
        """Return the velocity of a geom's material at a point of the world, m/s."""
        body, motion = self._body_of[geom], self._motion
        mujoco.mj_objectVelocity(
            self._engine.model, self._engine.data, mujoco.mjtObj.mjOBJ_XBODY, body, motion, 0
        )
        rx, ry, rz, vx, vy, vz = motion.tolist()
        x, y, z = self._positions[body].tolist()
        wx, wy, wz = cross((rx, ry, rz), (point[0] - x, point[1] - y, point[2] - z))
        return (vx + wx, vy + wy, vz + wz)

    def _bind(self) -> None:
        """Look up the wheels in the model; repeated after every recompile."""
        if self._generation == self._engine.generation:
            return
        model, name = self._engine.model, self._robot.name
        self._wheel_of = {
            model.geom(f'{name}/{wheel_geom_name(wheel.link)}').id: index
            for index, wheel in enumerate(self._robot.wheels)
        }
        self._joint_ids = [model.joint(f'{name}/{joint}').id for joint in self.joints]
        self._body_of = model.geom_bodyid.tolist()
        self._axes, self._positions = self._engine.data.xaxis, self._engine.data.xpos
        self._generation = self._engine.generation
