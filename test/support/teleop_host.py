# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot that hears what a teleop sends, and the teleop in a terminal, for tests."""

from contextlib import contextmanager
import sys
import termios

from geometry_msgs.msg import Twist
import rclpy
from rclpy.node import Node
from support.running_programs import Program

from amr_description.ros.service_calls import wait_until

COMMAND = f'{sys.executable} -m amr_description.nodes.teleop_twist_keyboard'
ONE_KEY_ONE_MESSAGE = ('-p', 'repeat_rate:=0.0', '-p', 'key_timeout:=0.0')
XTERM = {'TERM': 'xterm'}
"""Of a terminal that is asked for the kitty protocol, wherever the tests run."""


class Robot(Node):
    """Hears commands as (linear x, angular z)."""

    def __init__(self):
        super().__init__('robot')
        self.messages = []

    def listen(self, message_type=Twist, topic='/cmd_vel'):
        return self.create_subscription(message_type, topic, self.messages.append, 10)

    def until(self, condition):
        """Serve the node until ``condition()`` is true."""
        assert wait_until(
            self, lambda: condition() or None, lambda: None, every=60.0, timeout=20.0
        ), f'waited in vain; heard {self.commands}'

    @property
    def twists(self):
        return [getattr(message, 'twist', message) for message in self.messages]

    @property
    def commands(self):
        return [(twist.linear.x, twist.angular.z) for twist in self.twists]

    @property
    def heights(self):
        return [twist.linear.z for twist in self.twists]


@contextmanager
def robot_node():
    rclpy.init(args=[])
    node = Robot()
    try:
        yield node
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def connect(robot, program):
    """Wait until each has found the other; forget what was sent for that."""
    robot.until(lambda: program.type('k') or robot.messages)
    program.type('tk')  # what comes before this has been heard when this is heard
    robot.until(lambda: robot.heights[-2:] == [0.5, 0.0])
    robot.messages.clear()


@contextmanager
def driving(robot, *arguments, options=(), **listened):
    """Start teleop in a terminal, the robot listening; yield it when each has found the other."""
    robot.listen(**listened)
    words = [*options, '--ros-args', *arguments]
    with Program.module('teleop_twist_keyboard', *words, terminal=True, env=XTERM) as program:
        program.before = termios.tcgetattr(program.terminal)
        program.expect('currently:\tspeed')
        connect(robot, program)
        yield program
