# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Conditions on what is outside the stack's own processes: the ROS graph, and files.

Names without a leading slash are relative to the namespace of the group that the condition stands
in. An unmet condition names what is there instead, the most similar names first.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
import difflib
from os import PathLike
from pathlib import Path
import re

from amr_description.bringup.conditions import (
    Condition,
    NameOf,
    Scope,
    StackState,
    Verdict,
)
from amr_description.bringup.validation import require, TEXT, TOKEN, Validator
from amr_description.errors import BringupError

_NAME = re.compile(f'/?{TOKEN}(/{TOKEN})*')
_TYPE = Validator(
    'a type as std_msgs/msg/String',
    lambda value: isinstance(value, str) and bool(re.fullmatch(f'{TOKEN}/msg/{TOKEN}', value)),
)
_MAX_NAMES = 8  # in a message
# Of these device names only those that exist have a device behind them; ttyS0 … always exist.
_SERIAL_PORT = re.compile(r'tty(USB|ACM|AMA|THS)\d+|rfcomm\d+')
# Every node offers these, so they do not help to find a wrong name.
_OF_EVERY_NODE = re.compile(
    '.*/((describe|get|list|set)_(parameters|parameter_types|parameters_atomically)'
    '|get_type_description)|/rosout|/parameter_events'
)


def topic(name: str, type: str | None = None) -> Condition:  # noqa: A002 - as ROS calls it
    """
    Hold while a topic has a publisher.

    Args:
        name: the topic.
        type: its type, ``nav_msgs/msg/Odometry``; None: any.
    """
    require('topic(…, %s)', type, _TYPE.or_none())
    return _Topic(name, type)


def service(name: str) -> Condition:
    """Hold while a service is offered."""
    return _Service(name)


def ros_node(name: str) -> Condition:
    """Hold while there is a ROS node of this name, whoever started it."""
    return _RosNode(name)


def path_exists(path: str | Path) -> Condition:
    """Hold while there is a file, a folder or a device: ``path_exists('/dev/ttyUSB0')``."""
    require('path_exists(%s)', path, Validator('a path', lambda v: isinstance(v, str | PathLike)))
    return PathExists(str(Path(path).expanduser().absolute()))


@dataclass(frozen=True)
class GraphCondition(Condition):
    """A condition on the ROS graph; ``graph_watcher.py`` observes it in a process of its own."""

    name: str

    def __post_init__(self) -> None:
        """Raise BringupError unless the name is valid in ROS."""
        require('the name of a topic, a service or a node, %s', self.name, TEXT)
        if not _NAME.fullmatch(self.name):
            raise BringupError(
                f"'{self.name}' is not the name of a topic, a service or a node; "
                'one is of letters, digits, _ and /, as /robot1/odom or odom'
            )

    @property
    def is_external(self) -> bool:
        return True

    def resolved(self, scope: Scope) -> Condition:
        return replace(self, name=scope.absolute(self.name))


@dataclass(frozen=True)
class _Topic(GraphCondition):
    type: str | None

    def evaluate(self, state: StackState) -> Verdict:
        types = state.graph.topics.get(self.name)
        exists = types is not None and (self.type is None or self.type in types)
        return Verdict.HOLDS if exists else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        of_type = f' ({self.type})' if self.type else ''
        return f'somebody publishes {self.name}{of_type}'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        topics = state.graph.topics
        if self.name in topics:
            types = ', '.join(sorted(topics[self.name]))
            return f'{self.name} is published as {types}, not as {self.type}'
        return f'nobody publishes {self.name}; {_alternatives(self.name, topics)}'


@dataclass(frozen=True)
class _Service(GraphCondition):
    def evaluate(self, state: StackState) -> Verdict:
        return Verdict.HOLDS if self.name in state.graph.services else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'the service {self.name} is there'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        alternatives = _alternatives(self.name, state.graph.services)
        return f'the service {self.name} is not there; {alternatives}'


@dataclass(frozen=True)
class _RosNode(GraphCondition):
    def evaluate(self, state: StackState) -> Verdict:
        return Verdict.HOLDS if self.name in state.graph.nodes else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'the node {self.name} is there'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        alternatives = _alternatives(self.name, state.graph.nodes)
        return f'the node {self.name} is not there; {alternatives}'


@dataclass(frozen=True)
class PathExists(Condition):
    """See :func:`path_exists`."""

    path: str

    @property
    def is_external(self) -> bool:
        return True

    def evaluate(self, state: StackState) -> Verdict:
        path = state.paths.get(self.path)
        return Verdict.HOLDS if path and path.exists else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{self.path} is there'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        seen = state.paths.get(self.path)
        path = Path(self.path)
        siblings = sorted(seen.siblings) if seen else []
        similar = difflib.get_close_matches(path.name, siblings, n=_MAX_NAMES)
        if path.parent == Path('/dev'):
            similar = list(dict.fromkeys([*similar, *filter(_SERIAL_PORT.fullmatch, siblings)]))
            return f'there is no {path}; /dev has {_list(similar) or "no port of a USB device"}'
        return f'there is no {path}; {path.parent} has {_list(similar) or "nothing like it"}'


def _list(names: Sequence[str]) -> str:
    return ', '.join(names[:_MAX_NAMES])


def _alternatives(name: str, names: Collection[str]) -> str:
    useful = [each for each in names if not _OF_EVERY_NODE.fullmatch(each)]
    shown = _most_similar_first(name, useful)[:_MAX_NAMES]
    more = f' and {len(useful) - len(shown)} more' if len(useful) > len(shown) else ''
    return f'there are {", ".join(shown)}{more}' if shown else 'there is no other'


def _most_similar_first(name: str, names: Collection[str]) -> list[str]:
    matcher = difflib.SequenceMatcher(b=name)

    def key(other: str) -> tuple[float, str]:
        matcher.set_seq1(other)
        return -matcher.ratio(), other

    return sorted(names, key=key)
