# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ROS arguments of the manager of a simulated robot: above all its parameter files."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from amr_description.controllers.checks.drive_files import drive_warnings, plugin_warnings
from amr_description.controllers.checks.wheeled_drive_files import (
    rollers_of_controllers,
    rollers_of_plugins,
)
from amr_description.log import Log, Severity
from amr_description.model.controller_files import files_of, missing_files, named_files
from amr_description.model.gazebo.builder import CLAIMED_JOINTS, GazeboTranslation
from amr_description.model.gazebo.tags import ros2_control_host_of
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.wheels import Rollers
from amr_description.parameter_files import file_names, read_parameter_file
from amr_description.text import quote_all


def manager_arguments(
    robot: Robot,
    namespace: str,
    translation: GazeboTranslation,
    *,
    controllers: str,
    ros_args: Sequence[str],
    log: Log,
) -> list[str]:
    """
    Return the ROS arguments of a robot's manager.

    Args:
        robot: Its description.
        namespace: Of the manager.
        translation: What stands for plugins of Gazebo.
        controllers: Paths of the parameter files, between commas, or empty.
        ros_args: ROS arguments for every manager and controller.
        log: Of the simulator.

    Raises:
        ParameterError: A parameter file cannot be read.
    """
    for finding in plugin_warnings(robot, translation.controllers):
        log(Severity.WARN, finding.text)
    host = ros2_control_host_of(robot)
    rules = [word for rule in host.remappings for word in ('-r', rule)]
    arguments = [*ros_args, *rules]
    if namespace.strip('/'):  # several managers publish on one /diagnostics
        arguments += ['-p', 'diagnostic_updater.use_fqn:=true']
    if controllers or reads_files(robot):
        arguments += _parameter_files(robot, controllers, log)
    else:  # Gazebo's plugins are all that it has
        arguments += ['-p', f'update_rate:={translation.update_rate}']
    return arguments


def reads_files(robot: Robot) -> bool:
    """
    Return whether the manager of a robot reads parameter files that it names.

    It does not where plugins of Gazebo are all that it has.
    """
    return len(hardware_of(robot)) > len(robot.plugin_hardware) or any(
        each.name == CLAIMED_JOINTS for each in robot.plugin_hardware
    )


def rollers_of(
    robot: Robot, translation: GazeboTranslation, controllers: str
) -> Mapping[str, Rollers]:
    """Return the rollers of wheels of which only the parameters of a controller tell."""
    paths = file_names(controllers) or [str(path) for path in files_of(robot)]
    return rollers_of_controllers(robot, paths) | rollers_of_plugins(translation)


def _parameter_files(robot: Robot, controllers: str, log: Log) -> Sequence[str]:
    """Return ``--params-file`` arguments: of the parameter, else the URDF, else shipped."""
    paths = file_names(controllers) or _files_of(robot, log)
    for path in paths:
        read_parameter_file(Path(path))  # its errors have a line number, rcl's have none
    for finding in drive_warnings(robot, paths):
        log(Severity.WARN, finding.text)
    return [argument for path in paths for argument in ('--params-file', path)]


def _files_of(robot: Robot, log: Log) -> list[str]:
    """Return the parameter files of a robot for which none is given; say if it has none."""
    found, missing = files_of(robot), missing_files(named_files(robot))
    remedy = 'is given by the parameter controllers of the simulator'
    if missing:
        used = f'{quote_all([str(path) for path in found])} is used; ' if found else ''
        why = (
            f'a parameter file that it names is not there: {quote_all(missing)}; {used}another one'
        )
        log(Severity.WARN, f'{robot.source}: {why} {remedy}')
    elif not found:
        why = 'it names no parameter file for its controllers; one'
        log(Severity.WARN, f'{robot.source}: {why} {remedy}')
    return [str(path) for path in found]
