# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sensors that are mounted turned and beside the origin, differential and relative poses."""

import math

import numpy as np
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.navigation.ekf import STATE_SIZE, StateMember
from amr_description.navigation.ekf_measurement import (
    acceleration_values,
    in_the_plane,
    MeasurementChannel,
    orientation_values,
    OUT_OF_PLANE,
    pose_values,
    PoseMemory,
    RotationalMotion,
    StampedPose,
    twist_values,
    without_gravity,
)

ON_ITS_SIDE = quaternion_from_rpy(math.pi / 2, 0.0, 0.0)  # y of the sensor is z of the robot
FACING_LEFT = quaternion_from_rpy(0.0, 0.0, math.pi / 2)  # x of the sensor is y of the robot


def used(*names):
    mask = np.zeros(STATE_SIZE, dtype=bool)
    mask[[StateMember[name.upper()] for name in names]] = True
    return mask


def names_of(mask):
    return [member.name.lower() for member in StateMember if mask[member]]


def planar(x, y, yaw, seconds=0.0, covariance=None):
    pose = Transform((x, y, 0.0), quaternion_from_rpy(0.0, 0.0, yaw))
    if covariance is None:
        covariance = np.diag([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    return StampedPose(pose, covariance, round(seconds * NANOSECONDS))


def test_the_turn_rate_of_an_imu_on_its_side():
    covariance = np.diag([1.0, 1.0, 1.0, 0.1, 0.2, 0.3])
    transform = Transform((0.1, 0.0, 0.2), ON_ITS_SIDE)
    found = twist_values(
        (0.0, 0.0, 0.0), (0.01, 0.5, 0.02), covariance, used('vpitch'), transform, np.zeros(3)
    )
    assert names_of(found.used) == ['vyaw']
    assert found.values[StateMember.VYAW] == pytest.approx(0.5)
    assert found.covariance[StateMember.VYAW, StateMember.VYAW] == pytest.approx(0.2)
    assert found.covariance[StateMember.VPITCH, StateMember.VPITCH] == pytest.approx(0.3)


def test_a_speed_sensor_beside_the_origin_moves_as_the_robot_turns():
    # 0.5 m to the left of a robot that turns left on the spot by 2 rad/s it goes back by 1 m/s.
    found = twist_values(
        (-1.0, 0.0, 0.0),
        (0.0, 0.0, 2.0),
        np.eye(6),
        used('vx', 'vy', 'vyaw'),
        Transform((0.0, 0.5, 0.0)),
        np.array([0.0, 0.0, 2.0]),
    )
    assert found.values[StateMember.VX] == pytest.approx(0.0, abs=1e-12)
    assert found.values[StateMember.VY] == pytest.approx(0.0, abs=1e-12)


def test_an_accelerometer_beside_the_origin_feels_the_turn():
    # 0.5 m ahead: towards the axis by ω² r, to the left by α r.
    motion = RotationalMotion(np.array([0.0, 0.0, 2.0]), np.array([0.0, 0.0, 3.0]))
    found = acceleration_values(
        (-(2.0**2) * 0.5, 3.0 * 0.5, 0.0),
        np.eye(3),
        used('ax', 'ay'),
        Transform((0.5, 0.0, 0.0)),
        motion,
    )
    assert found.values[[StateMember.AX, StateMember.AY]] == pytest.approx((0.0, 0.0), abs=1e-12)


def test_gravity_is_taken_away_in_the_axes_of_the_sensor():
    # On its side at rest: what holds it up is along its y, -y or y by the turn.
    acceleration = without_gravity((1.0, 9.8, 0.0), ON_ITS_SIDE, 9.8)
    assert acceleration == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    still = RotationalMotion(np.zeros(3), np.zeros(3))
    turned = Transform(rotation=ON_ITS_SIDE)
    found = acceleration_values(acceleration, np.eye(3), used('ax', 'ay'), turned, still)
    assert names_of(found.used) == ['ax', 'az']
    assert found.values[StateMember.AX] == pytest.approx(1.0)


def test_roll_of_an_imu_that_faces_left_is_pitch_of_the_robot():
    transform = Transform(rotation=FACING_LEFT)
    # The robot pitches by 0.1: its IMU, turned left, rolls by 0.1 and has a yaw of 90°.
    rotation = quaternion_from_rpy(0.1, 0.0, math.pi / 2)
    stamped = StampedPose(Transform(rotation=rotation), np.diag([0.0] * 3 + [0.4, 0.5, 0.6]), 0)
    channel = MeasurementChannel('imu0_pose', used('roll', 'yaw'))
    found = orientation_values(stamped, channel, PoseMemory(), transform)
    assert names_of(found.used) == ['pitch', 'yaw']
    assert found.values[3:6] == pytest.approx((0.0, 0.1, 0.0), abs=1e-12)
    assert found.covariance[StateMember.PITCH, StateMember.PITCH] == pytest.approx(0.4)


def test_a_pose_in_another_frame_is_turned_and_moved():
    channel = MeasurementChannel('odom0_pose', used('x', 'yaw'))
    frame = Transform((1.0, 2.0, 0.0), FACING_LEFT)
    found = pose_values(planar(3.0, 0.0, 0.2), channel, PoseMemory(), frame)
    assert names_of(found.used) == ['y', 'yaw']
    assert found.values[[StateMember.X, StateMember.Y]] == pytest.approx((1.0, 5.0))
    assert found.values[StateMember.YAW] == pytest.approx(math.pi / 2 + 0.2)
    assert found.covariance[StateMember.Y, StateMember.Y] == pytest.approx(0.1)
    assert found.covariance[StateMember.X, StateMember.X] == pytest.approx(0.2)


def test_a_relative_pose_is_that_since_the_first():
    channel = MeasurementChannel('odom0_pose', used('x', 'y', 'yaw'), relative=True)
    memory = PoseMemory()
    first = pose_values(planar(3.0, 1.0, math.pi / 2), channel, memory, Transform())
    assert first.values == pytest.approx(np.zeros(STATE_SIZE), abs=1e-12)
    second = pose_values(planar(3.0, 3.0, math.pi / 2 + 0.3), channel, memory, Transform())
    assert second.values[[StateMember.X, StateMember.Y, StateMember.YAW]] == pytest.approx(
        (2.0, 0.0, 0.3)
    )


def test_a_differential_pose_is_the_velocity_since_the_last():
    channel = MeasurementChannel('odom0_pose', used('x', 'yaw'), differential=True)
    memory = PoseMemory()
    assert pose_values(planar(3.0, 1.0, math.pi / 2, 1.0), channel, memory, Transform()) is None
    found = pose_values(planar(3.0, 1.2, math.pi / 2 + 0.1, 1.5), channel, memory, Transform())
    assert names_of(found.used) == ['vx', 'vyaw']
    assert found.values[[StateMember.VX, StateMember.VYAW]] == pytest.approx((0.4, 0.2))
    # Both covariances, times dt.
    assert found.covariance[StateMember.VX, StateMember.VX] == pytest.approx(0.5 * (0.1 + 0.1))
    assert pose_values(planar(3.0, 1.2, 0.0, 1.5), channel, memory, Transform()) is None


def test_a_pose_of_another_frame_of_the_robot():
    # A camera 0.5 m ahead of the robot's origin, looking left, is at (2, 1), and looks along y.
    camera_in_robot = Transform((0.5, 0.0, 0.0), FACING_LEFT)
    robot_in_camera = camera_in_robot.inverse()
    channel = MeasurementChannel('odom0_pose', used('x', 'y', 'yaw'))
    found = pose_values(
        planar(2.0, 1.0, math.pi / 2), channel, PoseMemory(), Transform(), robot_in_camera
    )
    assert found.values[[StateMember.X, StateMember.Y, StateMember.YAW]] == pytest.approx(
        (1.5, 1.0, 0.0), abs=1e-12
    )
    # The same as a velocity: the robot turns about its own origin, and the camera goes round it.
    channel = MeasurementChannel('odom0_pose', used('x', 'y', 'yaw'), differential=True)
    memory, poses = PoseMemory(), []
    for index, yaw in enumerate((0.0, 0.2)):
        camera = Transform(rotation=quaternion_from_rpy(0.0, 0.0, yaw)) @ camera_in_robot
        stamped = StampedPose(camera, np.eye(6), index * NANOSECONDS)
        poses.append(pose_values(stamped, channel, memory, Transform(), robot_in_camera))
    velocity = poses[-1].values[[StateMember.VX, StateMember.VY, StateMember.VYAW]]
    assert velocity == pytest.approx((0.0, 0.0, 0.2), abs=1e-12)


def test_in_the_plane_nothing_else_moves():
    channel = MeasurementChannel('odom0_pose', used('x', 'y', 'z', 'roll'))
    pose = Transform((1.0, 2.0, 3.0), quaternion_from_rpy(0.3, 0.2, 0.1))
    found = in_the_plane(
        pose_values(StampedPose(pose, np.ones((6, 6)), 0), channel, PoseMemory(), Transform())
    )
    assert all(found.values[index] == 0.0 for index in OUT_OF_PLANE)
    assert names_of(found.used) == [
        'x', 'y', 'z', 'roll', 'pitch', 'vz', 'vroll', 'vpitch', 'az',
    ]  # fmt: skip
    assert found.covariance[StateMember.X, StateMember.Z] == 0.0
    assert found.covariance[StateMember.X, StateMember.Y] == 1.0
    assert found.covariance[StateMember.Z, StateMember.Z] == 1e-6
