# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages to pages: this side of ``web/src/protocol.ts``, which documents them.

A message is a frozen dataclass with the name and the fields that it has there; :func:`encode`
returns its text frame. Messages from pages are in ``requests.py``, binary states in
``states.py``, binary samples of sensors, whose heads are here, in ``samples.py``.
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
class SensorInfo:
    """A topic of a sensor, the robot that it belongs to, and the type of its messages."""

    topic: str
    robot: str
    kind: Literal['scan', 'cloud', 'picture', 'range', 'contacts']
    message: str


@dataclass(frozen=True, slots=True)
class Graph:
    """The robots, simulators and sensors of the ROS graph."""

    type: ClassVar[str] = 'graph'
    robots: tuple[RobotInfo, ...]
    simulators: tuple[SimulatorInfo, ...]
    hint: str | None
    sensors: tuple[SensorInfo, ...] = ()


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


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a sample is from: topic, frame, time of its stamp (s), messages per second."""

    topic: str
    frame: str
    stamp: float
    rate: float | None


@dataclass(frozen=True, slots=True)
class Scan:
    """The head of a LaserScan, rad and m; float32 of the ranges follow."""

    type: ClassVar[str] = 'scan'
    origin: Origin
    angle_min: float
    angle_increment: float
    range_min: float | None
    range_max: float | None
    count: int


@dataclass(frozen=True, slots=True)
class Cloud:
    """The head of a PointCloud2; positions and colours of some of its ``count`` points follow."""

    type: ClassVar[str] = 'cloud'
    origin: Origin
    count: int
    colouring: Literal['rgb', 'intensity', 'none']
    low: float | None
    high: float | None


@dataclass(frozen=True, slots=True)
class Picture:
    """The head of a picture; the file follows. ``low``, ``high``: of depths, m."""

    type: ClassVar[str] = 'picture'
    origin: Origin
    format: Literal['image/jpeg', 'image/png']
    encoding: str
    width: int
    height: int
    low: float | None
    high: float | None


@dataclass(frozen=True, slots=True)
class Distance:
    """The head of a Range, rad and m; a float32 follows, the distance."""

    type: ClassVar[str] = 'range'
    origin: Origin
    field_of_view: float | None
    min_range: float | None
    max_range: float | None


@dataclass(frozen=True, slots=True)
class ContactInfo:
    """Two shapes that touch, in ``points`` places, and the force on the first, N."""

    first: str
    second: str
    points: int
    force: float | None


@dataclass(frozen=True, slots=True)
class Contacts:
    """The head of contacts; 6 float32 a place follow: the point, m, and the normal."""

    type: ClassVar[str] = 'contacts'
    origin: Origin
    contacts: tuple[ContactInfo, ...]


@dataclass(frozen=True, slots=True)
class Unreadable:
    """In place of a sample: why the last message cannot be shown."""

    type: ClassVar[str] = 'unreadable'
    origin: Origin
    text: str


type Head = Scan | Cloud | Picture | Distance | Contacts | Unreadable
"""The head of a sample of a sensor."""

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


def encode(message: ServerMessage | Head) -> str:
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
