# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The whole stack over real DDS: brought up, driven by topics, and compared with the truth.

The truth is asked of the simulator (``get_entity_state``), odometry is heard on ``/odom``: what
lies between is physics, encoders, controller and wire.
"""

import math
import os
from pathlib import Path
import signal
import subprocess

from ament_index_python.packages import get_package_prefix
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import GetEntityState
from support.preloaded import Popen
from support.ros_processes import PATIENCE
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS
from amr_description.control.ros.client import ManagerClient
from amr_description.model.frames import yaw_of
from amr_description.ros.service_calls import call, wait_until
from amr_description.sim.actuators import FASTEST_JOINT

PERIOD = 0.05
"""s between two commands."""

pytestmark = pytest.mark.in_order('one robot: it rests, is driven, and drives still at the end')


@pytest.fixture(scope='module')
def stack(tmp_path_factory):
    """The stack as scripts/run brings it up; everything must be gone afterwards."""
    bringup = Path(get_package_prefix('amr_description'), 'lib', 'amr_description', 'bringup')
    log = tmp_path_factory.mktemp('log')
    process = Popen(
        [bringup, 'simulation', 'viewer:=false'],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {'ROS_LOG_DIR': str(log)},
        start_new_session=True,
    )
    said = []
    for line in process.stdout:
        said.append(line)
        if 'ready in' in line:
            break
    else:
        pytest.fail(f'the stack ended ({process.wait()}): {"".join(said)}')
    children = [int(pid) for pid in _children(process.pid)]
    yield process
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
    assert [pid for pid in children if Path(f'/proc/{pid}').exists()] == []


class Driver(Node):
    """Commands, hears odometry, and asks for the truth."""

    def __init__(self):
        super().__init__('test_stack', parameter_overrides=[Parameter('use_sim_time', value=True)])
        self.publisher = self.create_publisher(TwistStamped, '/diff_drive_controller/cmd_vel', 10)
        self.odometry = []
        self.transforms = {}
        self.create_subscription(Odometry, '/odom', self.odometry.append, 50)
        self.create_subscription(TFMessage, '/tf', self.hear_transforms, 100)

    def hear_transforms(self, message):
        for each in message.transforms:
            self.transforms[each.header.frame_id, each.child_frame_id] = each.transform

    def drive(self, linear, angular, until):
        """Command a twist 20 times a second until ``until()`` is true."""
        command = TwistStamped()
        command.twist.linear.x, command.twist.angular.z = linear, angular
        timer = self.create_timer(PERIOD, lambda: self.publisher.publish(command))
        assert wait_until(self, lambda: until() or None, lambda: None, every=9.0, timeout=PATIENCE)
        self.destroy_timer(timer)

    def wait(self, condition):
        assert wait_until(
            self, lambda: condition() or None, lambda: None, every=9.0, timeout=PATIENCE
        )

    def stop(self):
        """Command zero until odometry is at rest."""
        self.drive(0.0, 0.0, lambda: abs(self.speed) < 1e-3 and abs(self.turn) < 1e-3)

    @property
    def speed(self):
        return self.odometry[-1].twist.twist.linear.x

    @property
    def turn(self):
        return self.odometry[-1].twist.twist.angular.z

    @property
    def pose(self):
        return planar(self.odometry[-1].pose.pose)

    def truth(self):
        request = GetEntityState.Request(entity='amr')
        response = call(self, GetEntityState, '/mujoco_sim/get_entity_state', request)
        assert response.result.error_message == ''
        return planar(response.state.pose)


def planar(pose):
    q = pose.orientation
    return pose.position.x, pose.position.y, yaw_of((q.x, q.y, q.z, q.w))


def difference(angle, other):
    """The angle from one heading to another, rad, in (−π, π]."""
    return math.remainder(angle - other, math.tau)


@pytest.fixture
def driver(stack):
    rclpy.init(args=[])
    driver = Driver()
    assert wait_until(
        driver, lambda: driver.odometry or None, lambda: None, every=9.0, timeout=PATIENCE
    )
    yield driver
    driver.destroy_node()
    rclpy.try_shutdown()


def test_both_controllers_are_active_and_the_robot_rests(driver):
    states = ManagerClient(driver, 'controller_manager', timeout=PATIENCE).states()
    assert states == {'diff_drive_controller': 'active', 'joint_state_broadcaster': 'active'}
    x, y, yaw = driver.truth()
    assert (x, y, yaw) == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)


def test_straight_ahead_is_towards_x_and_odometry_tells_the_truth(driver):
    start, truth_start = driver.pose, driver.truth()
    driver.drive(0.5, 0.0, lambda: driver.pose[0] - start[0] > 1.0)
    driver.stop()
    travelled = driver.pose[0] - start[0]
    truly = driver.truth()[0] - truth_start[0]
    assert travelled > 1.0
    assert truly == pytest.approx(travelled, rel=0.01)


def test_a_full_turn_is_a_full_turn(driver):
    start, truth_start = driver.pose, driver.truth()
    turned = Turned(driver)
    driver.drive(0.0, 1.0, lambda: turned.angle() > math.tau)
    driver.stop()
    odometry, truth = driver.pose, driver.truth()
    error = difference(truth[2] - truth_start[2], odometry[2] - start[2])
    assert abs(error) < 0.03 * math.tau
    drift = math.hypot(truth[0] - truth_start[0], truth[1] - truth_start[1])
    assert drift < 0.02


def test_transforms_connect_odometry_to_every_wheel(driver):
    expected = {('odom', 'base_footprint')} | {
        ('base_link', f'wheel_{end}_{side}')
        for end in ('front', 'back')
        for side in ('left', 'right')
    }
    assert wait_until(
        driver,
        lambda: expected <= driver.transforms.keys() or None,
        lambda: None,
        every=9.0,
        timeout=PATIENCE,
    )
    parents = {}
    for parent, child in driver.transforms:
        parents.setdefault(child, set()).add(parent)
    assert {child: p for child, p in parents.items() if len(p) > 1} == {}


def test_silence_brakes(driver):
    driver.drive(0.5, 0.0, lambda: driver.speed > 0.45)
    last_stamp = driver.odometry[-1].header.stamp
    assert wait_until(
        driver, lambda: abs(driver.speed) < 1e-3 or None, lambda: None, every=9.0, timeout=PATIENCE
    )
    stamp = driver.odometry[-1].header.stamp
    assert (stamp.sec, stamp.nanosec) > (last_stamp.sec, last_stamp.nanosec)


HUGE = 1.7e308
"""m/s; finite, but the wheels' speeds that follow from it are not."""


