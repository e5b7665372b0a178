# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A node made ready to run: what can be wrong with it is found before the first start."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
import shlex

from amr_description.bringup.description import Node, Stack
from amr_description.bringup.packages import executable_of, path_of
from amr_description.bringup.parameter_file import node_key, yaml_text
from amr_description.bringup.placement import Placed, Placement


@dataclass(frozen=True)
class Job:
    """What the orchestrator starts for one node."""

    placed: Placed
    name: str
    """``<executable>-<number in the stack, from 1>``, as on the screen."""
    executable: Path
    parameter_files: Sequence[tuple[Path, str | None]]
    """(path, text to write there before the start; None: the file is the user's)."""

    @property
    def node(self) -> Node:
        """What it is made of."""
        return self.placed.node

    @property
    def environment(self) -> Mapping[str, str]:
        """The variables that the stack gives the node."""
        return self.placed.environment

    @property
    def command(self) -> list[str]:
        """The command line, as launch builds it."""
        node = self.node
        words = [*shlex.split(node.prefix), str(self.executable), *map(str, node.arguments)]
        words.append('--ros-args')
        if node.name:
            words += ['-r', f'__node:={node.name}']
        if self.placed.namespace:
            words += ['-r', f'__ns:={self.placed.namespace}']
        for path, _ in self.parameter_files:
            words += ['--params-file', str(path)]
        for source, target in self.placed.remappings:
            words += ['-r', f'{source}:={target}']
        return words

    @property
    def command_text(self) -> str:
        """The command line as one would type it."""
        return shlex.join(self.command)

    def write_parameter_files(self) -> None:
        """Write the parameters that stand in the stack to where the command line says."""
        for path, text in self.parameter_files:
            if text is not None:
                path.write_text(text, encoding='utf-8')


def jobs_of(stack: Stack, folder: Path) -> list[Job]:
    """
    Make the nodes of a stack ready to run; starts and writes nothing.

    :param folder: Where parameters are written: the log folder, so that they stay readable and
        the printed command line can be typed again, and no temporary file is ever left over.
    :raises BringupError: A package, an executable or a parameter file is missing.
    """
    placed = Placement(stack).nodes
    return [_job(each, number, folder) for number, each in enumerate(placed, start=1)]


def _job(placed: Placed, number: int, folder: Path) -> Job:
    node = placed.node
    name = f'{node.executable}-{number}'
    files: list[tuple[Path, str | None]] = []
    for index, entry in enumerate(placed.parameters, start=1):
        if isinstance(entry, Mapping):
            path = folder / f'{name}-parameters-{index}.yaml'
            files.append((path, yaml_text(node_key(node.name, placed.namespace), entry)))
        else:
            files.append((path_of(str(entry)), None))
    return Job(placed, name, executable_of(node.package, node.executable), files)
