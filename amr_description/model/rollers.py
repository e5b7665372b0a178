# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Wheels with rollers on their rim, mecanum and omni wheels, as descriptions tell of them.

A description made for Gazebo has a plain cylinder there, and says that it slides freely in one
direction: ``<mu1>1</mu1> <mu2>0</mu2> <fdir1>1 -1 0</fdir1>`` in the ``<gazebo reference="…">``
of the link, or the same in ``collision/surface/friction/ode``. The friction ``mu1`` (or ``mu``) is
along ``fdir1``, ``mu2`` is across. With an attribute ``expressed_in`` the direction is in the
frame of that link, otherwise in that of the wheel, all joints being at 0. It is taken as the
direction at the ground, however far the wheel has turned: rollers come to the ground one after the
other.

A wheel counts as one with rollers if one of the two frictions is at most :data:`FREE_PART` of the
other.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import math

from amr_description.model.frames import cross, dot, rotate, Vector
from amr_description.model.gazebo.physics import GazeboLink, GazeboPhysics
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Robot

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
