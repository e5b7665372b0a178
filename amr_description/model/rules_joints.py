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
