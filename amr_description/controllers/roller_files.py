# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The wheels with rollers that the controllers of parameter files drive.

A mecanum drive or omni wheel controller has no use for other wheels: those that it names have
rollers, whether or not the description tells of them.
"""

from collections.abc import Iterator, Sequence
import math

from amr_description.controllers.parameter_faults import controller_parameters, type_here
from amr_description.controllers.parameter_sections import listed_controllers, read_sections
from amr_description.errors import ParameterError
from amr_description.model.gazebo_builder import GazeboTranslation
from amr_description.model.gazebo_drives import CORNERS, MECANUM
from amr_description.model.robot import Robot
from amr_description.model.rollers import Rollers
from amr_description.parameters import build

MECANUM_DRIVE = 'mecanum_drive_controller/MecanumDriveController'
OMNI_WHEEL_DRIVE = 'omni_wheel_drive_controller/OmniWheelDriveController'

_EIGHTH = math.pi / 4.0
_SIGNS = (-1.0, 1.0, -1.0, 1.0)
"""Of their angles: front left, front right, rear right, rear left; an X from above."""


def rollers_of_controllers(robot: Robot, paths: Sequence[str]) -> dict[str, Rollers]:
    """
    Return the rollers of wheels, by joint, as their controllers have them.

    Args:
        robot: the robot; joints that it does not have are left out.
        paths: of the parameter files; what cannot be read is left to the manager.
    """
    try:
        found = read_sections(paths)
    except ParameterError:
        return {}
    rollers: dict[str, Rollers] = {}
    for each in listed_controllers(found):
        kind = type_here(each.type)
        if kind in (MECANUM_DRIVE, OMNI_WHEEL_DRIVE):
            read = controller_parameters(found, each.node, kind, each.location)
            if read.is_sound:
                rollers.update(_rollers(kind, read.values))
    return {joint: each for joint, each in rollers.items() if robot.has_joint(joint)}


def mecanum_rollers(joints: Sequence[str]) -> dict[str, Rollers]:
    """Return the rollers of four wheels: front left, front right, rear right, rear left."""
    return {joint: Rollers(sign * _EIGHTH) for joint, sign in zip(joints, _SIGNS, strict=True)}


def _rollers(kind: str, values: dict[str, object]) -> Iterator[tuple[str, Rollers]]:
    if kind == MECANUM_DRIVE:
        from amr_description.controllers.mecanum_drive_parameters import MecanumDriveParameters

        yield from mecanum_rollers(build(MecanumDriveParameters, values).command_joints).items()
    else:
        names = values.get('wheel_names')
        for joint in names if isinstance(names, Sequence) else ():
            yield joint, Rollers(0.0)


def rollers_of_plugins(translation: GazeboTranslation) -> dict[str, Rollers]:
    """Return the rollers of wheels, by joint, that a mecanum drive of Gazebo names."""
    found: dict[str, Rollers] = {}
    for each in translation.controllers:
        if each.type == MECANUM:
            found |= mecanum_rollers(
                [each.parameters[f'{corner}_wheel_command_joint_name'] for corner in CORNERS]
            )
    return found
