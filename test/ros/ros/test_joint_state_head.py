# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The head of a serialized JointState against what the real serialization says."""

import contextlib
import struct

from hypothesis import given, strategies
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from support.examples import examples

from amr_description.ros.cdr import HeadReader, JointStateHead, read_positions

names = strategies.lists(strategies.text(strategies.characters(exclude_categories=['Cs', 'Cc'])))
words = strategies.text(strategies.characters(exclude_categories=['Cs', 'Cc']))
seconds = strategies.integers(-(2**31), 2**31 - 1)
nanoseconds = strategies.integers(0, 2**32 - 1)


def message(joints=('left', 'right'), frame='base', sec=5, nanosec=7):
    result = JointState(name=list(joints))
    result.header.frame_id = frame
    result.header.stamp.sec, result.header.stamp.nanosec = sec, nanosec
    return result


def turned(data):
    """Return a message of the given names in the other byte order."""
    decoded = deserialize_message(data, JointState)
    body = struct.pack('>iI', decoded.header.stamp.sec, decoded.header.stamp.nanosec)

    def aligned():
        return body + b'\0' * (-len(body) % 4)

    for index, text in enumerate([decoded.header.frame_id, *decoded.name]):
        encoded = text.encode() + b'\0'
        body = aligned() + struct.pack('>I', len(encoded)) + encoded
        if index == 0:
            body = aligned() + struct.pack('>I', len(decoded.name))
    return b'\0\0\0\0' + body


@examples(60)
@given(names, words, seconds, nanoseconds)
def test_stamp_and_names_are_those_of_the_message(joints, frame, sec, nanosec):
    reader = HeadReader()
    data = bytes(serialize_message(message(joints, frame, sec, nanosec)))
    expected = JointStateHead(sec * 10**9 + nanosec, tuple(joints))
    assert reader.read(data) == expected  # decoded
    assert reader.read(data) == expected  # remembered
    assert HeadReader().read(turned(data)) == expected
    assert reader.read(turned(data)) == expected


@given(names, strategies.lists(strategies.floats(allow_nan=False)))
def test_positions_come_after_the_head(joints, values):
    reader = HeadReader()
    sent = message(joints)
    sent.position = values
    data = bytes(serialize_message(sent))
    for _ in ('decoded', 'remembered'):
        assert read_positions(data, reader.read(data)) == tuple(values)
    if values:
        with pytest.raises(ValueError, match='end within'):
            read_positions(data[: reader.read(data).end + 8], reader.read(data))


def test_sources_are_told_apart():
    reader = HeadReader()
    sources = [['a'], ['a', 'b'], ['b'], ['a', 'b', 'c'], [], *([f'joint{i}'] for i in range(20))]
    for time in range(3):
        for joints in sources:
            data = bytes(serialize_message(message(joints, sec=time, nanosec=0)))
            assert reader.read(data) == JointStateHead(time * 10**9, tuple(joints))


@given(strategies.binary(max_size=60))
def test_no_bytes_do_worse_than_a_value_error(data):
    reader = HeadReader()
    for each in (data, b'\0\1\0\0' + data, b'\0\0\0\0' + data):
        with contextlib.suppress(ValueError):
            assert isinstance(reader.read(each), JointStateHead)


def test_a_message_that_is_cut_short_is_refused():
    data = bytes(serialize_message(message()))
    end = data.index(b'right') + len(b'right') + 1
    assert HeadReader().read(data[:end]).names == ('left', 'right')
    for length in range(end):
        with pytest.raises(ValueError, match='no plain CDR|end within'):
            HeadReader().read(data[:length])
