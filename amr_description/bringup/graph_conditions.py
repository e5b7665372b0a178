# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Conditions on what is outside of the stack: the ROS graph, and files.

Names that do not begin with a slash are of the namespace of the group that the condition stands
in. They say what there is instead, near names first.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
import difflib
from os import PathLike
from pathlib import Path
import re

from amr_description.bringup.conditions import Condition, NameOf, Scope, StackState, Verdict
from amr_description.bringup.validation import require, TEXT, TOKEN, Validator
from amr_description.errors import BringupError

_NAME = re.compile(f'/?{TOKEN}(/{TOKEN})*')
_TYPE = Validator(
    'a type as std_msgs/msg/String',
    lambda value: isinstance(value, str) and bool(re.fullmatch(f'{TOKEN}/msg/{TOKEN}', value)),
)
_MOST_NAMES = 8  # in a message
_SERIAL_PORT = re.compile(r'tty(USB|ACM|AMA|THS)\d+|rfcomm\d+')  # with a device; of ttyS few have
# Every node has these, so they say nothing about what there is.
_OF_EVERY_NODE = re.compile(
    '.*/((describe|get|list|set)_(parameters|parameter_types|parameters_atomically)'
    '|get_type_description)|/rosout|/parameter_events'
)


@dataclass(frozen=True)
class OnGraph(Condition):
    """A condition on the ROS graph, as a process of its own sees it."""

    name: str

    def __post_init__(self) -> None:
        """Refuse what can be no name in ROS."""
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
class _Topic(OnGraph):
    type: str | None

    def evaluate(self, situation: StackState) -> Verdict:
        types = situation.graph.topics.get(self.name)
        there = types is not None and (self.type is None or self.type in types)
        return Verdict.HOLDS if there else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        of_type = f' ({self.type})' if self.type else ''
        return f'somebody publishes {self.name}{of_type}'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        topics = situation.graph.topics
        if self.name in topics:
            types = ', '.join(sorted(topics[self.name]))
            return f'{self.name} is published as {types}, not as {self.type}'
        return f'nobody publishes {self.name}; {_others(self.name, topics)}'


@dataclass(frozen=True)
class _Service(OnGraph):
    def evaluate(self, situation: StackState) -> Verdict:
        there = self.name in situation.graph.services
        return Verdict.HOLDS if there else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'the service {self.name} is there'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        others = _others(self.name, situation.graph.services)
        return f'the service {self.name} is not there; {others}'


@dataclass(frozen=True)
class _RosNode(OnGraph):
    def evaluate(self, situation: StackState) -> Verdict:
        return Verdict.HOLDS if self.name in situation.graph.nodes else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'the node {self.name} is there'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        others = _others(self.name, situation.graph.nodes)
        return f'the node {self.name} is not there; {others}'


@dataclass(frozen=True)
class PathExists(Condition):
    """See :func:`path_exists`."""

    path: str

    @property
    def is_external(self) -> bool:
        return True

    def evaluate(self, situation: StackState) -> Verdict:
        look = situation.paths.get(self.path)
        return Verdict.HOLDS if look and look.there else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{self.path} is there'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        look = situation.paths.get(self.path)
        path = Path(self.path)
        beside = sorted(look.beside) if look else []
        near = difflib.get_close_matches(path.name, beside, n=_MOST_NAMES)
        if path.parent == Path('/dev'):
            near = list(dict.fromkeys([*near, *filter(_SERIAL_PORT.fullmatch, beside)]))
            return f'there is no {path}; /dev has {_list(near) or "no port of a USB device"}'
        return f'there is no {path}; {path.parent} has {_list(near) or "nothing like it"}'


def _list(names: Sequence[str]) -> str:
    return ', '.join(names[:_MOST_NAMES])


def _others(name: str, names: Collection[str]) -> str:
    telling = [each for each in names if not _OF_EVERY_NODE.fullmatch(each)]
    shown = _nearest(name, telling)[:_MOST_NAMES]
    more = f' and {len(telling) - len(shown)} more' if len(telling) > len(shown) else ''
    return f'there are {", ".join(shown)}{more}' if shown else 'there is no other'


def _nearest(name: str, names: Collection[str]) -> list[str]:
    """Return the names, those first that are most like ``name``."""
    likeness = difflib.SequenceMatcher(b=name)

    def unlike(other: str) -> tuple[float, str]:
        likeness.set_seq1(other)
        return -likeness.ratio(), other

    return sorted(names, key=unlike)


def topic(name: str, type: str | None = None) -> Condition:  # noqa: A002 - as ROS calls it
    """
    Hold while somebody publishes a topic.

    :param type: If given, only as this type, ``nav_msgs/msg/Odometry``.
    """
    require('topic(…, %s)', type, _TYPE.or_none())
    return _Topic(name, type)


def service(name: str) -> Condition:
    """Hold while a service is offered."""
    return _Service(name)


def ros_node(name: str) -> Condition:
    """Hold while a ROS node of this name is there, started by whomever."""
    return _RosNode(name)


def path_exists(path: str | Path) -> Condition:
    """Hold while there is a file, a folder or a device: ``path_exists('/dev/ttyUSB0')``."""
    require('path_exists(%s)', path, Validator('a path', lambda v: isinstance(v, str | PathLike)))
    return PathExists(str(Path(path).expanduser().absolute()))
