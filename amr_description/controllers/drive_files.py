# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The differential drives of parameter files, with the lines on which their parameters stand.

As for a node, the last of several sections that set a parameter counts.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
import re
from typing import Any

import yaml

from amr_description.controllers.diff_drive_parameters import DiffDriveParameters
from amr_description.errors import ParameterError
from amr_description.model.checks import examine_drives
from amr_description.model.checks.context import DriveSettings, SourceLocation
from amr_description.model.findings import Finding, Severity
from amr_description.model.gazebo import read_gazebo_plugins
from amr_description.model.robot import Robot
from amr_description.model.urdf import read_robot
from amr_description.model.xml_reader import parse_xml
from amr_description.parameter_files import (
    dotted,
    flatten,
    KEY,
    read_parameter_file,
    Section,
    sections,
)
from amr_description.parameters import build

DIFF_DRIVE = 'diff_drive_controller/DiffDriveController'
_TYPE = '.type'
# Nodes, and parameters of one: aliases can make a short file mean any number of them.
_MOST = 10_000


@dataclass(frozen=True, slots=True)
class _Section:
    """A section with the values of its parameters, and where they stand, by dotted name."""

    section: Section
    location: SourceLocation
    values: dict[str, Any]
    locations: dict[str, SourceLocation]

    @property
    def node(self) -> str:
        """The full name of the node, perhaps with wildcards."""
        return self.section.pattern


def read_drives(*paths: str) -> tuple[DriveSettings, ...]:
    """
    Return the settings of every diff_drive_controller of some parameter files.

    Later files override earlier ones; the files that ``params_file`` of a controller names are
    read too.

    Raises:
        ParameterError: a file cannot be read, none names such a controller, or the controller
            would reject a value.
    """
    drives = _drives(paths)
    if not drives:
        raise ParameterError(
            f"parameter file '{', '.join(paths)}' names no controller of type {DIFF_DRIVE}; it is "
            f'written as  controller_manager: {{{KEY}: {{NAME: {{type: {DIFF_DRIVE}}}}}}}'
        )
    return drives


def drive_warnings(robot: Robot, paths: Sequence[str]) -> tuple[Finding, ...]:
    """
    Return what is wrong with the differential drives of parameter files on a sound robot.

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
        each for each in found if each.severity is Severity.WARNING or each.source == robot.source
    )


def drives_of(robot: Robot, paths: Sequence[str]) -> tuple[DriveSettings, ...]:
    """
    Return the drives of parameter files whose wheels are joints of a robot.

    Raises:
        ParameterError: as :func:`read_drives`, but not where no such controller is named.
    """
    return tuple(drive for drive in _drives(paths) if all(map(robot.has_joint, drive.wheels)))


def drives_named_by(text: str, source: str) -> tuple[DriveSettings, ...]:
    """
    Return the drives of the parameter files that a URDF names for its ros2_control plugin.

    Files that are not there are left out, and the faults of the URDF to the checker.

    Args:
        text: the URDF.
        source: names its file in messages.

    Raises:
        ParameterError: as :func:`drives_of`.
    """
    faults: list[Finding] = []
    xml = parse_xml(text, source, faults.append)
    if xml is None:
        return ()
    plugins = read_gazebo_plugins(xml, source, faults.append)
    paths = [path for each in plugins if each.hosts_ros2_control for path in each.parameters]
    there = [path for path in dict.fromkeys(paths) if Path(path).is_file()]
    return drives_of(read_robot(xml, text, source, faults.append), there) if there else ()


def _drives(paths: Sequence[str]) -> tuple[DriveSettings, ...]:
    """Return the drives of parameter files, perhaps none. Raises ParameterError."""
    found = [each for path in paths for each in _read(path)]
    found += [each for path in _further_files(found) for each in _read(path)]
    return tuple(_settings(node, found) for node in dict.fromkeys(_drive_nodes(found)))


def _read(path: str) -> list[_Section]:
    content = read_parameter_file(Path(path))
    tree = yaml.compose(Path(path).read_text(encoding='utf-8'), Loader=yaml.SafeLoader)
    try:
        return [_located(each, tree, path) for each in islice(sections(content), _MOST)]
    except RecursionError:  # an anchor that holds itself
        raise ParameterError(f"parameter file '{path}': nested too deeply") from None


def _further_files(found: list[_Section]) -> Iterator[str]:
    """Yield the files that a manager hands to its differential drives."""
    for each in found:
        for name, value in each.values.items():
            files = each.values.get(f'{name.removesuffix(_TYPE)}.params_file')
            if name.endswith(_TYPE) and value == DIFF_DRIVE:
                names = files if isinstance(files, list) else [files]
                yield from (file for file in names if isinstance(file, str))


def _drive_nodes(found: list[_Section]) -> Iterator[str]:
    """Yield the full names of the controllers that the sections give that type."""
    for each in found:
        if each.values.get('type') == DIFF_DRIVE and '*' not in each.node:
            yield each.node
        for name, value in each.values.items():
            if name.endswith(_TYPE) and value == DIFF_DRIVE:
                namespace = each.node.rpartition('/')[0]
                yield f'{"" if "*" in namespace else namespace}/{name.removesuffix(_TYPE)}'


def _settings(node: str, found: list[_Section]) -> DriveSettings:
    values: dict[str, Any] = {}
    locations: dict[str, SourceLocation] = {}
    mine = [each for each in found if each.section.is_of(node)]
    for each in mine:
        values |= each.values
        locations |= each.locations
    name = node.rpartition('/')[2]
    own = [each.location for each in mine if each.node.rpartition('/')[2] == name]
    location = own[-1] if own else found[0].location
    try:
        drive = build(DiffDriveParameters, values)
    except ParameterError as error:
        match = re.search(r"parameter '([^']+)'", str(error))
        source, line = locations.get(match[1], location) if match else location
        raise ParameterError(f'{source}:{line}: {name}: {error}') from error
    return DriveSettings(
        name=name,
        location=location,
        left_wheels=drive.left_wheel_names,
        right_wheels=drive.right_wheel_names,
        separation=drive.wheel_separation,
        radius=drive.wheel_radius,
        separation_multiplier=drive.wheel_separation_multiplier,
        base_frame=drive.base_frame_id,
        odom_frame=drive.odom_frame_id,
        publishes_transform=drive.enable_odom_tf,
        position_feedback=drive.position_feedback,
        open_loop=drive.open_loop,
        locations=locations,
    )


def _located(section: Section, tree: yaml.Node, path: str) -> _Section:
    line, below = _find(tree, section.keys)
    values, locations = {}, {}
    if isinstance(section.parameters, dict):
        _, below = _find(below, (KEY,))
        for keys, value in islice(flatten(section.parameters), _MOST):
            values[dotted(keys)] = value
            locations[dotted(keys)] = SourceLocation(path, _find(below, keys)[0])
    return _Section(section, SourceLocation(path, line), values, locations)


def _find(tree: yaml.Node, keys: tuple[Any, ...]) -> tuple[int, yaml.Node]:
    """Return the line of the innermost key, and the node below it."""
    line = tree.start_mark.line + 1
    for key in keys:
        line, tree = _entry(tree, key)
    return line, tree


def _entry(tree: yaml.Node, key: Any) -> tuple[int, yaml.Node]:
    """Return the line of a key and the node below it; of what is merged in, that of the whole."""
    if isinstance(tree, yaml.MappingNode):
        for name, below in tree.value:
            if name.value == str(key):
                return name.start_mark.line + 1, below
    return tree.start_mark.line + 1, tree
