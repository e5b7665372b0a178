# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``Buffer.transform``, tf2_geometry_msgs and tf2_sensor_msgs, by their own names."""

import math

from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    Polygon,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)
from hypothesis import given, strategies as st
import numpy as np
import pytest
from sensor_msgs.msg import PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header, String
import tf2_geometry_msgs
import tf2_geometry_msgs.tf2_geometry_msgs
import tf2_py
import tf2_ros
import tf2_ros.buffer_interface
import tf2_sensor_msgs

from amr_description.model.frames import quaternion_from_rpy

NUMBERS = st.floats(-10.0, 10.0)
ANGLES = st.floats(-3.1, 3.1)


def transform(translation=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0), parent='odom', child='base'):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    at, turn = message.transform.translation, message.transform.rotation
    at.x, at.y, at.z = translation
    turn.x, turn.y, turn.z, turn.w = quaternion_from_rpy(*rpy)
    return message


def at(kind, frame='base', **fields):
    return kind(header=Header(frame_id=frame), **fields)


@pytest.fixture
def buffer():
    buffer = tf2_ros.Buffer()
    buffer.set_transform_static(transform((5.0, 0.0, 1.0), (0.0, 0.0, math.pi / 2)), 'me')
    return buffer


def xyz(of):
    return pytest.approx((of.x, of.y, of.z))


def test_a_point_is_moved_and_a_direction_only_turned(buffer):
    point, vector = at(PointStamped), at(Vector3Stamped)
    point.point.x = vector.vector.x = 1.0
    there = buffer.transform(point, 'odom')
    assert xyz(there.point) == (5.0, 1.0, 1.0)
    assert there.header.frame_id == 'odom'
    assert xyz(buffer.transform(vector, 'odom').vector) == (0.0, 1.0, 0.0)
    assert point.point.x == 1.0


def test_a_pose_with_its_covariance(buffer):
    pose = at(PoseWithCovarianceStamped)
    pose.pose.pose.position.x = 1.0
    pose.pose.covariance[0], pose.pose.covariance[21] = 4.0, 9.0  # x, and about x
    there = buffer.transform(pose, 'odom').pose
    assert xyz(there.pose.position) == (5.0, 1.0, 1.0)
    expected = np.zeros((6, 6))
    expected[1, 1], expected[4, 4] = 4.0, 9.0
    assert np.reshape(there.covariance, (6, 6)) == pytest.approx(expected)


def test_a_polygon_and_a_pose_without_header(buffer):
    polygon = at(PolygonStamped, polygon=Polygon(points=[Point32(x=1.0), Point32(y=1.0)]))
    points = buffer.transform(polygon, 'odom').polygon.points
    assert [(round(p.x, 6), round(p.y, 6)) for p in points] == [(5.0, 1.0), (4.0, 0.0)]
    moved = tf2_geometry_msgs.do_transform_pose(Pose(), transform((1.0, 2.0, 3.0)))
    assert xyz(moved.position) == (1.0, 2.0, 3.0)


def test_a_rotation_of_another_length_turns_and_does_not_stretch():
    double = transform(rpy=(0.0, 0.0, math.pi / 2))
    double.transform.rotation.z *= 2.0
    double.transform.rotation.w *= 2.0
    moved = tf2_geometry_msgs.do_transform_point(at(PointStamped, point=Point(x=1.0)), double)
    assert xyz(moved.point) == (0.0, 1.0, 0.0)
    zeros = transform()
    zeros.transform.rotation.w = 0.0
    same = tf2_geometry_msgs.do_transform_point(at(PointStamped, point=Point(x=1.0)), zeros)
    assert xyz(same.point) == (1.0, 0.0, 0.0)


@given(st.tuples(NUMBERS, NUMBERS, NUMBERS), st.tuples(ANGLES, ANGLES, ANGLES))
def test_there_and_back_is_where_it_was(translation, rpy):
    buffer = tf2_ros.Buffer()
    buffer.set_transform_static(transform(translation, rpy), 'me')
    pose = at(PoseStamped)
    pose.pose.position.y = 2.0
    back = buffer.transform(buffer.transform(pose, 'odom'), 'base').pose
    assert (back.position.x, back.position.y, back.position.z) == pytest.approx(
        (0.0, 2.0, 0.0), abs=1e-9
    )
    assert back.orientation.w == pytest.approx(1.0)


def test_a_cloud_keeps_its_other_fields_and_turns_its_normals(buffer):
    names = ('x', 'y', 'z', 'normal_x', 'normal_y', 'normal_z', 'intensity')
    fields = [
        PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1)
        for i, name in enumerate(names)
    ]
    cloud = point_cloud2.create_cloud(
        Header(frame_id='base'), fields, [(1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 7.0)]
    )
    there = buffer.transform(cloud, 'odom')
    (point,) = point_cloud2.read_points_list(there)
    assert tuple(point) == pytest.approx((5.0, 1.0, 1.0, 0.0, 1.0, 0.0, 7.0), abs=1e-6)
    assert (there.header.frame_id, there.width, there.point_step) == ('odom', 1, 28)
    moved = tf2_sensor_msgs.transform_points(np.array([[1.0, 0.0, 0.0]]), transform().transform)
    assert moved == pytest.approx(np.array([[1.0, 0.0, 0.0]]))


def test_a_type_that_nobody_registers_is_said(buffer):
    with pytest.raises(tf2_ros.TransformException, match='Type std_msgs.*String is not loaded'):
        buffer.transform(String(), 'odom')
    with pytest.raises(tf2_ros.LookupException, match='nowhere'):
        buffer.transform(at(PointStamped), 'nowhere')


class Own:
    def __init__(self, x=0.0):
        self.x = x


def test_own_types_are_converted(buffer):
    registration = tf2_ros.ConvertRegistration()
    registration.add_from_msg(Own, lambda message: Own(message.point.x))
    registration.add_to_msg(Own, lambda own: at(PointStamped))
    found = buffer.transform(at(PointStamped), 'odom', new_type=Own)
    assert found.x == pytest.approx(5.0)
    copy = tf2_ros.convert(found, Own)
    assert copy is not found
    assert copy.x == found.x
    registration.add_convert((Own, str), lambda own: f'{own.x:.0f}')
    assert tf2_ros.convert(found, str) == '5'
    with pytest.raises(tf2_ros.TypeException):
        tf2_ros.convert(3, Own)
    stamped = tf2_ros.Stamped(found, Header().stamp, 'base')
    assert stamped.header.frame_id == 'base'


def test_between_two_times():
    buffer = tf2_ros.Buffer()
    for second in (1, 3):
        message = transform((float(second), 0.0, 0.0))
        message.header.stamp.sec = second
        buffer.set_transform(message, 'me')
    point = at(PointStamped)
    point.header.stamp.sec = 1
    later = transform().header.stamp
    later.sec = 3
    assert buffer.transform_full(point, 'base', later, 'odom').point.x == pytest.approx(-2.0)


def test_the_core_answers_at_once():
    core = tf2_py.BufferCore()
    zero = Header().stamp
    assert core.can_transform_core('odom', 'base', zero)[0] is False
    with pytest.raises(tf2_py.LookupException):
        core.lookup_transform_core('odom', 'base', zero)
    core.set_transform_static(transform((1.0, 0.0, 0.0)), 'me')
    assert core.can_transform_core('odom', 'base', zero) == (True, '')
    assert core.lookup_transform_core('odom', 'base', zero).transform.translation.x == 1.0
    assert core.can_transform_full_core('odom', zero, 'base', zero, 'odom') == (True, '')
    assert tf2_py.TimeoutException is tf2_ros.TimeoutException
