# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which links are wheels, by their joints and shapes, not by their names.

A wheel is the child of a continuous joint with a velocity command, and its collision shape is a
cylinder or a sphere that is round about the axis of the joint. The wheel of a caster has no
command, and a level axle: a lidar that turns about a vertical axis is not a wheel.
"""

from collections.abc import Collection
from dataclasses import dataclass
import math

from amr_description.model.frames import rotate, Vector
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Collision, Cylinder, Joint, JointType, Robot, Sphere

# A shape counts as round about the axis when it is off by less than this: 1 mm, and 2.5 degrees.
_LARGEST_OFFSET = 0.001
_SMALLEST_COSINE = 0.999
# The part of an axle along the root's z axis.
_LEVEL = 0.1

_Z: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel: ``collision`` is the index of its round shape in the link's collisions."""

    link: str
    joint: str
    collision: int
    radius: float
    """m."""
    half_width: float
    """m; half the length of the cylinder, the radius of a sphere."""


def find_wheels(robot: Robot, velocity_joints: Collection[str]) -> tuple[Wheel, ...]:
    """Return the driven wheels; ``velocity_joints`` are the joints with a velocity command."""
    driven = (j for j in robot.joints if j.name in velocity_joints)
    found = (_wheel_of(robot, joint) for joint in driven if joint.type is JointType.CONTINUOUS)
    return tuple(wheel for wheel in found if wheel is not None)


def find_passive_wheels(robot: Robot, commanded: Collection[str]) -> tuple[Wheel, ...]:
    """Return the wheels that are not driven; ``commanded`` are the joints with any command."""
    poses = link_poses(robot, {})
    found = (
        _wheel_of(robot, joint)
        for joint in robot.joints
        if joint.type is JointType.CONTINUOUS
        and joint.name not in commanded
        and joint.mimic is None
        and abs(rotate(poses[joint.child].rotation, joint.axis)[2]) < _LEVEL
    )
    return tuple(wheel for wheel in found if wheel is not None)


def _wheel_of(robot: Robot, joint: Joint) -> Wheel | None:
    for index, collision in enumerate(robot.link(joint.child).collisions):
        shape = collision.geometry
        if not _is_round_about(collision, joint.axis):
            continue
        if isinstance(shape, Cylinder):
            return Wheel(joint.child, joint.name, index, shape.radius, shape.length / 2.0)
        if isinstance(shape, Sphere):
            return Wheel(joint.child, joint.name, index, shape.radius, shape.radius)
    return None


def _is_round_about(collision: Collision, axis: Vector) -> bool:
    """Return whether the axis of the shape is that of the joint (through the link's origin)."""
    offset = collision.origin.translation
    along = math.sumprod(offset, axis)
    radial = math.sqrt(max(0.0, math.sumprod(offset, offset) - along * along))
    if radial > _LARGEST_OFFSET:
        return False
    if isinstance(collision.geometry, Sphere):
        return True
    return abs(math.sumprod(rotate(collision.origin.rotation, _Z), axis)) > _SMALLEST_COSINE
