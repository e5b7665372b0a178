# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The words of a stack: :class:`Node` and :class:`Stack`, named as in launch_ros."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, KW_ONLY
from pathlib import Path
from typing import Literal

from amr_description.bringup.conditions import Condition
from amr_description.bringup.console import Level
from amr_description.errors import BringupError

type Scalar = bool | int | float | str
type ParameterValue = Scalar | Sequence[Scalar] | Mapping[str, ParameterValue]


@dataclass(frozen=True, eq=False)
class Node:
    """
    One process of a stack; each Node is its own identity, so ``start_when`` can refer to it.

    The command line is launch's: ``<prefix>/lib/<package>/<executable> <arguments> --ros-args …``.
    """

    executable: str
    _: KW_ONLY
    package: str = 'amr_description'
    name: str | None = None
    """Name of the ROS node (``-r __node:=``); None: the name the program gives itself."""
    namespace: str | None = None
    """Namespace of the ROS node (``-r __ns:=``); a leading slash is added where it lacks."""
    parameters: Sequence[Mapping[str, ParameterValue] | str | Path] = ()
    """Tables of parameters and paths of YAML files, in order: the later wins."""
    remappings: Sequence[tuple[str, str]] = ()
    """Pairs (from, to), ``-r from:=to``."""
    arguments: Sequence[object] = ()
    """What stands before ``--ros-args``."""
    start_when: Condition | None = None
    """None: at once."""
    required: bool = True
    """Whether its failure (an exit code other than 0, or a signal) stops the stack."""
    on_exit: Literal['continue', 'shutdown'] = 'continue'
    """What its end with exit code 0 means to the rest of the stack."""
    terminal: bool = False
    """Whether it reads keys: it gets the terminal itself (see terminal.py); one of a stack may."""


@dataclass(frozen=True)
class Stack:
    """What to start, in which order, and when it is ready."""

    nodes: Sequence[Node]
    _: KW_ONLY
    ready_when: Condition | None = None
    """None: once every node was started."""
    next_steps: str = ''
    """Printed after ``ready in … s: ``; what a person would type next."""
    notes: Sequence[tuple[Level, str]] = ()
    """Said before the first node starts; see :func:`file_notes.notes_on`."""

    def __post_init__(self) -> None:
        """Refuse a stack that could not run as it is written."""
        if not self.nodes:
            raise BringupError('a stack needs at least one node')
        if len(set(self.nodes)) < len(self.nodes):
            twice = next(n for n in self.nodes if list(self.nodes).count(n) > 1)
            raise BringupError(
                f"the same Node('{twice.executable}') stands twice in the stack; "
                'make a second Node'
            )
        with_terminal = [node.executable for node in self.nodes if node.terminal]
        if len(with_terminal) > 1:
            raise BringupError(
                f'{" and ".join(with_terminal)} want the terminal, which one node can have'
            )
        conditions = [node.start_when for node in self.nodes] + [self.ready_when]
        for condition in filter(None, conditions):
            for node in condition.nodes:
                if node not in self.nodes:
                    raise BringupError(
                        f"a condition waits for Node('{node.executable}'), "
                        'which is not in the list of the stack'
                    )
