# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where the axles of wheels point, and what would have them point to the left.

A wheel that turns forward about +y of the base rolls along +x (REP 103: x forward, y left, z up).
All joints are at 0.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import math

from amr_description.model.frames import (
    conjugate,
    cross,
    dot,
    multiply,
    Quaternion,
    rotate,
    rpy_from_quaternion,
    Transform,
    Vector,
)
from amr_description.model.robot import Collision, Cylinder, Joint, Robot, Visual

ACROSS = 0.9
"""
The least cosine between an axle and the base's y axis at which the wheel rolls along x: 26°, so
that wheels with camber or toe pass.
"""

# The least cosine at which an axle is called vertical, or is said to point ahead.
_ALIGNED = 0.9
# The least cosine between a cylinder and the axis at which it may count as a wheel.
_TUMBLING = 0.7
# Vectors whose rotation, not yet scaled to 1, is below this are opposite to each other.
_OPPOSITE = 1e-6
_LEFT: Vector = (0.0, 1.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class AxleFault:
    """
    An axle that does not let its wheel roll along x.

    ``direction`` is the axis in the frame of the base. ``what`` goes on a sentence that names the
    joint, and ``fix`` is what to write.
    """

    direction: Vector
    what: str
    fix: str

    @property
    def is_vertical(self) -> bool:
        """Whether the wheel lies flat."""
        return abs(self.direction[2]) > _ALIGNED


def axle_fault(
    robot: Robot, poses: Mapping[str, Transform], joint: Joint, base: str
) -> AxleFault | None:
    """
    Return what is wrong with the axle of a wheel; None if it is across, either way round.

    A wheel whose only collision shapes are cylinders has to turn about the axis of one of them.

    Args:
        robot: the robot.
        poses: ``transform_link_to_root`` of its links, with all joints at 0.
        joint: the joint of the wheel.
        base: the link whose x axis is the drive direction.
    """
    to_base = conjugate(poses[base].rotation)
    turned = multiply(to_base, poses[joint.child].rotation)
    direction = rotate(turned, joint.axis)
    if not all(map(math.isfinite, direction)):
        return None
    if abs(direction[1]) > ACROSS:
        return _cylinder_fault(robot, joint, turned)
    if abs(direction[2]) > _ALIGNED:
        what = 'the axle is vertical, so that the wheel cannot roll'
    elif abs(direction[0]) > _ALIGNED:
        what = 'the axle points ahead, so that the wheel rolls sideways'
    else:
        what = 'the axle is askew, so that the wheel does not roll straight ahead'
    parent = multiply(to_base, poses[joint.parent].rotation)
    return AxleFault(direction, what, _fix(robot, joint, turned, parent))


def vector_text(vector: Vector) -> str:
    """Return a direction for a message, such as ``(0, 0.89, -0.45)``."""
    return f'({", ".join(f"{round(part, 2) + 0.0:g}" for part in vector)})'


def angles_text(angles: Vector) -> str:
    """Return an attribute of three angles (rad), such as ``rpy="-1.5708 0 0"``."""
    return f'rpy="{" ".join(f"{round(angle, 4) + 0.0:g}" for angle in angles)}"'


def _cylinder_fault(robot: Robot, joint: Joint, turned: Quaternion) -> AxleFault | None:
    """Return the fault of a wheel with a right axle and a cylinder that does not turn about it."""
    collisions = robot.link(joint.child).collisions
    axes = [rotate(part.origin.rotation, _Z) for part in collisions]
    is_round = any(abs(dot(axis, joint.axis)) > _TUMBLING for axis in axes)
    if is_round or not all(isinstance(part.geometry, Cylinder) for part in collisions) or not axes:
        return None
    if not all(map(math.isfinite, axes[0])):
        return None
    first = multiply(_rotation_between(axes[0], joint.axis), collisions[0].origin.rotation)
    return AxleFault(
        rotate(turned, axes[0]),
        'the cylinder of its <collision> does not turn about the axle, so that it cannot roll',
        f'write {angles_text(rpy_from_quaternion(first))} in the <origin> of its shapes',
    )


def _fix(robot: Robot, joint: Joint, turned: Quaternion, parent: Quaternion) -> str:
    """
    Return what to write in a joint to have its axle point to the left.

    The cylinder of a wheel tells how it is meant to stand: where it lies across the robot, only
    the axis is wrong; otherwise the joint is to be turned. ``turned`` is the rotation of the joint
    to the base, ``parent`` that of its parent.
    """
    cylinder = _cylinder_axis(robot, joint)
    wanted = rotate(conjugate(turned), _LEFT)
    if cylinder is None or abs(dot(cylinder, wanted)) > ACROSS:
        return f'write {_axis_text(wanted)}'
    along = dot(cylinder, joint.axis)
    axis = joint.axis if abs(along) > ACROSS else cylinder
    # How far a wheel is turned about its axle does not matter.
    rpy = rpy_from_quaternion(_rotation_between(axis, rotate(conjugate(parent), _LEFT)))
    also = '' if axis is joint.axis else f', and {_axis_text(axis)}'
    return f'write {angles_text(rpy)} in its <origin>{also}'


def _axis_text(axis: Vector) -> str:
    return f'<axis xyz="{" ".join(f"{round(part, 3) + 0.0:g}" for part in axis)}"/>'


def _cylinder_axis(robot: Robot, joint: Joint) -> Vector | None:
    """Return the axis of the first cylinder of a wheel in the joint's frame; None without one."""
    link = robot.link(joint.child)
    parts: tuple[Collision | Visual, ...] = (*link.collisions, *link.visuals)
    for part in parts:
        axis = rotate(part.origin.rotation, _Z)
        if isinstance(part.geometry, Cylinder) and all(map(math.isfinite, axis)):
            return axis
    return None


def _rotation_between(one: Vector, other: Vector) -> Quaternion:
    """Return the shortest rotation that takes a unit vector to another one."""
    x, y, z = cross(one, other)
    w = 1.0 + dot(one, other)
    length = math.hypot(x, y, z, w)
    if length < _OPPOSITE:  # half a turn, about any axis that is square to both
        a, b, c = one
        x, y, z, w = (-b, a, 0.0, 0.0) if abs(c) < ACROSS else (0.0, -c, b, 0.0)
        length = math.hypot(x, y, z)
    return (x / length, y / length, z / length, w / length)
