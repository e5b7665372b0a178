# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""joy_node: events of a joystick as axes and buttons, and the devices that they come from."""

import contextlib
import errno
import os
import struct

import pytest
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Joy

from amr_description.nodes import joy_node
from amr_description.nodes.joy_node import devices
from amr_description.nodes.joy_node.devices import (
    device_files,
    EVENT,
    InputDevice,
    InputEvent,
    KEY,
    open_joystick,
)
from amr_description.nodes.joy_node.gamepad import AxisRange, GamepadState, PublishingPace
from amr_description.ros.service_calls import wait_until

STICK = AxisRange(-32768, 32767)
BYTE = AxisRange(0, 255)
HAT = AxisRange(-1, 1)
TRIGGER, THUMB, MOUSE = 0x120, 0x121, 0x110
X, Y, HAT_X, HAT_Y, ABSOLUTE = 0, 1, 0x10, 0x11, 3


def state(**options):
    return GamepadState(
        [MOUSE, TRIGGER, THUMB],
        {X: STICK, Y: BYTE, HAT_X: HAT, HAT_Y: HAT},
        **{'deadzone': 0.0} | options,
    )


def test_buttons_are_in_the_order_of_their_codes_and_those_of_a_mouse_come_last():
    pad = state()
    assert [pad.press(code, True) for code in (TRIGGER, MOUSE)] == [True, True]
    assert pad.buttons == [1, 0, 1]
    assert pad.press(TRIGGER, False) and pad.buttons == [0, 0, 1]
    assert not pad.press(MOUSE, True), 'it repeats itself while it is held'
    assert not pad.press(0x2FF, True), 'it has no such button'


def test_a_sticky_button_changes_with_each_press():
    pad = state(sticky=True)
    seen = []
    for is_down in (True, False, True, False):
        pad.press(THUMB, is_down)
        seen.append(pad.buttons[1])
    assert seen == [1, 1, 0, 0]


@pytest.mark.parametrize(
    ('code', 'value', 'index', 'position'),
    [
        (X, -32768, 0, 1.0), (X, 32767, 0, -1.0), (X, 0, 0, 0.0),
        (Y, 0, 1, 1.0), (Y, 255, 1, -1.0), (Y, 300, 1, -1.0),
        (HAT_X, -1, 2, 1.0), (HAT_X, 1, 2, -1.0), (HAT_Y, -1, 3, 1.0), (HAT_Y, 0, 3, 0.0),
    ],
)  # fmt: skip
def test_left_and_forward_are_positive(code, value, index, position):
    pad = state()
    pad.move(code, value)
    assert pad.axes == [position if each == index else 0.0 for each in range(4)]


@pytest.mark.parametrize(
    ('deadzone', 'value', 'position'),
    [
        (0.1, 3276, 0.0), (0.1, -3276, 0.0), (0.1, 32767, -1.0), (0.1, -32768, 1.0),
        (0.5, 16384, -0.5 / 32767 / 0.5), (0.5, 24575, -0.5), (1.0, 32767, 0.0),
    ],
)  # fmt: skip
def test_a_position_grows_from_0_where_the_dead_zone_ends(deadzone, value, position):
    pad = state(deadzone=deadzone)
    pad.move(X, value)
    assert pad.axes[0] == pytest.approx(position, abs=2e-5)


def test_a_move_within_the_dead_zone_is_nothing_to_publish():
    pad = state(deadzone=0.1)
    assert [pad.move(X, value) for value in (100, 20000, 20000, -100)] == [
        False, True, False, True,
    ]  # fmt: skip
    assert not pad.move(0x3F, 1), 'it has no such axis'


def test_a_button_is_published_at_once_an_axis_soon_and_the_rest_again():
    pace = PublishingPace(repeat=50, coalescing=10)
    assert pace.wait(0) is None, 'there is no joystick yet'
    pace.start(0)
    assert pace.wait(0) == 50
    pace.after_axis(20)
    pace.after_axis(25)
    assert pace.wait(25) == 5
    pace.after_button(26)
    assert pace.wait(26) == 0
    pace.published(26)
    assert pace.wait(30) == 46
    assert PublishingPace(repeat=0, coalescing=0).wait(0) is None


class FakeKernel:
    """Answers the requests of ``linux/input.h`` about one joystick with two axes."""

    def __init__(self, name='Toy Pad', keys=(TRIGGER, THUMB), axes=(X, Y)):
        self.name, self.keys, self.axes = name, keys, axes
        self.values = {X: 0, Y: 128}
        self.down = set()

    def __call__(self, _descriptor, request, answer):
        number, size = request & 0xFF, request >> 16 & 0x3FFF
        assert (request >> 30, request >> 8 & 0xFF) == (2, ord('E')) and size == len(answer)
        words = {
            0x06: self.name.encode(),
            0x18: bits(self.down),
            0x20 + KEY: bits(self.keys),
            0x20 + ABSOLUTE: bits(self.axes),
            0x40: struct.pack('6i', self.values[X], -32768, 32767, 0, 0, 0),
            0x41: struct.pack('6i', self.values[Y], 0, 255, 0, 0, 0),
        }[number]
        answer[: len(words)] = words
        return 0


