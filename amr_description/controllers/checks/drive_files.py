# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The differential drives of parameter files, with the lines on which their parameters stand.

As for a node, the last of several sections that set a parameter counts.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from amr_description.ament_index import parameter_path
from amr_description.controllers.checks.parameter_faults import (
    controller_parameters,
    ControllerParameters,
    errors_of,
    MANAGER,
    manager_faults,
    type_fault,
)
from amr_description.controllers.checks.parameter_sections import (
    listed_controllers,
    LocatedSection,
    read_sections,
)
from amr_description.controllers.checks.wheeled_drive_files import (
    plugin_findings,
    wheeled_drive_findings,
)
from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
from amr_description.errors import AmrError, ParameterError
from amr_description.model.checks import examine_drives
from amr_description.model.checks.context import DriveSettings
from amr_description.model.findings import Finding, Severity, SourceLocation
from amr_description.model.gazebo.builder import PluginController
from amr_description.model.gazebo.tags import GazeboPlugin, read_gazebo_plugins
from amr_description.model.gazebo.translation import translate
from amr_description.model.origins import relocated
from amr_description.model.robot import Robot
from amr_description.model.urdf import parse, read_robot
from amr_description.model.xml_reader import parse_xml
from amr_description.parameter_files import KEY
from amr_description.parameters import build
from amr_description.text import quote, quote_all

DIFF_DRIVE = 'diff_drive_controller/DiffDriveController'


@dataclass(frozen=True, slots=True)
class DriveExamination:
    """The differential drives of parameter files as far as they are sound, and the faults."""

    drives: tuple[DriveSettings, ...]
    faults: tuple[Finding, ...]
    controllers: tuple[str, ...] = ()
    """The names of all controllers, of whatever type."""


def examine_drive_files(
    paths: Sequence[str], managers: Sequence[str] = (MANAGER,)
) -> DriveExamination:
    """
    Return the differential drives of parameter files, and everything that is wrong in these.

    Later files override earlier ones; the files that ``params_file`` of a controller names are
    read too.

    Args:
        paths: of the files.
        managers: the names that the robot gives its controller managers.

    Raises:
        ParameterError: a file cannot be read.
    """
    found = read_sections(paths)
    listed = listed_controllers(found)
    nodes = _manager_nodes(found, managers)
    faults = [fault for node in nodes for fault in manager_faults(found, node)]
    names = tuple(each.name for each in listed)
    if not listed:
        faults += [_no_controllers(each) for each in found if each.name in managers]
    drives = []
    for each in listed:
        kind, fault = type_fault(each.name, each.type, each.location)
        faults += [fault] if fault is not None else []
        read = controller_parameters(found, each.node, kind, each.location)
        faults += read.faults + read.readings
        if kind == DIFF_DRIVE and read.is_sound:
            drives.append(_settings(each.name, read, names))
    return DriveExamination(tuple(drives), tuple(dict.fromkeys(faults)), names)


def read_drives(*paths: str) -> tuple[DriveSettings, ...]:
    """
    Return the settings of every diff_drive_controller of some parameter files.

    Raises:
        ParameterError: as :func:`examine_drive_files`, or none of the files names such a
            controller, or it would reject a value.
    """
    examination = examine_drive_files(paths)
    errors = errors_of(examination.faults)
    if errors:
        raise ParameterError(errors[0].text)
    if not examination.drives:
        raise ParameterError(no_drive(paths))
    return examination.drives


def no_drive(paths: Sequence[str]) -> str:
    """Return the message that no controller of some files is a differential drive."""
    types = list(dict.fromkeys(each.type for each in listed_controllers(read_sections(paths))))
    others = f', but {quote_all(types)}' if types else ''
    return (
        f"parameter file '{', '.join(paths)}' names no controller of type {DIFF_DRIVE}{others}; "
        f'it is written as  controller_manager: {{{KEY}: {{NAME: {{type: {DIFF_DRIVE}}}}}}}'
    )


def drive_warnings(robot: Robot, paths: Sequence[str]) -> tuple[Finding, ...]:
    """
    Return what is wrong with the wheeled drives of parameter files on a sound robot.

    Errors that keep a controller from running are left to the manager, which finds them when it
    loads the controller; wheels that turn about the wrong axle do not keep it from running. Drives
    with wheels of another robot are skipped.

    Args:
        robot: the robot.
        paths: of the parameter files.
    """
    try:
        found = examine_drives(robot, drives_of(robot, paths))
    except ParameterError:
        return ()
    return tuple(
        relocated(each, robot.text) if each.source == robot.source else each
        for each in (*found, *wheeled_drive_findings(robot, paths))
        if each.severity is Severity.WARNING or each.source == robot.source
    )


def plugin_warnings(robot: Robot, plugins: Sequence[PluginController]) -> tuple[Finding, ...]:
    """
    Return what is wrong with the wheeled drives that stand for plugins of Gazebo.

    Args:
        robot: the robot, sound.
        plugins: the controllers that stand for its plugins.
    """
    found = examine_drives(robot, _plugin_drives(robot.source, plugins))
    return tuple(
        relocated(each, robot.text) for each in (*found, *plugin_findings(robot, plugins))
    )


