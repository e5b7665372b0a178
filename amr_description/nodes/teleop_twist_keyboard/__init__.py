# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``teleop_twist_keyboard``: drive a robot with the keys of a terminal.

It publishes ``cmd_vel``, ``geometry_msgs/Twist`` or, with ``stamped``, ``TwistStamped`` (reliable,
depth 10). Keys, texts and the parameters ``stamped``, ``frame_id``, ``speed`` and ``turn`` are
those of the original; every key press publishes one message. What is added, and why:

``stamped`` need not be given
    The type is the one that the listeners on the topic want, also if they come later, and it is
    said. Of the wrong type no command would arrive, without a word.
``repeat_rate``
    While a key is held the command is repeated. The original stutters on a controller that brakes
    0.5 s after the last command: the second message of a held key comes up to 0.66 s after the
    first.
``key_timeout``
    A key that is let go stops the robot: at once where the terminal tells it (the kitty keyboard
    protocol), else when it repeats no more, or that long after a single press. One zero is sent,
    and nothing more: other publishers of ``cmd_vel`` have their turn.
``--latch``
    The robot drives on until the next key, as with the original. With ``-p repeat_rate:=0.0`` it
    is the original: one message per key press.

In every way out (Ctrl-C, SIGTERM, SIGHUP, SIGQUIT, a fault, Ctrl-Z for the time being) a zero is
sent and the terminal restored.
"""

import argparse
from collections.abc import Iterable
import os
import sys
import time

from rclpy.utilities import remove_ros_args

from amr_description.errors import AmrError
from amr_description.nodes.teleop_twist_keyboard.keyboard import CTRL_C, CTRL_Z, Keyboard, KeyEvent
from amr_description.nodes.teleop_twist_keyboard.keys import HELP, Hold, Teleop
from amr_description.nodes.teleop_twist_keyboard.node import TeleopTwistKeyboard
from amr_description.ros.runtime import argument_errors, program, ros, spinning

_STDIN = 0  # sys.stdin is None where it was closed
_LOOK_PERIOD = 0.5  # s: how soon another listener is seen; a look takes 0.1 ms


class Driver:
    """Keys in, commands and prints out."""

    def __init__(self, node: TeleopTwistKeyboard, keyboard: Keyboard) -> None:
        settings = node.settings
        self._node, self._keyboard = node, keyboard
        self._teleop = Teleop(settings.speed, settings.turn)
        period = 1.0 / settings.repeat_rate if settings.repeat_rate else 0.0
        self._hold = Hold(period, settings.key_timeout)

    def drive(self) -> None:
        """Turn keys into commands until Ctrl-C."""
        say([HELP, *self._node.look_first(), self._teleop.speeds])
        look_at = time.monotonic() + _LOOK_PERIOD
        while True:
            now = time.monotonic()
            due = self._hold.wait(now)
            until_look = max(0.0, look_at - now)
            timeout = until_look if due is None else min(due, until_look)
            for event in self._keyboard.read(timeout):
                if event.key == CTRL_C:
                    return
                self._take(event)
            self._keep_on(time.monotonic())
            if time.monotonic() >= look_at:
                say(self._node.look())
                look_at = time.monotonic() + _LOOK_PERIOD

    def _take(self, event: KeyEvent) -> None:
        if event.is_release:
            if self._hold.release(event.name):
                self._stop()
            return
        text = self._teleop.press(event.key)
        say([text] if text else [])
        self._node.publish(self._teleop.velocity)
        self._hold.press(
            event.key, time.monotonic(), moving=self._teleop.is_moving, name=event.name
        )
        if event.key == CTRL_Z:  # has stopped the robot, as every key without a meaning
            self._keyboard.suspend()

    def _keep_on(self, now: float) -> None:
        """Repeat the command of a held key, or stop when it has been let go."""
        if self._hold.is_released(now):
            self._stop()
        elif self._hold.is_repeat_due(now):
            self._node.publish(self._teleop.velocity)

    def _stop(self) -> None:
        self._teleop.stop()
        self._node.publish(self._teleop.velocity)


def say(lines: Iterable[str]) -> None:
    """Print for the driver, at once. Raises AmrError: nobody reads it any more (``| head``)."""
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
    """Set up node and terminal, drive, and leave both in order."""
    words = sys.argv if args is None else ['teleop_twist_keyboard', *args]
    options = parser().parse_args(remove_ros_args(words)[1:])
    with ros(args) as stop:
        with argument_errors():
            node = TeleopTwistKeyboard(latch=options.latch)
        with spinning(node):
            releases = node.settings.key_timeout > 0.0
            keyboard = Keyboard(_STDIN, instead=node.instead, releases=releases)
            with stop.on_stop(keyboard.leave), keyboard:
                try:
                    Driver(node, keyboard).drive()
                finally:
                    stop.leave()
                    node.stop_robot()


def main(args: list[str] | None = None) -> int:
    """Drive until Ctrl-C."""
    return program(lambda: teleop_twist_keyboard(args), stopped=0)
