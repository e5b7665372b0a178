# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages to bytes and back, for both ends of :mod:`amr_description.hardware.serial_protocol`.

Pure: no port, no clock.
"""

import binascii
from collections.abc import Callable
from dataclasses import dataclass, fields
import math
import re
from typing import Any

from amr_description.errors import HardwareError
from amr_description.hardware.serial_protocol import (
    Arm,
    Board,
    Disarm,
    Error,
    Get,
    GREATEST_VELOCITY,
    Hello,
    LONGEST_LINE,
    Message,
    Mode,
    Reason,
    Refused,
    Set,
    State,
)


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
