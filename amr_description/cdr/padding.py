# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Serialized messages with zeros where bytes only align numbers, whoever has made them."""

from amr_description.cdr.cursor import BEGIN, Cursor
from amr_description.cdr.layouts import FieldGroup, Layout, Many, Number, Text


def without_padding(layout: FieldGroup, data: bytes) -> bytes:
    """
    Return a serialized message with zeros where bytes only align, or fill the end.

    Raises ValueError, struct.error: these bytes are no such message.
    """
    copy = _PaddingCopy(data)
    copy.part(layout)
    return bytes(copy.made[: BEGIN + copy.at])


class _PaddingCopy(Cursor):
    """Goes through a message and copies what is not padding."""

    def __init__(self, data: bytes) -> None:
        super().__init__(data)
        self.made = bytearray(len(data))
        self.made[:BEGIN] = data[:BEGIN]

    def part(self, layout: Layout) -> None:
        match layout:
            case Number():
                self._numbers(layout, 1)
            case Text(width=width):
                self._copy_to(self._length() * width)
            case FieldGroup(fields=fields):
                for _, field in fields:
                    self.part(field)
                if not fields:  # its only member is hidden
                    self._copy_to(1)
            case Many(element=element, count=count):
                self._many(element, self._length() if count is None else count)

    def _many(self, element: Layout, count: int) -> None:
        if isinstance(element, Number):
            if count:
                self._numbers(element, count)
            return
        for _ in range(count):
            self.part(element)

    def _numbers(self, number: Number, count: int) -> None:
        self.align(number)
        self._copy_to(number.size * count)

    def _length(self) -> int:
        length = self.count()
        begin = BEGIN + self.at
        self.made[begin - 4 : begin] = self.data[begin - 4 : begin]
        return length

    def _copy_to(self, size: int) -> None:
        """Copy so many bytes from here on, and go behind them."""
        begin = BEGIN + self.at
        self.go(size)
        self.made[begin : begin + size] = self.data[begin : begin + size]
