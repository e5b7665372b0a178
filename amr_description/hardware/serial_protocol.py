# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The line protocol between a robot computer (the host) and a motor board with two sides, version 1.

This is the specification for a firmware, and the code that reads and writes the messages, for both
ends, without a port or a clock. **A line** is ASCII, at most 96 bytes including its line feed::

    $<word>,<field>,…*<CRC>

The CRC is CRC-16/CCITT-FALSE (polynomial 0x1021, start 0xFFFF; ``123456789`` gives ``29B1``) of
the bytes between ``$`` and ``*``, as four upper-case hexadecimal digits. Any other line is refused
as a whole; an empty line is ignored. A line feed always starts a new line, so the host sends one
before its first message.

========================================  =========================================================
from the host                             the board
========================================  =========================================================
``HELLO,<number>,<version>``              answers ``BOARD``
``GET,<number>``                          answers ``STATE``
``ARM,<number>,<watchdog>``               unless in FAULT, powers the motors at 0 rad/s and goes to
                                          ARMED; answers ``STATE``. ``watchdog``: 20 to 5000 ms
``SET,<number>,<left>,<right>``           in ARMED or TIMEOUT, follows these target velocities and
                                          goes to ARMED; answers ``STATE``
``DISARM,<number>``                       brakes and goes to IDLE, from FAULT if the fault is over;
                                          answers ``STATE``
========================================  =========================================================

========================================  =========================================================
from the board                            meaning
========================================  =========================================================
``BOARD,<number>,<version>,<name>,``      identification. ``ticks``: of the encoder, per turn of
``<ticks>,<velocity>``                    the motor shaft; ``velocity``: the greatest of ``SET``,
                                          rad/s
``STATE,<number>,<uptime>,``              ms since its start; encoder counts, growing as the motor
``<left ticks>,<right ticks>,``           turns forward; measured velocities, rad/s; mode
``<left>,<right>,<mode>``
``ERROR,<reason>``                        a line was refused, and nothing was changed
========================================  =========================================================

The board only answers. Every valid line has exactly one answer, with the ``number`` of its
request, so that no old answer is taken for a new one. A state is as old as its request: a host
that asks periodically gets periodic samples.

**The watchdog.** If the board is ARMED and receives no valid ``SET`` for ``watchdog`` ms, it
brakes and goes to TIMEOUT. The next valid ``SET`` makes it go on. No other message resets the
watchdog: the robot stops if the host's program hangs, even if its driver still asks for states.

