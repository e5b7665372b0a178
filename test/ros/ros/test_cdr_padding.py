# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Serialized messages of which equal ones have equal bytes."""

from controller_manager_msgs.msg import ControllerManagerActivity, NamedLifecycleState
from geometry_msgs.msg import TwistStamped
from lifecycle_msgs.msg import State
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState, PointField
from std_msgs.msg import Empty, Float64MultiArray, MultiArrayDimension, MultiArrayLayout

from amr_description.cdr.padding import without_padding
from amr_description.ros.layouts import layout_of, serialize


def stamped(frame):
    message = TwistStamped()
    message.header.frame_id = frame
    message.twist.linear.x = 0.5
    return message


@pytest.mark.parametrize(
    'message',
    [
        Empty(),
        stamped(''),
        stamped('o'),
        JointState(name=['a', 'bcd'], position=[1.0, 2.0], effort=[3.0]),
        PointField(name='x', offset=7, datatype=7, count=1),
        Float64MultiArray(
            layout=MultiArrayLayout(dim=[MultiArrayDimension(label='l', size=3)]), data=[0.5] * 3
        ),
        ControllerManagerActivity(
            controllers=[NamedLifecycleState(name='xy', state=State(id=3, label='active'))] * 2
        ),
    ],
)
def test_what_is_serialized_is_the_message(message):
    made = serialize(message)
    assert deserialize_message(made, type(message)) == message
    assert len(made) <= len(serialize_message(message))


def test_what_only_aligns_is_zero():
    message = stamped('o')  # 4 + 8 + 4 + 2 bytes, and 6 up to the first double
    clean = serialize(message)
    assert clean[4 + 14 : 4 + 16] == bytes(2)
    dirty = clean[: 4 + 14] + b'\xd5\xfa' + clean[4 + 16 :] + b'\x99'
    assert deserialize_message(dirty, TwistStamped) == message
    assert without_padding(layout_of(TwistStamped), dirty) == clean
