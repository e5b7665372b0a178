# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on the wheels of a robot."""

from collections.abc import Iterator
import math

from amr_description.model.findings import Finding, quote, quote_all
from amr_description.model.frames import rotate
from amr_description.model.robot import Joint
from amr_description.model.subject import Subject
from amr_description.model.wheels import Wheel

# An axle within this cosine of the robot's y axis is that of a wheel that rolls along x; others
# (a turning lidar, the wheels of an omnidirectional robot) are left alone.
_ALONG_Y = 0.9
# m; by as much two sides may differ, and a wheel this near to the middle belongs to neither.
_TOLERANCE = 0.001


def wheels_roll_forward(subject: Subject) -> Iterator[Finding]:
    """
    A positive speed of a wheel carries the robot to +x.

    A wheel on the ground that turns by ω about its axle moves the robot along axle × z, so the
    axle has to point to the robot's left, +y of the root at zero pose (REP 103: x forward).
    Wheels are the continuous joints with a velocity command. One finding for all wheels that
    share the fault.
    """
    backwards = [
        joint for joint in subject.speed_joints if _axle_to_the_left(subject, joint) < -_ALONG_Y
    ]
    if not backwards:
        return
    names = quote_all([joint.name for joint in backwards])
    plural = 's' if len(backwards) > 1 else ''
    yield subject.warning(
        backwards[0].line,
        f'wheel joint{plural} {names}: a positive speed drives the robot backwards',
        found='the axle along -y of the root frame',
        expected='+y',
        fix=_turn_round(backwards),
    )


def _axle_to_the_left(subject: Subject, joint: Joint) -> float:
    """Return the part of a joint's axis along +y of the root."""
    return rotate(subject.poses[joint.child].rotation, joint.axis)[1]


def _turn_round(joints: list[Joint]) -> str:
    """Return what to write instead of the axes of these joints."""
    axes = {' '.join(f'{0.0 - part:g}' for part in joint.axis) for joint in joints}
    return f'write <axis xyz="{axes.pop()}"/>' if len(axes) == 1 else 'turn each <axis> round'


def sides_are_symmetric(subject: Subject) -> Iterator[Finding]:
    """
    Each wheel on the left has one on the right: as far out, as far ahead, as high, as large.

    Otherwise the robot pulls to one side. Wheels in the middle, and those that do not roll along
    x, are left alone.
    """
    sides: dict[bool, list[Wheel]] = {True: [], False: []}
    for wheel in subject.wheels:
        y = _hub(subject, wheel)[1]
        along_y = abs(_axle_to_the_left(subject, subject.robot.joint(wheel.joint)))
        if abs(y) > _TOLERANCE and along_y > _ALONG_Y:
            sides[y > 0.0].append(wheel)
    left, right = (
        sorted(sides[is_left], key=lambda wheel: _hub(subject, wheel)[0])
        for is_left in (True, False)
    )
    if len(left) != len(right):
        yield _uneven(subject, left, right)
        return
    for one, other in zip(left, right, strict=True):
        yield from _judge_pair(subject, one, other)


def _hub(subject: Subject, wheel: Wheel) -> tuple[float, float, float]:
    return subject.poses[wheel.link].translation


def _uneven(subject: Subject, left: list[Wheel], right: list[Wheel]) -> Finding:
    named = [quote_all([wheel.joint for wheel in side]) for side in (left, right)]
    lines = [subject.robot.joint(wheel.joint).line for wheel in max(left, right, key=len)]
    return subject.warning(
        min(lines),
        'the driven wheels are not the same on both sides',
        found=f'on the left (y > 0) {named[0]}, on the right {named[1]}',
        expected='pairs',
        fix='correct the y of <origin> of the joints',
    )


def _judge_pair(subject: Subject, left: Wheel, right: Wheel) -> Iterator[Finding]:
    """Report the first way in which two wheels are not each other's mirror image."""
    (x, y, z), (x2, y2, z2) = _hub(subject, left), _hub(subject, right)
    measures = (
        ('are not as far out', 'y', y, -y2),
        ('are not as far ahead', 'x', x, x2),
        ('are not as high', 'z', z, z2),
        ('differ in radius', 'radius', left.radius, right.radius),
        ('differ in width', 'half width', left.half_width, right.half_width),
    )
    for what, name, one, other in measures:
        if math.isfinite(one - other) and abs(one - other) > _TOLERANCE:
            sign = -1.0 if name == 'y' else 1.0
            yield subject.warning(
                subject.robot.joint(right.joint).line,
                f'wheels {quote(left.joint)} and {quote(right.joint)} {what}',
                found=f'{name} {one:g} m and {sign * other:g} m',
                expected='a left and a right side that mirror each other',
            )
            return
