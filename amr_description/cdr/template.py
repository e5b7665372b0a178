# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Serialized messages of which only numbers change, made without making messages.

To read every field of a Python object takes 20 µs for an Odometry, whatever has changed. Of a
message that is sent again and again most is constant: names, frames, covariances. A
:class:`Template` is made once from such a message; then one ``struct.pack``, 1 µs, makes the bytes
of the next one.

The bytes are plain CDR (see :mod:`amr_description.cdr`), little endian. Whether a middleware
at hand writes the same is for the caller to see, once, by :meth:`Template.has_made`.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass
import struct
from typing import Any, NamedTuple

from amr_description.cdr.layouts import FieldGroup, Layout, Many, Number, Text

_ENCAPSULATION = bytes((0, 1, 0, 0))
"""Plain CDR, little endian, no options."""


@dataclass(frozen=True, slots=True)
class Template:
    """
    The bytes of a message with gaps, one for each part that changes.

    ``pack(constants[0], *numbers of the first gap, constants[1], …, constants[-1])`` returns those
    of the next message. It raises ``struct.error``: there are not as many numbers as in the
    message of which this was made.
    """

    pack: Callable[..., bytes]
    constants: tuple[bytes, ...]
    """What is before each gap, and after the last one."""
    padding: frozenset[int]
    """Which bytes only align what follows them: zero here, anything elsewhere."""

    def has_made(self, data: bytes, expected: bytes) -> bool:
        """Return whether these bytes are ``expected``, which may have more at their end."""
        if expected.startswith(data):
            return True
        return len(expected) >= len(data) and all(
            byte == other or at in self.padding
            for at, (byte, other) in enumerate(zip(data, expected, strict=False))
        )


def template_of(
    layout: FieldGroup, message: Any, changing: Collection[str], *, blocks: Collection[str] = ()
) -> Template:
    """
    Return the template of a message.

    Args:
        layout: of the message.
        message: has everything that does not change, and as many numbers as there will be.
        changing: paths of fields, such as ``header.stamp`` and ``transforms.transform``, in any
            order: numbers, messages of numbers, or arrays of numbers. Below an array of messages
            each element has a gap of its own.
        blocks: those of them that are arrays of numbers which will be given as ``bytes``, little
            endian, instead of number by number; of the same length.

    Raises:
        TypeError: a field is of a type that is not supported, or text would change.
    """
    builder = _Builder()
    _add_message(builder, layout, message, '', _Changing(frozenset(changing), frozenset(blocks)))
    builder.begin_gap()
    pack = struct.Struct(builder.format).pack
    return Template(pack, tuple(builder.constants), frozenset(builder.padding))


class _Changing(NamedTuple):
    """Paths of fields."""

    all: frozenset[str]
    blocks: frozenset[str]


class _Builder:
    """Takes the fields in their order."""

    def __init__(self) -> None:
        self.format = '<'
        self.constants: list[bytes] = []
        self.padding: list[int] = []
        self._constant = bytearray(_ENCAPSULATION)
        self._size = 0
        """Of what follows the encapsulation, by which numbers are aligned."""
        self._in_gap = False

    def begin_gap(self) -> None:
        self.format += f'{len(self._constant)}s'
        self.constants.append(bytes(self._constant))
        self._constant.clear()
        self._in_gap = True

    def end_gap(self) -> None:
        self._in_gap = False

    def add(self, code: str, value: Any) -> None:
        if isinstance(value, bytes):  # as rclpy has an octet
            (value,) = value
        width = struct.calcsize(f'<{code}')
        padding = -self._size % width
        begin = len(_ENCAPSULATION) + self._size
        self.padding.extend(range(begin, begin + padding))
        self._size += padding + width
        if self._in_gap:
            self.format += f'{padding}x{code}'
        else:
            self._constant += bytes(padding) + struct.pack(f'<{code}', value)

    def add_block(self, code: str, count: int) -> None:
        """Add numbers that one ``bytes`` object will have."""
        width = struct.calcsize(f'<{code}')
        padding = -self._size % width if count else 0
        begin = len(_ENCAPSULATION) + self._size
        self.padding.extend(range(begin, begin + padding))
        self._size += padding + count * width
        self.format += f'{padding}x{count * width}s'

    def add_text(self, text: str) -> None:
        if self._in_gap:
            raise TypeError('text that changes is not supported')
        data = text.encode() + b'\0'
        self.add('I', len(data))
        self._constant += data
        self._size += len(data)


def _add_message(
    builder: _Builder, layout: FieldGroup, message: Any, prefix: str, changing: _Changing
) -> None:
    for name, part in layout.fields:
        path = f'{prefix}{name}'
        value = getattr(message, name)
        if isinstance(part, Many):
            if part.count is None:
                builder.add('I', len(value))  # which does not change
            part, values = part.element, value
        else:
            values = (value,)
        if path in changing.all:
            builder.begin_gap()
        if path in changing.blocks:
            assert isinstance(part, Number), 'a block is of numbers'
            builder.add_block(part.code, len(values))
            values = ()
        for each in values:
            _add(builder, each, part, path, changing)
        if path in changing.all:
            builder.end_gap()


def _add(builder: _Builder, value: Any, part: Layout, path: str, changing: _Changing) -> None:
    match part:
        case Number(code=code):
            builder.add(code, value)
        case Text(width=1):
            builder.add_text(value)
        case FieldGroup():
            _add_message(builder, part, value, f'{path}.', changing)
        case _:
            raise TypeError(f'{path} is of a type that is not supported: {part}')
