# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The geoms with which wheels touch the ground: ellipsoids of their size.

An ellipsoid touches flat ground in one point; the edge of a cylinder gives contacts that come and
go as the wheel turns, and a mesh rolls on the corners of its convex hull.

Wheels are found by joints and primitive shapes (:mod:`amr_description.model.wheels`), and here
also those whose collision is a mesh that is round about the axis. A robot that nothing drives
stands on wheels too: several of one height that turn freely.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from amr_description.control.interfaces import EFFORT, VELOCITY
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Joint, Robot, WORLD_LINK
from amr_description.model.wheels import (
    is_driven_wheel_joint,
    is_passive_wheel_joint,
    Wheel,
    wheel_of,
)
from amr_description.sim.gazebo_physics import wheel_geom_name

_DRIVING_INTERFACES = {VELOCITY, EFFORT}
"""The command interfaces by which a wheel is driven."""

_ROUND = (mujoco.mjtGeom.mjGEOM_CYLINDER, mujoco.mjtGeom.mjGEOM_SPHERE)
_DIRECTIONS = 32
"""In which a mesh has to reach as far from the axis."""
_ROUNDNESS = 0.95
"""The least reach of a round mesh, as a share of the largest."""
_TREAD = 0.9
"""What is farther from the axis than this share of the radius is its tread."""
_WIDEST = 2.0
"""Half the width of a wheel is at most so many radii: what is longer is a roller or a shaft."""
_SAME_HEIGHT = 0.2
"""The share of the radius by which wheels of a robot that nothing drives may differ in height."""


def make_wheels(
    spec: mujoco.MjSpec, robot: Robot, commands: Mapping[str, Collection[str]]
) -> tuple[Wheel, ...]:
    """
    Find the wheels of a robot and give each a geom of its shape, driven ones first.

    Args:
        spec: Of the robot, its meshes in it; edited.
        robot: Its description.
        commands: The command interfaces of joints.
    """
    driving = {joint for joint, names in commands.items() if _DRIVING_INTERFACES & {*names}}
    driving |= {j.name for j in robot.joints if j.mimic is not None and j.mimic.joint in driving}
    driven = [j for j in robot.joints if is_driven_wheel_joint(j, driving)]
    poses = link_poses(robot, {})
    commanded = {joint for joint, names in commands.items() if names}  # others are only read
    free = [j for j in robot.joints if is_passive_wheel_joint(j, poses, commanded)]
    found = {joint.name: _find(spec, robot, joint) for joint in (*driven, *free)}
    wheels = [each for joint in driven if (each := found[joint.name]) is not None]
    passive = [each for joint in free if (each := found[joint.name]) is not None]
    if wheels or _stands_on(robot, [wheel for wheel, _ in passive]):
        wheels += passive
    for wheel, mesh in wheels:
        _make_geom(spec, robot, wheel, mesh)
    return tuple(wheel for wheel, _ in wheels)


@dataclass(frozen=True, slots=True)
class _RoundMesh:
    """A geom whose mesh is round about an axis; lengths in m."""

    geom: mujoco.MjsGeom
    radius: float
    half_width: float
    middle: float
    """Of its tread, along the axis."""


def _find(
    spec: mujoco.MjSpec, robot: Robot, joint: Joint
) -> tuple[Wheel, _RoundMesh | None] | None:
    """Return the wheel that the child of a joint is, with its mesh if that is its shape."""
    primitive = wheel_of(robot, joint)
    if primitive is not None:
        return primitive, None
    meshes = (_round_mesh(spec, geom, joint) for geom in _touching(spec, joint.child))
    mesh = max(filter(None, meshes), key=lambda each: each.radius, default=None)
    if mesh is None:
        return None
    return Wheel(joint.child, joint.name, mesh.radius, mesh.half_width), mesh


def _stands_on(robot: Robot, wheels: list[Wheel]) -> bool:
    """Whether a robot that nothing drives stands on its wheels: they reach equally far down."""
    if len(wheels) < 2 or robot.root.name == WORLD_LINK:
        return False
    poses = link_poses(robot, {})
    lows = [poses[wheel.link].translation[2] - wheel.radius for wheel in wheels]
    return max(lows) - min(lows) < _SAME_HEIGHT * min(wheel.radius for wheel in wheels)


def _make_geom(spec: mujoco.MjSpec, robot: Robot, wheel: Wheel, mesh: _RoundMesh | None) -> None:
    """Replace the wheel's round geom by an ellipsoid of its size."""
    if mesh is None:
        # By its radius: a collision before it may have been left out.
        round_geoms = (geom for geom in _touching(spec, wheel.link) if geom.type in _ROUND)
        geom = min(round_geoms, key=lambda each: abs(float(each.size[0]) - wheel.radius))
    else:
        axis, rotation = np.array(robot.joint(wheel.joint).axis), np.empty(4)
        mujoco.mju_quatZ2Vec(rotation, axis)
        geom = mesh.geom
        geom.meshname = ''
        geom.pos, geom.quat = axis * mesh.middle, rotation
    geom.name = wheel_geom_name(wheel.link)
    geom.type = mujoco.mjtGeom.mjGEOM_ELLIPSOID
    geom.size = [wheel.radius, wheel.radius, wheel.half_width]


def _touching(spec: mujoco.MjSpec, link: str) -> list[mujoco.MjsGeom]:
    return [geom for geom in spec.body(link).geoms if geom.contype or geom.conaffinity]


def _round_mesh(spec: mujoco.MjSpec, geom: mujoco.MjsGeom, joint: Joint) -> _RoundMesh | None:
    """Return a geom whose mesh is round about the axis of a joint; None: it is another."""
    if geom.type != mujoco.mjtGeom.mjGEOM_MESH:
        return None
    corners = _corners(spec, geom)
    if len(corners) < 3:
        return None
    axis = np.array(joint.axis)
    along = corners @ axis
    across = corners - np.outer(along, axis)
    first = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    first /= np.linalg.norm(first)
    angles = 2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    directions = np.outer(np.cos(angles), first) + np.outer(np.sin(angles), np.cross(axis, first))
    reach = (across @ directions.T).max(axis=0)
    distances = np.linalg.norm(across, axis=1)
    radius = float(distances.max())
    if radius <= 0.0 or reach.min() < _ROUNDNESS * radius:
        return None
    tread = along[distances > _TREAD * radius]
    half_width = float(np.ptp(tread)) / 2.0
    if not 0.0 < half_width < _WIDEST * radius:
        return None
    return _RoundMesh(geom, radius, half_width, float(tread.max() + tread.min()) / 2.0)


def _corners(spec: mujoco.MjSpec, geom: mujoco.MjsGeom) -> NDArray[np.float64]:
    """Return the corners of a mesh in the frame of its body, (n, 3) m; none if MuJoCo reads it."""
    vertices = np.reshape(np.array(spec.mesh(geom.meshname).uservert, dtype=float), (-1, 3))
    rotation = np.empty(9)
    mujoco.mju_quat2Mat(rotation, np.array(geom.quat, dtype=float))
    return vertices @ rotation.reshape(3, 3).T + np.array(geom.pos)