Fields: velocities are of the motor shafts, rad/s, with four digits after the point (``-12.5000``).
``uptime`` is an unsigned, a tick count a signed 32-bit number; both wrap around. ``number`` and
``version`` have 16 bits. A name has 1 to 16 letters, digits, ``-`` or ``_``. Modes and reasons:
:class:`BoardMode`, :class:`Reason`. A board of another version answers ``HELLO`` too, with its own
version.
"""

import binascii
from collections.abc import Callable
from dataclasses import dataclass, fields
from enum import StrEnum
import math
import re
from typing import Any, TypeAlias

from amr_description.errors import HardwareError

VERSION = 1
LONGEST_LINE = 96
"""bytes, including the line feed."""
SHORTEST_WATCHDOG, LONGEST_WATCHDOG = 20, 5000
"""ms."""
GREATEST_VELOCITY = 10_000.0
"""rad/s: the greatest in a line."""


class BoardMode(StrEnum):
    """The mode of a board."""

    IDLE = 'IDLE'
    """The motors have no power, as after the start."""
    ARMED = 'ARMED'
    """The motors follow ``SET``."""
    TIMEOUT = 'TIMEOUT'
    """The watchdog has stopped the motors."""
    FAULT = 'FAULT'
    """The board has stopped the motors: over-current, over-temperature, a missing encoder."""


class Reason(StrEnum):
    """Why a line was refused."""

    CHECKSUM = 'CHECKSUM'
    """Not a line, too long, or a wrong CRC: noise, or the wrong baud rate."""
    MESSAGE = 'MESSAGE'
    """An unknown word, or wrong fields."""
    RANGE = 'RANGE'
    """A number out of range."""


@dataclass(frozen=True, slots=True)
class Hello:
    """``HELLO``."""

    number: int
    version: int


@dataclass(frozen=True, slots=True)
class Get:
    """``GET``."""

    number: int


@dataclass(frozen=True, slots=True)
class Arm:
    """``ARM``; ``watchdog`` in ms."""

    number: int
    watchdog: int


@dataclass(frozen=True, slots=True)
class Set:
    """``SET``; rad/s."""

    number: int
    left: float
    right: float


@dataclass(frozen=True, slots=True)
class Disarm:
    """``DISARM``."""

    number: int


@dataclass(frozen=True, slots=True)
class Board:
    """``BOARD``; ``ticks`` per turn, ``velocity`` in rad/s."""

    number: int
    version: int
    name: str
    ticks: int
    velocity: float


@dataclass(frozen=True, slots=True)
class State:
    """``STATE``; ``uptime`` in ms, velocities in rad/s."""

    number: int
    uptime: int
    left_ticks: int
    right_ticks: int
    left: float
    right: float
    mode: BoardMode


@dataclass(frozen=True, slots=True)
class Error:
    """``ERROR``."""

    reason: Reason


Request: TypeAlias = Hello | Get | Arm | Set | Disarm
Answer: TypeAlias = Board | State | Error
Message: TypeAlias = Request | Answer


@dataclass(frozen=True, slots=True)
class Refused:
    """An invalid line, without its line feed; the beginning of one that is too long."""

    line: bytes
    reason: Reason


@dataclass(frozen=True, slots=True)
class _Field:
    """How a value is written, and read from a text that matches ``pattern``."""

    pattern: str
    read: Callable[[str], Any]
    write: Callable[[Any], str]


def _integer(low: int, high: int) -> _Field:
    def checked(value: int) -> int:
        if low <= value <= high:
            return value
        raise HardwareError(f'{value} is no field of a line; it must be from {low} to {high}')

    return _Field('-?[0-9]{1,10}', lambda text: checked(int(text)), lambda n: str(checked(n)))


def _checked_velocity(value: float) -> float:
    if math.isfinite(value) and abs(value) <= GREATEST_VELOCITY:
        return round(value, 4) + 0.0  # + 0.0 makes 0.0 of -0.0
    raise HardwareError(
        f'{value} rad/s is no field of a line; it must be finite and at most {GREATEST_VELOCITY:g}'
    )


def _text(pattern: str, kind: type[str] = str) -> _Field:
    def checked(value: str) -> str:
        if re.fullmatch(pattern, value):
            return kind(value)
        raise HardwareError(f'{value!r} is no field of a line; it must match {pattern}')

    return _Field(pattern, checked, checked)


_U16 = _integer(0, 2**16 - 1)
_U32 = _integer(0, 2**32 - 1)
_I32 = _integer(-(2**31), 2**31 - 1)
_VELOCITY = _Field(
    '-?[0-9]{1,5}[.][0-9]{4}',
    lambda text: _checked_velocity(float(text)),
    lambda value: f'{_checked_velocity(value):.4f}',
)

_LAYOUTS: dict[type[Message], tuple[_Field, ...]] = {
    Hello: (_U16, _U16),
    Get: (_U16,),
    Arm: (_U16, _U16),
    Set: (_U16, _VELOCITY, _VELOCITY),
    Disarm: (_U16,),
    Board: (_U16, _U16, _text('[A-Za-z0-9_-]{1,16}'), _U32, _VELOCITY),
    State: (_U16, _U32, _I32, _I32, _VELOCITY, _VELOCITY, _text('|'.join(BoardMode), BoardMode)),
    Error: (_text('|'.join(Reason), Reason),),
}
_BY_WORD = {kind.__name__.upper(): (kind, layout) for kind, layout in _LAYOUTS.items()}
_FRAME = re.compile(rb'[$]([!-~]*)[*]([0-9A-F]{4})')


def encode(message: Message) -> bytes:
    """Return the line of a message. Raises HardwareError where a value has no place in it."""
    values = [getattr(message, field.name) for field in fields(message)]
    layout = _LAYOUTS[type(message)]
    texts = [field.write(value) for field, value in zip(layout, values, strict=True)]
    body = ','.join([type(message).__name__.upper(), *texts]).encode('ascii')
    return b'$%b*%04X\n' % (body, _crc(body))


def decode(line: bytes) -> Message | Refused:
    """Read one line, given without its line feed."""
    frame = _FRAME.fullmatch(line)
    if frame is None or len(line) >= LONGEST_LINE or int(frame[2], 16) != _crc(frame[1]):
        return Refused(line[:LONGEST_LINE], Reason.CHECKSUM)
    word, *texts = frame[1].decode('ascii').split(',')
    kind, layout = _BY_WORD.get(word, (None, ()))
    if kind is None or len(texts) != len(layout):
        return Refused(line, Reason.MESSAGE)
    pairs = list(zip(layout, texts, strict=True))
    if not all(re.fullmatch(field.pattern, text) for field, text in pairs):
        return Refused(line, Reason.MESSAGE)
    try:
        return kind(*(field.read(text) for field, text in pairs))
    except HardwareError:
        return Refused(line, Reason.RANGE)


def _crc(data: bytes) -> int:
    return binascii.crc_hqx(data, 0xFFFF)


class LineReader:
    """Splits a stream of bytes into messages and refused lines."""

    def __init__(self) -> None:
        self._line = bytearray()

    def feed(self, data: bytes) -> list[Message | Refused]:
        """Return the lines that are complete, oldest first."""
        *ended, started = data.split(b'\n')
        found = []
        for piece in ended:
            self._append(piece)
            if self._line:
                found.append(decode(bytes(self._line)))
            self._line.clear()
        self._append(started)
        return found

    def _append(self, piece: bytes) -> None:
        """Keep only as much of a line as shows that it is too long."""
        self._line += piece[: LONGEST_LINE - len(self._line)]
