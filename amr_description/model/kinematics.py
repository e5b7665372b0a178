# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics: the poses of links for given joint positions."""

from collections.abc import Mapping
import math

from amr_description.model.frames import multiply, Transform
from amr_description.model.robot import Joint, Robot


def joint_transform(joint: Joint, position: float = 0.0) -> Transform:
    """
    Return ``transform_child_to_parent`` of a joint at ``position`` (rad; m for a prismatic joint).

    It is the origin composed with the motion along or about the axis. Fixed, planar and floating
    joints have no single position and stay at their origin, as in KDL.
    """
    origin = joint.origin
    if joint.type in ('revolute', 'continuous'):
        x, y, z = joint.axis
        sine = math.sin(position / 2.0)
        rotation = (x * sine, y * sine, z * sine, math.cos(position / 2.0))
        return Transform(origin.translation, multiply(origin.rotation, rotation))
    if joint.type == 'prismatic':
        x, y, z = joint.axis
        return Transform(origin.apply((x * position, y * position, z * position)), origin.rotation)
    return origin


def joint_position(joint: Joint, positions: Mapping[str, float]) -> float:
    """
    Return the position of a joint, given the known positions by joint name; others are 0.

    A mimic joint that is not in ``positions`` is at multiplier · source + offset (one level only).
    """
    if joint.name in positions or joint.mimic is None:
        return positions.get(joint.name, 0.0)
    return joint.mimic.multiplier * positions.get(joint.mimic.joint, 0.0) + joint.mimic.offset


def link_poses(robot: Robot, positions: Mapping[str, float] | None = None) -> dict[str, Transform]:
    """Return ``transform_link_to_root`` of every link; joints without a position are at 0."""
    poses = {link.name: Transform() for link in robot.roots}
    for _, joint in robot.walk():
        moved = joint_transform(joint, joint_position(joint, positions or {}))
        poses[joint.child] = poses[joint.parent] @ moved
    return poses
