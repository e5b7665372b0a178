# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of any type as trees for JSON, of bounded size, read without making messages of them.

A message is an object by its fields, in their order; numbers, truths, strings and arrays are what
they are in JSON. What JSON cannot say, or what is too long, is an object with keys that begin with
``#``, as no field does:

- ``{"#number": "NaN"}``, also ``"Infinity"`` and ``"-Infinity"``; and integers beyond 2^53, which
  JavaScript cannot hold: ``{"#number": "18446744073709551615"}``;
- ``{"#length": 921600, "#first": […]}``: an array of that length, of which these come first;
- ``{"#length": 48211, "#text": "…"}``: a string of that many bytes, of which this comes first.
"""

import math
import struct
from typing import Any

from amr_description.cdr.cursor import BEGIN, Cursor, ORDERS
from amr_description.cdr.layouts import FieldGroup, Layout, Many, Number, Text

MOST_NUMBERS = 64
"""Of an array of numbers, or of strings."""
MOST_MESSAGES = 16
"""Of an array of messages."""
MOST_TEXT = 4096
"""Bytes of a string."""
MOST_LEAVES = 3000
"""Numbers and strings of a message; what comes later is shortened to nothing."""
_EXACT = 2**53


def read_tree(layout: FieldGroup, data: bytes) -> dict[str, Any]:
    """Return a message as a tree. Raises ValueError: it is broken."""
    try:
        return _TreeReader(data).group(layout)
    except struct.error as error:
        raise ValueError(f'{len(data)} bytes end within a message: {error}') from None


class _TreeReader(Cursor):
    """Reads one part after the other."""

    def __init__(self, data: bytes) -> None:
        super().__init__(data)
        self._left = MOST_LEAVES

    def group(self, layout: FieldGroup) -> dict[str, Any]:
        if not layout.fields:
            self.skip(layout)  # it has one byte
        return {name: self._part(field) for name, field in layout.fields}

    def _part(self, layout: Layout) -> Any:
        match layout:
            case Number():
                return self._numbers(layout, 1)[0]
            case Text():
                return self._text(layout)
            case FieldGroup():
                return self.group(layout)
            case Many():
                return self._many(layout)

    def _numbers(self, layout: Number, count: int) -> list[Any]:
        """Read so many numbers, at least one."""
        self._left -= count
        begin = self.align(layout)
        self.at += count * layout.size
        form = f'{ORDERS[self.order]}{count}{layout.code}'
        return [_json(each) for each in struct.unpack_from(form, self.data, BEGIN + begin)]

    def _text(self, layout: Text) -> Any:
        self._left -= 1
        count = self.count()
        begin = BEGIN + self.at
        self.go(count * layout.width)
        kept = min(count * layout.width, MOST_TEXT if self._left >= 0 else 0)
        if layout.is_wide:
            units = struct.unpack_from(
                f'{ORDERS[self.order]}{kept // layout.width}I', self.data, begin
            )
            octets = struct.pack(f'<{len(units)}H', *(unit & 0xFFFF for unit in units))
            shown = octets.decode('utf-16-le', 'replace')
        else:
            octets = self.data[begin : begin + kept]
            shown = octets.removesuffix(b'\0').decode('utf-8', 'replace')
        is_whole = kept == count * layout.width
        return shown if is_whole else {'#length': count, '#text': shown}

    def _many(self, layout: Many) -> Any:
        count, element = layout.count, layout.element
        if count is None:
            count = self.count()
        most = MOST_MESSAGES if isinstance(element, FieldGroup | Many) else MOST_NUMBERS
        shown = min(count, most, max(self._left, 0))
        if isinstance(element, Number):
            first = self._numbers(element, shown) if shown else []
        else:
            first = [self._part(element) for _ in range(shown)]
        if shown == count:
            return first
        self.skip_elements(element, count - shown)
        return {'#length': count, '#first': first}


def _json(value: float) -> Any:
    if isinstance(value, float):
        if math.isfinite(value):
            return value
        return {'#number': 'NaN' if math.isnan(value) else f'{"-" * (value < 0)}Infinity'}
    return value if -_EXACT <= value <= _EXACT else {'#number': str(value)}
