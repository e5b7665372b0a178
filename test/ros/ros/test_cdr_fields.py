# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Fields and trees of serialized messages against what rclpy reads, for every type installed."""

import importlib
import math
from pathlib import Path
import random
import struct
import sys

from control_msgs.msg import DynamicJointState, InterfaceValue
from hypothesis import given, strategies as st
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
)
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from tf2_msgs.msg import TFMessage

from amr_description.cdr.fields import FieldReader, MOST_PARTS, why_no_number
from amr_description.cdr.layouts import CODES
from amr_description.cdr.tree import MOST_NUMBERS, read_tree
from amr_description.errors import AmrError
from amr_description.ros.layouts import layout_of
from amr_description.ros.message_types import type_name

_INTEGERS = {'b': 8, 'B': 8, 'h': 16, 'H': 16, 'i': 32, 'I': 32, 'q': 64, 'Q': 64}


def installed_types():
    """Return all message classes on the path."""
    packages = {
        path.parent.parent.name
        for place in sys.path
        for path in Path(place).glob('*/msg/__init__.py')
    }
    found = []
    for package in sorted(packages):
        for value in vars(importlib.import_module(f'{package}.msg')).values():
            if hasattr(value, 'get_fields_and_field_types'):
                found.append(value)
    return sorted(found, key=type_name)


TYPES = installed_types()
STATE = layout_of(JointState)


def filled(message_type, rng):
    """Return a message with a random value in every field."""
    message = message_type()
    for name, slot in zip(
        message.get_fields_and_field_types(), message_type.SLOT_TYPES, strict=True
    ):
        setattr(message, name, value_of(slot, rng))
    return message


def value_of(slot, rng):
    if isinstance(slot, BasicType):
        code = CODES[slot.typename]
        if slot.typename == 'boolean':
            return rng.random() < 0.5
        if slot.typename == 'octet':
            return bytes([rng.randrange(256)])
        if code in _INTEGERS:
            bits = _INTEGERS[code]
            low = -(2 ** (bits - 1)) if code.islower() else 0
            return rng.randrange(low, low + 2**bits)
        number = rng.choice([rng.uniform(-1e3, 1e3), math.nan, math.inf, -math.inf, 0.0])
        return struct.unpack('f', struct.pack('f', number))[0] if code == 'f' else number
    if isinstance(slot, AbstractString | AbstractWString):
        return ''.join(rng.choice('aé€ 😀x') for _ in range(rng.randrange(9)))
    if isinstance(slot, AbstractNestedType):
        most = getattr(slot, 'maximum_size', 3)
        count = slot.size if isinstance(slot, Array) else rng.randint(0, min(most, 3))
        return [value_of(slot.value_type, rng) for _ in range(count)]
    return filled(getattr(importlib.import_module('.'.join(slot.namespaces)), slot.name), rng)


def leaves(value, path=''):
    """Yield the path of every field of rclpy's message that is no message, with its value."""
    if hasattr(value, 'tolist'):  # numpy's arrays and numbers
        value = value.tolist()
    if hasattr(value, 'get_fields_and_field_types'):
        for name in value.get_fields_and_field_types():
            yield from leaves(getattr(value, name), f'{path}.{name}' if path else name)
    elif isinstance(value, str | bytes | int | float):  # bytes: an octet, or a sequence of them
        yield path, ord(value) if isinstance(value, bytes) and len(value) == 1 else value
    else:
        for index, each in enumerate(value):
            yield from leaves(each, f'{path}[{index}]')


def of_tree(tree, path=''):
    """Yield the same of a tree."""
    if isinstance(tree, dict) and '#first' in tree:
        tree = tree['#first']
    if isinstance(tree, dict) and '#number' not in tree:
        for name, value in tree.items():
            yield from of_tree(value, f'{path}.{name}' if path else name)
    elif isinstance(tree, list):
        for index, each in enumerate(tree):
            yield from of_tree(each, f'{path}[{index}]')
    else:
        yield path, tree


def same(one, other):
    if isinstance(one, dict):
        return str(float(one['#number'])) == str(float(other))
    return one == other


@pytest.mark.parametrize('message_type', TYPES, ids=type_name)
def test_fields_and_trees_are_what_rclpy_reads(message_type):
    rng = random.Random(type_name(message_type))
    for _ in range(2):
        data = serialize_message(filled(message_type, rng))
        message = dict(leaves(deserialize_message(data, message_type)))
        numbers = {
            path: float(value) for path, value in message.items() if not isinstance(value, str)
        }
        paths = rng.sample(sorted(numbers), min(len(numbers), 12))
        found = FieldReader(layout_of(message_type), paths).read(data)
        assert list(map(str, map(float, found))) == [str(numbers[path]) for path in paths]
        tree = dict(of_tree(read_tree(layout_of(message_type), data)))
        assert tree.keys() <= message.keys()
        assert all(same(value, message[path]) for path, value in tree.items())


def test_both_byte_orders_are_read():
    little = serialize_message(Float64MultiArray(data=[1.5, -2.0]))
    fields, big = struct.unpack_from('<III4xdd', little, 4), bytearray(b'\0\0\0\0')
    assert fields == (0, 0, 2, 1.5, -2.0)
    big += struct.pack('>III4xdd', *fields)
    for data in (little, bytes(big)):
        assert FieldReader(layout_of(Float64MultiArray), ['data[1]']).read(data) == [-2.0]
        assert read_tree(layout_of(Float64MultiArray), data)['data'] == [1.5, -2.0]


def test_an_element_that_is_not_there_is_nan():
    data = serialize_message(JointState(position=[1.0, 2.0]))
    first, third, again = FieldReader(STATE, ['position[0]', 'position[2]', 'position[0]']).read(
        data
    )
    assert (first, again, math.isnan(third)) == (1.0, 1.0, True)


