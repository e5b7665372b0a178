# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bytes of messages, read without rclpy: as rclpy itself wrote them."""

from contextlib import suppress
import struct

from builtin_interfaces.msg import Time
from control_msgs.msg import DynamicJointState, InterfaceValue
from geometry_msgs.msg import TransformStamped, Twist, TwistStamped, Vector3
from hypothesis import given, strategies as st
from nav_msgs.msg import Odometry
import numpy as np
from pal_statistics_msgs.msg import StatisticsNames, StatisticsValues
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from amr_description.ros import readers
from amr_description.ros.readers import StatisticNames, StatisticValues

TEXTS = st.text(st.characters(blacklist_characters='\0', blacklist_categories=('Cs',)), max_size=9)
NUMBERS = st.floats(allow_nan=False)
SEVEN = st.tuples(*[NUMBERS] * 7)
WHOLE = {
    readers.CLOCK: Clock(clock=Time(sec=-5, nanosec=7)),
    readers.TRANSFORMS: TFMessage(transforms=[TransformStamped(child_frame_id='base')] * 2),
    readers.JOINT_STATE: JointState(name=['a', 'wheel'], position=[1.0, 0.5], velocity=[-1.0]),
    readers.ODOMETRY: Odometry(child_frame_id='base'),
    readers.DYNAMIC_JOINT_STATE: DynamicJointState(
        joint_names=['left'],
        interface_values=[InterfaceValue(interface_names=['contact'], values=[0.25])],
    ),
    readers.STATISTICS_NAMES: StatisticsNames(names=['a', 'bc'], names_version=3),
    readers.STATISTICS_VALUES: StatisticsValues(values=[1.0, -2.0], names_version=3),
    readers.TWIST: Twist(linear=Vector3(x=0.5), angular=Vector3(z=-1.0)),
    readers.TWIST_STAMPED: TwistStamped(twist=Twist(linear=Vector3(x=0.5))),
}
ROWS = pytest.mark.parametrize('row', WHOLE, ids=lambda row: row.type)


def written(message, order):
    """A message in plain CDR of a byte order, by the rules of DDS-XTypes 1.3, 7.4.1."""
    body = bytearray()

    def number(code, value):
        body.extend(bytes(-len(body) % struct.calcsize(f'={code}')))
        body.extend(struct.pack(f'{order}{code}', value))

    def write(value):
        if isinstance(value, str):
            number('I', len(value.encode()) + 1)
            body.extend(value.encode() + b'\0')
        elif isinstance(value, float):
            number('d', value)
        elif isinstance(value, int):
            number('i' if value < 0 else 'I', value)
        elif hasattr(value, 'get_fields_and_field_types'):
            for field in value.get_fields_and_field_types():
                write(getattr(value, field))
        else:
            if not isinstance(value, np.ndarray):  # of a length that is in no type
                number('I', len(value))
            for each in value:
                write(each)

    write(message)
    return bytes([0, order == '<', 0, 0]) + bytes(body)


def fill(pose, values):
    position = getattr(pose, 'position', None) or pose.translation
    turned = getattr(pose, 'orientation', None) or pose.rotation
    position.x, position.y, position.z = values[:3]
    turned.x, turned.y, turned.z, turned.w = values[3:]


@given(st.integers(-(2**31), 2**31 - 1), st.integers(0, 2**32 - 1))
def test_a_time(sec, nanosec):
    data = serialize_message(Clock(clock=Time(sec=sec, nanosec=nanosec)))
    assert readers.CLOCK.read(data) == sec * 1_000_000_000 + nanosec


@given(st.lists(st.tuples(TEXTS, TEXTS, SEVEN), max_size=3))
def test_transforms(frames):
    message = TFMessage()
    for parent, name, pose in frames:
        each = TransformStamped(child_frame_id=name)
        each.header.frame_id = parent
        fill(each.transform, pose)
        message.transforms.append(each)
    read = readers.TRANSFORMS.read(serialize_message(message))
    assert [(each.parent, each.name, each.pose) for each in read] == frames


