# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is typed -> the fields of a message."""

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseArray, Twist, TwistStamped
from nav_msgs.msg import Odometry
import pytest
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Bool, Byte, ByteMultiArray, Float64, Int32, String, UInt8, UInt8MultiArray

from amr_description.errors import AmrError
from amr_description.ros.message_fields import set_fields

NOW = Time(sec=7, nanosec=8)


def filled(message, values):
    for stamp in set_fields(message, values):
        stamp(NOW)
    return message


def test_what_is_not_mentioned_keeps_its_default():
    message = filled(TwistStamped(), {'twist': {'linear': {'x': 0.5}}})
    assert message == TwistStamped(twist=Twist(linear=message.twist.linear))
    assert (message.twist.linear.x, message.twist.linear.y) == (0.5, 0.0)


@pytest.mark.parametrize(
    ('message', 'value', 'stored'),
    [
        (String, 5, '5'),
        (String, 0.5, '0.5'),
        (String, True, 'True'),
        (Float64, 1, 1.0),
        (Float64, '1e-3', 0.001),
        (Int32, '7', 7),
        (Bool, 5, True),
        (Bool, 0, False),
        (Bool, 'false', False),
        (Byte, 5, b'\x05'),
    ],
)
def test_a_value_of_another_type_is_converted(message, value, stored):
    data = filled(message(), {'data': value}).data
    assert (data, type(data)) == (stored, type(stored))


def test_arrays_of_every_kind():
    assert list(filled(UInt8MultiArray(), {'data': [1, 255]}).data) == [1, 255]
    assert filled(ByteMultiArray(), {'data': [1, 255]}).data == [b'\x01', b'\xff']
    assert list(filled(Image(), {'data': b'\x01\x02'}).data) == [1, 2]
    joints = filled(JointState(), {'name': ['a', 5], 'position': [1, '2.5'], 'velocity': []})
    assert (joints.name, list(joints.position)) == (['a', '5'], [1.0, 2.5])
    fixed = filled(Odometry(), {'pose': {'covariance': list(range(36))}}).pose.covariance
    assert fixed.tolist() == [float(i) for i in range(36)]
    poses = filled(PoseArray(), {'poses': [{'position': {'x': 1}}, {}]}).poses
    assert [pose.position.x for pose in poses] == [1.0, 0.0]


def test_auto_and_now_are_the_time_of_each_publication():
    message = TwistStamped()
    stamps = set_fields(message, {'header': 'auto'})
    assert (message.header.stamp.sec, message.header.frame_id) == (0, '')
    for second in (1, 2):
        for stamp in stamps:
            stamp(Time(sec=second))
        assert message.header.stamp.sec == second
    stamped = filled(TwistStamped(), {'header': {'stamp': 'now', 'frame_id': 'base_link'}})
    assert (stamped.header.stamp, stamped.header.frame_id) == (NOW, 'base_link')


@pytest.mark.parametrize(
    ('message', 'values', 'reason'),
    [
        (String, {'datas': 'hi'}, "'String' object has no attribute 'datas'; it has data"),
        (
            Twist,
            {'linear': {'x': 'abc'}},
            "could not convert string to float: 'abc' (field linear.x)",
        ),
        (
            Twist,
            {'linear': 1},
            "Value '1' is expected to be a dictionary but is a int (field linear)",
        ),
        (Twist, {'linear': {'q': 1}}, "'Vector3' object has no attribute 'q'; it has x, y, z"),
        (
            Twist,
            {'linear': {'x:1': None}},
            "'Vector3' object has no attribute 'x:1': a blank is lacking beh",
        ),
        (Twist, {5: 1}, "'Twist' object has no attribute '5'; it has linear, angular"),
        (String, {'data': None}, 'expected a string, found nothing (field data)'),
        (String, {'data': {'a': 1}}, "expected a string, found '{'a': 1}' (field data)"),
        (Float64, {'data': [1.0]}, "expected a double, found '[1.0]' (field data)"),
        (Bool, {'data': 'maybe'}, "'maybe' is neither true nor false (field data)"),
        (UInt8, {'data': 300}, "The 'data' field must be an unsigned integer in [0, 255]"),
        (UInt8, {'data': -1}, "The 'data' field must be an unsigned integer in [0, 255]"),
        (Byte, {'data': 256}, 'bytes must be in range(0, 256) (field data)'),
        (UInt8MultiArray, {'data': [300]}, 'unsigned byte integer is greater than maximum'),
        (JointState, {'name': 'abc'}, "expected a list, found the str 'abc' (field name)"),
        (Odometry, {'pose': {'covariance': [1]}}, "The 'covariance' numpy.ndarray() must have"),
        (
            PoseArray,
            {'poses': [{}, {'position': {'y': 'q'}}]},
            "could not convert string to float: 'q' (field poses[1].position.y)",
        ),
        (TwistStamped, {'header': 'now'}, "Value 'now' is expected to be a dictionary"),
    ],
)
def test_what_does_not_fit_is_told_with_its_field(message, values, reason):
    with pytest.raises(AmrError, match='^Failed to populate field: ') as error:
        set_fields(message(), values)
    assert str(error.value).removeprefix('Failed to populate field: ').startswith(reason)
