# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot as an entity of ``simulation_interfaces``: its pose, motion and bounds; moving it.

Poses and velocities are those of the robot's root link, in the axes of the world.
"""

from dataclasses import dataclass
from itertools import product

import mujoco
import numpy as np

from amr_description.errors import SimulationError
from amr_description.model.frames import (
    conjugate,
    rotate,
    Transform,
    Vector,
    wxyz_from_xyzw,
)
from amr_description.sim.engine import Engine
from amr_description.sim.robot_spec import root_joint
from amr_description.sim.robot_view import RobotView


@dataclass(frozen=True, slots=True)
class EntityMotion:
    """Velocities (m/s, rad/s) and accelerations (m/s², rad/s²) in the axes of the world."""

    linear_velocity: Vector
    angular_velocity: Vector
    linear_acceleration: Vector
    angular_acceleration: Vector


@dataclass(frozen=True, slots=True)
class BoundingBox:
    """Two opposite corners, m."""

    lower: Vector
    upper: Vector


def pose_of(robot: RobotView) -> Transform:
    """Return the transform from the root link to the world. Raises SimulationError."""
    return robot.pose(robot.description.root.name)


def motion_of(engine: Engine, robot: RobotView) -> EntityMotion:
    """
    Return how the origin of the root link moves. Raises SimulationError.

    The acceleration is that of the last physics step: (velocity after - before) / step.
    """
    root = robot.description.root.name
    pose = robot.pose(root)
    linear, angular = robot.velocity(root)
    model, data = engine.model, engine.data
    body = max(0, mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, f'{robot.name}/{root}'))
    mujoco.mj_rnePostConstraint(model, data)
    change = np.empty(6)
    mujoco.mj_objectAcceleration(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, change, 0)
    # MuJoCo models gravity as an upward acceleration of the world.
    return EntityMotion(
        linear_velocity=rotate(pose.rotation, linear),
        angular_velocity=rotate(pose.rotation, angular),
        linear_acceleration=_vector(change[3:] + model.opt.gravity),
        angular_acceleration=_vector(change[:3]),
    )


def set_state(
    engine: Engine, robot: RobotView, pose: Transform, linear: Vector, angular: Vector
) -> None:
    """
    Set pose and velocity of a robot; its joints stay as they are.

    Args:
        engine: Of the world.
        robot: Of the world.
        pose: Transform from the root link to the world, with a unit quaternion.
        linear: Velocity of the root link's origin, m/s.
        angular: Its angular velocity, rad/s.

    Raises:
        SimulationError: The robot stands fixed.
    """
    name = f'{robot.name}/{root_joint(robot.description)}'
    joint = mujoco.mj_name2id(engine.model, mujoco.mjtObj.mjOBJ_JOINT, name)
    if joint < 0:
        raise SimulationError(
            f"'{robot.name}' stands fixed in the world: its root link is "
            f"'{robot.description.root.name}'"
        )
    state = engine.data.joint(joint)
    state.qpos[:] = (*pose.translation, *wxyz_from_xyzw(pose.rotation))
    # The angular velocity of a free joint is in the axes of the body, the linear in the world's.
    state.qvel[:] = (*linear, *rotate(conjugate(pose.rotation), angular))
    engine.invalidate_kinematics()


def bounds_of(engine: Engine, robot: RobotView, frame: Transform) -> BoundingBox | None:
    """
    Return the box around all geoms of a robot as it is now, or None without any.

    Args:
        engine: Of the world.
        robot: Of the world.
        frame: Transform to the world from the frame in which the box is axis-aligned.

    Raises:
        SimulationError: The robot was removed.
    """
    robot.pose(robot.description.root.name)  # brings geom poses up to date
    model, data = engine.model, engine.data
    to_frame = np.array(frame.inverse().to_matrix())
    corners = []
    for geom in range(model.ngeom):
        body = model.body(model.geom_bodyid[geom]).name
        if not body.startswith(f'{robot.name}/'):
            continue
        centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        for signs in product((-1.0, 1.0), repeat=3):
            turned = data.geom_xmat[geom].reshape(3, 3) @ (centre + half * signs)
            corners.append(to_frame[:3, :3] @ (data.geom_xpos[geom] + turned) + to_frame[:3, 3])
    if not corners:
        return None
    return BoundingBox(_vector(np.min(corners, axis=0)), _vector(np.max(corners, axis=0)))


def _vector(values: np.ndarray) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)