def _plugin_drives(source: str, plugins: Sequence[PluginController]) -> tuple[DriveSettings, ...]:
    """Return the settings of the differential drives that stand for plugins of Gazebo."""
    return tuple(
        DriveSettings(
            name=each.name,
            location=SourceLocation(source, each.line),
            left_wheels=tuple(each.parameters['left_wheel_names']),
            right_wheels=tuple(each.parameters['right_wheel_names']),
            separation=each.parameters['wheel_separation'],
            radius=each.parameters['wheel_radius'],
            separation_multiplier=1.0,
            base_frame='',
            odom_frame='',
            publishes_transform=False,
            position_feedback=True,
            open_loop=False,
            tags=each.tags,
            locations={name: SourceLocation(source, tag.line) for name, tag in each.tags.items()},
        )
        for each in plugins
        if 'left_wheel_names' in each.parameters and each.tags
    )


def plugins_in(text: str, source: str) -> DriveExamination:
    """
    Return the differential drives of a URDF's plugins, and what is wrong with its other ones.

    The faults of the URDF are left to the checker: with any there are none of these.
    """
    try:
        robot = parse(text, source)
        translated = translate(robot)
    except AmrError:
        return DriveExamination((), ())
    plugins = translated.controllers
    faults = [Finding.warning(source, line, note) for line, note in translated.faults]
    return DriveExamination(
        _plugin_drives(source, plugins), (*faults, *plugin_findings(robot, plugins))
    )


def drives_of(robot: Robot, paths: Sequence[str]) -> tuple[DriveSettings, ...]:
    """
    Return the drives of parameter files whose wheels are joints of a robot.

    Raises:
        ParameterError: as :func:`examine_drive_files`.
    """
    drives = examine_drive_files(paths).drives
    return tuple(drive for drive in drives if all(map(robot.has_joint, drive.wheels)))


def drives_named_by(text: str, source: str) -> DriveExamination:
    """
    Return the drives of the parameter files that a URDF names for its ros2_control plugin.

    Files that are not there are left out, and the faults of the URDF to the checker. What is wrong
    in the files is a warning: it is no fault of the description.

    Args:
        text: the URDF.
        source: names its file in messages.

    Raises:
        ParameterError: as :func:`examine_drive_files`.
    """
    faults: list[Finding] = []
    xml = parse_xml(text, source, faults.append)
    if xml is None:
        return DriveExamination((), ())
    robot = read_robot(xml, text, source, faults.append)
    found = examine_drive_files(named_files(text, source), manager_names(text, source))
    return DriveExamination(
        tuple(drive for drive in found.drives if all(map(robot.has_joint, drive.wheels))),
        tuple(replace(each, severity=Severity.WARNING) for each in found.faults),
    )


def named_files(text: str, source: str) -> list[str]:
    """Return the paths of the parameter files that a URDF names and that are there."""
    hosts = _hosts(text, source)
    return [path for each in hosts for path in files_of(each.parameters, source)]


def manager_names(text: str, source: str) -> list[str]:
    """Return the names that a URDF gives its controller managers, and the usual one."""
    names = (each.controller_manager_name for each in _hosts(text, source))
    return list(dict.fromkeys((MANAGER, *names)))


def _hosts(text: str, source: str) -> list[GazeboPlugin]:
    """Return the plugins of a URDF, sound or not, that host ros2_control."""
    faults: list[Finding] = []
    xml = parse_xml(text, source, faults.append)
    plugins = () if xml is None else read_gazebo_plugins(xml, source, faults.append)
    return [each for each in plugins if each.hosts_ros2_control]


def files_of(parameters: Sequence[str], source: str) -> list[str]:
    """Return the paths of the files that are there, of those in ``<parameters>`` of a URDF."""
    paths = []
    for written in dict.fromkeys(parameters):
        try:
            path = parameter_path(written, Path(source).parent)
        except AmrError:  # of a package that is not installed
            continue
        paths += [str(path)] if path.is_file() else []
    return paths


def _no_controllers(section: LocatedSection) -> Finding:
    """Return the warning about the section of a manager that gives no controller its type."""
    return Finding.warning(
        *section.location,
        f'the section {quote(section.label)} names no controller, so none can be spawned',
        fix=f'add NAME: {{type: joint_state_broadcaster/JointStateBroadcaster}} below its {KEY}',
    )


def _manager_nodes(found: Sequence[LocatedSection], managers: Sequence[str]) -> list[str]:
    """Return the nodes that the sections of managers are for; without any, where they would be."""
    nodes = (each.node for each in found if each.name in managers)
    named = [f'/{node.rpartition("/")[2]}' if '*' in node else node for node in nodes]
    return list(dict.fromkeys(named or (f'/{name}' for name in managers)))


def _settings(
    name: str, read: ControllerParameters, controllers: Collection[str]
) -> DriveSettings:
    """Return the settings of a drive; a wheel behind one of ``controllers`` by its joint."""

    def joints(wheels: Sequence[str]) -> tuple[str, ...]:
        split = ((wheel, *wheel.partition('/')) for wheel in wheels)
        return tuple(below if above in controllers else all_ for all_, above, _, below in split)

    drive = build(DiffDriveParameters, read.values)
    return DriveSettings(
        name=name,
        location=read.location,
        left_radius_multiplier=drive.left_wheel_radius_multiplier,
        right_radius_multiplier=drive.right_wheel_radius_multiplier,
        left_wheels=joints(drive.left_wheel_names),
        right_wheels=joints(drive.right_wheel_names),
        separation=drive.wheel_separation,
        radius=drive.wheel_radius,
        separation_multiplier=drive.wheel_separation_multiplier,
        base_frame=drive.base_frame_id,
        odom_frame=drive.odom_frame_id,
        publishes_transform=drive.enable_odom_tf,
        position_feedback=drive.position_feedback,
        open_loop=drive.open_loop,
        locations=read.locations,
    )