def bits(codes):
    return sum(1 << code for code in codes).to_bytes(0x60, 'little')


def event(*words):
    return EVENT.pack(0, 0, *words)


@pytest.fixture
def joystick(tmp_path):
    """The writing end of a joystick in a folder that stands for /dev/input."""
    os.mkfifo(tmp_path / 'event3')
    # Both ways, as a pipe without a reader cannot be opened for writing alone.
    descriptor = os.open(tmp_path / 'event3', os.O_RDWR)
    yield descriptor
    with contextlib.suppress(OSError):
        os.close(descriptor)


def test_a_device_tells_its_buttons_axes_and_events(tmp_path, joystick):
    kernel = FakeKernel()
    device = InputDevice(tmp_path / 'event3', kernel)
    assert (device.name, device.keys) == ('Toy Pad', [TRIGGER, THUMB])
    assert device.ranges == {X: STICK, Y: BYTE}
    assert device.is_joystick
    assert device.read() == []
    os.write(joystick, event(KEY, TRIGGER, 1) + event(0, 0, 0))
    assert device.read() == [InputEvent(KEY, TRIGGER, 1), InputEvent(0, 0, 0)]
    kernel.down, kernel.values[X] = {THUMB}, 7
    os.write(joystick, event(0, 3, 0))
    assert device.read() == [
        InputEvent(KEY, TRIGGER, 0),
        InputEvent(KEY, THUMB, 1),
        InputEvent(ABSOLUTE, X, 7),
        InputEvent(ABSOLUTE, Y, 128),
    ], 'some were lost'
    os.close(joystick)
    with pytest.raises(OSError, match='it is gone'):
        device.read()
    device.close()


@pytest.mark.parametrize(('keys', 'axes'), [((MOUSE,), (X, Y)), ((TRIGGER,), (X,)), ((), (X, Y))])
def test_mice_and_keyboards_are_no_joysticks(tmp_path, joystick, keys, axes):
    kernel = FakeKernel(keys=keys, axes=axes)
    assert open_joystick(0, '', tmp_path, kernel) is None


def test_a_joystick_is_chosen_by_number_or_name(tmp_path, joystick):
    (tmp_path / 'event10').write_text('no device')
    (tmp_path / 'mice').write_text('')
    assert [path.name for path in device_files(tmp_path)] == ['event3', 'event10']
    kernel = FakeKernel()
    for number, name, is_there in [(0, '', True), (0, 'Toy Pad', True), (9, 'Toy Pad', True),
                                   (2, '', False), (0, 'Other', False)]:  # fmt: skip
        device = open_joystick(number, name, tmp_path, kernel)
        assert (device is not None) == is_there
        if device is not None:
            device.close()
    assert open_joystick(0, '', tmp_path / 'none') is None


@pytest.fixture
def node():
    rclpy.init(args=['--ros-args', '-p', 'autorepeat_rate:=0.0', '-p', 'deadzone:=0.1'])
    yield Node('robot', use_global_arguments=False)
    rclpy.try_shutdown()


def test_the_node_publishes_what_the_joystick_does(tmp_path, joystick, node, monkeypatch):
    def opened(number, name):
        return open_joystick(number, name, tmp_path, FakeKernel())

    monkeypatch.setattr(devices, 'open_joystick', opened)
    heard = []
    node.create_subscription(Joy, 'joy', heard.append, 10)
    joy = joy_node.JoyNode()

    def until(condition):
        assert wait_until(node, lambda: condition() or None, every=0.02, timeout=20.0), heard

    try:
        until(lambda: joy.count_subscribers('joy'))
        assert joy.get_name() == 'joy_node'
        assert not heard, 'nothing has happened, and it repeats nothing'
        os.write(joystick, event(KEY, THUMB, 1))
        until(lambda: len(heard) == 1)
        assert list(heard[0].buttons) == [0, 1] and heard[0].header.frame_id == 'joy'
        os.write(joystick, event(ABSOLUTE, X, -32768))
        until(lambda: len(heard) == 2)
        assert list(heard[1].axes) == [1.0, 0.0] and list(heard[1].buttons) == [0, 1]
    finally:
        joy.destroy_node()


def test_a_joystick_that_is_gone_is_looked_for_again(tmp_path, joystick, node, monkeypatch):
    asked = []

    def opened(number, name):
        device = None if asked else open_joystick(number, name, tmp_path, FakeKernel())
        asked.append(number)
        return device

    monkeypatch.setattr(devices, 'open_joystick', opened)
    monkeypatch.setattr(joy_node, '_SEARCH_PERIOD', 0.01)
    joy = joy_node.JoyNode()
    try:
        assert wait_until(node, lambda: asked or None, every=0.02, timeout=20.0)
        os.close(joystick)
        assert wait_until(node, lambda: len(asked) > 2 or None, every=0.02, timeout=20.0)
    finally:
        joy.destroy_node()


def test_a_device_that_cannot_answer_is_closed(tmp_path, joystick):
    def ioctl(*_words):
        raise OSError(errno.ENOTTY, 'no device')

    before = len(os.listdir('/proc/self/fd'))
    with pytest.raises(OSError, match='no device'):
        InputDevice(tmp_path / 'event3', ioctl)
    assert len(os.listdir('/proc/self/fd')) == before
