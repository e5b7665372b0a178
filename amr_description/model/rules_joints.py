# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on joints, one by one."""

from collections.abc import Iterator
import math

from amr_description.model.element_reader import line_of
from amr_description.model.findings import Finding, quote, quote_all
from amr_description.model.robot import Joint, JointType, Robot
from amr_description.model.subject import Subject

# An axis written with three digits, as 0.707 0.707 0, counts as a unit vector.
_UNIT_TOLERANCE = 1e-3
# Beyond this factor no solver knows the direction any more.
_EXTREME = 1e6
# Joints that mimic each other in a row: nobody builds more, and a made-up file may.
_LONGEST_CHAIN = 100


def limits_are_ordered(subject: Subject) -> Iterator[Finding]:
    """The lower limit of a joint that has limits is below the upper one."""
    for joint in subject.robot.joints:
        if joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC) or joint.limit is None:
            continue
        lower, upper = joint.limit.lower, joint.limit.upper
        found = f'lower {lower:g}, upper {upper:g}'
        if lower > upper:
            yield subject.error(
                joint.line,
                f'joint {quote(joint.name)}: the lower limit is above the upper one',
                found=found,
                fix='swap them',
            )
        elif lower == upper:
            yield subject.warning(
                joint.line,
                f'joint {quote(joint.name)} cannot move',
                found=found,
                expected='a lower limit below the upper one',
                fix='give its range, or make it type="fixed"',
            )


def limits_let_it_move(subject: Subject) -> Iterator[Finding]:
    """Limits of effort and velocity are above 0."""
    for joint in subject.robot.joints:
        if joint.limit is None or not joint.is_moving:
            continue
        for name in ('effort', 'velocity'):
            value = getattr(joint.limit, name)
            if value <= 0.0:
                judge = subject.error if value < 0.0 else subject.warning
                yield judge(
                    joint.line,
                    f'joint {quote(joint.name)}: the {name} limit leaves nothing to move it with',
                    found=f'{value:g}',
                    expected='a number above 0',
                )


def damping_takes_energy(subject: Subject) -> Iterator[Finding]:
    """Damping and friction are not negative: such a joint would drive itself."""
    for joint in subject.robot.joints:
        for name in ('damping', 'friction') if joint.dynamics is not None else ():
            value = getattr(joint.dynamics, name)
            if value < 0.0:
                yield subject.error(
                    joint.line,
                    f'joint {quote(joint.name)}: {name}',
                    found=f'{value:g}',
                    expected='0 or more',
                )


def axis_is_a_unit_vector(subject: Subject) -> Iterator[Finding]:
    """The axis is written with length 1: programs differ in what they make of another."""
    for element in subject.xml.iterchildren('joint'):
        axis = element.find('axis')
        kind = element.get('type')
        if axis is None or kind in (JointType.FIXED, JointType.FLOATING):
            continue
        length = _length(axis.get('xyz', '1 0 0'))
        if 0.0 < length < math.inf and abs(length - 1.0) > _UNIT_TOLERANCE:
            parts = (float(part) / length for part in axis.get('xyz', '').split())
            judge = subject.warning if 1.0 / _EXTREME < length < _EXTREME else subject.error
            yield judge(
                line_of(axis),
                f'joint {quote(element.get("name", ""))}: the axis is no unit vector',
                found=f'length {length:.4g}',
                expected='1',
                fix=f'write <axis xyz="{" ".join(f"{part:.6g}" for part in parts)}"/>',
            )


def _length(text: str) -> float:
    """Return the length of the vector that a text writes, NaN when it writes none."""
    words = text.split()
    try:
        return math.hypot(*map(float, words)) if len(words) == 3 else math.nan
    except ValueError:
        return math.nan


def mimicked_joint_exists(subject: Subject) -> Iterator[Finding]:
    """A mimic joint follows another joint of the robot, one that moves and is no mimic itself."""
    robot = subject.robot
    known = quote_all([joint.name for joint in robot.joints])
    for joint in robot.joints:
        source = '' if joint.mimic is None else joint.mimic.joint
        if source and (source == joint.name or not robot.has_joint(source)):
            yield subject.error(
                joint.line,
                f'joint {quote(joint.name)} mimics a joint that is not there',
                found='itself' if source == joint.name else quote(source),
                expected=f'another one of {known}',
            )
        elif source:
            yield from _judge_source(subject, joint, robot.joint(source))


def _judge_source(subject: Subject, joint: Joint, source: Joint) -> Iterator[Finding]:
    """Judge a joint that is followed and exists."""
    name = f'joint {quote(joint.name)}'
    if not (source.has_position and joint.has_position):
        odd = joint if source.has_position else source
        yield subject.error(
            joint.line,
            f'{name} cannot mimic {quote(source.name)}',
            found=f'{quote(odd.name)} of type {odd.type}',
            expected='two joints of type revolute, continuous or prismatic',
        )
    elif source.mimic is not None:
        end = _end_of_chain(subject.robot, joint)
        yield subject.warning(
            joint.line,
            f'{name} mimics {quote(source.name)}, which is a mimic itself',
            expected='one step, as programs take it',
            fix=f'mimic {quote(end)}' if end else 'mimic a joint that is none',
        )


def _end_of_chain(robot: Robot, joint: Joint) -> str:
    """Return the joint at the end of a chain of mimics; '' when it has none."""
    seen: set[str] = set()
    while joint.mimic is not None and joint.name not in seen and len(seen) < _LONGEST_CHAIN:
        seen.add(joint.name)
        if not robot.has_joint(joint.mimic.joint):
            return ''
        joint = robot.joint(joint.mimic.joint)
    return '' if joint.mimic is not None else joint.name
