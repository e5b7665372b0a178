# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The messages from pages, validated: a text frame is one of these, or refused in one line that says
what is wrong with it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, MISSING
import json
import math
from typing import Annotated, Any, ClassVar, get_args, Literal, TypeAlias

from amr_description.errors import ProtocolError
from amr_description.model.frames import Vector
from amr_description.text import quote
from amr_description.viewer.bags import BagRequest
from amr_description.viewer.forms import CallRequest
from amr_description.viewer.protocol import FrameInfo, RobotLayout

_LARGEST_ID = 2**53  # up to here JavaScript's numbers are exact integers
_SHOWN = 80  # characters of a value that an error quotes
MOST_TOPICS = 64
"""Topics that a page may show of each kind: more are refused."""
MOST_FIELDS = 256
"""Fields that a page may plot, of all topics together: more are refused."""
_HIGHEST_RATE = 100.0  # Hz
_FASTEST = 100.0  # m/s or rad/s; no wheeled robot is faster

Speed: TypeAlias = Annotated[float, 'speed']
"""m/s or rad/s; its own type, because it has a limit: more than 100 either way is refused."""
Rate: TypeAlias = Annotated[float, 'rate']
"""Hz; its own type, because more than 100, or less than 0, is refused."""
Document: TypeAlias = Annotated[str, 'document']
"""A text of any lines."""
Part: TypeAlias = Literal[
    'wheels', 'topics', 'services', 'rates', 'transforms', 'log', 'findings', 'alarms'
]
"""
What the node collects only while a page shows it: a part of the states (wheels), or a message of
the same name; ``rates`` are those of ``topics``.
"""
PARTS: tuple[Part, ...] = get_args(Part)


@dataclass(frozen=True, slots=True)
class Drive:
    """
    Drive a robot, with the keyboard, the joystick or a gamepad, at most 60 times per second.

    The first message acquires the robot's lock, if no other page holds it; ``stop`` (or
    drive_timeout without a ``drive``) stops the robot and releases the lock. There is no reply,
    as there is no ``id``; a refusal is a notice.
    """

    types: ClassVar[tuple[str, ...]] = ('drive',)
    robot: str
    linear: Speed  #: m/s ahead; more than 100 either way is refused
    angular: Speed  #: rad/s to the left, of the same bounds
    sideways: Speed = 0.0  #: m/s to the left, of robots whose wheels can


@dataclass(frozen=True, slots=True)
class Stop:
    """
    Stop a robot once, whichever page drives it: what a page sends when it lets go.

    Joints that pages have moved by controllers stay where they are.
    """

    types: ClassVar[tuple[str, ...]] = ('stop',)
    robot: str | None  #: ``None``: all robots


@dataclass(frozen=True, slots=True)
class PressStop:
    """
    STOP: hold a robot at rest until it is released, whoever commands it.

    It outlives this page. See the message `emergency_stop` for what becomes of it.
    """

    types: ClassVar[tuple[str, ...]] = ('press_stop',)
    robot: str | None  #: ``None``: all robots, also those that come later


@dataclass(frozen=True, slots=True)
class Release:
    """
    Release a robot from ``press_stop``, whichever page pressed it.

    Pages that drove it must let go before they can drive again.
    """

    types: ClassVar[tuple[str, ...]] = ('release',)
    robot: str | None  #: ``None``: all robots


@dataclass(frozen=True, slots=True)
class SetJoints:
    """
    Move joints: by joint_state_publisher where there is one, else by the active controllers whose
    ``moves`` have them; a trajectory takes the time that the joints' limits of velocity ask for.
    """

    types: ClassVar[tuple[str, ...]] = ('set_joints',)
    robot: str
    positions: Mapping[str, float]  #: rad or m, by the names of the joints