def test_one_reader_follows_lengths_as_they_change():
    """Also back to lengths that it has seen, in turns of more than it remembers."""
    rng = random.Random(1)
    reader = FieldReader(STATE, ['velocity[1]', 'header.stamp.sec', 'position[0]'])
    for turn in range(60):
        state = JointState(name=['a' * (turn % 7)] * rng.randrange(2))
        state.header.stamp.sec, state.header.frame_id = turn, 'b' * rng.randrange(3)
        state.position = [rng.random() for _ in range(rng.randrange(1, 3))]
        state.velocity = [rng.random() for _ in range(rng.randrange(2, 4))]
        found = reader.read(serialize_message(state))
        assert found == [state.velocity[1], turn, state.position[0]]


@given(st.integers(0, 200))
def test_a_message_that_ends_too_early_is_refused_by_who_has_seen_it_whole(length):
    whole = serialize_message(JointState(name=['a', 'bc'], position=[1.0, 2.0]))
    reader = FieldReader(STATE, ['position[1]'])
    assert reader.read(whole) == [2.0]
    needed = whole.index(struct.pack('<d', 2.0)) + 8
    if length < needed:
        with pytest.raises(ValueError, match='bytes end within|no plain CDR'):
            reader.read(whole[:length])
    else:
        assert reader.read(whole[:length]) == [2.0]


def test_long_arrays_and_strings_are_shortened_with_their_length():
    state = JointState(name=['a' * 5000], position=[0.5] * 1000, effort=[1.0])
    tree = read_tree(layout_of(JointState), serialize_message(state))
    assert tree['position'] == {'#length': 1000, '#first': [0.5] * MOST_NUMBERS}
    assert tree['name'] == [{'#length': 5001, '#text': 'a' * 4096}]
    assert tree['effort'] == [1.0]


@pytest.mark.parametrize(
    ('path', 'reason'),
    [
        ('positon[0]', "sensor_msgs/msg/JointState has no field 'positon'; did you mean"),
        ('position', "'position' is no number, but a sequence"),
        ('name[0]', "'name[0]' is no number, but a string"),
        ('header', "'header' is no number, but a message (std_msgs/msg/Header)"),
        ('header[0]', "'header' is a message (std_msgs/msg/Header), without an element [0]"),
        ('position[0].x', "'position[0]' is a number (double), without a field x"),
        ('header..stamp', "'header..stamp' is no path to a field"),
        ('', "'' is no number"),
        ('position[-1]', "'position[-1]' is no path"),
        ('.position[0]', "'.position[0]' is no path"),
    ],
)
def test_a_path_that_leads_nowhere_is_refused_in_one_line(path, reason):
    found = why_no_number(STATE, path)
    assert found.startswith(reason)
    assert '\n' not in found
    assert why_no_number(STATE, 'position[7]') == ''


@pytest.mark.parametrize('path', ['header', 'header[0]', 'positon', '', 'name[', 'name[].x'])
def test_what_is_neither_number_string_nor_array_cannot_be_read(path):
    with pytest.raises(AmrError, match='no number|no path|no field|without'):
        FieldReader(STATE, [path])


def test_strings_arrays_and_each_element_are_read():
    state = JointState(name=['left', 'ø'], position=[1.0, 2.0, 3.0])
    state.header.frame_id = 'base'
    paths = [
        'header.frame_id',
        'name[]',
        'position[]',
        'position',
        'name[1]',
        'velocity[]',
        'name[2]',
    ]
    reader = FieldReader(STATE, [*paths, 'header.frame_id'])
    data = serialize_message(state)
    for _ in ('by a walk', 'by what it remembers', 'again'):
        frame, names, each, array, second, none, third, again = reader.read(data)
        assert (frame, again, names, second) == ('base', 'base', ['left', 'ø'], 'ø')
        assert (each, array.tolist(), none) == ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [])
        assert math.isnan(third)
        assert not array.flags.owndata  # no copy


def test_elements_of_elements_are_lists_of_lists():
    layout = layout_of(DynamicJointState)
    message = DynamicJointState(
        interface_values=[
            InterfaceValue(interface_names=['a', 'b'], values=[1.0, 2.0]),
            InterfaceValue(),
            InterfaceValue(interface_names=['c'], values=[3.0]),
        ]
    )
    reader = FieldReader(
        layout, ['interface_values[].values[]', 'interface_values[].interface_names[]']
    )
    for _ in range(3):
        values, names = reader.read(serialize_message(message))
        assert values == [[1.0, 2.0], [], [3.0]]
        assert names == [['a', 'b'], [], ['c']]


def test_more_parts_than_anybody_needs_are_refused():
    data = serialize_message(Float64MultiArray(data=[0.0] * (MOST_PARTS + 1)))
    with pytest.raises(ValueError, match=f'more than {MOST_PARTS} parts'):
        FieldReader(layout_of(Float64MultiArray), ['data[]']).read(data)
    (array,) = FieldReader(layout_of(Float64MultiArray), ['data']).read(data)
    assert len(array) == MOST_PARTS + 1


@given(st.integers(0, 400), st.binary(min_size=1, max_size=6))
def test_broken_bytes_are_refused_or_read(at, noise):
    whole = serialize_message(filled(TFMessage, random.Random(3)))
    data = whole[: min(at, len(whole))] + noise + whole[at + len(noise) :]
    for read in (
        FieldReader(layout_of(TFMessage), ['transforms[1].transform.translation.x']).read,
        lambda bytes_: read_tree(layout_of(TFMessage), bytes_),
    ):
        try:
            read(data)
        except ValueError as error:
            assert '\n' not in str(error)
