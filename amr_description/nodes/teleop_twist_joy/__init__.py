# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``teleop_node`` of ``teleop_twist_joy``, where that is not installed: a joystick drives a robot.

::

    ros2 run teleop_twist_joy teleop_node --ros-args -p enable_button:=4 -p axis_linear.x:=1 \
        -p axis_angular.yaw:=0 -r cmd_vel:=/diff_drive_controller/cmd_vel

======================  =======================================================================
subscribes to           ``joy``, ``sensor_msgs/Joy``: of ``ros2 run joy joy_node``
publishes               ``cmd_vel``: ``Twist``, or ``TwistStamped`` with
                        ``publish_stamped_twist``
======================  =======================================================================

Names, parameters, defaults and QoS are those of the original. In addition it says who wants the
other type on ``cmd_vel``: DDS would deliver no command there, and report nothing.
"""

from dataclasses import dataclass

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time import ClockType
from sensor_msgs.msg import Joy

from amr_description.nodes.teleop_twist_joy.commands import (
    JoyCommand,
    JoyCommander,
    JoyCommandSettings,
)
from amr_description.parameters import parameter
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import add_validation_callback, declare, values
from amr_description.ros.runtime import run
from amr_description.ros.type_mismatch import unheard_lines

_PURPOSE = 'Publish velocity commands on cmd_vel, as a joystick on the topic "joy" says.'
_CHECK_PERIOD = 0.5
"""s between two looks at who subscribes to the commands: rclpy has no event for that."""


@dataclass(frozen=True)
class TeleopTwistJoySettings(JoyCommandSettings):
    """All parameters; those of its own cannot be changed while the node runs."""

    publish_stamped_twist: bool = parameter(
        False, 'Publish TwistStamped instead of Twist', read_only=True
    )
    frame: str = parameter(
        'teleop_twist_joy', 'Frame of the commands, with TwistStamped only', read_only=True
    )


class TeleopTwistJoy(Node):
    """The node."""

    def __init__(self) -> None:
        super().__init__('teleop_twist_joy_node')
        settings = declare(self, TeleopTwistJoySettings)
        self._is_stamped, self._frame = settings.publish_stamped_twist, settings.frame
        self._commander = JoyCommander(settings)
        add_validation_callback(self, TeleopTwistJoySettings)
        self.add_post_set_parameters_callback(self._take_settings)
        kind = TwistStamped if self._is_stamped else Twist
        self._commands = self.create_publisher(kind, 'cmd_vel', 10)
        self._states = self.create_subscription(Joy, 'joy', self._receive, 10)
        self._said: set[str] = set()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_CHECK_PERIOD, self._check, clock=steady)
        if settings.require_enable_button:
            self.get_logger().info(f'Teleop enable button {settings.enable_button}.')
        if settings.enable_turbo_button >= 0:
            self.get_logger().info(f'Turbo on button {settings.enable_turbo_button}.')

    def _take_settings(self, _changed: list[Parameter]) -> None:
        self._commander.settings = values(self, TeleopTwistJoySettings)

    def _receive(self, message: Joy) -> None:
        command = self._commander.command(message.axes, message.buttons)
        if command is not None:
            self._commands.publish(self._message(command))

    def _message(self, command: JoyCommand) -> Twist | TwistStamped:
        message = TwistStamped()
        linear, angular = message.twist.linear, message.twist.angular
        linear.x, linear.y, linear.z = command.x, command.y, command.z
        angular.x, angular.y, angular.z = command.roll, command.pitch, command.yaw
        if not self._is_stamped:
            return message.twist
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = self._frame
        return message

    def _check(self) -> None:
        """Say once who subscribes to the other type."""
        option = 'publish_stamped_twist'
        for line in unheard_lines(self, self._commands.topic_name, self._is_stamped, option):
            if line not in self._said:
                self._said.add(line)
                self.get_logger().warning(line)


def main(args: list[str] | None = None) -> int:
    """Drive until asked to stop."""
    if print_help(args, 'teleop_twist_joy', _PURPOSE, TeleopTwistJoySettings):
        return 0
    return run(TeleopTwistJoy, args)
