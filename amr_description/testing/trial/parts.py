# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Controllers that stay out of a robot, and whether it lacks them.

The parameter file of a vendor is for his real robots, all of them: it lists controllers in C++
that talk to his hardware, and those of a gripper that this robot has not. A robot does without
them as long as each of its joints that they name is moved by another controller.
"""

from collections.abc import Collection, Iterable, Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from amr_description.parameter_files import read_parameter_file, sections
from amr_description.testing.trial.findings import ControllerFinding

NOT_HERE = 'its class is not here'
NO_SUCH_INTERFACES = 'its robot has not the interfaces that it needs'


def is_here(kind: str, known: Collection[str]) -> bool:
    """Return whether a type is one of those that are known, or may be one in Python of a user."""
    return kind in known or find_spec(kind.partition('/')[0].partition('.')[0]) is not None


def named_in_parameters(name: str, files: Iterable[Path]) -> frozenset[str]:
    """Return the texts in the parameters of a controller, the names of joints among them."""
    return frozenset(
        text
        for file in files
        for section in sections(read_parameter_file(file))
        if section.is_of(f'/{name}') or section.pattern.endswith(f'/{name}')
        for text in _texts(section.parameters)
    )


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for inner in value.values():
            yield from _texts(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _texts(inner)


def split(
    findings: Sequence[ControllerFinding], joints: Collection[str], moved: Collection[str]
) -> tuple[list[ControllerFinding], list[ControllerFinding]]:
    """
    Return the controllers that are not active: those that the robot lacks, and those it does not.

    Args:
        findings: Of all controllers.
        joints: Of the robot, which move.
        moved: Those that a controller has moved.
    """
    out = [each for each in findings if each.state != 'active']
    spare = [
        each
        for each in out
        if each.without and not set(each.names).intersection(joints).difference(moved)
    ]
    return [each for each in out if each not in spare], spare
