# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of any type as their bytes.

A message is any object with its fields as attributes. What aligns numbers is zero, so that equal
messages have equal bytes, those that :func:`amr_description.ros.cdr_padding.serialize` makes of
messages of rclpy.
"""

from collections.abc import Sequence
import struct
from typing import Any

import numpy as np

from amr_description.cdr.cursor import BEGIN
from amr_description.cdr.layouts import Group, Layout, Many, Number, Text

_HEAD = b'\0\1\0\0'
"""Plain CDR, little endian."""
_ORDER = '<'
_COUNT = struct.Struct('<I')


def serialized(layout: Group, message: Any) -> bytes:
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
        case Group(fields=fields):
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
