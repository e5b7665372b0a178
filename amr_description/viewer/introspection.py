# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages to pages about the ROS graph itself, and what requests about it are answered: topics,
transforms, the log, parameters.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A publisher of a topic, or a subscription."""

    node: str  #: "/robot1/controller_manager", or "?": not known
    qos: str  #: "reliable, volatile"


@dataclass(frozen=True, slots=True)
class TopicInfo:
    """A topic of the ROS graph."""

    name: str
    kinds: tuple[str, ...]  #: types of its messages; usually one
    publishers: tuple[Endpoint, ...]
    subscriptions: tuple[Endpoint, ...]
    rate: float | None  #: messages per second, of one publisher, while ``rates`` are watched


@dataclass(frozen=True, slots=True)
class Topics:
    """All nodes and topics, to pages that watch ``topics``, and on every change."""

    type: ClassVar[str] = 'topics'
    nodes: tuple[str, ...]
    topics: tuple[TopicInfo, ...]


@dataclass(frozen=True, slots=True)
class FrameStatus:
    """A TF frame that is the child of another one."""

    name: str
    parent: str  #: of the latest transform
    #: all that it had in the last seconds, and static ones: more than one is an error
    parents: tuple[str, ...]
    is_static: bool
    rate: float | None  #: transforms per second
    age: float | None  #: s since the last one came; of static ones ``None``
    topics: tuple[str, ...]  #: by which it comes: "/tf", that of ``parent`` first


@dataclass(frozen=True, slots=True)
class Transforms:
    """The TF tree, to pages that watch ``transforms``, each half a second."""

    type: ClassVar[str] = 'transforms'
    frames: tuple[FrameStatus, ...]
    publishers: Mapping[str, tuple[str, ...]]  #: nodes, by topic


@dataclass(frozen=True, slots=True)
class FindingInfo:
    """What ``ros2 doctor`` finds wrong in the graph."""

    severity: Literal['error', 'warning']
    rule: str  #: its section in docs/api/doctor.md
    what: str  #: what was seen
    why: str  #: why it matters
    fix: str  #: what mends it; commands are between back-quotes


@dataclass(frozen=True, slots=True)
class Findings:
    """
    All findings: errors first, the causes before the rest.

    To pages that watch ``findings``, and, looked for less often, to those that watch ``alarms``.
    """

    type: ClassVar[str] = 'findings'
    items: tuple[FindingInfo, ...]


@dataclass(frozen=True, slots=True)
class LogLine:
    """A message of /rosout."""

    number: int  #: one more for each that the node got
    stamp: float
    level: Literal['debug', 'info', 'warning', 'error', 'fatal']
    node: str  #: as it names itself: "robot1.controller_manager"
    text: str
    place: str  #: where in the source: "main (talker.py:23)"


@dataclass(frozen=True, slots=True)
class Log:
    """New lines of /rosout, to pages that watch ``log``; at first the last warnings and errors."""

    type: ClassVar[str] = 'log'
    lines: tuple[LogLine, ...]


@dataclass(frozen=True, slots=True)
class ParameterInfo:
    """A parameter of a node: what it answers to ``parameters``."""

    name: str
    #: "bool", "integer", "double", "string", "byte_array", "bool_array" …, or "not set"
    kind: str
    value: Any
    read_only: bool
    description: str
    constraints: str
    lower: float | None  #: of a number with a range
    upper: float | None
    step: float | None
