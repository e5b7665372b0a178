# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on joints, one by one."""

from collections.abc import Iterator

from amr_description.model.findings import Finding, quote, quote_all
from amr_description.model.robot import JointType
from amr_description.model.subject import Subject


def limits_are_ordered(subject: Subject) -> Iterator[Finding]:
    """The lower limit of a joint that has limits is not above the upper one."""
    for joint in subject.robot.joints:
        limited = joint.type in (JointType.REVOLUTE, JointType.PRISMATIC)
        if limited and joint.limit is not None and joint.limit.lower > joint.limit.upper:
            yield subject.error(
                joint.line,
                f'joint {quote(joint.name)}: the lower limit is above the upper one',
                found=f'lower {joint.limit.lower:g}, upper {joint.limit.upper:g}',
                fix='swap them',
            )


def mimicked_joint_exists(subject: Subject) -> Iterator[Finding]:
    """A mimic joint follows another joint of the robot."""
    names = [joint.name for joint in subject.robot.joints]
    known = set(names)
    for joint in subject.robot.joints:
        if joint.mimic is None or not joint.mimic.joint:
            continue
        if joint.mimic.joint not in known - {joint.name}:
            others = [name for name in names if name != joint.name]
            yield subject.error(
                joint.line,
                f'joint {quote(joint.name)} mimics a joint that is not there',
                found=quote(joint.mimic.joint),
                expected=f'one of {quote_all(others)}',
            )
