# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A plain message has the bytes of the message of rclpy, and is read from them."""

import random
import struct

import pytest

from amr_description.cdr.layouts import FieldGroup, Many, Number, Text
from amr_description.cdr.serialized import fill, serialized
from amr_description.messages.definitions import layout_of, texts
from amr_description.messages.plain import message_of, PlainMessage
from amr_description.ros import layouts
from amr_description.ros.layouts import serialize
from amr_description.ros.message_fields import set_fields
from amr_description.ros.message_types import message_type

NAMES = [name for name in texts() if '/msg/' in name]
WORDS = ('', 'a', 'base_link', 'Räder', 'x' * 21)


def drawn(layout, chance):
    """A value in the form of a dict, drawn at random."""
    match layout:
        case Number(name='boolean'):
            return chance.random() < 0.5
        case Number(code=code) if code in 'fd':
            number = chance.choice([0.0, -0.0, chance.uniform(-1e6, 1e6), float('inf')])
            return struct.unpack(code, struct.pack(code, number))[0]
        case Number(size=size, code=code):
            half = 2 ** (8 * size - 1)
            return chance.randrange(2 * half) - (half if code.islower() else 0)
        case Text():
            return chance.choice(WORDS)
        case FieldGroup(fields=fields):
            return {name: drawn(field, chance) for name, field in fields}
        case Many(element=element, count=count):
            length = chance.randrange(3) if count is None else count
            return [drawn(element, chance) for _ in range(length)]


@pytest.mark.parametrize('name', NAMES)
def test_both_are_laid_out_alike(name):
    assert layout_of(name) == layouts.layout_of(message_type(name))


@pytest.mark.parametrize('name', NAMES)
def test_both_have_the_same_bytes_and_they_are_read_again(name):
    layout = layout_of(name)
    for seed in range(8):
        values = drawn(layout, random.Random(f'{name} {seed}'))
        of_ros = message_type(name)()
        set_fields(of_ros, values)
        data = serialized(layout, message_of(name, values))
        assert data == serialize(of_ros)
        read = PlainMessage(name)
        fill(layout, data, read, PlainMessage)
        assert serialized(layout, read) == data
