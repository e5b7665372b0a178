# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``teleop_twist_keyboard``: drive a robot with the keys of a terminal.

It publishes ``cmd_vel``, ``geometry_msgs/Twist`` or, with ``stamped``, ``TwistStamped`` (reliable,
depth 10). Keys, texts and the parameters ``stamped``, ``frame_id``, ``speed`` and ``turn`` are
those of the original; every key press publishes one message. In addition:

``stamped`` is optional
    By default the type is that of the subscriptions on the topic, also of later ones, and it is
    printed. With the wrong type DDS would deliver no command, and report nothing.
``repeat_rate``
    While a key is held, the command is repeated. With the original, a controller that brakes 0.5 s
    after the last command stutters: the second message of a held key comes up to 0.66 s after the
    first.
``key_timeout``
    Releasing a key stops the robot: at once if the terminal reports releases (kitty keyboard
    protocol), else when the auto-repeat ends, or this long after a single press. A single zero is
    published and then nothing, so other publishers of ``cmd_vel`` can command the robot.
``--latch``
    The robot drives on until the next key, as with the original. Together with
    ``-p repeat_rate:=0.0`` it publishes exactly what the original does.

However it ends (Ctrl-C, SIGTERM, SIGHUP, SIGQUIT, an exception), and on Ctrl-Z, it publishes a
zero and restores the terminal.
"""

import argparse
from collections.abc import Iterable
import os
import sys
import time

from rclpy.utilities import remove_ros_args

from amr_description.errors import AmrError
from amr_description.nodes.teleop_twist_keyboard.keyboard import Keyboard
from amr_description.nodes.teleop_twist_keyboard.keys import HELP, KeyHold, Teleop
from amr_description.nodes.teleop_twist_keyboard.node import TeleopTwistKeyboard
from amr_description.ros.runtime import argument_errors, program, ros, spinning
from amr_description.terminal import CTRL_C, CTRL_Z, KeyEvent

_STDIN = 0  # sys.stdin is None where it was closed
_CHECK_PERIOD = 0.5  # s between two checks for new subscriptions; each takes 0.1 ms


class KeyboardDriver:
    """Turns keys into commands, and prints what the user needs to know."""

    def __init__(self, node: TeleopTwistKeyboard, keyboard: Keyboard) -> None:
        settings = node.settings
        self._node, self._keyboard = node, keyboard
        self._teleop = Teleop(settings.speed, settings.turn)
        period = 1.0 / settings.repeat_rate if settings.repeat_rate else 0.0
        self._hold = KeyHold(period, settings.key_timeout)

    def drive(self) -> None:
        """Publish commands until Ctrl-C."""
        print_lines([HELP, *self._node.check_first(), self._teleop.speeds])
        check_at = time.monotonic() + _CHECK_PERIOD
        while True:
            now = time.monotonic()
            due = self._hold.wait(now)
            until_check = max(0.0, check_at - now)
            timeout = until_check if due is None else min(due, until_check)
            for event in self._keyboard.read(timeout):
                if event.key == CTRL_C:
                    return
                self._handle(event)
            self._repeat_or_stop(time.monotonic())
            if time.monotonic() >= check_at:
                print_lines(self._node.check())
                check_at = time.monotonic() + _CHECK_PERIOD

    def _handle(self, event: KeyEvent) -> None:
        if event.is_release:
            if self._hold.release(event.name):
                self._stop()
            return
        text = self._teleop.press(event.key)
        print_lines([text] if text else [])
        self._node.publish(self._teleop.velocity)
        self._hold.press(
            event.key, time.monotonic(), moving=self._teleop.is_moving, name=event.name
        )
        if event.key == CTRL_Z:  # which has stopped the robot, like every unassigned key
            self._keyboard.suspend()

    def _repeat_or_stop(self, now: float) -> None:
        """Repeat the command of a held key, or stop after its release."""
        if self._hold.is_released(now):
            self._stop()
        elif self._hold.is_repeat_due(now):
            self._node.publish(self._teleop.velocity)

    def _stop(self) -> None:
        self._teleop.stop()
        self._node.publish(self._teleop.velocity)


def print_lines(lines: Iterable[str]) -> None:
    """Print at once. Raises AmrError if the output is not read any more (``| head``)."""
    try:
        for line in lines:
            print(line, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise AmrError(
            'nobody reads standard output any more, so the robot is stopped; pipe the output of '
            'teleop_twist_keyboard only into what reads to the end'
        ) from None


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line, without ROS arguments."""
    options = argparse.ArgumentParser(
        prog='teleop_twist_keyboard',
        description='Drive a robot with the keys of a terminal; they are shown at the start.',
        epilog='Parameters, after --ros-args: stamped, frame_id, speed, turn, repeat_rate, '
        'key_timeout; a topic: -r cmd_vel:=/diff_drive_controller/cmd_vel',
    )
    options.add_argument(
        '--latch', action='store_true', help='drive on until the next key, also when one is let go'
    )
    return options


def teleop_twist_keyboard(args: list[str] | None) -> None:
    """Drive the robot; at the end stop it, and restore the terminal."""
    words = sys.argv if args is None else ['teleop_twist_keyboard', *args]
    options = parser().parse_args(remove_ros_args(words)[1:])
    with ros(args) as stop:
        with argument_errors():
            node = TeleopTwistKeyboard(latch=options.latch)
        with spinning(node):
            releases = node.settings.key_timeout > 0.0
            keyboard = Keyboard(_STDIN, alternative=node.alternative, releases=releases)
            with stop.on_stop(keyboard.stop), keyboard:
                try:
                    KeyboardDriver(node, keyboard).drive()
                finally:
                    stop.leave()
                    node.stop_robot()


def main(args: list[str] | None = None) -> int:
    """Drive until Ctrl-C."""
    return program(lambda: teleop_twist_keyboard(args), stopped=0)
