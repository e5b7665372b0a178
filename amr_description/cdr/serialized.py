# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of any type as their bytes, and back.

A message is any object with its fields as attributes. What aligns numbers is zero, so that equal
messages have equal bytes, those that :func:`amr_description.ros.layouts.serialize` makes of
messages of rclpy.
"""

from collections.abc import Callable, Sequence
import struct
from typing import Any

import numpy as np

from amr_description.cdr.cursor import BEGIN, Cursor, ORDERS
from amr_description.cdr.layouts import FieldGroup, Layout, Many, Number, Text

_HEAD = b'\0\1\0\0'
"""Plain CDR, little endian."""
_ORDER = '<'
_COUNT = struct.Struct('<I')


def serialized(layout: FieldGroup, message: Any) -> bytes:
    """
    Return the bytes of a message.

    Raises struct.error, TypeError, AttributeError: a value does not fit its field.
    """
    data = bytearray(_HEAD)
    _put(data, layout, message)
    return bytes(data)


def _put(data: bytearray, layout: Layout, value: Any) -> None:
    match layout:
        case Number():
            _put_numbers(data, layout, (value,))
        case Text():
            _put_text(data, layout, value)
        case FieldGroup(fields=fields):
            for name, field in fields:
                _put(data, field, getattr(value, name))
            if not fields:  # its only member is hidden
                data.append(0)
        case Many(element=element, count=count):
            if count is None:
                _put_count(data, len(value))
            elif len(value) != count:
                raise struct.error(f'{len(value)} elements where there are {count}')
            if isinstance(element, Number):
                if len(value):
                    _put_numbers(data, element, value)
            else:
                for each in value:
                    _put(data, element, each)


def _put_numbers(data: bytearray, number: Number, values: Sequence[Any]) -> None:
    data += bytes(-(len(data) - BEGIN) % number.size)
    if isinstance(values, bytes | bytearray) and number.size == 1:
        data += values
    elif isinstance(values, np.ndarray):
        data += values.astype(np.dtype(number.code).newbyteorder(_ORDER), copy=False).tobytes()
    else:
        if isinstance(values[0], bytes):  # as rclpy has an octet
            values = [each[0] for each in values]
        data += struct.pack(f'{_ORDER}{len(values)}{number.code}', *values)


def _put_text(data: bytearray, layout: Text, text: str) -> None:
    if layout.is_wide:
        units = np.frombuffer(text.encode('utf-16-le'), '<u2').astype(f'<u{layout.width}')
        _put_count(data, len(units))
        data += units.tobytes()
        return
    encoded = text.encode()
    _put_count(data, len(encoded) + 1)
    data += encoded
    data.append(0)


def _put_count(data: bytearray, count: int) -> None:
    data += bytes(-(len(data) - BEGIN) % _COUNT.size)
    data += _COUNT.pack(count)


def fill(layout: FieldGroup, data: bytes, message: Any, new: Callable[[str], Any]) -> None:
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
    _Filler(data, new).into(layout, message)


class _Filler(Cursor):
    def __init__(self, data: bytes, new: Callable[[str], Any]) -> None:
        super().__init__(data)
        self._new = new

    def into(self, layout: FieldGroup, message: Any) -> None:
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
            case FieldGroup(name=name):
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
