# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The messages between the page and the node ``viewer``, over one WebSocket at ``/ws``.

Text frames are JSON, one message each, with its ``type``. Binary frames, from the node to the
page alone, are states and samples of sensors. Lengths are in m, angles in rad, times in s, frames
and axes as in REP 103 (x ahead, y left, z up), quaternions in the order x, y, z, w.

Here are the messages to pages, and the heads of samples; those from pages are in ``requests.py``,
the layout of states in ``states.py``, that of samples in ``samples.py``. These files define
the protocol, and ``web/protocol.py`` writes the page's side from them, with the documentation:
docstrings, and for a field the comment that begins with ``#:``, beside it or above it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, TypeAlias

from amr_description.model.frames import Quaternion, Vector
from amr_description.viewer.bags import BagWriting, Playhead, Recording
from amr_description.viewer.forms import GoalProgress, Services
from amr_description.viewer.introspection import Findings, Log, Topics, Transforms
from amr_description.viewer.marks import MarkBatch, MarkText, Shape
from amr_description.viewer.navigation import GoalStatus, Navigator

PROTOCOL = 'amr.v1'
"""The WebSocket's subprotocol: a page of another version is refused."""


@dataclass(frozen=True, slots=True)
class Hello:
    """The first message of every connection."""

    type: ClassVar[str] = 'hello'
    client: str  #: the name of this page, as the others see it: "page 3"
    version: str  #: of the package
    domain: int  #: ROS_DOMAIN_ID
    rate: float  #: states per second, at most
    drive_timeout: float  #: s after the last ``drive`` until the node stops the robot by itself


@dataclass(frozen=True, slots=True)
class Command:
    """The topic of velocity commands."""

    topic: str
    message: str  #: its type: "geometry_msgs/msg/TwistStamped" or "geometry_msgs/msg/Twist"


@dataclass(frozen=True, slots=True)
class EntityInfo:
    """A robot in a simulator's world."""

    simulator: str
    name: str  #: that ``delete`` takes


@dataclass(frozen=True, slots=True)
class RobotInfo:
    """A robot, and its topics and nodes in the ROS graph; ``None``: there is none."""

    id: str  #: its namespace, "/" or "/robot1": the name of the robot in every other message
    name: str  #: of the URDF
    #: false: only described; the simulator has no such robot, as it was deleted, or never spawned
    present: bool
    command: Command | None
    odometry: str | None  #: the topic of odometry
    truth: str | None  #: the topic of ground truth
    wheels: str | None  #: the topic of wheel states
    joint_states: str | None  #: the topic of joint states
    #: the joint_state_publisher that takes positions, so that there are sliders
    joint_publisher: str | None
    manager: str | None  #: the controller manager
    #: what it is in a simulator's world; ``None``: in none, or nobody can tell
    entity: EntityInfo | None = None


@dataclass(frozen=True, slots=True)
class SimulatorInfo:
    """A simulator."""

    id: str  #: the node: "/mujoco_sim"
    entities: tuple[str, ...]  #: what is in its world, by the names that ``delete`` takes
    world: str  #: the name of the present world; empty: it is not told
    worlds: tuple[str, ...]  #: the names of those that ``load_world`` takes


SensorKind: TypeAlias = Literal[
    'scan', 'cloud', 'picture', 'range', 'contacts', 'map', 'path', 'markers', 'poses', 'polygon',
    'point',
]  # fmt: skip
"""How a topic is shown: what a sensor measured, or what others draw."""


@dataclass(frozen=True, slots=True)
class SensorInfo:
    """
    A topic of a sensor, or of maps, paths and markers, which the page shows as it does sensors.

    Pictures that come raw and compressed are there once.
    """

    topic: str
    robot: str  #: whose namespace holds the topic; empty: a map, path or marker in none of theirs
    kind: SensorKind
    message: str  #: its type: "sensor_msgs/msg/LaserScan"


@dataclass(frozen=True, slots=True)
class Graph:
    """The robots, simulators and sensors of the ROS graph. Sent on every change."""

    type: ClassVar[str] = 'graph'
    robots: tuple[RobotInfo, ...]
    simulators: tuple[SimulatorInfo, ...]
    #: what to do when there is nothing to see: "nothing publishes /robot_description; start …"
    hint: str | None
    sensors: tuple[SensorInfo, ...] = ()
    navigators: tuple[Navigator, ...] = ()


