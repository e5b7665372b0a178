# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How messages are laid out in plain CDR (see :mod:`amr_description.cdr`).

A layout is made once of a type of messages. It tells where what follows a field begins: the
size of a part without strings and sequences depends on nothing but where it begins, modulo 8.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

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
class FieldGroup:
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


Layout: TypeAlias = Number | Text | FieldGroup | Many


_HIDDEN = Number('B', 'uint8')
"""The only member of a message without fields, which has no name in Python."""


def group(name: str, fields: Sequence[tuple[str, Layout]]) -> FieldGroup:
    """Return the layout of a message of these fields, by the name of its type."""
    parts = [layout for _, layout in fields] or [_HIDDEN]
    return FieldGroup(name, tuple(fields), _sum(parts))


def many(element: Layout, count: int | None) -> Many:
    """Return the layout of an array of ``count`` elements; None: of a sequence."""
    return Many(element, count, None if count is None else _times(element.advance, count))


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