@pytest.mark.parametrize('value', [math.nan, -math.inf, HUGE, -1e30])
@pytest.mark.parametrize('age', [0.0, 3.0, -3600.0, math.inf], ids='age {} s'.format)
def test_no_command_makes_a_wheel_run_away(driver, value, age):
    """Last, as the robot may be anywhere afterwards; age inf: no stamp."""
    states = []
    subscription = driver.create_subscription(JointState, '/joint_states', states.append, 100)
    command = TwistStamped()
    command.twist.linear.x = command.twist.angular.z = value
    if math.isfinite(age):
        driver.wait(lambda: driver.get_clock().now().nanoseconds > age * NANOSECONDS)
        stamp = driver.get_clock().now() - Duration(seconds=age)
        command.header.stamp = stamp.to_msg()
    for _ in range(5):
        driver.publisher.publish(command)
        heard = len(states)
        driver.wait(lambda: len(states) > heard + 1)  # noqa: B023
    driver.destroy_subscription(subscription)
    speeds = [speed for state in states for speed in state.velocity]
    assert all(abs(speed) <= FASTEST_JOINT * 1.05 for speed in speeds)
    assert all(math.isfinite(part) for part in driver.pose)


def test_after_all_that_it_drives(driver):
    manager = ManagerClient(driver, 'controller_manager', timeout=PATIENCE)
    assert set(manager.states().values()) == {'active'}
    driver.stop()
    driver.drive(0.5, 0.0, lambda: driver.speed > 0.45)


class Turned:
    """The angle that odometry has turned since it was made, rad, beyond full turns too."""

    def __init__(self, driver):
        self._driver = driver
        self._last = driver.pose[2]
        self._seen = len(driver.odometry)
        self._angle = 0.0

    def angle(self):
        for message in self._driver.odometry[self._seen :]:
            heading = planar(message.pose.pose)[2]
            self._angle += difference(heading, self._last)
            self._last = heading
        self._seen = len(self._driver.odometry)
        return self._angle


def _children(pid):
    return Path(f'/proc/{pid}/task/{pid}/children').read_text().split()
