# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot as one thing in the world: where it is, how it moves, what space it takes; put elsewhere.

Everything is said of the robot's root link, in the axes of the world.
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
class Motion:
    """m/s, rad/s, m/s², rad/s², in the axes of the world."""

    linear_velocity: Vector
    angular_velocity: Vector
    linear_acceleration: Vector
    angular_acceleration: Vector


@dataclass(frozen=True, slots=True)
class Box:
    """Its two opposite corners, m."""

    lower: Vector
    upper: Vector


def pose_of(robot: RobotView) -> Transform:
    """Transform from the root link to the world. Raises SimulationError."""
    return robot.pose(robot.description.root.name)


def motion_of(engine: Engine, robot: RobotView) -> Motion:
    """
    How the origin of the root link moves. Raises SimulationError.

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
    # MuJoCo lets the world accelerate upwards in the place of gravity.
    return Motion(
        linear_velocity=rotate(pose.rotation, linear),
        angular_velocity=rotate(pose.rotation, angular),
        linear_acceleration=_vector(change[3:] + model.opt.gravity),
        angular_acceleration=_vector(change[:3]),
    )


def place(
    engine: Engine, robot: RobotView, pose: Transform, linear: Vector, angular: Vector
) -> None:
    """
    Put a robot elsewhere and set it in motion; its joints stay as they are.

    ``pose``: from the root link to the world, with a unit quaternion; ``linear`` (m/s) and
    ``angular`` (rad/s): of the root link's origin. Raises SimulationError for a fixed robot.
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
    # MuJoCo turns a free body in its own axes, and moves it in the world's.
    state.qvel[:] = (*linear, *rotate(conjugate(pose.rotation), angular))
    engine.forget_truth()


def bounds_of(engine: Engine, robot: RobotView, frame: Transform) -> Box | None:
    """
    The box around all of a robot's shapes as it stands now, with its edges along ``frame``.

    ``frame``: transform from it to the world. None: there is no shape. Raises SimulationError.
    """
    robot.pose(robot.description.root.name)  # brings the places of the shapes up to date
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
    return Box(_vector(np.min(corners, axis=0)), _vector(np.max(corners, axis=0)))


def _vector(values: np.ndarray) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)
