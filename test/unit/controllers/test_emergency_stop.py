# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The lock ``emergency_stop`` of every controller that takes velocity commands."""

import pytest
from support.control_fakes import FakeLog
from support.wheel_bench import PERIOD, WheelBench

from amr_description.control.samples import FlagSample, TwistSample
from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.wheeled_drive import EMERGENCY_STOP, EmergencyStop
from amr_description.log import Severity

CORNERS = ('front_left', 'front_right', 'rear_right', 'rear_left')
SIDES = {'left_wheel_names': ['left'], 'right_wheel_names': ['right']}
DIFFERENTIAL = SIDES | {'wheel_separation': 0.5, 'wheel_radius': 0.1}
MECANUM = {f'{corner}_wheel_command_joint_name': corner for corner in CORNERS} | {
    'kinematics.wheels_radius': 0.1,
    'kinematics.sum_of_robot_center_projection_on_X_Y_axis': 0.5,
}
BICYCLE = {
    'traction_joints_names': ['rear'],
    'steering_joints_names': ['steer'],
    'wheelbase': 1.0,
    'traction_wheel_radius': 0.1,
}
CAR = BICYCLE | {'traction_joints_names': ['tr', 'tl'], 'traction_track_width': 0.5}
TRICYCLE = CAR | {'traction_wheels_radius': 0.1}
del CAR['traction_wheel_radius'], TRICYCLE['traction_wheel_radius']
ACKERMANN = TRICYCLE | {'steering_joints_names': ['sr', 'sl'], 'steering_track_width': 0.5}
DRIVES = {
    'diff_drive_controller/DiffDriveController': DIFFERENTIAL,
    'amr_description/GazeboDiffDrive': DIFFERENTIAL,
    'mecanum_drive_controller/MecanumDriveController': MECANUM | {'reference_timeout': 0.5},
    'amr_description/GazeboMecanumDrive': MECANUM,
    'omni_wheel_drive_controller/OmniWheelDriveController': {
        'wheel_names': ['a', 'b', 'c'],
        'wheel_offset': 0.0,
        'robot_radius': 0.2,
        'wheel_radius': 0.05,
    },
    'bicycle_steering_controller/BicycleSteeringController': BICYCLE | {'reference_timeout': 0.5},
    'tricycle_steering_controller/TricycleSteeringController': TRICYCLE
    | {'reference_timeout': 0.5},
    'ackermann_steering_controller/AckermannSteeringController': ACKERMANN
    | {'reference_timeout': 0.5},
    'amr_description/GazeboAckermannDrive': ACKERMANN,
    'tricycle_controller/TricycleController': {
        'traction_joint_name': 'drive',
        'steering_joint_name': 'steer',
        'wheelbase': 0.5,
        'wheel_radius': 0.1,
    },
    'amr_description/GazeboPlanarMove': {},
}
CHAINABLE = [each for each in DRIVES if CONTROLLERS.find(each).is_chainable]


def bench(kind, chained=False, **values):
    return WheelBench(CONTROLLERS.find(kind), DRIVES[kind] | values, chained=chained)


def lock_of(robot):
    (lock,) = (each for each in robot.controller.inputs() if each.port.name == EMERGENCY_STOP)
    return lock


def speeds(robot):
    """What is commanded of the driven joints, not of those that steer."""
    return [
        command.value for command in robot.commands.values() if command.interface != 'position'
    ]


def test_the_lock_is_the_topic_that_twist_mux_and_real_robots_have():
    port = EmergencyStop(FakeLog()).port
    assert (port.name, port.message) == ('emergency_stop', 'std_msgs/msg/Bool')
    assert (port.qos.reliability, port.qos.durability) == ('reliable', 'system_default')