@dataclass(frozen=True, slots=True)
class JointInfo:
    """A joint with one position, rad or m."""

    name: str
    kind: Literal['revolute', 'continuous', 'prismatic']
    lower: float  #: -pi and pi of a continuous joint; finite
    upper: float
    zero: float  #: where Center puts it
    follows: str | None  #: the joint that a mimic joint follows: it has no slider


@dataclass(frozen=True, slots=True)
class Finding:
    """A finding of check_urdf about the description."""

    level: Literal['error', 'warning', 'note']
    line: int | None  #: of its file, which for what xacro expanded is another than the URDF
    at: int | None  #: the line of the URDF that this became
    text: str  #: what is wrong
    remedy: str  #: what would do; may be empty


@dataclass(frozen=True, slots=True)
class Model:
    """A robot's description. Sent when it was received, and when it has changed."""

    type: ClassVar[str] = 'model'
    robot: str
    urdf: str
    root: str  #: the link that is nobody's child
    #: file name as in the URDF -> where the page fetches it: "/mesh/3f2a….stl"
    meshes: Mapping[str, str]
    joints: tuple[JointInfo, ...]  #: all that move, in the order of the URDF
    findings: tuple[Finding, ...]  #: of check_urdf


@dataclass(frozen=True, slots=True)
class World:
    """The static shapes of the world, in its frame ``world``. Sent on every change."""

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
    """The order of the values in the states. Sent before the first state, and on every change."""

    type: ClassVar[str] = 'layout'
    id: int  #: 0..65535; a state with another id is of an older layout and is dropped
    frames: tuple[FrameInfo, ...]  #: the TF tree, parents before children; a root is no child
    robots: tuple[RobotLayout, ...]


@dataclass(frozen=True, slots=True)
class SimulationStatus:
    """State, time and real-time factors of a simulator; sent a few times per second."""

    type: ClassVar[str] = 'simulation'
    simulator: str
    state: Literal['playing', 'paused', 'stopped', 'unknown']
    time: float
    factor: float | None  #: the real-time factor asked for; 0: as fast as possible
    real_factor: float | None  #: the one that is, over the last second


@dataclass(frozen=True, slots=True)
class TimeReset:
    """Time has jumped back (a reset): trails and plots are cleared."""

    type: ClassVar[str] = 'reset'
    time: float


@dataclass(frozen=True, slots=True)
class ControllerInfo:
    """A controller."""

    name: str
    kind: str
    state: str
    claims: tuple[str, ...]  #: the command interfaces that it has claimed
    moves: tuple[str, ...] = ()  #: the joints that ``set_joints`` can move by it


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
    """The page that drives a robot; sent to every page on every change."""

    type: ClassVar[str] = 'driver'
    robot: str
    client: str | None  #: ``None``: nobody
    #: who drove until another page stopped the robot: it must let go
    stopped: str | None = None


@dataclass(frozen=True, slots=True)
class Commanders:
    """
    Who commands a robot besides the pages of this node, by its command topic.

    Sent to every page on every change.
    """

    type: ClassVar[str] = 'commanders'
    robot: str
    nodes: tuple[str, ...]  #: that have a publisher there: "/planner"
    rate: float  #: commands per second of all of them together, 0: none lately


@dataclass(frozen=True, slots=True)
class HeldRobot:
    """A robot that is held at rest by ``emergency_stop``."""

    robot: str
    client: str  #: the page that pressed STOP
    since: float  #: when, s since 1970
    #: 'holds': it stands, as measured or, where nothing measures it, by its lock; 'moves': it does
    #: not, and does not brake; 'unknown': nothing measures it, and it has no lock
    state: Literal['holds', 'braking', 'moves', 'unknown']
    is_locked: bool  #: what drives it takes part in the lock, the topic `emergency_stop`
    controllers: tuple[str, ...]  #: active ones that drive it: deactivated, they cannot
    deactivated: tuple[str, ...]  #: those that were deactivated for it; a release activates them


