# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""teleop_twist_joy: what a joystick commands, by the parameters of the original."""

from dataclasses import fields

from geometry_msgs.msg import Twist, TwistStamped
import pytest
import rclpy
from rclpy.parameter import Parameter
from sensor_msgs.msg import Joy
from support.teleop_host import Robot

from amr_description.nodes.teleop_twist_joy import TeleopTwistJoy
from amr_description.nodes.teleop_twist_joy.commands import (
    AngularAxes,
    JoyCommand,
    JoyCommander,
    JoyCommandSettings,
    LinearAxes,
)

AXES = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
HELD = [0, 0, 0, 0, 0, 1]
TURBO = [0, 1, 0, 0, 0, 0]
NONE = [0] * 6


def commander(**settings):
    return JoyCommander(JoyCommandSettings(**settings))


def test_by_default_button_5_enables_and_axes_5_and_2_drive():
    assert commander().command(AXES, HELD) == JoyCommand(x=0.3, yaw=0.15)


def test_a_stop_is_published_once_after_the_button_is_let_go():
    joystick = commander()
    assert joystick.command(AXES, NONE) == JoyCommand()
    assert joystick.command(AXES, NONE) is None
    assert joystick.command(AXES, HELD) != JoyCommand()
    assert joystick.command(AXES, NONE) == JoyCommand()
    assert joystick.command(AXES, NONE) is None


def test_the_turbo_button_has_speeds_of_its_own_and_goes_first():
    joystick = commander(enable_turbo_button=1)
    assert joystick.command(AXES, TURBO) == JoyCommand(x=0.6, yaw=0.3)
    assert joystick.command(AXES, [0, 1, 0, 0, 0, 1]) == JoyCommand(x=0.6, yaw=0.3)
    assert joystick.command(AXES, HELD) == JoyCommand(x=0.3, yaw=0.15)


def test_without_a_required_button_all_of_it_commands():
    assert commander(require_enable_button=False).command(AXES, []) == JoyCommand(x=0.3, yaw=0.15)


@pytest.mark.parametrize('settings', [{'enable_button': 9}, {'enable_button': -1}])
def test_a_button_that_is_not_there_is_not_held(settings):
    assert commander(**settings).command(AXES, [1] * 6) == JoyCommand()


def test_an_axis_that_is_not_there_is_at_rest():
    joystick = commander(axis_linear=LinearAxes(x=6), axis_angular=AngularAxes(yaw=-1))
    assert joystick.command(AXES, HELD) == JoyCommand()


@pytest.mark.parametrize(('inverted', 'turn'), [(False, 0.15), (True, -0.15)])
def test_a_car_turns_the_other_way_while_it_reverses(inverted, turn):
    backwards = [*AXES[:5], -0.6]
    joystick = commander(inverted_reverse=inverted)
    assert joystick.command(backwards, HELD) == JoyCommand(x=-0.3, yaw=turn)
    assert joystick.command(AXES, HELD).yaw == 0.15


def test_all_six_directions():
    speeds = {'x': 1.0, 'y': 2.0, 'z': 3.0}
    turns = {'yaw': 4.0, 'pitch': 5.0, 'roll': 6.0}
    settings = JoyCommandSettings(
        axis_linear=LinearAxes(0, 1, 2),
        axis_angular=AngularAxes(3, 4, 5),
        scale_linear=type(JoyCommandSettings().scale_linear)(**speeds),
        scale_angular=type(JoyCommandSettings().scale_angular)(**turns),
    )
    found = JoyCommander(settings).command([1.0] * 6, HELD)
    assert {field.name: getattr(found, field.name) for field in fields(found)} == speeds | turns


@pytest.fixture
def host():
    """Start the node with parameters, beside a robot that listens."""
    nodes = []

    def started(*words, message_type=Twist):
        rclpy.init(args=['--ros-args', *words])
        robot, teleop = Robot(), TeleopTwistJoy()
        nodes.extend([robot, teleop])
        robot.listen(message_type)
        joystick = robot.create_publisher(Joy, 'joy', 10)
        robot.until(
            lambda: joystick.get_subscription_count() and robot.count_publishers('cmd_vel')
        )
        executor = rclpy.executors.SingleThreadedExecutor()
        executor.add_node(teleop)

        def command(axes, buttons):
            joystick.publish(Joy(axes=axes, buttons=buttons))
            heard = len(robot.messages)
            while len(robot.messages) == heard:
                executor.spin_once(timeout_sec=0.1)
                rclpy.spin_once(robot, timeout_sec=0.1)
            return robot.messages[-1]

        return teleop, command

    yield started
    for node in nodes:
        node.destroy_node()
    rclpy.try_shutdown()


def test_the_node_commands_as_its_parameters_say_also_once_they_are_changed(host):
    teleop, command = host('-p', 'enable_button:=0', '-p', 'axis_linear.x:=1')
    assert teleop.get_fully_qualified_name() == '/teleop_twist_joy_node'
    assert command([0.0, 1.0, 0.5], [1]).linear.x == 0.5
    (good,) = teleop.set_parameters([Parameter('scale_linear.x', value=2.0)])
    assert good.successful
    assert command([0.0, 1.0, 0.5], [1]).linear.x == 2.0
    (bad,) = teleop.set_parameters([Parameter('axis_linear.x', value=1.5)])
    assert not bad.successful
    assert command([0.0, 1.0, 0.5], [1]).angular.z == 0.25


def test_stamped_commands_have_a_frame_and_a_time(host):
    _, command = host('-p', 'publish_stamped_twist:=true', message_type=TwistStamped)
    message = command(AXES, HELD)
    assert message.twist.linear.x == pytest.approx(0.3)
    assert message.header.frame_id == 'teleop_twist_joy'
    assert message.header.stamp.sec > 0
