# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A parameter file that a robot description names, and that is not there: a tutorial's placeholder.

Meant is the file of that name in the package whose launch file runs. Without it the simulator
would take parameters of ours, and an edit of the user's file would change nothing.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

from amr_description.ament_index import OWN_PACKAGE
from amr_description.bringup.controller_files import absent_file
from amr_description.bringup.description import Node

_SIMULATOR = 'mujoco_sim'
_DESCRIPTION = 'robot_description'
_PARAMETER = 'controllers'


def use_files_of_package(nodes: Sequence[Node], launch_file: Path) -> str:
    """
    Have the simulator take the file that is meant; return what is to be said about it, or ''.

    Not where the description names one that is there, where there are several descriptions, or
    where the simulator is given a file.

    Args:
        nodes: all that are started.
        launch_file: the one that runs.
    """
    simulators = [
        node for node in nodes if (node.package, node.executable) == (OWN_PACKAGE, _SIMULATOR)
    ]
    texts = {text for node in nodes if (text := value_of(node, _DESCRIPTION))}
    if len(simulators) != 1 or len(texts) != 1 or not _has_tables_alone(simulators[0]):
        return ''
    if not (named := absent_file(texts.pop())):
        return ''
    file = next(_candidates(launch_file, Path(named).name), None)
    if file is None:
        return ''
    parameters = simulators[0].parameters
    assert isinstance(parameters, list), 'what translation makes of a node of a launch file'
    parameters.append({_PARAMETER: str(file)})
    return (
        f"the description names a parameter file that is not there, '{named}'; {file} is "
        'used in its place'
    )


def _has_tables_alone(simulator: Node) -> bool:
    """Return whether its parameters are known here, and no file for controllers is among them."""
    known = all(isinstance(each, dict) for each in simulator.parameters)
    return known and not simulator.command and not value_of(simulator, _PARAMETER)


def value_of(node: Node, name: str) -> str:
    """Return a parameter that a table gives as a text; '': none does."""
    tables = [each for each in node.parameters if isinstance(each, dict)]
    values = [table[name] for table in tables if isinstance(table.get(name), str)]
    return values[-1] if values else ''


def _candidates(launch_file: Path, name: str) -> Iterator[Path]:
    """Yield the files of that name in the package of a launch file."""
    for folder in launch_file.parents:
        if (folder / 'package.xml').is_file():
            places = (folder / 'config' / name, *sorted(folder.rglob(name)))
            yield from (path for path in places if path.is_file())
            return