@dataclass(frozen=True, slots=True)
class EmergencyStop:
    """The stops that are held, by any page. Sent to every page on every change."""

    type: ClassVar[str] = 'emergency_stop'
    client: str | None  #: the page that stopped all robots; ``None``: not all are stopped
    since: float | None  #: when, s since 1970
    robots: tuple[HeldRobot, ...]


@dataclass(frozen=True, slots=True)
class RobotAges:
    """The age of the latest message of each kind, s of wall time; ``None``: there was none."""

    robot: str
    command: float | None
    odometry: float | None
    truth: float | None
    joint_states: float | None


@dataclass(frozen=True, slots=True)
class Ages:
    """How old is what the states say; sent a few times per second, whatever moves."""

    type: ClassVar[str] = 'ages'
    clock: float | None  #: of the latest /clock, s of wall time; ``None``: nobody publishes it
    tf: float | None  #: of the latest transform that moves
    robots: tuple[RobotAges, ...]


@dataclass(frozen=True, slots=True)
class Reply:
    """The reply to a request, by its ``id``."""

    type: ClassVar[str] = 'reply'
    id: int
    ok: bool
    message: str  #: one line: what was done, or what was asked, found, and would do
    data: Any = None  #: what was asked for: the request says of what type
    #: of a request that was done in part: the fields of the one that tries the rest again
    again: Mapping[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class Notice:
    """A line for the user: a robot has left the graph, a Twist without subscribers, and so on."""

    type: ClassVar[str] = 'notice'
    level: Literal['info', 'warning', 'error']
    text: str


Channel: TypeAlias = Literal['sensor', 'message', 'values']
"""How a topic is shown: as ``topics``, ``messages`` or ``fields`` of Watch say."""


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a sample is from."""

    topic: str
    frame: str  #: of TF; of a robot with a TF of its own, without its namespace
    stamp: float  #: s
    rate: float | None  #: messages per second of the topic, those that were left out, too


@dataclass(frozen=True, slots=True)
class Scan:
    """
    The head of a LaserScan, rad and m.

    f32 of the ranges follow; those that are none are not finite, or out of bounds.
    """

    type: ClassVar[str] = 'scan'
    origin: Origin
    angle_min: float
    angle_increment: float
    range_min: float | None  #: ``None``: no bound
    range_max: float | None
    count: int  #: ranges of the message; fewer may follow, evenly thinned


@dataclass(frozen=True, slots=True)
class Cloud:
    """
    The head of a PointCloud2.

    For each point x, y, z follow, f32, all points first; then their colours, three u8, if they
    are 'rgb', or an f32, if they are 'intensity'.
    """

    type: ClassVar[str] = 'cloud'
    origin: Origin
    count: int  #: points of the message; fewer may follow
    colouring: Literal['rgb', 'intensity', 'none']
    low: float | None  #: the least intensity
    high: float | None


@dataclass(frozen=True, slots=True)
class Picture:
    """The head of a picture; its file follows."""

    type: ClassVar[str] = 'picture'
    origin: Origin
    format: Literal['image/jpeg', 'image/png']
    encoding: str  #: of the message: rgb8, 32FC1 …
    width: int  #: of the message; the file's may be smaller
    height: int
    low: float | None  #: of a picture of depths, m: the nearest is the lightest, black is none
    high: float | None


@dataclass(frozen=True, slots=True)
class Distance:
    """
    The head of a Range, rad and m.

    An f32 follows: the distance; -inf: too near, inf: nothing there (REP 117).
    """

    type: ClassVar[str] = 'range'
    origin: Origin
    field_of_view: float | None
    min_range: float | None
    max_range: float | None


@dataclass(frozen=True, slots=True)
class ContactInfo:
    """Two shapes that touch."""

    first: str
    second: str
    points: int  #: places in which they do
    force: float | None  #: N, on the first, of all of them together


@dataclass(frozen=True, slots=True)
class Contacts:
    """The head of contacts. For each place x, y, z (m), and the normal, follow, f32."""

    type: ClassVar[str] = 'contacts'
    origin: Origin
    contacts: tuple[ContactInfo, ...]


@dataclass(frozen=True, slots=True)
class OccupancyGrid:
    """
    The head of a map or a costmap. Sent again when it has changed.

    The cells follow, i8, row by row from the origin, deflated (RFC 1950): 0 free to 100 occupied,
    -1 not known.
    """

    type: ClassVar[str] = 'map'
    origin: Origin  #: ``stamp`` is 0
    width: int  #: cells in a row, along x
    height: int  #: rows, along y
    resolution: float  #: m, the side of a cell
    position: Vector  #: of the outer corner of the first cell, m in ``origin.frame``
    orientation: Quaternion


@dataclass(frozen=True, slots=True)
class Route:
    """The head of a path. For each pose x, y, z (m, in ``origin.frame``) follow, f32."""

    type: ClassVar[str] = 'path'
    origin: Origin
    count: int  #: poses of the message; fewer may follow, evenly thinned
    length: float  #: m


@dataclass(frozen=True, slots=True)
class Marks:
    """
    The head of what others draw: Marker, MarkerArray, PoseArray, PolygonStamped, PointStamped.

    All that there is, at each change. The numbers of each batch follow, one batch after the other.
    """

    type: ClassVar[str] = 'marks'
    origin: Origin  #: of the newest; ``frame`` of the first batch
    count: int  #: shapes, lines and points that there are; fewer may follow, evenly thinned
    shown: int
    batches: tuple[MarkBatch, ...]
    texts: tuple[MarkText, ...]
    faults: tuple[str, ...]  #: why some are not drawn, or not as told, one line each


@dataclass(frozen=True, slots=True)
class AnyMessage:
    """
    The head of the latest message of any topic, see ``messages`` of Watch.

    The message follows as JSON, an object by the names of the fields. What JSON cannot say, and
    what is too long, is an object with keys that begin with #: {"#number": "NaN"}, or "Infinity",
    "-Infinity", and integers beyond 2^53; {"#length": 360, "#first": [...]}, an array of that
    many elements, of which these come first; {"#length": 5000, "#text": "..."}, a string of so
    many bytes.
    """

    type: ClassVar[str] = 'message'
    origin: Origin  #: ``frame`` and ``stamp`` are empty and 0
    message: str  #: its type: "nav_msgs/msg/Odometry"
    size: int  #: bytes


@dataclass(frozen=True, slots=True)
class Values:
    """
    The head of numbers of messages of a topic: of all that came since the last sample.

    f64, aligned to 8 bytes, follow, column by column: the stamps of the ``count`` messages, s,
    then the values of each path. A stamp is that of the header, if it is not 0, else
    when the message was received, as states have their time. NaN: there is no such element, or
    the path is one of ``faults``. A page that is slow gets all samples later, up to a bound;
    then the oldest are lost.
    """

    type: ClassVar[str] = 'values'
    origin: Origin  #: ``stamp``: of the last message
    paths: tuple[str, ...]  #: those that any page plots
    count: int  #: messages
    #: the number of the first message: the one before ended before it, or messages were lost
    first: int
    faults: Mapping[str, str]  #: path -> why there is no number, in one line
    #: path of a state -> value -> its name: a truth, a constant, or the text that it stands for
    names: Mapping[str, Mapping[str, str]]


@dataclass(frozen=True, slots=True)
class Unreadable:
    """In place of a sample: why the last message cannot be shown."""

    type: ClassVar[str] = 'unreadable'
    origin: Origin
    text: str
    channel: Channel = 'sensor'


Head: TypeAlias = (
    Scan
    | Cloud
    | Picture
    | Distance
    | Contacts
    | OccupancyGrid
    | Route
    | Marks
    | AnyMessage
    | Values
    | Unreadable
)
"""The head of a sample."""

ServerMessage: TypeAlias = (
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
    | Commanders
    | EmergencyStop
    | Ages
    | Reply
    | Notice
    | Topics
    | Services
    | GoalProgress
    | Transforms
    | Log
    | Findings
    | GoalStatus
    | Recording
    | Playhead
    | BagWriting
)
"""A text frame from the node."""
REPLACED: frozenset[type[ServerMessage]] = frozenset({
    Graph, Model, World, Layout, SimulationStatus, Controllers, Diagnostics, Commanders, Services,
    EmergencyStop, Ages, Topics, Transforms, Findings, GoalStatus, Recording, Playhead, BagWriting,
})  # fmt: skip
"""
Messages that say how something is: of each subject a page that reads slowly gets the newest alone.

All others say what has happened, and each is sent.
"""
