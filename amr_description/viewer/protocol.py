# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the node tells a page; the node's side of ``web/src/protocol.ts``, which says what it means.

A message is a frozen dataclass of the same name with the same fields; :func:`encode` makes the
text frame of it. What pages tell the node is read in ``requests.py``, the binary states are made
in ``states.py``.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
import json
import math
from typing import Any, ClassVar, Literal

from amr_description.model.frames import Quaternion, Vector

SUBPROTOCOL = 'amr.v1'
"""Of the WebSocket; a page of another version is refused."""

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
    """Where commands go: a topic, and the type that is wanted there."""

    topic: str
    message: str


@dataclass(frozen=True, slots=True)
class RobotInfo:
    """One robot; ``id`` is its namespace, the rest are topics and nodes."""

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
    """A simulator, by its node, and who is in its world."""

    id: str
    entities: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Graph:
    """What there is in the ROS graph."""

    type: ClassVar[str] = 'graph'
    robots: tuple[RobotInfo, ...]
    simulators: tuple[SimulatorInfo, ...]
    hint: str | None


@dataclass(frozen=True, slots=True)
class JointInfo:
    """A joint that moves, with one position; ``lower`` and ``upper`` are finite."""

    name: str
    kind: Literal['revolute', 'continuous', 'prismatic']
    lower: float
    upper: float
    zero: float
    follows: str | None


@dataclass(frozen=True, slots=True)
class Finding:
    """What check_urdf says of the description."""

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
    """A part of the surroundings."""

    name: str
    kind: Literal['box', 'sphere', 'cylinder', 'capsule', 'plane', 'triangles']
    size: Vector
    position: Vector
    orientation: Quaternion
    colour: Colour
    points: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class World:
    """The static surroundings."""

    type: ClassVar[str] = 'world'
    simulator: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True)
class FrameInfo:
    """A frame of TF, and the one that it is in."""

    name: str
    parent: str


@dataclass(frozen=True, slots=True)
class RobotLayout:
    """The parts of a robot of which a state tells."""

    id: str
    joints: tuple[str, ...]
    wheels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Layout:
    """What stands where in the states that follow."""

    type: ClassVar[str] = 'layout'
    id: int
    frames: tuple[FrameInfo, ...]
    robots: tuple[RobotLayout, ...]


@dataclass(frozen=True, slots=True)
class SimulationStatus:
    """The simulator's clock and health."""

    type: ClassVar[str] = 'simulation'
    simulator: str
    state: Literal['playing', 'paused', 'stopped', 'unknown']
    time: float
    factor: float | None
    real_factor: float | None


@dataclass(frozen=True, slots=True)
class TimeReset:
    """Time went back."""

    type: ClassVar[str] = 'reset'
    time: float


@dataclass(frozen=True, slots=True)
class ControllerInfo:
    """A controller, and the interfaces that it has claimed."""

    name: str
    kind: str
    state: str
    claims: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class HardwareComponentInfo:
    """A hardware component."""

    name: str
    kind: str
    state: str


@dataclass(frozen=True, slots=True)
class Controllers:
    """What a controller manager has."""

    type: ClassVar[str] = 'controllers'
    robot: str
    controllers: tuple[ControllerInfo, ...]
    hardware: tuple[HardwareComponentInfo, ...]


@dataclass(frozen=True, slots=True)
class DiagnosticItem:
    """One line of /diagnostics."""

    level: Literal['ok', 'warn', 'error', 'stale']
    name: str
    message: str


@dataclass(frozen=True, slots=True)
class Diagnostics:
    """What /diagnostics says of a robot."""

    type: ClassVar[str] = 'diagnostics'
    robot: str
    items: tuple[DiagnosticItem, ...]


@dataclass(frozen=True, slots=True)
class Driver:
    """Who drives a robot; None: nobody. ``stopped``: who drove, until another page stopped it."""

    type: ClassVar[str] = 'driver'
    robot: str
    client: str | None
    stopped: str | None = None


@dataclass(frozen=True, slots=True)
class Reply:
    """The answer to a request."""

    type: ClassVar[str] = 'reply'
    id: int
    ok: bool
    message: str


@dataclass(frozen=True, slots=True)
class Notice:
    """Something that a person should know."""

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
    """Return the text frame of a message; a number that is none becomes null."""
    fields = {'type': message.type, **asdict(message)}
    try:
        return json.dumps(fields, allow_nan=False, separators=(',', ':'))
    except ValueError:  # of a stranger's message: JSON has no NaN, and a page could not read it
        return json.dumps(_finite(fields), allow_nan=False, separators=(',', ':'))


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(each) for each in value]
    return value
