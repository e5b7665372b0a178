# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Whole messages of any type of their bytes: what the writer of the product is held against."""

from collections.abc import Callable
import struct
from typing import Any

import numpy as np

from amr_description.cdr.cursor import BEGIN, Cursor, ORDERS
from amr_description.cdr.layouts import Group, Layout, Many, Number, Text
from amr_description.messages.definitions import layout_of
from amr_description.messages.plain import PlainMessage


def plain_message(name: str, data: bytes) -> PlainMessage:
    """Return the message of bytes. Raises ValueError or struct.error: they are none."""
    message = PlainMessage(name)
    fill(layout_of(name), data, message, PlainMessage)
    return message


def fill(layout: Group, data: bytes, message: Any, new: Callable[[str], Any]) -> None:
    """
    Read bytes into a message, whose fields are set.

    Args:
        layout: Of the message.
        data: Its bytes.
        message: Gets the fields.
        new: Returns a message, by the name of its type, for those in it.

    Raises:
        ValueError, struct.error: These bytes are no such message.
    """
    _Reader(data, new).into(layout, message)


class _Reader(Cursor):
    def __init__(self, data: bytes, new: Callable[[str], Any]) -> None:
        super().__init__(data)
        self._new = new

    def into(self, layout: Group, message: Any) -> None:
        for name, field in layout.fields:
            setattr(message, name, self._part(field))
        if not layout.fields:
            self.go(1)

    def _part(self, layout: Layout) -> Any:
        match layout:
            case Number():
                return self._numbers(layout, 1)[0]
            case Text():
                return self._text(layout)
            case Group(name=name):
                message = self._new(name)
                self.into(layout, message)
                return message
            case Many(element=element, count=count):
                return self._many(element, self.count() if count is None else count)

    def _many(self, element: Layout, count: int) -> list[Any]:
        if isinstance(element, Number):
            return list(self._numbers(element, count)) if count else []
        if count > len(self.data):
            raise ValueError(f'{len(self.data)} bytes cannot have {count} elements')
        return [self._part(element) for _ in range(count)]

    def _numbers(self, number: Number, count: int) -> tuple[Any, ...]:
        begin = BEGIN + self.align(number)
        self.go(count * number.size)
        return struct.unpack_from(f'{ORDERS[self.order]}{count}{number.code}', self.data, begin)

    def _text(self, layout: Text) -> str:
        length = self.count()
        begin = BEGIN + self.at
        self.go(length * layout.width)
        found = self.data[begin : BEGIN + self.at]
        if not layout.is_wide:
            return found[:-1].decode()
        order = ORDERS[self.order]
        units = np.frombuffer(found, f'{order}u{layout.width}').astype('<u2')
        return units.tobytes().decode('utf-16-le')
