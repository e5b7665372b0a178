# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What dies beside a robot is started again; the robot stops meanwhile, and goes on after that."""

import os
import signal

from fixtures.bringup.running import Bringup
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from support.ros_processes import PATIENCE

from amr_description.ros.qos import CLOCK
from amr_description.ros.service_calls import wait_until

START = 10.0
"""s after which a failure is none of the start; see bringup/description.py."""


class Operator(Node):
    """Sends goals, and looks at clock and speed."""

    def __init__(self):
        super().__init__('operator')
        self.time = self.speed = 0.0
        self.goals = self.create_publisher(PoseStamped, 'goal_pose', 10)
        self.create_subscription(Odometry, 'ground_truth/odom', self.hear_odometry, 10)
        self.create_subscription(Clock, '/clock', self.hear_clock, CLOCK)

    def hear_odometry(self, message):
        self.speed = abs(message.twist.twist.linear.x)

    def hear_clock(self, message):
        self.time = message.clock.sec + 1e-9 * message.clock.nanosec

    def until(self, condition, on_wait=lambda: None):
        found = wait_until(self, lambda: condition() or None, on_wait, every=1.0, timeout=PATIENCE)
        assert found, 'waited in vain'

    def pass_time(self, seconds):
        end = self.time + seconds
        self.until(lambda: self.time >= end)

    def drive(self):
        """Send it to the other one of two goals until it drives."""

        def send():
            goal = PoseStamped()
            goal.header.frame_id = 'map'
            goal.pose.position.x, goal.pose.position.y = 2.0, 0.8
            self.goals.publish(goal)

        self.until(lambda: self.speed > 0.2, send)


@pytest.fixture
def operator():
    rclpy.init(args=[])
    node = Operator()
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.mark.long
def test_the_robot_outlives_all_that_it_does_not_stand_on(tmp_path, operator):
    prefix = os.environ['AMENT_PREFIX_PATH']
    with Bringup(tmp_path, 'navigation', AMENT_PREFIX_PATH=prefix) as stack:
        kinds = ('navigator', 'truth_localizer', 'map_of_world', 'viewer')
        beside = {
            kind: stack.expect(rf'\[({kind}-\d+)\]: process started with pid')[1] for kind in kinds
        }
        operator.until(lambda: operator.time > 0.0)
        operator.pass_time(START + 2.0)
        before = stack.pids()
        operator.drive()
        for kind, name in beside.items():
            os.kill(before[name], signal.SIGKILL)
            died = stack.expect(
                name + r'\]: process is started again in 1.0 s \(1 of 5\); its last'
            )
            if kind == 'navigator':
                operator.until(lambda: operator.speed < 0.01)
            stack.expect(name + r'\]: process started with pid', died.end())
        operator.drive()
        after = stack.pids()
        assert {name for name in before if before[name] != after[name]} == {*beside.values()}
        assert stack.end(signal.SIGINT) == 0
        assert 'Traceback' not in stack.output
