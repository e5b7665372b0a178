# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which links are wheels, by their joints and shapes, not by their names.

A wheel is the child of a continuous joint with a velocity command, and its collision shape is a
cylinder or a sphere that is round about the axis of the joint. The wheel of a caster has no
command, and a level axle: a lidar that turns about a vertical axis is not a wheel.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
import math

from amr_description.model.frames import dot, rotate, Transform, Vector
from amr_description.model.robot import Collision, Cylinder, Joint, JointType, Robot, Sphere

# A shape counts as round about the axis when it is off by less than this: 1 mm, and 2.5 degrees.
_LARGEST_OFFSET = 0.001
_SMALLEST_COSINE = 0.999
# The part of an axle along the root's z axis.
_LEVEL = 0.1

_Z: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel: the child of ``joint``."""

    link: str
    joint: str
    radius: float
    """m; where several round shapes are about one axle, of the largest, which rolls."""
    half_width: float
    """m; half the length of the cylinder, the radius of a sphere."""


def find_wheels(robot: Robot, velocity_joints: Collection[str]) -> tuple[Wheel, ...]:
    """Return the driven wheels; ``velocity_joints`` are the joints with a velocity command."""
    driven = (each for each in robot.joints if is_driven_wheel_joint(each, velocity_joints))
    return tuple(wheel for joint in driven if (wheel := wheel_of(robot, joint)) is not None)


def is_driven_wheel_joint(joint: Joint, velocity_joints: Collection[str]) -> bool:
    """Return whether a joint may be that of a driven wheel, whatever the shape of its child."""
    return joint.name in velocity_joints and joint.type is JointType.CONTINUOUS


def is_passive_wheel_joint(
    joint: Joint, poses: Mapping[str, Transform], commanded: Collection[str]
) -> bool:
    """
    Return whether a joint may be that of a wheel that nothing drives: its axle is level.

    Args:
        joint: any joint.
        poses: ``transform_link_to_root`` of the links, with all joints at 0.
        commanded: the joints with any command.
    """
    return (
        joint.type is JointType.CONTINUOUS
        and joint.name not in commanded
        and joint.mimic is None
        and abs(rotate(poses[joint.child].rotation, joint.axis)[2]) < _LEVEL
    )


def wheel_of(robot: Robot, joint: Joint) -> Wheel | None:
    """Return the wheel that the child of a joint is by its primitive shapes; None: it is none."""
    sizes = []
    for collision in robot.link(joint.child).collisions:
        shape = collision.geometry
        if isinstance(shape, Cylinder) and _is_round_about(collision, joint.axis):
            sizes.append((shape.radius, shape.length / 2.0))
        if isinstance(shape, Sphere) and _is_round_about(collision, joint.axis):
            sizes.append((shape.radius, shape.radius))
    return Wheel(joint.child, joint.name, *max(sizes)) if sizes else None


def _is_round_about(collision: Collision, axis: Vector) -> bool:
    """Return whether the axis of the shape is that of the joint (through the link's origin)."""
    offset = collision.origin.translation
    along = dot(offset, axis)
    radial = math.sqrt(max(0.0, dot(offset, offset) - along * along))
    if radial > _LARGEST_OFFSET:
        return False
    if isinstance(collision.geometry, Sphere):
        return True
    return abs(dot(rotate(collision.origin.rotation, _Z), axis)) > _SMALLEST_COSINE
