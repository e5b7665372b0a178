# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules on joints: each by itself, those that mimic others, and those that carry wheels.
"""

from collections.abc import Iterator
import math

from amr_description.model.axles import ACROSS
from amr_description.model.checks.context import CheckContext
from amr_description.model.findings import Finding
from amr_description.model.frames import rotate
from amr_description.model.robot import Joint, JointType, Robot
from amr_description.model.wheels import Wheel
from amr_description.model.xml_reader import line_of
from amr_description.text import quote, quote_all

# An axis written with three digits, as 0.707 0.707 0, counts as a unit vector.
_UNIT_TOLERANCE = 1e-3
# Beyond this factor solvers lose the direction.
_EXTREME = 1e6
# Joints of a chain of mimics; limits the time for absurd files.
_LONGEST_CHAIN = 100
# m; two sides may differ by this much, and a wheel this close to the middle is on neither.
_TOLERANCE = 0.001


def limits_leave_a_range(context: CheckContext) -> Iterator[Finding]:
    """
    The limits of a joint that has them are not equal.

    Such a joint cannot move.
    """
    for joint in context.robot.joints:
        if joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC) or joint.limit is None:
            continue
        lower, upper = joint.limit.lower, joint.limit.upper
        if lower == upper:
            yield context.warning(
                joint.line,
                f'joint {quote(joint.name)} cannot move',
                found=f'lower {lower:g}, upper {upper:g}',
                expected='a lower limit below the upper one',
                fix='give its range, or make it type="fixed"',
            )


def limits_let_it_move(context: CheckContext) -> Iterator[Finding]:
    """Limits of effort and velocity are above 0, but for a joint that a spring moves."""
    springs = {
        element.get('reference')
        for element in context.xml.iterchildren('gazebo')
        if element.find('springStiffness') is not None
    }
    for joint in context.robot.joints:
        if joint.limit is None or not joint.is_moving or joint.name in springs:
            continue
        for name in ('effort', 'velocity'):
            value = getattr(joint.limit, name)
            if value <= 0.0:
                yield context.warning(
                    joint.line,
                    f'joint {quote(joint.name)}: the {name} limit leaves nothing to move it with',
                    found=f'{value:g}',
                    expected='a number above 0',
                    taken='there is no such limit' if value < 0.0 else '',
                )


def damping_takes_energy(context: CheckContext) -> Iterator[Finding]:
    """Damping and friction are not negative, which would drive the joint."""
    for joint in context.robot.joints:
        for name in ('damping', 'friction') if joint.dynamics is not None else ():
            value = getattr(joint.dynamics, name)
            if value < 0.0:
                yield context.error(
                    joint.line,
                    f'joint {quote(joint.name)}: {name}',
                    found=f'{value:g}',
                    expected='0 or more',
                )


def axis_is_a_unit_vector(context: CheckContext) -> Iterator[Finding]:
    """The axis has length 1; programs treat other lengths differently."""
    for element in context.xml.iterchildren('joint'):
        axis = element.find('axis')
        kind = element.get('type')
        if axis is None or kind in (JointType.FIXED, JointType.FLOATING):
            continue
        length = _length(axis.get('xyz', '1 0 0'))
        if 0.0 < length < math.inf and abs(length - 1.0) > _UNIT_TOLERANCE:
            parts = (float(part) / length for part in axis.get('xyz', '').split())
            report = context.warning if 1.0 / _EXTREME < length < _EXTREME else context.error
            yield report(
                line_of(axis),
                f'joint {quote(element.get("name", ""))}: the axis is no unit vector',
                found=f'length {length:.4g}',
                expected='1',
                fix=f'write <axis xyz="{" ".join(f"{part:.6g}" for part in parts)}"/>',
            )


def mimicked_joint_is_no_mimic(context: CheckContext) -> Iterator[Finding]:
    """The joint that a mimic joint follows is no mimic itself."""
    robot = context.robot
    for joint in robot.joints:
        source = '' if joint.mimic is None else joint.mimic.joint
        if source and robot.joint(source).mimic is not None:
            end = _end_of_chain(robot, joint)
            yield context.warning(
                joint.line,
                f'joint {quote(joint.name)} mimics {quote(source)}, which is a mimic itself',
                expected='one step, as programs take it',
                fix=f'mimic {quote(end)}' if end else 'mimic a joint that is none',
            )


def wheels_roll_forward(context: CheckContext) -> Iterator[Finding]:
    """
    A positive speed of a wheel moves the robot to +x.

    A wheel on the ground that turns about its axle moves the robot along axle × z, so the axle
    must point to the robot's left, +y of the root at zero pose (REP 103: x forward). Wheels are
    the continuous joints with a velocity command; others (a turning lidar, the wheels of an
    omnidirectional robot) are left out. There is one finding for all wheels. It is an error if a
    controller has wheels of both kinds: it cannot drive straight then.
    """
    to_the_left = {joint.name: _axle_to_the_left(context, joint) for joint in context.speed_joints}
    backwards = [joint for joint in context.speed_joints if to_the_left[joint.name] < -ACROSS]
    if not backwards:
        return
    names = quote_all([joint.name for joint in backwards])
    plural = 's' if len(backwards) > 1 else ''
    is_split = any(
        min(axles, default=0.0) < -ACROSS and max(axles, default=0.0) > ACROSS
        for drive in context.inputs.drives
        for axles in [[to_the_left.get(wheel, 0.0) for wheel in drive.wheels]]
    )
    also = ', and its other wheels drive it forward: it turns where it should roll'
    report = context.error if is_split else context.warning
    yield report(
        backwards[0].line,
        f'wheel joint{plural} {names}: a positive speed drives the robot backwards'
        f'{also if is_split else ""}',
        found='the axle along -y of the root frame',
        expected='+y',
        fix=_reversed_axes(backwards),
    )


def sides_are_symmetric(context: CheckContext) -> Iterator[Finding]:
    """
    Each wheel on the left has a mirror image on the right, in position and in size.

    Otherwise the robot pulls to one side. Wheels in the middle, and those that do not roll along
    x, are not checked.
    """
    sides: dict[bool, list[Wheel]] = {True: [], False: []}
    for wheel in context.wheels:
        y = _hub(context, wheel)[1]
        along_y = abs(_axle_to_the_left(context, context.robot.joint(wheel.joint)))
        if abs(y) > _TOLERANCE and along_y > ACROSS:
            sides[y > 0.0].append(wheel)
    left, right = (
        sorted(sides[is_left], key=lambda wheel: _hub(context, wheel)[0])
        for is_left in (True, False)
    )
    if len(left) != len(right):
        yield _uneven(context, left, right)
        return
    for one, other in zip(left, right, strict=True):
        yield from _check_pair(context, one, other)


def _length(text: str) -> float:
    """Return the length of the vector that a text stands for; NaN if it is not a vector."""
    words = text.split()
    try:
        return math.hypot(*map(float, words)) if len(words) == 3 else math.nan
    except ValueError:
        return math.nan


def _end_of_chain(robot: Robot, joint: Joint) -> str:
    """Return the joint at the end of a chain of mimics; '' if there is none."""
    seen: set[str] = set()
    while joint.mimic is not None and joint.name not in seen and len(seen) < _LONGEST_CHAIN:
        seen.add(joint.name)
        if not robot.has_joint(joint.mimic.joint):
            return ''
        joint = robot.joint(joint.mimic.joint)
    return '' if joint.mimic is not None else joint.name


def _axle_to_the_left(context: CheckContext, joint: Joint) -> float:
    """Return the part of a joint's axis along +y of the root."""
    return rotate(context.poses[joint.child].rotation, joint.axis)[1]


