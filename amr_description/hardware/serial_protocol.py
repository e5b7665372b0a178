# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The line protocol between a robot computer (the host) and a motor board with two sides, version 1.

All that a firmware has to know stands here; :mod:`amr_description.hardware.serial_protocol` reads
and writes it. **A line** is ASCII, at most 96 bytes with the line feed that ends it::

    $<word>,<field>,…*<CRC>

The CRC is CRC-16/CCITT-FALSE (polynomial 0x1021, start 0xFFFF; ``123456789`` gives ``29B1``) of
all between ``$`` and ``*``, as four upper-case hexadecimal digits. A line that departs from this
in anything is refused whole; an empty line says nothing. Whatever went wrong, the next line feed
puts things right, so the host sends one before its first word.

========================================  =========================================================
from the host                             the board
========================================  =========================================================
``HELLO,<number>,<version>``              answers ``BOARD``
``GET,<number>``                          answers ``STATE``
``ARM,<number>,<watchdog>``               but in FAULT powers the motors at 0 rad/s and goes to
                                          ARMED; answers ``STATE``. ``watchdog``: 20 to 5000 ms
``SET,<number>,<left>,<right>``           in ARMED or TIMEOUT follows these target velocities and
                                          goes to ARMED; answers ``STATE``, whose mode tells
``DISARM,<number>``                       brakes and goes to IDLE, from FAULT if the fault is over;
                                          answers ``STATE``
========================================  =========================================================

========================================  =========================================================
from the board                            meaning
========================================  =========================================================
``BOARD,<number>,<version>,<name>,``      who it is. ``ticks``: of the encoder, per turn of the
``<ticks>,<velocity>``                    motor shaft; ``velocity``: the greatest that ``SET`` may
                                          ask for, rad/s
``STATE,<number>,<uptime>,``              ms since its start; encoder counts, growing as the motor
``<left ticks>,<right ticks>,``           turns forward; measured velocities, rad/s; mode
``<left>,<right>,<mode>``
``ERROR,<reason>``                        a line was refused, and nothing was changed
========================================  =========================================================

The board says nothing by itself. Every good line has exactly one answer, with the ``number`` of
its question, so that no old answer is taken for a new one. What the host reads is as old as its
question: a host that asks in its own rhythm gets samples in that rhythm.

**The watchdog.** When the board is ARMED and for ``watchdog`` ms no ``SET`` came that it could
follow, it brakes and goes to TIMEOUT. The next good ``SET`` makes it go on. Nothing else feeds it:
a host whose program hangs stops, even if its driver still asks for states.

Fields: velocities are of the motor shafts, rad/s, with four digits after the point (``-12.5000``).
``uptime`` is an unsigned, a tick count a signed 32-bit number; both wrap around. ``number`` and
``version`` have 16 bits. A name has 1 to 16 letters, digits, ``-`` or ``_``. Modes and reasons:
:class:`Mode`, :class:`Reason`. A board that is of another version answers ``HELLO`` all the same,
with its own version.

Messages to bytes and back, for both ends of :mod:`amr_description.hardware.serial_protocol`.

Pure: no port, no clock.
"""

import binascii
from collections.abc import Callable
from dataclasses import dataclass, fields
from enum import StrEnum
import math
import re
from typing import Any

from amr_description.errors import HardwareError

VERSION = 1
LONGEST_LINE = 96
"""bytes, with the line feed."""
SHORTEST_WATCHDOG, LONGEST_WATCHDOG = 20, 5000
"""ms."""
GREATEST_VELOCITY = 10_000.0
"""rad/s: no line carries more."""


class Mode(StrEnum):
    """What the motors of a board do."""

    IDLE = 'IDLE'
    """Without power, as after its start."""
    ARMED = 'ARMED'
    """They follow ``SET``."""
    TIMEOUT = 'TIMEOUT'
    """The watchdog has stopped them."""
    FAULT = 'FAULT'
    """The board has stopped them: over-current, over-temperature, an encoder that is missing."""


class Reason(StrEnum):
    """Why a line was refused."""

    CHECKSUM = 'CHECKSUM'
    """Not a line, too long a line, or a wrong CRC: noise, or the wrong baud rate."""
    MESSAGE = 'MESSAGE'
    """An unknown word, or fields that do not belong to it."""
    RANGE = 'RANGE'
    """A number beyond its limits."""


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
    mode: Mode


@dataclass(frozen=True, slots=True)
class Error:
    """``ERROR``."""

    reason: Reason


type Question = Hello | Get | Arm | Set | Disarm
type Answer = Board | State | Error
type Message = Question | Answer


@dataclass(frozen=True, slots=True)
class Refused:
    """A line that is none, without its line feed; of one that is too long, the beginning."""

    line: bytes
    reason: Reason


@dataclass(frozen=True, slots=True)
class _Field:
    """How a value is written, and read from a text that ``pattern`` matches."""

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
    State: (_U16, _U32, _I32, _I32, _VELOCITY, _VELOCITY, _text('|'.join(Mode), Mode)),
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
    """Turns bytes, in whatever pieces they come, into messages and refused lines."""

    def __init__(self) -> None:
        self._begun = bytearray()

    def feed(self, data: bytes) -> list[Message | Refused]:
        """Return what has become complete, oldest first."""
        *ended, begun = data.split(b'\n')
        found = []
        for piece in ended:
            self._grow(piece)
            if self._begun:
                found.append(decode(bytes(self._begun)))
            self._begun.clear()
        self._grow(begun)
        return found

    def _grow(self, piece: bytes) -> None:
        """Of a line that is too long, keep as much as shows that it is."""
        self._begun += piece[: LONGEST_LINE - len(self._begun)]