@dataclass(frozen=True, slots=True)
class Push:
    """
    Push a link, as by a hand that holds it, at most 60 times per second.

    The last force acts until the next one, or none for 0.3 s; a page that has gone pushes nothing.
    There is no reply; a refusal is a notice.
    """

    types: ClassVar[tuple[str, ...]] = ('push',)
    simulator: str
    entity: str  #: by the name that ``delete`` takes
    link: str
    force: Vector  #: N, in the axes of ``world``, at the origin of the link; 0, 0, 0: let go
    torque: Vector  #: N m


@dataclass(frozen=True, slots=True)
class Watch:
    """
    What this page shows from now on of what is collected on demand; nothing for a new connection.

    What no page shows is not known, NaN, in the states of all pages, and not subscribed: a
    simulator need not work it out. There is no reply.
    """

    types: ClassVar[tuple[str, ...]] = ('watch',)
    #: of the states, beyond those that every state has; any other than those of Part is refused
    parts: tuple[Part, ...]
    topics: tuple[str, ...] = ()  #: of SensorInfo; one that is not there may come later
    #: any topics, whose messages come whole (see AnyMessage), a few a second; likewise
    messages: tuple[str, ...] = ()
    #: by any topic, paths of numbers, as ``ros2 topic echo --field`` has them (``position[2]``),
    #: which come of each message (see Values)
    fields: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    whole: tuple[str, ...] = ()  #: of topics, clouds of which all points come, less often


@dataclass(frozen=True, slots=True)
class Play:
    """Run the simulation, or pause it."""

    types: ClassVar[tuple[str, ...]] = ('play', 'pause')
    type: str
    id: int
    simulator: str


@dataclass(frozen=True, slots=True)
class Step:
    """Advance a paused simulation by physics steps."""

    types: ClassVar[tuple[str, ...]] = ('step',)
    id: int
    simulator: str
    steps: int


@dataclass(frozen=True, slots=True)
class ResetSimulation:
    """Reset the time to 0, and all robots to their initial poses."""

    types: ClassVar[tuple[str, ...]] = ('reset_simulation',)
    id: int
    simulator: str


@dataclass(frozen=True, slots=True)
class SetFactor:
    """Set the real-time factor."""

    types: ClassVar[tuple[str, ...]] = ('set_factor',)
    id: int
    simulator: str
    factor: float  #: 0: as fast as possible


@dataclass(frozen=True, slots=True)
class Spawn:
    """Spawn a robot."""

    types: ClassVar[tuple[str, ...]] = ('spawn',)
    id: int
    simulator: str
    name: str
    namespace: str
    position: Vector
    yaw: float
    like: str | None  #: the robot whose description and active controllers it gets
    urdf: Document | None = None  #: its description, where it is like no other
    fixed: bool = False  #: whether its root link is fixed to the world, as that of an arm


@dataclass(frozen=True, slots=True)
class SetUp:
    """
    Activate the controllers of a robot: those that are, or were, active of the one it is like.

    Of a robot that is not there any more nobody may know them; then all of the parameter file.
    """

    types: ClassVar[tuple[str, ...]] = ('set_up',)
    id: int
    robot: str
    like: str


@dataclass(frozen=True, slots=True)
class LoadWorld:
    """Load another world; the robots are spawned again in it, with their active controllers."""

    types: ClassVar[tuple[str, ...]] = ('load_world',)
    id: int
    simulator: str
    name: str  #: one of ``worlds``


@dataclass(frozen=True, slots=True)
class Place:
    """
    Put a robot elsewhere, upright and at rest.

    The data of the reply are true where the simulator warns, as of one that is inside something.
    """

    types: ClassVar[tuple[str, ...]] = ('place',)
    id: int
    simulator: str
    name: str
    position: Vector  #: of its root link, in ``world``
    yaw: float


@dataclass(frozen=True, slots=True)
class ResetEntity:
    """Put a robot back to where it was spawned, at rest; time goes on."""

    types: ClassVar[tuple[str, ...]] = ('reset_entity',)
    id: int
    simulator: str
    name: str


@dataclass(frozen=True, slots=True)
class Delete:
    """Delete a robot from the world."""

    types: ClassVar[tuple[str, ...]] = ('delete',)
    id: int
    simulator: str
    name: str


