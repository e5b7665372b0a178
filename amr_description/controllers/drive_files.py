# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The differential drives of parameter files, with the lines on which their parameters stand.

What belongs to a node is found as rcl finds it: under its full name, in a namespace of its own or
by nesting, and under the wildcards ``*`` (one part of a name) and ``**`` (any); where a parameter
is set more than once, the last counts.
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
from amr_description.model.checks import examine
from amr_description.model.checks.context import CheckInputs, DriveSettings, SourceLocation
from amr_description.model.findings import Finding
from amr_description.model.robot import Robot
from amr_description.parameter_files import read_parameter_file
from amr_description.parameters import build

DIFF_DRIVE = 'diff_drive_controller/DiffDriveController'
_PARAMETERS = 'ros__parameters'
_TYPE = '.type'
# Nodes, and parameters of one: aliases can make a short file mean any number of them.
_MOST = 10_000


@dataclass(frozen=True, slots=True)
class _Block:
    """The parameters below one ``ros__parameters``, by dotted name; wildcards in ``node``."""

    node: str
    place: SourceLocation
    values: dict[str, Any]
    places: dict[str, SourceLocation]

    def is_of(self, node: str) -> bool:
        """Tell whether this block speaks of a node, given by its full name."""
        pattern = re.escape(self.node).replace(r'/\*\*', '(/.+)?').replace(r'\*', '[^/]+')
        return self.node == '/**' or re.fullmatch(pattern, node) is not None


def read_drives(*paths: str) -> tuple[DriveSettings, ...]:
    """
    Return the settings of every diff_drive_controller of some parameter files, read one over the
    other, with the files that ``params_file`` of a controller names.

    ParameterError when a file cannot be read, none names such a controller, or one holds a value
    that the controller would refuse.
    """
    blocks = [block for path in paths for block in _read(path)]
    blocks += [block for path in _further_files(blocks) for block in _read(path)]
    nodes = list(dict.fromkeys(_drive_nodes(blocks)))
    if not nodes:
        raise ParameterError(
            f"parameter file '{', '.join(paths)}' names no controller of type {DIFF_DRIVE}; it is "
            f'written as  controller_manager: {{{_PARAMETERS}: {{NAME: {{type: {DIFF_DRIVE}}}}}}}'
        )
    return tuple(_settings(node, blocks) for node in nodes)


def drive_warnings(robot: Robot, paths: Sequence[str]) -> tuple[Finding, ...]:
    """
    Return in what the differential drives of parameter files are mistaken about a sound robot.

    What keeps a controller from running is not told here: the manager does, when it is loaded.
    Nor is a drive for the wheels of another robot.
    """
    try:
        drives = read_drives(*paths)
    except ParameterError:
        return ()
    mine = tuple(
        drive
        for drive in drives
        if all(map(robot.has_joint, (*drive.left_wheels, *drive.right_wheels)))
    )
    found = examine(robot.text, robot.source, CheckInputs(drives=mine)).warnings
    return tuple(finding for finding in found if finding.source != robot.source)


def _read(path: str) -> list[_Block]:
    content = read_parameter_file(Path(path))
    text = Path(path).read_text(encoding='utf-8')
    tree = yaml.compose(text, Loader=yaml.SafeLoader)
    try:
        return list(islice(_blocks(content, tree, path, ''), _MOST))
    except RecursionError:  # an anchor that holds itself
        raise ParameterError(f"parameter file '{path}': nested too deeply") from None


def _further_files(blocks: list[_Block]) -> Iterator[str]:
    """Yield the files that a manager hands to its differential drives."""
    for block in blocks:
        for name, value in block.values.items():
            files = block.values.get(f'{name.removesuffix(_TYPE)}.params_file')
            if name.endswith(_TYPE) and value == DIFF_DRIVE:
                names = files if isinstance(files, list) else [files]
                yield from (file for file in names if isinstance(file, str))


def _drive_nodes(blocks: list[_Block]) -> Iterator[str]:
    """Yield the full names of the controllers that the blocks give that type."""
    for block in blocks:
        if block.values.get('type') == DIFF_DRIVE and '*' not in block.node:
            yield block.node
        for name, value in block.values.items():
            if name.endswith(_TYPE) and value == DIFF_DRIVE:
                namespace = block.node.rpartition('/')[0]
                yield f'{"" if "*" in namespace else namespace}/{name.removesuffix(_TYPE)}'


def _settings(node: str, blocks: list[_Block]) -> DriveSettings:
    values: dict[str, Any] = {}
    places: dict[str, SourceLocation] = {}
    mine = [block for block in blocks if block.is_of(node)]
    for block in mine:
        values |= block.values
        places |= block.places
    name = node.rpartition('/')[2]
    own = [block.place for block in mine if block.node.rpartition('/')[2] == name]
    place = own[-1] if own else blocks[0].place
    try:
        drive = build(DiffDriveParameters, values)
    except ParameterError as error:
        match = re.search(r"parameter '([^']+)'", str(error))
        source, line = places.get(match[1], place) if match else place
        raise ParameterError(f'{source}:{line}: {name}: {error}') from error
    return DriveSettings(
        name=name,
        place=place,
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
        places=places,
    )


def _blocks(content: dict, tree: yaml.Node, path: str, above: str) -> Iterator[_Block]:
    for key, value in content.items():
        line, below = _entry(tree, key)
        name = f'{above}/{str(key).strip("/")}'
        if _PARAMETERS not in value:
            yield from _blocks(value, below, path, name)
            continue
        _, tree_below = _entry(below, _PARAMETERS)
        values, places = {}, {}
        parameters = _flatten(value[_PARAMETERS], tree_below, '')
        for parameter, (number, item) in islice(parameters, _MOST):
            values[parameter], places[parameter] = item, SourceLocation(path, number)
        yield _Block(name, SourceLocation(path, line), values, places)


def _flatten(content: Any, tree: yaml.Node, prefix: str) -> Iterator[tuple[str, tuple[int, Any]]]:
    """Yield the dotted name, line and value of every parameter."""
    for key, value in content.items() if isinstance(content, dict) else ():
        line, below = _entry(tree, key)
        if isinstance(value, dict):
            yield from _flatten(value, below, f'{prefix}{key}.')
        else:
            yield f'{prefix}{key}', (line, value)


def _entry(tree: yaml.Node, key: Any) -> tuple[int, yaml.Node]:
    """Return the line of a key and the node below it; of what is merged in, that of the whole."""
    if isinstance(tree, yaml.MappingNode):
        for name, below in tree.value:
            if name.value == str(key):
                return name.start_mark.line + 1, below
    return tree.start_mark.line + 1, tree
