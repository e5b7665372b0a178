# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages to pages: this side of ``web/src/protocol.ts``, which documents them.

A message is a frozen dataclass with the name and the fields that it has there; :func:`encode`
returns its text frame. Messages from pages are in ``requests.py``, binary states in
``states.py``.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
import json
import math
from typing import Any, ClassVar, Literal

from amr_description.model.frames import Quaternion, Vector

SUBPROTOCOL = 'amr.v1'
"""The WebSocket subprotocol; a page of another version is refused."""

type Colour = tuple[float, float, float, float]
"""Red, green, blue, alpha in 0..1."""


@dataclass(frozen=True, slots=True)
class Hello:
    """The first message of every connection."""

    type: ClassVar[str] = 'hello'
    client: str
    version: str
    domain: int
    rate: float
    drive_timeout: float


@dataclass(frozen=True, slots=True)
class Command:
    """The topic of velocity commands, and its message type."""

    topic: str
    message: str


@dataclass(frozen=True, slots=True)
class RobotInfo:
    """One robot; ``id`` is its namespace, the other names are topics and nodes."""

    id: str
    name: str
    command: Command | None
    odometry: str | None
    truth: str | None
    wheels: str | None
    joint_states: str | None
    joint_publisher: str | None
    manager: str | None


@dataclass(frozen=True, slots=True)
class SimulatorInfo:
    """A simulator: its node, and the entities in its world."""

    id: str
    entities: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Graph:
    """The robots and simulators of the ROS graph."""

    type: ClassVar[str] = 'graph'
    robots: tuple[RobotInfo, ...]
    simulators: tuple[SimulatorInfo, ...]
    hint: str | None


@dataclass(frozen=True, slots=True)
class JointInfo:
    """A joint with one position, rad or m; ``lower`` and ``upper`` are finite."""

    name: str
    kind: Literal['revolute', 'continuous', 'prismatic']
    lower: float
    upper: float
    zero: float
    follows: str | None


@dataclass(frozen=True, slots=True)
class Finding:
    """A finding of check_urdf about the description."""

    level: Literal['error', 'warning', 'note']
    line: int | None
    text: str
    remedy: str


@dataclass(frozen=True, slots=True)
class Model:
    """A robot's description."""

    type: ClassVar[str] = 'model'
    robot: str
    urdf: str
    root: str
    meshes: Mapping[str, str]
    joints: tuple[JointInfo, ...]
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True)
class Shape:
    """A static shape of the world."""

    name: str
    kind: Literal['box', 'sphere', 'cylinder', 'capsule', 'plane', 'triangles']
    size: Vector
    position: Vector
    orientation: Quaternion
    colour: Colour
    points: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class World:
    """The static shapes of a simulator's world."""

    type: ClassVar[str] = 'world'
    simulator: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True)
class FrameInfo:
    """A TF frame and its parent."""

    name: str
    parent: str


@dataclass(frozen=True, slots=True)
class RobotLayout:
    """The joints and wheels of a robot, in the order of the states."""

    id: str
    joints: tuple[str, ...]
    wheels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Layout:
    """The order of the values in the states that follow."""

    type: ClassVar[str] = 'layout'
    id: int
    frames: tuple[FrameInfo, ...]
    robots: tuple[RobotLayout, ...]


@dataclass(frozen=True, slots=True)
class SimulationStatus:
    """State, time (s) and real-time factors of a simulator."""

    type: ClassVar[str] = 'simulation'
    simulator: str
    state: Literal['playing', 'paused', 'stopped', 'unknown']
    time: float
    factor: float | None
    real_factor: float | None


@dataclass(frozen=True, slots=True)
class TimeReset:
    """Time has jumped back, to ``time`` (s)."""

    type: ClassVar[str] = 'reset'
    time: float


@dataclass(frozen=True, slots=True)
class ControllerInfo:
    """
    A controller and the command interfaces that it has claimed.

    ``moves``: the joints that pages can move by it, with ``set_joints``.
    """

    name: str
    kind: str
    state: str
    claims: tuple[str, ...]
    moves: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class HardwareComponentInfo:
    """A hardware component."""

    name: str
    kind: str
    state: str


@dataclass(frozen=True, slots=True)
class Controllers:
    """The controllers and hardware components of a controller manager."""

    type: ClassVar[str] = 'controllers'
    robot: str
    controllers: tuple[ControllerInfo, ...]
    hardware: tuple[HardwareComponentInfo, ...]


@dataclass(frozen=True, slots=True)
class DiagnosticItem:
    """One status of /diagnostics."""

    level: Literal['ok', 'warn', 'error', 'stale']
    name: str
    message: str


@dataclass(frozen=True, slots=True)
class Diagnostics:
    """The latest statuses of /diagnostics for a robot."""

    type: ClassVar[str] = 'diagnostics'
    robot: str
    items: tuple[DiagnosticItem, ...]


@dataclass(frozen=True, slots=True)
class Driver:
    """The page that drives a robot; ``stopped``: the one that drove until another stopped it."""

    type: ClassVar[str] = 'driver'
    robot: str
    client: str | None
    stopped: str | None = None


@dataclass(frozen=True, slots=True)
class Reply:
    """The reply to a request."""

    type: ClassVar[str] = 'reply'
    id: int
    ok: bool
    message: str


@dataclass(frozen=True, slots=True)
class Notice:
    """A line for the user."""

    type: ClassVar[str] = 'notice'
    level: Literal['info', 'warning', 'error']
    text: str


type ServerMessage = (
    Hello
    | Graph
    | Model
    | World
    | Layout
    | SimulationStatus
    | TimeReset
    | Controllers
    | Diagnostics
    | Driver
    | Reply
    | Notice
)


def encode(message: ServerMessage) -> str:
    """Return the text frame of a message; NaN and infinity become null."""
    fields = {'type': message.type, **asdict(message)}
    try:
        return json.dumps(fields, allow_nan=False, separators=(',', ':'))
    except ValueError:  # from a third-party message; JSON has neither NaN nor infinity
        return json.dumps(_finite(fields), allow_nan=False, separators=(',', ':'))


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(each) for each in value]
    return value
