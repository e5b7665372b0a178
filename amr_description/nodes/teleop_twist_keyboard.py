# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``teleop_twist_keyboard``: drive a robot with the keys of a terminal.

It publishes ``cmd_vel``, ``geometry_msgs/Twist`` or, with ``stamped``, ``TwistStamped`` (reliable,
depth 10). Keys, texts and the parameters ``stamped``, ``frame_id``, ``speed`` and ``turn`` are
those of the original; every key press publishes one message. Two things are added, because the
original stutters on a controller that brakes 0.5 s after the last command (the second message of a
held key comes up to 0.66 s after the first), and because on a controller that does not brake the
robot drives on when the key is let go:

``repeat_rate``
    While a key is held, and ``key_timeout`` after a single press, the command is repeated.
``key_timeout``
    Then one zero is sent, and nothing more: other publishers of ``cmd_vel`` have their turn.

``-p repeat_rate:=0.0 -p key_timeout:=0.0`` is the original: one message per key press.

In every way out (Ctrl-C, SIGTERM, SIGHUP, a fault, Ctrl-Z for the time being) a zero is sent and
the terminal restored.
"""

from dataclasses import dataclass
import sys
import time

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.duration import Duration
from rclpy.node import Node

from amr_description.errors import ParameterError
from amr_description.nodes.keyboard import Keyboard
from amr_description.nodes.node_parameters import declare
from amr_description.nodes.runtime import argument_errors, program, ros, spinning
from amr_description.nodes.teleop_keys import CTRL_C, CTRL_Z, HELP, Hold, Teleop, Velocity
from amr_description.parameters import parameter

_GOODBYE_TIMEOUT = Duration(seconds=0.2)


@dataclass(frozen=True)
class Settings:
    """The parameters of teleop_twist_keyboard; none can be changed while it runs."""

    stamped: bool = parameter(False, 'Publish TwistStamped instead of Twist', read_only=True)
    frame_id: str = parameter('', 'Frame of the commands, with stamped only', read_only=True)
    speed: float = parameter(0.5, 'Linear speed at the start', unit='m/s', read_only=True)
    turn: float = parameter(1.0, 'Angular speed at the start', unit='rad/s', read_only=True)
    repeat_rate: float = parameter(
        10.0,
        'How often a held command is repeated; 0: one message per key press',
        unit='Hz',
        read_only=True,
        minimum=0.0,
        maximum=1000.0,
    )
    key_timeout: float = parameter(
        0.7,
        'How long a single key press holds; above the delay of the auto-repeat. 0: for ever',
        unit='s',
        read_only=True,
        minimum=0.0,
    )


class TeleopTwistKeyboard(Node):
    """The publisher of commands; it knows no keys."""

    def __init__(self) -> None:
        super().__init__('teleop_twist_keyboard')
        self.settings = declare(self, Settings)
        if self.settings.frame_id and not self.settings.stamped:
            raise ParameterError("'frame_id' can only be set when 'stamped' is True")
        message_type = TwistStamped if self.settings.stamped else Twist
        self._commands = self.create_publisher(message_type, 'cmd_vel', 10)

    def publish(self, velocity: Velocity) -> None:
        """Publish one command, stamped with the node's clock."""
        message = TwistStamped()
        twist = message.twist
        twist.linear.x, twist.linear.y, twist.linear.z = velocity.x, velocity.y, velocity.z
        twist.angular.z = velocity.yaw
        if self.settings.stamped:
            message.header.stamp = self.get_clock().now().to_msg()
            message.header.frame_id = self.settings.frame_id
            self._commands.publish(message)
        else:
            self._commands.publish(twist)

    def stop_robot(self) -> None:
        """Publish zero and wait, but not for long, until every subscriber has it."""
        self.publish(Velocity())
        self._commands.wait_for_all_acked(_GOODBYE_TIMEOUT)


def drive(node: TeleopTwistKeyboard, keyboard: Keyboard) -> None:
    """Turn keys into commands until Ctrl-C."""
    settings = node.settings
    teleop = Teleop(settings.speed, settings.turn)
    hold = Hold(1.0 / settings.repeat_rate if settings.repeat_rate else 0.0, settings.key_timeout)
    print(HELP)
    print(teleop.speeds, flush=True)
    while True:
        for key in keyboard.read(hold.wait(time.monotonic())):
            if key == CTRL_C:
                return
            text = teleop.press(key)
            if text:
                print(text, flush=True)
            node.publish(teleop.velocity)
            hold.press(key, time.monotonic(), moving=teleop.is_moving)
            if key == CTRL_Z:  # has stopped the robot, as every key without a meaning
                keyboard.suspend()
        if hold.is_released(time.monotonic()):
            teleop.stop()
            node.publish(teleop.velocity)
        elif hold.is_repeat_due(time.monotonic()):
            node.publish(teleop.velocity)


def teleop_twist_keyboard(args: list[str] | None) -> None:
    """Set up node and terminal, drive, and leave both in order."""
    with ros(args) as stop:
        with argument_errors():
            node = TeleopTwistKeyboard()
        with (
            spinning(node),
            Keyboard(sys.stdin.fileno()) as keyboard,
            stop.on_stop(keyboard.leave),
        ):
            try:
                drive(node, keyboard)
            finally:
                stop.leave()
                node.stop_robot()


def main(args: list[str] | None = None) -> int:
    """Drive until Ctrl-C."""
    return program(lambda: teleop_twist_keyboard(args), stopped=0)


if __name__ == '__main__':
    raise SystemExit(main())