@given(st.lists(st.tuples(st.integers(-(2**31), 2**31 - 1), TEXTS, SEVEN), max_size=3))
def test_stamps_of_transforms(frames):
    message = TFMessage()
    for sec, name, pose in frames:
        each = TransformStamped(child_frame_id=name)
        each.header.stamp.sec = sec
        each.header.stamp.nanosec = 7
        fill(each.transform, pose)
        message.transforms.append(each)
    read = readers.TRANSFORMS.read(serialize_message(message))
    assert [(each.stamp, each.name, each.pose) for each in read] == [
        (sec * 1_000_000_000 + 7, name, pose) for sec, name, pose in frames
    ]


@given(TEXTS, st.lists(TEXTS, max_size=4), st.lists(NUMBERS, max_size=4), st.lists(NUMBERS))
def test_joint_states(frame, names, positions, velocities):
    message = JointState(name=names, position=positions, velocity=velocities)
    message.header.frame_id = frame
    data = serialize_message(message)
    read = readers.JOINT_STATE.read(data)
    reader = readers.JOINT_STATE.reader()
    assert reader(data) == reader(data) == read
    assert (read.names, list(read.positions), list(read.velocities)) == (
        names, positions, velocities
    )  # fmt: skip


@given(TEXTS, TEXTS, SEVEN, NUMBERS, NUMBERS, NUMBERS)
def test_odometry(frame, child, pose, linear, angular, sideways):
    message = Odometry(child_frame_id=child)
    message.header.frame_id = frame
    fill(message.pose.pose, pose)
    message.pose.covariance[35] = 1.0
    message.twist.twist.linear.x, message.twist.twist.angular.z = linear, angular
    message.twist.twist.linear.y = sideways
    read = readers.ODOMETRY.read(serialize_message(message))
    assert read == (*pose, linear, angular, sideways)


@given(TEXTS, st.lists(st.tuples(TEXTS, st.dictionaries(TEXTS, NUMBERS, max_size=3)), max_size=3))
def test_dynamic_joint_states(frame, joints):
    message = DynamicJointState(joint_names=[name for name, _ in joints])
    message.header.frame_id = frame
    message.interface_values = [
        InterfaceValue(interface_names=list(values), values=list(values.values()))
        for _, values in joints
    ]
    data = serialize_message(message)
    read = readers.DYNAMIC_JOINT_STATE.read(data)
    reader = readers.DYNAMIC_JOINT_STATE.reader()
    assert reader(data) == reader(data) == read
    assert list(zip(read.names, read.values, strict=True)) == joints


@given(TEXTS, NUMBERS, NUMBERS)
def test_commands(frame, linear, angular):
    plain, stamped = Twist(), TwistStamped()
    stamped.header.frame_id = frame
    for twist in (plain, stamped.twist):
        twist.linear.x, twist.angular.z = linear, angular
        twist.linear.y = 9.0
    assert readers.TWIST.read(serialize_message(plain)) == (linear, angular, 9.0)
    assert readers.TWIST_STAMPED.read(serialize_message(stamped)) == (linear, angular, 9.0)


@given(TEXTS, st.lists(TEXTS, max_size=4), st.lists(NUMBERS), st.integers(0, 2**32 - 1))
def test_statistics(frame, names, values, version):
    named = StatisticsNames(names=names, names_version=version)
    valued = StatisticsValues(values=values, names_version=version)
    named.header.frame_id = valued.header.frame_id = frame
    assert readers.STATISTICS_NAMES.read(serialize_message(named)) == StatisticNames(
        names, version
    )
    assert readers.STATISTICS_VALUES.read(serialize_message(valued)) == StatisticValues(
        values, version
    )


