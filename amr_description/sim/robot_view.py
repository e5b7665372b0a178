# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One simulated robot, by the names of its URDF: what a hardware component sees of the world."""

from collections.abc import Callable, Sequence
import math

import mujoco
import numpy as np

from amr_description.control.world import ImuReading, Wrench
from amr_description.errors import SimulationError
from amr_description.log import Log
from amr_description.model.frames import (
    conjugate,
    cross,
    matrix_from_quaternion,
    multiply,
    rotate,
    Transform,
    Vector,
    xyzw_from_wxyz,
)
from amr_description.model.robot import Robot, WORLD_LINK
from amr_description.sim.actuator_modes import RobotActuators
from amr_description.sim.base_servo import command_base_servo
from amr_description.sim.engine import Engine
from amr_description.sim.joint_group import MujocoJointGroup
from amr_description.sim.rays import Mask, RayScene
from amr_description.sim.robot_spec import RobotSpec, root_joint

GAZEBO_FIELD = (5.5645e-6, 22.8758e-6, -42.3884e-6)
"""T, along x, y, z of the world: SDF's default ``<magnetic_field>``."""
_MUJOCO_FIELD = (0.0, -0.5, 0.0)


class RobotView:
    """
    The :class:`~amr_description.control.world.World` of one robot.

    It stays valid while other robots come and go; after its own removal every call raises
    SimulationError.
    """

    def __init__(
        self,
        engine: Engine,
        name: str,
        description: Robot,
        model: RobotSpec,
        pose: Transform,
        log: Log,
        seed: int = 0,
        ray_scene: Callable[[], RayScene] | None = None,
    ) -> None:
        """
        Bind a robot that has just been spawned.

        Args:
            engine: Of the world.
            name: Of the robot in the world.
            description: Its URDF.
            model: The spec made of it.
            pose: Where it was spawned: transform from its root link to the world.
            log: Gets what the joints' commands cause.
            seed: Of the world.
            ray_scene: What can be seen, where it is now; None: nothing.
        """
        self.name = name
        self.seed_with(seed)
        self.description = description
        self.wheels = model.wheels
        """The links that touch the ground as wheels."""
        self.rollers = model.rollers
        """Those of mecanum and omni wheels, by geom."""
        self.collisions = model.collisions
        """Which collision each geom of a link is; see :attr:`RobotSpec.collisions`."""
        self.spawn_pose = pose
        """Where it was spawned: transform from its root link to the world."""
        self._log = log
        self._engine = engine
        self._ray_scene = ray_scene
        self._bodies: dict[str, int] = {}
        self._masks: dict[int, Mask] = {}
        self._generation = -1
        self._initial_states = model.initial_states
        self._actuators = RobotActuators(engine, name, model.commands)
        self.start()

    def seed_with(self, seed: int) -> None:
        """Take the seed of the world."""
        self.seed = (seed, *self.name.encode())
        """Seeds the noise of the robot's sensors."""

    def start(self) -> None:
        """Set the joints to their initial states, held; called at spawn and after a reset."""
        for name, state in self._initial_states.items():
            joint = self._engine.data.joint(f'{self.name}/{name}')
            joint.qpos[:], joint.qvel[:] = state.position, state.velocity
        self._actuators.start()

    @property
    def time(self) -> int:
        """Simulated time, ns."""
        return self._engine.time

    def joints(self, names: Sequence[str]) -> MujocoJointGroup:
        """Return a group of joints, in the given order. Raises SimulationError."""
        known = {joint.name: joint for joint in self.description.joints if joint.has_position}
        for name in names:
            if name not in known:
                raise SimulationError(
                    f"robot '{self.name}': there is no joint '{name}' that moves; there are: "
                    f'{", ".join(known)}'
                )
        joints = [known[name] for name in names]
        return MujocoJointGroup(self._engine, self.name, joints, self._actuators, self._log)

    def pose(self, link: str) -> Transform:
        """Return the transform from a link to the world, now. Raises SimulationError."""
        body = self.body(link)
        if body == 0:
            return self.spawn_pose
        self._engine.refresh_kinematics()
        data = self._engine.data
        x, y, z = data.xpos[body].tolist()
        return Transform((x, y, z), xyzw_from_wxyz(data.xquat[body].tolist()))

    def velocity(self, link: str) -> tuple[Vector, Vector]:
        """
        Return the linear (m/s) and angular (rad/s) velocity of a link's origin.

        Both in the link's own axes. Raises SimulationError.
        """
        body = self.body(link)
        self._engine.refresh_kinematics()
        result = np.empty(6)
        mujoco.mj_objectVelocity(
            self._engine.model, self._engine.data, mujoco.mjtObj.mjOBJ_XBODY, body, result, 1
        )
        wx, wy, wz, vx, vy, vz = result.tolist()
        return (vx, vy, vz), (wx, wy, wz)

    def move_base(self, x: float, y: float, yaw: float) -> None:
        """Move the root link over the ground, in its own axes: m/s, m/s, rad/s."""
        try:
            command_base_servo(self._engine.model, self._engine.data, self.name, (x, y, yaw))
        except (KeyError, ValueError) as cause:
            raise SimulationError(
                f"robot '{self.name}': its base cannot be moved: {cause}"
            ) from cause

    def imu(self, link: str, mount_pose: Transform) -> ImuReading:
        """
        Return what an inertial measurement unit on ``link`` measures, without noise.

        The acceleration is that of the last physics step: (velocity after - before) / step.

        Args:
            link: The link that the unit is fixed to.
            mount_pose: Transform from the unit to the link.

        Raises:
            SimulationError: There is no such link.
        """
        body = self.body(link)
        model, data = self._engine.model, self._engine.data
        self._engine.refresh_kinematics()
        mujoco.mj_rnePostConstraint(model, data)
        motion, change = np.empty(6), np.empty(6)
        # In world axes, including gravity, which MuJoCo models as an upward acceleration.
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, motion, 0)
        mujoco.mj_objectAcceleration(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, change, 0)
        rate, turning, acceleration = map(_vector, (motion[:3], change[:3], change[3:]))
        pose = self.pose(link)
        lever = rotate(pose.rotation, mount_pose.translation)
        # a + α × r + ω × (ω × r)
        parts = zip(
            acceleration, cross(turning, lever), cross(rate, cross(rate, lever)), strict=True
        )
        x, y, z = (sum(part) for part in parts)
        orientation = multiply(pose.rotation, mount_pose.rotation)
        back = conjugate(orientation)
        return ImuReading(
            orientation=orientation,
            angular_velocity=rotate(back, rate),
            linear_acceleration=rotate(back, (x, y, z)),
        )

    def wrench(self, link: str, mount_pose: Transform) -> Wrench:
        """
        Return the wrench of a link's parent on the link, from the last physics step.

        It is what Newton's and Euler's laws ask for, given how the link and all below it are
        accelerated, and what acts on them from outside: gravity, contacts and such.

        Args:
            link: The link.
            mount_pose: Transform from the frame of the wrench to the link.

        Raises:
            SimulationError: There is no such link.
        """
        body = self.body(link)
        model, data = self._engine.model, self._engine.data
        self._engine.refresh_kinematics()
        mujoco.mj_rnePostConstraint(model, data)
        wrench = data.cfrc_int[body]
        torque, force = _vector(wrench[:3]), _vector(wrench[3:])
        frame = self.pose(link) @ mount_pose
        # In world axes, about the centre of mass of the whole robot.
        centre = data.subtree_com[model.body_rootid[body]]
        lever = _vector(centre - frame.translation)
        moment = cross(lever, force)
        x, y, z = (of + by for of, by in zip(torque, moment, strict=True))
        back = conjugate(frame.rotation)
        return Wrench(force=rotate(back, force), torque=rotate(back, (x, y, z)))

    @property
    def magnetic_field(self) -> Vector:
        """
        The magnetic field, T: ``<option magnetic>`` of the world's file, or Gazebo's.

        A file that has MuJoCo's own default, half a gauss along -y without a unit, has none.
        """
        field = _vector(self._engine.model.opt.magnetic)
        return GAZEBO_FIELD if field == _MUJOCO_FIELD else field

    def distances(
        self, link: str, mount_pose: Transform, directions: Sequence[Vector], farthest: float
    ) -> list[float]:
        """
        Return how far away something is seen, m, in each direction; inf where nothing is.

        Args:
            link: The link that the observer is fixed to; what is rigid with it is not seen.
            mount_pose: Transform from the observer to the link.
            directions: Unit vectors in its axes.
            farthest: What is farther away, m, need not be seen.

        Raises:
            SimulationError: There is no such link.
        """
        body = self.body(link)
        if self._ray_scene is None:
            return [math.inf] * len(directions)
        scene = self._ray_scene()
        mask = self._masks.get(body)
        if mask is None:
            mask = scene.mask(without=scene.geoms_fixed_to(self.name, body))
            self._masks[body] = mask
        pose = self.pose(link) @ mount_pose
        turn = np.array(matrix_from_quaternion(pose.rotation))
        hits = scene.cast(
            np.array(pose.translation), np.array(directions) @ turn.T, mask=mask, cutoff=farthest
        )
        return [each if each >= 0.0 else math.inf for each in hits.distances.tolist()]

    def height_index(self) -> int | None:
        """Return the index of the root's height in ``qpos``; None: the robot stands fixed."""
        model = self._engine.model
        joint = mujoco.mj_name2id(
            model, mujoco.mjtObj.mjOBJ_JOINT, f'{self.name}/{root_joint(self.description)}'
        )
        return None if joint < 0 else int(model.jnt_qposadr[joint]) + 2

    def body(self, link: str) -> int:
        """Return MuJoCo's id of a link, good for one generation. Raises SimulationError."""
        if self._generation != self._engine.generation:
            self._bodies.clear()
            self._masks.clear()
            self._generation = self._engine.generation
        body = self._bodies.get(link)
        if body is None:
            body = self._bodies[link] = self._find_body(link)
        return body

    def _find_body(self, link: str) -> int:
        body = mujoco.mj_name2id(
            self._engine.model, mujoco.mjtObj.mjOBJ_BODY, f'{self.name}/{link}'
        )
        if body >= 0:
            return body
        if link == self.description.root.name == WORLD_LINK:
            return 0
        links = ', '.join(each.name for each in self.description.links)
        raise SimulationError(
            f"robot '{self.name}': there is no link '{link}' in the world; there are: {links}"
        )


def _vector(array: np.ndarray) -> Vector:
    x, y, z = array.tolist()
    return (x, y, z)
