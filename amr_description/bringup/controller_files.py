# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which parameter file a stack's controllers have, where none or one is given, and whom it is for.

YAML and the URDF are read where they are needed only: a stack of the shipped robot starts at once.
"""

from pathlib import Path

from amr_description.ament_index import path_of
from amr_description.errors import DescriptionError, UsageError
from amr_description.text import one_line

URDF = 'package://amr_description/urdf/amr.urdf'
"""The robot of this package."""
URDF_WITH_SENSORS = 'package://amr_description/urdf/amr_sensors.urdf.xacro'
"""The same with a lidar, a depth camera and an IMU."""
ABOUT_SENSORS = 'whether amr has a lidar, a depth camera and an IMU'
"""The help text of a stack's ``sensors:=``."""
SHIPPED = 'package://amr_description/config/controllers.yaml'
"""The parameters of its controllers."""
_MANAGER = 'controller_manager'


def with_sensors(urdf: str, sensors: bool) -> str:
    """
    Return the description that a stack is to bring up.

    Args:
        urdf: as given.
        sensors: whether amr is to have its sensors.

    Raises:
        UsageError: sensors are asked for another robot.
    """
    if not sensors:
        return urdf
    if urdf not in (URDF, URDF_WITH_SENSORS):
        raise UsageError(
            f'sensors:=true is for amr, the robot of this package; urdf:={urdf} has the sensors '
            'of its own <gazebo> tags'
        )
    return URDF_WITH_SENSORS


def controllers_files(controllers: str, urdf: str, description: str) -> list[Path]:
    """
    Return the parameter files of the controllers of a stack: one, unless several are given.

    Args:
        controllers: as given; '': that which the URDF names for its ros2_control plugin, else the
            shipped one, if it is for this robot.
        urdf: the description as given.
        description: its text.

    Raises:
        ResourceError: there is no such file.
        UsageError: it has to be given.
    """
    if controllers:
        from amr_description.parameter_files import given_files

        return given_files(controllers, 'controllers')
    return [_file_of(urdf, description)]


def _file_of(urdf: str, description: str) -> Path:
    shipped = path_of(SHIPPED)
    if urdf == URDF:
        return shipped
    from amr_description.model.controller_files import existing_files, foreign_wheels, named_files
    from amr_description.model.urdf import parse

    try:
        robot = parse(description)
        named = named_files(robot)
    except DescriptionError:  # the node that reads it says where, and what would do
        return shipped
    found = existing_files(named)
    if found:
        return found[0]
    foreign = foreign_wheels(robot, shipped)
    if not foreign:
        return shipped
    if named:
        raise UsageError(
            f'urdf:={urdf}: the file that it names in <parameters> is not there: '
            f'{", ".join(map(one_line, named))}; write its name, or give controllers:=FILE'
        )
    raise UsageError(
        f'urdf:={urdf}: {shipped} has the controllers of amr, and this robot has no joint '
        f'{foreign[0]}; give controllers:=FILE'
    )


def absent_file(description: str) -> str:
    """Return the parameter file that a URDF names in vain; '': there is one, or none is named."""
    from amr_description.model.controller_files import existing_files, missing_files, named_files
    from amr_description.model.urdf import parse

    try:
        named = named_files(parse(description))
    except DescriptionError:  # the node that reads it says where, and what would do
        return ''
    missing = missing_files(named)
    return missing[0] if missing and not existing_files(named) else ''


def require_namespaces(file: Path, namespaces: list[str]) -> None:
    """Raise UsageError: the parameter file is for a single robot, without a namespace."""
    from amr_description.parameter_files import (
        compose,
        find_keys,
        read_parameter_file,
        sections,
    )

    found = [
        each
        for each in sections(read_parameter_file(file))
        if each.pattern.rpartition('/')[2] == _MANAGER
    ]
    managers = [f'/{namespace}/{_MANAGER}' for namespace in namespaces]
    lacking = [node for node in managers if not any(each.is_of(node) for each in found)]
    if not found or not lacking:
        return
    line, _ = find_keys(compose(file.read_text('utf-8')), found[0].keys)
    raise UsageError(
        f'{file}:{line}: the section {"/".join(map(str, found[0].keys))} is not for {lacking[0]}; '
        f'write /**/{_MANAGER}: there, and /**/ before the names of the controllers, for robots '
        'in any namespace'
    )
