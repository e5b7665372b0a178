# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How the wheels of a robot stand on what they touch: load and slip, as nothing on a robot could
measure them.

Odometry takes a wheel's turning for travel; the slip seen here is what it is wrong by.
"""

from dataclasses import dataclass
import math

import mujoco
import numpy as np

from amr_description.model.frames import cross, Vector
from amr_description.sim.engine import Engine
from amr_description.sim.robot_spec import tread_name
from amr_description.sim.robot_view import RobotView

_NO_CONTACT = -1


@dataclass(frozen=True, slots=True)
class WheelContact:
    """The load and the slip of one wheel; all zero in the air."""

    normal_force: float = 0.0
    """N, the sum over all places where the wheel touches something; 0: it touches nothing."""
    along: float = 0.0
    """
    m/s: velocity of the tread over the surface, in the direction in which the wheel rolls when its
    joint turns forward. v - w r: below 0 where it spins, above 0 where it is braked.
    """
    across: float = 0.0
    """m/s: the same, along the joint's axis: the sideways scrub."""

    @property
    def is_touching(self) -> bool:
        """Whether the wheel bears on anything."""
        return self.normal_force > 0.0


class WheelContacts:
    """Reads the contacts of one robot's wheels; valid as long as its :class:`RobotView` is."""

    def __init__(self, engine: Engine, robot: RobotView) -> None:
        self.joints = tuple(wheel.joint for wheel in robot.wheels)
        """The joint of each wheel, in the order of :meth:`read`."""
        self._engine = engine
        self._robot = robot
        self._generation = -1
        self._place_of: dict[int, int] = {}
        self._joint_ids: list[int] = []

    def read(self) -> tuple[WheelContact, ...]:
        """
        Each wheel at the present time; forces are those of the last physics step.

        Where a wheel touches at several places, the slip is that of the most loaded one.
        """
        self._bind()
        self._engine.refresh_truth()
        model, data = self._engine.model, self._engine.data
        count = len(self.joints)
        loads, heaviest, places = [0.0] * count, [0.0] * count, [_NO_CONTACT] * count
        force = np.empty(6)
        for contact, geoms in enumerate(data.contact.geom.tolist() if data.ncon else ()):
            wheel = self._place_of.get(geoms[0], self._place_of.get(geoms[1]))
            if wheel is None:
                continue
            mujoco.mj_contactForce(model, data, contact, force)
            normal = float(force[0])
            loads[wheel] += normal
            if normal > heaviest[wheel]:
                heaviest[wheel], places[wheel] = normal, contact
        return tuple(
            WheelContact(load, *self._slip(wheel, place)) if load > 0.0 else WheelContact()
            for wheel, (load, place) in enumerate(zip(loads, places, strict=True))
        )

    def _slip(self, wheel: int, place: int) -> tuple[float, float]:
        """Slip along and across at a contact, m/s."""
        data = self._engine.data
        contact = data.contact[place]
        is_first = int(contact.geom[0]) in self._place_of
        # MuJoCo's normal points from the first geom to the second; this one, to the wheel.
        sign = -1.0 if is_first else 1.0
        x, y, z = contact.frame[:3].tolist()
        normal = (sign * x, sign * y, sign * z)
        tread, surface = contact.geom.tolist() if is_first else contact.geom[::-1].tolist()
        point = contact.pos.tolist()
        pairs = zip(
            self._velocity_at(tread, point), self._velocity_at(surface, point), strict=True
        )
        slip = [of_tread - of_surface for of_tread, of_surface in pairs]
        forward = cross(data.xaxis[self._joint_ids[wheel]].tolist(), normal)
        length = math.hypot(*forward)
        if length == 0.0:  # it stands on its flat side
            return 0.0, 0.0
        sideways = cross(normal, forward)
        return math.sumprod(slip, forward) / length, math.sumprod(slip, sideways) / length

    def _velocity_at(self, geom: int, point: Vector) -> tuple[float, ...]:
        """The velocity of a geom's material at a point of the world, m/s."""
        model, data = self._engine.model, self._engine.data
        body = int(model.geom_bodyid[geom])
        if body == 0:
            return (0.0, 0.0, 0.0)
        motion = np.empty(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, motion, 0)
        *rate, vx, vy, vz = motion.tolist()
        x, y, z = data.xpos[body].tolist()
        wx, wy, wz = cross(rate, (point[0] - x, point[1] - y, point[2] - z))
        return (vx + wx, vy + wy, vz + wz)

    def _bind(self) -> None:
        """Find the wheels in the model, after it was built anew."""
        if self._generation == self._engine.generation:
            return
        model, name = self._engine.model, self._robot.name
        self._place_of = {
            model.geom(f'{name}/{tread_name(wheel.link)}').id: place
            for place, wheel in enumerate(self._robot.wheels)
        }
        self._joint_ids = [model.joint(f'{name}/{joint}').id for joint in self.joints]
        self._generation = self._engine.generation