@dataclass(frozen=True, slots=True)
class Switch:
    """Activate and deactivate controllers."""

    types: ClassVar[tuple[str, ...]] = ('switch',)
    id: int
    robot: str
    activate: tuple[str, ...]
    deactivate: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class DeactivateDrive:
    """Deactivate the controllers that drive a stopped robot, until it is released."""

    types: ClassVar[tuple[str, ...]] = ('deactivate_drive',)
    id: int
    robot: str


@dataclass(frozen=True, slots=True)
class Definition:
    """Ask what a message, a request of a service or a goal has: FieldInfo of each field."""

    types: ClassVar[tuple[str, ...]] = ('definition',)
    id: int
    message: str  #: the type of it, or of the service or action: "geometry_msgs/msg/Twist"


@dataclass(frozen=True, slots=True)
class Publish:
    """
    Publish a message, once or at a rate: until ``unpublish``, or the end of this page.

    Another one of the same topic takes the place of the first. A velocity command is refused while
    a stop holds.
    """

    types: ClassVar[tuple[str, ...]] = ('publish',)
    id: int
    topic: str
    message: str  #: its type
    #: of the fields that are not their defaults; "now" is a time, "auto" a header
    values: Mapping[str, Any]
    rate: Rate = 0.0  #: Hz; 0: once


@dataclass(frozen=True, slots=True)
class Unpublish:
    """Publish no more what this page publishes at a rate."""

    types: ClassVar[tuple[str, ...]] = ('unpublish',)
    id: int
    topic: str


@dataclass(frozen=True, slots=True)
class ListParameters:
    """Ask for the parameters of a node: ParameterInfo of each."""

    types: ClassVar[tuple[str, ...]] = ('parameters',)
    id: int
    node: str


@dataclass(frozen=True, slots=True)
class SetParameter:
    """Set a parameter of a node."""

    types: ClassVar[tuple[str, ...]] = ('set_parameter',)
    id: int
    node: str
    name: str
    kind: str  #: as in ParameterInfo: the value is converted to it
    value: Any


@dataclass(frozen=True, slots=True)
class SetGoal:
    """
    Have a robot navigate to a pose: by its action where there is one, else by its topic of goals.

    Refused while a stop holds the robot, which also cancels the goals that pages gave.
    """

    types: ClassVar[tuple[str, ...]] = ('set_goal',)
    id: int
    robot: str
    frame: str  #: of TF, by the name that the states have it by
    x: float  #: m
    y: float
    yaw: float  #: rad


@dataclass(frozen=True, slots=True)
class CancelGoal:
    """Cancel the goal that a page, this or another one, gave to a robot."""

    types: ClassVar[tuple[str, ...]] = ('cancel_goal',)
    id: int
    robot: str


@dataclass(frozen=True, slots=True)
class SetInitialPose:
    """Tell who localises a robot where it is, as RViz does: about 0.5 m and 15 degrees."""

    types: ClassVar[tuple[str, ...]] = ('set_initial_pose',)
    id: int
    robot: str
    frame: str  #: of TF, by the name that the states have it by
    x: float  #: m
    y: float
    yaw: float  #: rad


@dataclass(frozen=True, slots=True)
class OverviewData:
    """What ``overview`` is answered; the layout is that of its states, not of the one shown."""

    states: str  #: binary states one after the other, all of one length, in base64
    count: int
    layout: int  #: the id of their layout
    frames: tuple[FrameInfo, ...]
    robots: tuple[RobotLayout, ...]


SimulatorRequest: TypeAlias = (
    Play | Step | ResetSimulation | SetFactor | Spawn | LoadWorld | Place | ResetEntity | Delete
)
"""What a simulator is asked."""
Request: TypeAlias = (
    SimulatorRequest
    | SetUp
    | Switch
    | DeactivateDrive
    | Definition
    | Publish
    | Unpublish
    | ListParameters
    | SetParameter
    | SetGoal
    | CancelGoal
    | SetInitialPose
    | BagRequest
    | CallRequest
)
"""Messages with an ``id``, which get a reply."""
ClientMessage: TypeAlias = Drive | Stop | PressStop | Release | SetJoints | Push | Watch | Request
"""A text frame from a page."""