def test_every_controller_that_drives_has_it():
    drives = {each for each in CONTROLLERS.names if 'Drive' in each or 'Steering' in each}
    drives |= {'amr_description/GazeboPlanarMove', 'tricycle_controller/TricycleController'}
    assert drives == set(DRIVES)
    for kind in DRIVES:
        assert lock_of(bench(kind)).is_engaged is False


@pytest.mark.parametrize('kind', DRIVES)
def test_a_stranger_who_goes_on_moves_nothing_until_the_lock_is_released(kind):
    robot = bench(kind)
    robot.drive(0.3, seconds=0.5)
    assert any(speeds(robot))
    lock_of(robot).put(FlagSample(True))
    for _ in range(100):
        robot.drive(0.3, angular=0.2)
        assert not any(speeds(robot))
    lock_of(robot).put(FlagSample(False))
    robot.update(3)  # what came before the release is forgotten
    assert not any(speeds(robot))
    robot.drive(0.3, seconds=0.1)
    assert any(speeds(robot))


@pytest.mark.parametrize('kind', CHAINABLE)
def test_a_preceding_controller_moves_nothing_either(kind):
    robot = bench(kind, chained=True)
    references = len(robot.controller.references())
    command = (0.3,) + (0.0,) * (references - 1)
    robot.refer(*command)
    robot.update()
    assert any(speeds(robot))
    lock_of(robot).put(FlagSample(True))
    for _ in range(10):
        robot.refer(*command)
        robot.update()
        assert not any(speeds(robot))


def test_the_robot_decelerates_within_its_limits():
    kind = 'diff_drive_controller/DiffDriveController'
    robot = bench(kind, **{'linear.x.max_acceleration': 1.0, 'linear.x.max_deceleration': -1.0})
    robot.drive(0.5, seconds=1.0)
    lock_of(robot).put(FlagSample(True))
    rims = [robot.update()[0] * 0.1 for _ in range(60)]
    assert rims[0] == pytest.approx(0.49)
    assert rims[24] == pytest.approx(0.25)
    assert rims[49:] == pytest.approx([0.0] * 11, abs=1e-12)


def test_odometry_goes_on():
    robot = bench('diff_drive_controller/DiffDriveController', publish_rate=1000.0)
    robot.drive(0.5, seconds=0.1)
    lock_of(robot).put(FlagSample(True))
    before = len(robot.sent['~/odom'])
    robot.update(50)
    assert len(robot.sent['~/odom']) == before + 50


def test_the_lock_stays_while_the_controller_is_switched_off_and_on():
    robot = bench('diff_drive_controller/DiffDriveController')
    for port in robot.controller.inputs():
        port.close()
    robot.controller.deactivate(robot.time)
    assert lock_of(robot).put(FlagSample(True))
    robot.activate()
    robot.drive(0.3, seconds=0.5)
    assert not any(speeds(robot))


def test_a_change_is_logged_once():
    log = FakeLog()
    lock = EmergencyStop(log)
    for value in (False, True, True, True, False, False):
        lock.put(FlagSample(value))
    assert [text.partition(':')[0] for text in log.texts(Severity.WARN)] == [
        "'emergency_stop' is true",
        "'emergency_stop' is false",
    ]


def test_it_is_recorded_when_the_controller_acts_on_it():
    robot, recorded = bench('diff_drive_controller/DiffDriveController'), []
    lock = lock_of(robot)
    lock.on_drain = recorded.extend
    lock.put(FlagSample(True), b'true')
    assert recorded == []
    robot.update()
    assert recorded == [b'true']


def test_a_command_of_before_the_stop_is_not_in_force_after_it():
    robot = bench('amr_description/GazeboDiffDrive')  # whose commands never expire
    robot.controller.inputs()[0].put(TwistSample(0, 0.3, 0.0))
    robot.update()
    assert any(speeds(robot))
    lock_of(robot).put(FlagSample(True))
    robot.update()
    lock_of(robot).put(FlagSample(False))
    robot.update(round(1e9 / PERIOD))
    assert not any(speeds(robot))
