# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A place in a serialized message (:mod:`amr_description.cdr`), which goes on from part to part.
"""

import struct

from amr_description.cdr.layouts import (
    advance_by,
    ALIGNMENT,
    FieldGroup,
    Layout,
    Many,
    Number,
    Text,
)

BEGIN = 4
"""Bytes before the first field."""
ORDERS = '><'
"""Of bytes, as ``struct`` has them: big endian, little endian."""
_COUNTS = tuple(struct.Struct(f'{order}I') for order in ORDERS)


class Cursor:
    """
    A place in a message.

    Its methods raise ValueError or struct.error where the message ends too early.

    Attributes:
        data: The message.
        order: Of its bytes, an index of :data:`ORDERS`.
        at: The place: bytes after the first field begins.
        counts: The places of all lengths of strings and sequences so far.
    """

    def __init__(self, data: bytes) -> None:
        """Begin with the first field. Raises ValueError: these bytes are no plain CDR."""
        if len(data) < BEGIN or data[0] != 0 or data[1] > 1:
            raise ValueError(f'no plain CDR: {data[:BEGIN].hex(" ")}')
        self.data = data
        self.order = data[1]
        self.at = 0
        self.counts: list[int] = []

    def count(self) -> int:
        """Read the length of a string or sequence, and go to what it has."""
        begin = self.at + 3 & ~3
        self.counts.append(begin)
        self.at = begin + 4
        return int(_COUNTS[self.order].unpack_from(self.data, BEGIN + begin)[0])

    def align(self, number: Number) -> int:
        """Go to where a number begins; return that."""
        self.at = self.at + number.size - 1 & -number.size
        return self.at

    def skip(self, layout: Layout) -> None:
        """Go behind a part."""
        match layout:
            case Text(width=width):
                self.go(self.count() * width)
            case FieldGroup(advance=None, fields=fields):
                for _, field in fields:
                    self.skip(field)
            case Many(count=None, element=element):
                self.skip_elements(element, self.count())
            case Many(count=int(count), element=element):
                self.skip_elements(element, count)
            case Number(advance=advance) | FieldGroup(advance=advance) if advance is not None:
                self.at += advance[self.at % ALIGNMENT]
            case _:
                raise AssertionError(layout)

    def skip_elements(self, element: Layout, count: int) -> None:
        """Go behind so many elements of an array or a sequence."""
        if not count:
            return
        if isinstance(element, Number):
            self.align(element)
            self.go(count * element.size)
        elif element.advance is not None:
            if count > len(self.data):
                raise ValueError(f'{len(self.data)} bytes cannot have {count} elements')
            self.go(advance_by(element.advance, self.at, count) - self.at)
        else:
            for _ in range(count):
                self.skip(element)

    def go(self, count: int) -> None:
        """Go on by so many bytes, those of a string or sequence."""
        self.at += count
        if BEGIN + self.at > len(self.data):
            raise ValueError(f'{len(self.data)} bytes end within a string or sequence')