MESSAGES: tuple[type[ClientMessage], ...] = get_args(ClientMessage)
_BY_TYPE = {name: message for message in MESSAGES for name in message.types}


def decode(frame: str) -> ClientMessage:
    """Return the message of a text frame. Raises ProtocolError."""
    try:
        found = json.loads(frame)
    except (ValueError, RecursionError) as error:
        raise ProtocolError(f'a frame is no JSON: {error}') from None
    kind = found.get('type') if isinstance(found, dict) else None
    message = _BY_TYPE.get(kind) if isinstance(kind, str) else None
    if message is None:
        known = ', '.join(_BY_TYPE)
        raise ProtocolError(f'a frame of type {_show(kind)} is not known; there are: {known}')
    values = {
        each.name: _value(found, each.name, _READERS[each.type], str(kind))
        for each in fields(message)
        if each.name in found or each.default is each.default_factory is MISSING
    }
    return message(**values)


def _value(found: dict[str, Any], name: str, read: Callable[[Any], Any], kind: str) -> Any:
    if name not in found:
        raise ProtocolError(f"'{kind}' lacks '{name}'")
    try:
        return read(found[name])
    except (ValueError, TypeError, OverflowError):
        raise ProtocolError(f"'{name}' of '{kind}' cannot be {_show(found[name])}") from None


def _text(value: Any) -> str:
    if not isinstance(value, str) or not value.isprintable():
        raise ValueError
    return value


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError
    return float(value)


def _truth(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ValueError
    return value


def _speed(value: Any) -> float:
    if abs(value := _number(value)) > _FASTEST:
        raise ValueError
    return value


def _rate(value: Any) -> float:
    if not 0.0 <= (value := _number(value)) <= _HIGHEST_RATE:
        raise ValueError
    return value


def _any(value: Any) -> Any:
    return value


def _object(value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise ValueError
    return value


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= _LARGEST_ID:
        raise ValueError
    return value


def _vector(value: Any) -> Vector:
    x, y, z = _items(value)
    return (_number(x), _number(y), _number(z))


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(_text(each) for each in _items(value))


def _parts(value: Any) -> tuple[Part, ...]:
    if not all(each in PARTS for each in _items(value)):
        raise ValueError
    return tuple(value)


def _items(value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise ValueError
    return value


def _numbers(value: Any) -> dict[str, float]:
    if not isinstance(value, dict):
        raise ValueError
    return {_text(key): _number(each) for key, each in value.items()}


def _paths(value: Any) -> dict[str, tuple[str, ...]]:
    if not isinstance(value, dict) or len(value) > MOST_TOPICS:
        raise ValueError
    paths = {_text(key): _texts(each) for key, each in value.items()}
    if sum(map(len, paths.values())) > MOST_FIELDS:
        raise ValueError
    return paths


def _document_or_none(value: Any) -> str | None:
    if value is not None and not isinstance(value, str):
        raise ValueError
    return value


def _text_or_none(value: Any) -> str | None:
    return None if value is None else _text(value)


def _show(value: Any) -> str:
    return quote(value) if isinstance(value, str) else repr(value)[:_SHOWN]


_READERS: Mapping[Any, Callable[[Any], Any]] = {
    str: _text,
    int: _whole,
    float: _number,
    bool: _truth,
    Speed: _speed,
    Rate: _rate,
    Any: _any,
    Mapping[str, Any]: _object,
    str | None: _text_or_none,
    Document | None: _document_or_none,
    Vector: _vector,
    tuple[str, ...]: _texts,
    tuple[Part, ...]: _parts,
    Mapping[str, float]: _numbers,
    Mapping[str, tuple[str, ...]]: _paths,
}
"""By the type of a field."""
