# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages from pages, validated: a text frame becomes a frozen dataclass, or a ProtocolError says
what is wrong with it. ``web/src/protocol.ts`` documents each message.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, MISSING
import json
import math
from typing import Any, ClassVar, get_args, Literal

from amr_description.errors import ProtocolError
from amr_description.model.frames import Vector
from amr_description.text import quote

_LARGEST_ID = 2**53  # up to here JavaScript's numbers are exact integers
_SHOWN = 80  # characters of a value that an error quotes
_FASTEST = 100.0  # m/s or rad/s; no wheeled robot is faster

type Speed = float
"""m/s or rad/s; its own type, because it has a limit."""
type Part = Literal['wheels']
"""A part of a state that is collected only while a page shows it."""
PARTS: tuple[Part, ...] = get_args(Part.__value__)


@dataclass(frozen=True, slots=True)
class Drive:
    """Move a robot: m/s ahead, rad/s to the left, and m/s to the left if its wheels can."""

    types: ClassVar[tuple[str, ...]] = ('drive',)
    robot: str
    linear: Speed
    angular: Speed
    sideways: Speed = 0.0


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop a robot; None: all robots."""

    types: ClassVar[tuple[str, ...]] = ('stop',)
    robot: str | None


@dataclass(frozen=True, slots=True)
class SetJoints:
    """Move joints by joint_state_publisher, or by active controllers, rad or m."""

    types: ClassVar[tuple[str, ...]] = ('set_joints',)
    robot: str
    positions: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Watch:
    """
    What the page shows from now on of what is collected on demand.

    ``parts``: of the states, beyond those that every state has; ``topics``: of sensors.
    """

    types: ClassVar[tuple[str, ...]] = ('watch',)
    parts: tuple[Part, ...]
    topics: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Play:
    """Run the simulation, or (type ``pause``) pause it."""

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
    """Set the real-time factor; 0: as fast as possible."""

    types: ClassVar[tuple[str, ...]] = ('set_factor',)
    id: int
    simulator: str
    factor: float


@dataclass(frozen=True, slots=True)
class Spawn:
    """Spawn a robot with the description of robot ``like``; position in m, yaw in rad."""

    types: ClassVar[tuple[str, ...]] = ('spawn',)
    id: int
    simulator: str
    name: str
    namespace: str
    position: Vector
    yaw: float
    like: str


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


type Request = Play | Step | ResetSimulation | SetFactor | Spawn | Delete | Switch
"""Messages with an ``id``, which get a reply."""
type ClientMessage = Drive | Stop | SetJoints | Watch | Request

REQUESTS = (Play, Step, ResetSimulation, SetFactor, Spawn, Delete, Switch)
MESSAGES = (Drive, Stop, SetJoints, Watch, *REQUESTS)
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
        field.name: _value(found, field.name, _READERS[field.type], kind)
        for field in fields(message)
        if field.name in found or field.default is MISSING
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


def _speed(value: Any) -> float:
    if abs(value := _number(value)) > _FASTEST:
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


def _text_or_none(value: Any) -> str | None:
    return None if value is None else _text(value)


def _show(value: Any) -> str:
    return quote(value) if isinstance(value, str) else repr(value)[:_SHOWN]


_READERS: Mapping[Any, Callable[[Any], Any]] = {
    str: _text,
    int: _whole,
    float: _number,
    Speed: _speed,
    str | None: _text_or_none,
    Vector: _vector,
    tuple[str, ...]: _texts,
    tuple[Part, ...]: _parts,
    Mapping[str, float]: _numbers,
}
"""By the type of a field."""