@ROWS
def test_every_vendor_is_understood(row):
    """Big-endian hosts, bits of options, padding at the end."""
    read, message = row.reader(), WHOLE[row]
    data = serialize_message(message)
    expected = read(data)
    for order in '<>':
        other = written(message, order)
        assert deserialize_message(other, type(message)) == message
        assert read(other) == expected
    assert read(data[:2] + b'\x00\x03' + data[4:] + bytes(3)) == expected


@given(st.sampled_from([*WHOLE]), st.data())
def test_bytes_of_nothing_are_refused(row, data):
    """Whatever a peer sends: a sample, or a ValueError, and soon."""
    rubbish = st.binary(max_size=80).map(lambda tail: bytes([0, len(tail) % 2, 0, 0]) + tail)
    read, whole = row.reader(), serialize_message(WHOLE[row])
    read(whole)
    at = data.draw(st.integers(0, len(whole)))
    changed = whole[:at] + data.draw(st.binary(max_size=8)) + whole[at + 4 :]
    for each in (data.draw(st.binary(max_size=80)), data.draw(rubbish), changed):
        with suppress(ValueError):
            read(each)


@pytest.mark.parametrize('length', [0xFFFFFFFF, 0x7FFFFFFF, 0x10000000])
def test_lengths_beyond_the_bytes_cost_nothing(length):
    head = struct.pack('<4BiII', 0, 1, 0, 0, 0, 0, 1) + bytes(4)
    for data in (head + struct.pack('<I', length), head + struct.pack('<III', 0, length, 0)):
        with pytest.raises(ValueError, match='end within|cannot have'):
            readers.JOINT_STATE.read(data + bytes(40))


@ROWS
@pytest.mark.parametrize('times', [0, 2])
def test_every_message_that_is_cut_off_is_refused(row, times):
    """Also by who remembers what the whole one is like."""
    read, data = row.reader(), serialize_message(WHOLE[row])
    for _ in range(times):
        read(data)
    with pytest.raises(ValueError, match='no plain CDR'):
        read(data[:3])
    for length in range(4, len(data) // 2):
        with pytest.raises(ValueError, match='end within|cannot have'):
            read(data[:length])


def test_another_encoding_is_refused():
    with pytest.raises(ValueError, match='no plain CDR: 00 0a'):
        readers.CLOCK.read(b'\x00\x0a\x00\x00' + bytes(8))


@given(st.data())
def test_what_is_remembered_of_a_topic_is_not_taken_for_what_has_changed(data):
    """Names of the same length, more or fewer of them, other numbers."""
    texts = st.lists(st.sampled_from(['a', 'b', 'left', 'rear']), max_size=3)
    interfaces, joints = readers.DYNAMIC_JOINT_STATE.reader(), readers.JOINT_STATE.reader()
    for _ in range(4):
        names = data.draw(texts)
        message = DynamicJointState(joint_names=names)
        message.interface_values = [
            InterfaceValue(interface_names=each, values=data.draw(st.lists(NUMBERS, max_size=3)))
            for each in data.draw(st.lists(texts, max_size=3))
        ]
        found = interfaces(serialize_message(message))
        assert found.names == names
        assert found.values == [
            dict(zip(each.interface_names, each.values, strict=False))
            for each in message.interface_values
        ]
        numbers = data.draw(st.lists(NUMBERS, max_size=3))
        state = joints(serialize_message(JointState(name=names, position=numbers)))
        assert (state.names, state.positions) == (names, numbers)


def test_sources_of_a_topic_are_told_apart():
    read = readers.JOINT_STATE.reader()
    sources = [['a'], ['a', 'b'], ['b'], ['a', 'b', 'c'], [], *([f'joint{i}'] for i in range(20))]
    for time in range(3):
        for joints in sources:
            message = JointState(name=joints)
            message.header.stamp.sec = time
            found = read(serialize_message(message))
            assert (found.stamp, found.names) == (time * 10**9, joints)
