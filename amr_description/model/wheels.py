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

from amr_description.model.frames import cross, dot, rotate, Transform, Vector
from amr_description.model.gazebo.physics import GazeboLink, GazeboPhysics
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Collision, Cylinder, Joint, JointType, Robot, Sphere

# --- Wheels with rollers -------------------------------------------------------------------------
#
# A description made for Gazebo has a plain cylinder there, and says that it slides freely in one
# direction: ``<mu1>1</mu1> <mu2>0</mu2> <fdir1>1 -1 0</fdir1>`` in the ``<gazebo reference="…">``
# of the link, or the same in ``collision/surface/friction/ode``. The friction ``mu1`` (or ``mu``)
# is along ``fdir1``, ``mu2`` is across. With an attribute ``expressed_in`` the direction is in the
# frame of that link, otherwise in that of the wheel, all joints being at 0. It is taken as the
# direction at the ground, however far the wheel has turned: rollers come to the ground one after
# the other.
#
# A wheel counts as one with rollers if one of the two frictions is at most :data:`FREE_PART` of
# the other.

FREE_PART = 0.1
"""Of the larger friction: a rubber tyre whose two frictions differ a little has no rollers."""

_UP: Vector = (0.0, 0.0, 1.0)
_SHORT = 1e-6


@dataclass(frozen=True, slots=True)
class Rollers:
    """
    The rollers of one wheel, at the ground.

    ``angle`` (rad) is that of their axes: 0 ahead, where the wheel rolls that turns forward about
    its axle, and a right angle along the axle. The wheel holds along them, and is free across.
    ``grip`` and ``free`` are sliding frictions along and across; infinite: that of the surface.
    """

    angle: float
    grip: float = math.inf
    free: float = 0.0


def described_rollers(robot: Robot, physics: GazeboPhysics) -> Mapping[str, Rollers]:
    """Return the rollers that the ``<gazebo>`` blocks of a robot tell of, by link."""
    joints = {joint.child: joint for joint in robot.joints if joint.has_position}
    told = {name: link for name, link in physics.links.items() if name in joints}
    poses = link_poses(robot, {}) if any(map(_has_rollers, told.values())) else {}
    found = {}
    for name, link in told.items():
        if not _has_rollers(link) or link.direction is None:
            continue
        frame = link.direction_frame if link.direction_frame in poses else name
        direction = rotate(poses[frame].rotation, link.direction)
        angle = roller_angle(rotate(poses[name].rotation, joints[name].axis), direction)
        if angle is None:
            continue
        along, across = link.mu1 or 0.0, link.mu2 or 0.0
        if along < across:
            angle, along, across = angle + math.pi / 2.0, across, along
        found[name] = Rollers(angle, along, across)
    return found


def roller_angle(axle: Vector, direction: Vector) -> float | None:
    """
    Return the angle of a direction as :class:`Rollers` has it.

    Args:
        axle: of the wheel, about which it turns, in a frame whose z axis is up.
        direction: of the axes of the rollers at the ground, in the same frame.

    Returns:
        The angle, rad; None if the axle or the direction is vertical.
    """
    ahead = cross(axle, _UP)
    length = math.hypot(*ahead)
    if length < _SHORT or math.hypot(*direction[:2]) < _SHORT:
        return None
    aside = cross(_UP, ahead)
    return math.atan2(dot(direction, aside), dot(direction, ahead))


def _has_rollers(link: GazeboLink) -> bool:
    if link.direction is None or link.mu1 is None or link.mu2 is None:
        return False
    smaller, greater = sorted((link.mu1, link.mu2))
    return smaller <= FREE_PART * greater and greater > 0.0


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
