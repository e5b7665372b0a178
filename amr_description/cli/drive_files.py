# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The differential drives of a parameter file, with the lines on which their parameters stand.

What belongs to a node is found as rcl finds it: under its full name, in a namespace of its own or
by nesting, and under the wildcards ``*`` (one part of a name) and ``**`` (any); where a parameter
is set more than once, the last counts.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
import re
from typing import Any

import yaml

from amr_description.controllers.diff_drive_parameters import DiffDriveParameters
from amr_description.errors import ParameterError
from amr_description.model.drive_settings import DriveSettings
from amr_description.nodes.parameter_files import read_parameter_file
from amr_description.parameters import build

DIFF_DRIVE = 'diff_drive_controller/DiffDriveController'
_PARAMETERS = 'ros__parameters'
_TYPE = '.type'


@dataclass(frozen=True, slots=True)
class _Block:
    """The parameters below one ``ros__parameters``, by dotted name; wildcards in ``node``."""

    node: str
    line: int
    values: dict[str, Any]
    lines: dict[str, int]

    def is_of(self, node: str) -> bool:
        """Tell whether this block speaks of a node, given by its full name."""
        pattern = re.escape(self.node).replace(r'/\*\*', '(/.+)?').replace(r'\*', '[^/]+')
        return self.node == '/**' or re.fullmatch(pattern, node) is not None


def read_drives(path: str) -> tuple[DriveSettings, ...]:
    """
    Return the settings of every diff_drive_controller of a parameter file.

    ParameterError when the file cannot be read, names no such controller, or holds a value that
    the controller would refuse.
    """
    content = read_parameter_file(Path(path))
    tree = yaml.compose(Path(path).read_text(encoding='utf-8'), Loader=yaml.SafeLoader)
    blocks = list(_blocks(content, tree, ''))
    nodes = list(dict.fromkeys(_drive_nodes(blocks)))
    if not nodes:
        raise ParameterError(
            f"parameter file '{path}' names no controller of type {DIFF_DRIVE}; it is written as  "
            f'controller_manager: {{{_PARAMETERS}: {{NAME: {{type: {DIFF_DRIVE}}}}}}}'
        )
    return tuple(_settings(path, node, blocks) for node in nodes)


def _drive_nodes(blocks: list[_Block]) -> Iterator[str]:
    """Yield the full names of the controllers that the blocks give that type."""
    for block in blocks:
        if block.values.get('type') == DIFF_DRIVE and '*' not in block.node:
            yield block.node
        for name, value in block.values.items():
            if name.endswith(_TYPE) and value == DIFF_DRIVE:
                namespace = block.node.rpartition('/')[0]
                yield f'{"" if "*" in namespace else namespace}/{name.removesuffix(_TYPE)}'


def _settings(path: str, node: str, blocks: list[_Block]) -> DriveSettings:
    values: dict[str, Any] = {}
    lines: dict[str, int] = {}
    mine = [block for block in blocks if block.is_of(node)]
    for block in mine:
        values |= block.values
        lines |= block.lines
    name = node.rpartition('/')[2]
    line = next((block.line for block in reversed(mine) if '*' not in block.node), 1)
    try:
        drive = build(DiffDriveParameters, values)
    except ParameterError as error:
        match = re.search(r"parameter '([^']+)'", str(error))
        where = lines.get(match[1], line) if match else line
        raise ParameterError(f'{path}:{where}: {name}: {error}') from error
    return DriveSettings(
        name=name,
        source=path,
        line=line,
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
        lines=lines,
    )


def _blocks(content: dict, tree: yaml.Node, above: str) -> Iterator[_Block]:
    for key, value in content.items():
        line, below = _entry(tree, key)
        name = f'{above}/{str(key).strip("/")}'
        if _PARAMETERS not in value:
            yield from _blocks(value, below, name)
            continue
        _, parameters = _entry(below, _PARAMETERS)
        values: dict[str, Any] = {}
        lines: dict[str, int] = {}
        _flatten(value[_PARAMETERS] or {}, parameters, '', values, lines)
        yield _Block(name, line, values, lines)


def _flatten(
    content: Any, tree: yaml.Node, prefix: str, values: dict[str, Any], lines: dict[str, int]
) -> None:
    if not isinstance(content, dict):
        return
    for key, value in content.items():
        line, below = _entry(tree, key)
        name = f'{prefix}{key}'
        lines[name] = line
        if isinstance(value, dict):
            _flatten(value, below, f'{name}.', values, lines)
        else:
            values[name] = value


def _entry(tree: yaml.Node, key: Any) -> tuple[int, yaml.Node]:
    """Return the line of a key and the node below it; of what is merged in, that of the whole."""
    if isinstance(tree, yaml.MappingNode):
        for name, below in tree.value:
            if name.value == str(key):
                return name.start_mark.line + 1, below
    return tree.start_mark.line + 1, tree