def _reversed_axes(joints: list[Joint]) -> str:
    """Return what to write instead of the axes of these joints."""
    axes = {' '.join(f'{0.0 - part:g}' for part in joint.axis) for joint in joints}
    return f'write <axis xyz="{axes.pop()}"/>' if len(axes) == 1 else 'turn each <axis> round'


def _hub(context: CheckContext, wheel: Wheel) -> tuple[float, float, float]:
    return context.poses[wheel.link].translation


def _uneven(context: CheckContext, left: list[Wheel], right: list[Wheel]) -> Finding:
    named = [quote_all([wheel.joint for wheel in side]) for side in (left, right)]
    lines = [context.robot.joint(wheel.joint).line for wheel in max(left, right, key=len)]
    return context.warning(
        min(lines),
        'the driven wheels are not the same on both sides',
        found=f'on the left (y > 0) {named[0]}, on the right {named[1]}',
        expected='pairs',
        fix='correct the y of <origin> of the joints',
    )


def _check_pair(context: CheckContext, left: Wheel, right: Wheel) -> Iterator[Finding]:
    """Report the first way in which two wheels are not each other's mirror image."""
    (x, y, z), (x2, y2, z2) = _hub(context, left), _hub(context, right)
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
            yield context.warning(
                context.robot.joint(right.joint).line,
                f'wheels {quote(left.joint)} and {quote(right.joint)} {what}',
                found=f'{name} {one:g} m and {sign * other:g} m',
                expected='a left and a right side that mirror each other',
            )
            return
