# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on wheels and drive."""

from collections.abc import Iterator

from amr_description.model.findings import Finding, quote_all
from amr_description.model.frames import link_poses, rotate
from amr_description.model.robot import Joint, JointType
from amr_description.model.subject import Subject

# An axle within this cosine of the robot's y axis is that of a wheel that rolls along x; others
# (a turning lidar, the wheels of an omnidirectional robot) are left alone.
_ALONG_Y = 0.9


def wheels_roll_forward(subject: Subject) -> Iterator[Finding]:
    """
    A positive speed of a wheel carries the robot to +x.

    A wheel on the ground that turns by ω about its axle moves the robot along axle × z, so the
    axle has to point to the robot's left, +y of the root at zero pose (REP 103: x forward).
    Wheels are the continuous joints with a velocity command. One finding for all wheels that
    share the fault.
    """
    poses = link_poses(subject.robot)
    backwards = [
        joint
        for joint in _velocity_commanded_joints(subject)
        if joint.child in poses and rotate(poses[joint.child].rotation, joint.axis)[1] < -_ALONG_Y
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


def _velocity_commanded_joints(subject: Subject) -> list[Joint]:
    commanded = {
        component.name
        for hardware in subject.hardware
        for component in hardware.joints
        if any(interface.name == 'velocity' for interface in component.command_interfaces)
    }
    return [
        joint
        for joint in subject.robot.joints
        if joint.name in commanded and joint.type is JointType.CONTINUOUS
    ]


def _turn_round(joints: list[Joint]) -> str:
    """Return what to write instead of the axes of these joints."""
    axes = {' '.join(f'{0.0 - part:g}' for part in joint.axis) for joint in joints}
    return f'write <axis xyz="{axes.pop()}"/>' if len(axes) == 1 else 'turn each <axis> round'
