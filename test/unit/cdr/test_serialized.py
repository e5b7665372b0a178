# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages as bytes, and back: alignment, lengths, both orders of bytes, broken ones."""

import struct
from types import SimpleNamespace

import numpy as np
import pytest

from amr_description.cdr.layouts import group, many, Number, Text
from amr_description.cdr.serialized import fill, serialized
from amr_description.cdr.template import template_of

OCTET, SHORT, DOUBLE = Number('B', 'octet'), Number('h', 'int16'), Number('d', 'double')
INNER = group('p/msg/Inner', [('flag', OCTET), ('value', DOUBLE)])
LAYOUT = group(
    'p/msg/Outer',
    [
        ('name', Text()),
        ('inner', INNER),
        ('many', many(INNER, None)),
        ('pair', many(SHORT, 2)),
        ('wide', Text(width=4)),
        ('data', many(OCTET, None)),
    ],
)


def inner(flag, value):
    return SimpleNamespace(flag=flag, value=value)


def message(**changes):
    fields = {
        'name': 'Rä',
        'inner': inner(1, 0.5),
        'many': [inner(2, 1.5), inner(3, -2.5)],
        'pair': [-1, 2],
        'wide': 'aü😀',
        'data': b'abc',
        **changes,
    }
    return SimpleNamespace(**fields)


def read(data):
    found = SimpleNamespace()
    fill(LAYOUT, data, found, lambda _: SimpleNamespace())
    return found


def test_numbers_are_aligned_and_what_aligns_is_zero():
    assert serialized(INNER, inner(7, 0.25)) == b'\0\1\0\0\7' + bytes(7) + struct.pack('<d', 0.25)


def test_what_is_written_is_read():
    found = read(serialized(LAYOUT, message()))
    assert found == message(data=[*b'abc'])


def test_a_message_without_fields_has_a_byte():
    assert serialized(group('p/msg/Empty', []), object()) == b'\0\1\0\0\0'


def test_arrays_of_numpy_are_written_as_lists_are():
    values = many(DOUBLE, None)
    layout = group('p/msg/Values', [('values', values)])
    as_list = serialized(layout, SimpleNamespace(values=[1.0, 2.5]))
    as_array = serialized(layout, SimpleNamespace(values=np.array([1.0, 2.5], np.float32)))
    assert as_array == as_list


def test_the_other_order_of_bytes_is_read():
    data = b'\0\0\0\0\7' + bytes(7) + struct.pack('>d', 0.25)
    found = SimpleNamespace()
    fill(INNER, data, found, SimpleNamespace)
    assert (found.flag, found.value) == (7, 0.25)


def test_bytes_that_end_too_early_are_an_error_wherever_they_do():
    data = serialized(LAYOUT, message())
    for end in range(len(data)):
        with pytest.raises((ValueError, struct.error)):
            read(data[:end])


def test_a_length_that_cannot_be_is_an_error_before_memory_is_taken():
    data = bytearray(serialized(LAYOUT, message(name='')))
    begin = data.index(struct.pack('<I', 2), 16)  # of many
    data[begin : begin + 4] = struct.pack('<I', 2**31)
    with pytest.raises(ValueError, match='bytes'):
        read(bytes(data))


@pytest.mark.parametrize('change', [{'pair': [1]}, {'pair': [1, 70_000]}, {'inner': inner(1, '')}])
def test_a_value_that_does_not_fit_is_an_error(change):
    with pytest.raises(struct.error):
        serialized(LAYOUT, message(**change))


def test_a_template_makes_the_same_bytes():
    layout = group('p/msg/Part', LAYOUT.fields[:4])
    template = template_of(layout, message(), ('inner', 'many.value', 'pair'))
    constants = iter(template.constants)
    data = template.pack(
        next(constants), 9, 4.5,
        next(constants), 5.5,
        next(constants), 6.5,
        next(constants), 3, 4, next(constants),
    )  # fmt: skip
    changed = message(inner=inner(9, 4.5), many=[inner(2, 5.5), inner(3, 6.5)], pair=[3, 4])
    assert data == serialized(layout, changed)
