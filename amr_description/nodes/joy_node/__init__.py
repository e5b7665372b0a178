# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``joy_node``: the axes and buttons of a joystick as a topic, where ``joy`` is not installed.

::

    ros2 run joy joy_node --ros-args -p deadzone:=0.1

It publishes ``joy``, ``sensor_msgs/Joy`` (reliable, depth 10, frame ``joy``): when a button is
pressed or let go, soon after an axis moves, and again at ``autorepeat_rate``. Names, parameters,
defaults and the order of axes and buttons are those of the original. It reads ``/dev/input``, and
has no rumble. A joystick that is plugged in later, or again, is taken then.
"""

from collections.abc import Iterable
from dataclasses import dataclass
import os
import select
import threading
import time

from rclpy.node import Node
from sensor_msgs.msg import Joy

from amr_description.clock import NANOSECONDS
from amr_description.nodes.joy_node import devices
from amr_description.nodes.joy_node.devices import InputDevice, InputEvent
from amr_description.nodes.joy_node.gamepad import GamepadState, PublishingPace
from amr_description.parameters import parameter
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import run

_PURPOSE = 'Publish the axes and buttons of a joystick on the topic "joy".'
_SEARCH_PERIOD = 1.0
"""s between two looks for a joystick, while there is none."""


@dataclass(frozen=True)
class JoyParameters:
    """The parameters of joy_node; none can be changed while it runs."""

    device_id: int = parameter(
        0, 'Which joystick, counted from 0 in the order of /dev/input', read_only=True, minimum=0
    )
    device_name: str = parameter(
        '', 'The joystick of this name, in place of device_id', read_only=True
    )
    deadzone: float = parameter(
        0.05,
        'Share of an axis around its centre that counts as 0',
        read_only=True,
        minimum=0.0,
        maximum=1.0,
    )
    autorepeat_rate: float = parameter(
        20.0,
        'How often an unchanged state is published again; 0: never',
        unit='Hz',
        read_only=True,
        minimum=0.0,
        maximum=1000.0,
        magnitude=(1e-3, 1000.0),
    )
    sticky_buttons: bool = parameter(
        False, 'Whether a press toggles a button, and its release does nothing', read_only=True
    )
    coalesce_interval_ms: int = parameter(
        1,
        'How long after the move of an axis others are awaited',
        unit='ms',
        read_only=True,
        minimum=0,
    )


class JoyNode(Node):
    """The node; a thread of its own waits for events of the joystick."""

    def __init__(self) -> None:
        super().__init__('joy_node')
        self._settings = settings = declare(self, JoyParameters)
        rate = settings.autorepeat_rate
        self._pace = PublishingPace(
            repeat=round(NANOSECONDS / rate) if rate else 0,
            coalescing=settings.coalesce_interval_ms * 1_000_000,
        )
        self._states = self.create_publisher(Joy, 'joy', 10)
        self._said_none = False
        self._stop_out, self._stop_in = os.pipe()
        self._thread = threading.Thread(target=self._serve, name='joystick', daemon=True)
        self._thread.start()

    def destroy_node(self) -> None:
        """End the thread as well."""
        os.write(self._stop_in, b'.')
        self._thread.join()
        os.close(self._stop_in)
        os.close(self._stop_out)
        super().destroy_node()

    def _serve(self) -> None:
        """Open the joystick, and serve it until it is gone; again until the node ends."""
        is_stopped = False
        while not is_stopped:
            device = devices.open_joystick(self._settings.device_id, self._settings.device_name)
            if device is None:
                self._say_none()
                is_stopped = self._is_stopped_within(_SEARCH_PERIOD)
                continue
            self._said_none = False
            try:
                is_stopped = self._serve_device(device)
            except OSError:
                self.get_logger().warning(f'{device.name} is gone; it may be plugged in again')
            finally:
                device.close()

    def _is_stopped_within(self, timeout: float) -> bool:
        return bool(select.select([self._stop_out], [], [], timeout)[0])

    def _say_none(self) -> None:
        """Log once that there is no joystick, and what to do."""
        if self._said_none:
            return
        self._said_none = True
        name = self._settings.device_name
        wanted = f"'{name}'" if name else f'number {self._settings.device_id}'
        denied = devices.unreadable()
        hint = (
            f'{denied[0]} may not be read: add yourself to its group, as with sudo usermod -aG '
            'input $USER, and log in again'
            if denied
            else 'it is taken as soon as it is plugged in. A gamepad beside the browser drives by '
            "the page of 'ros2 run amr_description viewer'"
        )
        self.get_logger().warning(f'no joystick {wanted} in {devices.FOLDER}: {hint}')

    def _serve_device(self, device: InputDevice) -> bool:
        """Publish its states; return that the node ends. Raises OSError: it is gone."""
        settings = self._settings
        state = GamepadState(
            device.keys, device.ranges, deadzone=settings.deadzone, sticky=settings.sticky_buttons
        )
        # A button that is held from before counts once it is pressed again, as in the original.
        self._take(state, (each for each in device.present() if each.type == devices.ABSOLUTE))
        self._pace.start(time.monotonic_ns())
        self.get_logger().info(f'Opened joystick: {device.name}.  deadzone: {settings.deadzone:f}')
        while True:
            wait = self._pace.wait(time.monotonic_ns())
            if wait == 0:
                self._publish(state)
                continue
            timeout = None if wait is None else wait / NANOSECONDS
            ready, _, _ = select.select([self._stop_out, device.descriptor], [], [], timeout)
            if self._stop_out in ready:
                return True
            if device.descriptor in ready:
                self._take(state, device.read())

    def _take(self, state: GamepadState, events: Iterable[InputEvent]) -> None:
        """Change the state by events, and have it published."""
        now = time.monotonic_ns()
        for each in events:
            if each.type == devices.KEY and state.press(each.code, each.value != 0):
                self._pace.after_button(now)
            elif each.type == devices.ABSOLUTE and state.move(each.code, each.value):
                self._pace.after_axis(now)

    def _publish(self, state: GamepadState) -> None:
        message = Joy(axes=state.axes, buttons=state.buttons)
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = 'joy'
        self._states.publish(message)
        self._pace.published(time.monotonic_ns())


def main(args: list[str] | None = None) -> int:
    """Publish until asked to stop."""
    if print_help(args, 'joy_node', _PURPOSE, JoyParameters):
        return 0
    return run(JoyNode, args)
