# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Load and slip of the wheels of a robot: ground truth that no sensor of a robot measures.

Odometry assumes that wheels roll without slip; its error is the slip measured here.
"""

from dataclasses import dataclass
import math

import mujoco
import numpy as np

from amr_description.model.frames import cross, Vector
from amr_description.sim.engine import Engine
from amr_description.sim.gazebo_physics import wheel_geom_name
from amr_description.sim.robot_view import RobotView

_NO_CONTACT = -1


@dataclass(frozen=True, slots=True)
class WheelSlip:
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
        force = np.empty(6)
        for contact, geoms in enumerate(data.contact.geom.tolist() if data.ncon else ()):
            wheel = self._wheel_of.get(geoms[0], self._wheel_of.get(geoms[1]))
            if wheel is None:
                continue
            mujoco.mj_contactForce(model, data, contact, force)
            normal = float(force[0])
            loads[wheel] += normal
            if normal > heaviest[wheel]:
                heaviest[wheel], contacts[wheel] = normal, contact
        return tuple(
            WheelSlip(load, *self._slip(wheel, contact)) if load > 0.0 else WheelSlip()
            for wheel, (load, contact) in enumerate(zip(loads, contacts, strict=True))
        )

    def _slip(self, wheel: int, index: int) -> tuple[float, float]:
        """Return the slip along and across at a contact, m/s."""
        data = self._engine.data
        contact = data.contact[index]
        is_first = int(contact.geom[0]) in self._wheel_of
        # MuJoCo's normal points from the first geom to the second; ours points to the wheel.
        sign = -1.0 if is_first else 1.0
        x, y, z = contact.frame[:3].tolist()
        normal = (sign * x, sign * y, sign * z)
        geom, surface = contact.geom.tolist() if is_first else contact.geom[::-1].tolist()
        point = contact.pos.tolist()
        pairs = zip(self._velocity_at(geom, point), self._velocity_at(surface, point), strict=True)
        slip = [of_wheel - of_surface for of_wheel, of_surface in pairs]
        forward = cross(data.xaxis[self._joint_ids[wheel]].tolist(), normal)
        length = math.hypot(*forward)
        if length == 0.0:  # the wheel lies on its side
            return 0.0, 0.0
        sideways = cross(normal, forward)
        return math.sumprod(slip, forward) / length, math.sumprod(slip, sideways) / length

    def _velocity_at(self, geom: int, point: Vector) -> tuple[float, ...]:
        """Return the velocity of a geom's material at a point of the world, m/s."""
        model, data = self._engine.model, self._engine.data
        body = int(model.geom_bodyid[geom])
        if body == 0:
            return (0.0, 0.0, 0.0)
        motion = np.empty(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, motion, 0)
        rx, ry, rz, vx, vy, vz = motion.tolist()
        x, y, z = data.xpos[body].tolist()
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
        self._generation = self._engine.generation
