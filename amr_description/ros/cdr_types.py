# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How the messages of any type are laid out in plain CDR (see :mod:`amr_description.ros.cdr`).

A :class:`Layout` is made once of a message class. It tells where what follows a field begins: the
size of a part without strings and sequences depends on nothing but where it begins, modulo 8.

This module imports no rclpy.
"""

from dataclasses import dataclass
from functools import cache
import importlib
from typing import Any, TypeAlias

from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)

ALIGNMENT = 8
"""Bytes; no number is larger."""
CODES = {
    'boolean': '?',
    'octet': 'B',
    'char': 'B',
    'int8': 'b',
    'uint8': 'B',
    'int16': 'h',
    'uint16': 'H',
    'int32': 'i',
    'uint32': 'I',
    'int64': 'q',
    'uint64': 'Q',
    'float': 'f',
    'double': 'd',
}
"""Of ``struct``, by rclpy's name of the type."""
_SIZES = {'?': 1, 'B': 1, 'b': 1, 'h': 2, 'H': 2, 'i': 4, 'I': 4, 'q': 8, 'Q': 8, 'f': 4, 'd': 8}

Advance: TypeAlias = tuple[int, ...]
"""Bytes from where a part may begin to behind it, by where that is, modulo 8."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number, or a truth; ``code`` is that of ``struct``, ``name`` the type as ROS has it."""

    code: str
    name: str

    @property
    def size(self) -> int:
        """Bytes, to which it is aligned, too."""
        return _SIZES[self.code]

    @property
    def advance(self) -> Advance:
        """See :data:`Advance`."""
        return tuple(-at % self.size + self.size for at in range(ALIGNMENT))


@dataclass(frozen=True, slots=True)
class Text:
    """
    A string.

    Of a ``wstring``, each unit of UTF-16 takes ``width`` bytes as Fast DDS writes it, and no zero
    ends it.
    """

    width: int = 1

    @property
    def is_wide(self) -> bool:
        """Whether it is a ``wstring``."""
        return self.width > 1

    @property
    def advance(self) -> None:
        """It has no size of its own."""
        return


@dataclass(frozen=True, slots=True)
class Group:
    """A message: its type, its fields in their order, and what that makes (:data:`Advance`)."""

    name: str
    fields: tuple[tuple[str, 'Layout'], ...]
    advance: Advance | None

    def field(self, name: str) -> 'Layout | None':
        """Return a field; None: there is none of that name."""
        return dict(self.fields).get(name)


@dataclass(frozen=True, slots=True)
class Many:
    """An array of ``count`` elements; None: a sequence, whose length precedes it."""

    element: 'Layout'
    count: int | None
    advance: Advance | None


Layout: TypeAlias = Number | Text | Group | Many


_HIDDEN = Number('B', 'uint8')
"""The only member of a message without fields, which has no name in Python."""


@cache
def layout_of(message_type: Any) -> Group:
    """Return the layout of the messages of a class."""
    module, name = message_type.__module__.split('.')[0], message_type.__name__
    slots = zip(message_type.get_fields_and_field_types(), message_type.SLOT_TYPES, strict=True)
    fields = tuple((field, _layout(slot)) for field, slot in slots)
    parts = [layout for _, layout in fields] or [_HIDDEN]
    return Group(f'{module}/msg/{name}', fields, _sum(parts))


def advance_by(element: Advance, at: int, count: int) -> int:
    """Return where so many elements of fixed size end that begin at ``at``."""
    seen: dict[int, tuple[int, int]] = {}
    done = 0
    while done < count:
        phase = at % ALIGNMENT
        if phase in seen:  # the pattern of their alignment begins anew
            done_0, at_0 = seen[phase]
            cycles, seen = (count - done) // (done - done_0), {}
            at, done = at + cycles * (at - at_0), done + cycles * (done - done_0)
            if done == count:
                break
            phase = at % ALIGNMENT
        else:
            seen[phase] = done, at
        at, done = at + element[phase], done + 1
    return at


def _layout(slot: Any) -> Layout:
    if isinstance(slot, BasicType):
        return Number(CODES[slot.typename], slot.typename)
    if isinstance(slot, AbstractString):
        return Text()
    if isinstance(slot, AbstractWString):
        return Text(width=4)
    if isinstance(slot, NamespacedType):
        module = importlib.import_module('.'.join(slot.namespaces))
        return layout_of(getattr(module, slot.name))
    assert isinstance(slot, AbstractNestedType), f'{slot} is no type of a field'
    element = _layout(slot.value_type)
    if not isinstance(slot, Array):
        return Many(element, None, None)
    return Many(element, slot.size, _times(element.advance, slot.size))


def _sum(parts: list[Layout]) -> Advance | None:
    """Return what parts one after the other make; None where one has no fixed size."""
    total = [0] * ALIGNMENT
    for part in parts:
        advance = part.advance
        if advance is None:
            return None
        total = [size + advance[(at + size) % ALIGNMENT] for at, size in enumerate(total)]
    return tuple(total)


def _times(advance: Advance | None, count: int) -> Advance | None:
    if advance is None:
        return None
    return tuple(advance_by(advance, at, count) - at for at in range(ALIGNMENT))
