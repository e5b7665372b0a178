# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The swap, over real ROS: the shipped robot with another ``<plugin>`` drives a motor board on a
serial port; the board is unplugged in mid-drive, and comes back.
"""

from contextlib import contextmanager
from itertools import pairwise
import math
import signal
import subprocess

from controller_manager_msgs.srv import ListHardwareComponents
from geometry_msgs.msg import TwistStamped
from lifecycle_msgs.msg import State
from nav_msgs.msg import Odometry
from rclpy.node import Node
from support.manager_host import ros_in_this_process
from support.paths import ROOT
from support.ros_processes import command, environment, PATIENCE
from support.running_stack import NAMES, running_stack

from amr_description.bringup.stacks.hardware import swap_hardware
from amr_description.control.ros.client import ManagerClient
from amr_description.ros.service_calls import call, wait_until

URDF = (ROOT / 'urdf' / 'amr.urdf').read_text()
UNCONFIGURED, ACTIVE = 'unconfigured', 'active'


@contextmanager
def motor_board(link):
    """Run a simulated board behind ``link``, until it is unplugged."""
    line = command('motor_board', '--link', str(link))
    board = subprocess.Popen(line, stdout=subprocess.PIPE, text=True, env=environment())
    try:
        assert 'linked as' in board.stdout.readline()
        yield board
    finally:
        board.kill()
        board.communicate()


class Driver(Node):
    """Commands 0.5 m/s, subscribes to odometry, and calls the manager."""

    def __init__(self):
        super().__init__('driver')
        self.manager = ManagerClient(self, 'controller_manager', timeout=PATIENCE)
        self.odometry = []
        self.create_subscription(Odometry, '/diff_drive_controller/odom', self.odometry.append, 50)
        self.publisher = self.create_publisher(TwistStamped, '/diff_drive_controller/cmd_vel', 1)

    def wait(self, condition):
        assert wait_until(
            self, lambda: condition() or None, lambda: None, every=9.0, timeout=PATIENCE
        )

    def drive(self):
        """Wait until the robot is at speed."""
        message = TwistStamped()
        message.twist.linear.x = 0.5
        timer = self.create_timer(0.05, lambda: self.publisher.publish(message))
        self.wait(lambda: self.odometry and self.odometry[-1].twist.twist.linear.x > 0.45)
        self.destroy_timer(timer)

    def component(self):
        response = call(
            self,
            ListHardwareComponents,
            '/controller_manager/list_hardware_components',
            ListHardwareComponents.Request(),
        )
        return response.component[0].state.label


def steps(odometry):
    """m and s from one odometry to the next; some may be lost on the way."""
    for a, b in pairwise(odometry):
        places = [(m.pose.pose.position.x, m.pose.pose.position.y) for m in (a, b)]
        yield math.dist(*places), (seconds(b.header.stamp) - seconds(a.header.stamp))


def seconds(stamp):
    return stamp.sec + stamp.nanosec * 1e-9


def test_a_board_is_driven_unplugged_and_plugged_in_again(tmp_path):
    link = tmp_path / 'board'
    urdf = swap_hardware(
        URDF,
        'amr_description/SerialBaseSystem',
        {
            'port': str(link),
            'left_joints': 'joint_wheel_front_left joint_wheel_back_left',
            'right_joints': 'joint_wheel_front_right joint_wheel_back_right',
            'answer_timeout': '5.0',  # s; the board is a process that others may delay
        },
    )
    with motor_board(link) as board, running_stack(tmp_path, urdf) as log, ros_in_this_process():
        driver = Driver()
        driver.drive()

        board.send_signal(signal.SIGKILL)
        before = driver.odometry[-1].pose.pose.position.x
        driver.wait(lambda: driver.component() == UNCONFIGURED)
        assert driver.manager.states() == dict.fromkeys(NAMES, 'inactive')
        driver.wait(lambda: 'the motor board' in log.read_text())
        (line,) = [text for text in log.read_text().splitlines() if 'the motor board' in text]
        assert f'the motor board on {link} is gone' in line
        assert 'ros2 control set_hardware_component_state AmrSystem active' in line

        with motor_board(link):
            response = driver.manager.set_component_state('AmrSystem', State(label=ACTIVE))
            assert response.ok
            assert response.state.label == ACTIVE
            assert driver.manager.switch(activate=NAMES) is None
            driver.odometry.clear()
            driver.drive()
        odometry = list(driver.odometry)
        driver.destroy_node()
    assert before <= odometry[0].pose.pose.position.x < before + 1.0
    # At 0.5 m/s, and no jump: at 50 Hz a centimetre from one odometry to the next.
    assert all(way < 0.04 + 0.5 * time for way, time in steps(odometry))
