# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""teleop_twist_keyboard in a terminal of its own, driving a robot over real DDS."""

import signal
import sys
import termios

from geometry_msgs.msg import Twist, TwistStamped
import pytest
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from running_programs import Program

from amr_description.nodes.clients import call, wait_until

ONE_KEY_ONE_MESSAGE = ['-p', 'repeat_rate:=0.0', '-p', 'key_timeout:=0.0']

FAULTY = """
from amr_description.nodes import teleop_twist_keyboard as teleop

class FaultyHold(teleop.Hold):
    def press(self, key, now, *, moving):
        if key == '!':
            raise ZeroDivisionError('a bug')

teleop.Hold = FaultyHold
teleop.main([])
"""


class Robot(Node):
    """Hears commands as (linear x, angular z)."""

    def __init__(self):
        super().__init__('robot')
        self.messages = []

    def listen(self, message_type, topic):
        self.create_subscription(message_type, topic, self.messages.append, 10)

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


@pytest.fixture
def robot():
    rclpy.init(args=[])
    node = Robot()
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def teleop(robot):
    """Start teleop in a terminal, the robot listening; return it when each has found the other."""
    started = []

    def start(*arguments, message_type=Twist, topic='/cmd_vel'):
        robot.listen(message_type, topic)
        program = Program.module('teleop_twist_keyboard', '--ros-args', *arguments, terminal=True)
        started.append(program)
        program.before = termios.tcgetattr(program.terminal)
        program.expect('currently:\tspeed')
        robot.until(lambda: program.type('k') or robot.messages)
        program.type('tk')  # what comes before this has been heard when this is heard
        robot.until(lambda: robot.heights[-2:] == [0.5, 0.0])
        robot.messages.clear()
        return program

    yield start
    for program in started:
        program.__exit__()


def test_each_key_is_one_message(robot, teleop):
    program = teleop(*ONE_KEY_ONE_MESSAGE)
    program.type('iiu,k')
    robot.until(lambda: len(robot.messages) == 5)
    assert robot.commands == [(0.5, 0.0), (0.5, 0.0), (0.5, 1.0), (-0.5, 0.0), (0.0, 0.0)]


def test_speeds_are_printed_and_used(robot, teleop):
    program = teleop('-p', 'speed:=0.5', '-p', 'turn:=2.0', *ONE_KEY_ONE_MESSAGE)
    program.expect('currently:\tspeed 0.5\tturn 2.0 ')
    program.type('uq')
    robot.until(lambda: robot.commands == [(0.5, 2.0), (0.55, 2.2)])
    program.expect('currently:\tspeed 0.55\tturn 2.2 ')


def test_a_key_let_go_stops_the_robot_by_itself(robot, teleop):
    program = teleop('-p', 'key_timeout:=0.35')
    program.type('i')
    robot.until(lambda: (0.0, 0.0) in robot.commands)
    *moving, last = robot.commands
    assert moving == [(0.5, 0.0)] * len(moving)
    assert 2 <= len(moving) <= 4
    assert last == (0.0, 0.0)


def test_an_arrow_key_is_one_stop(robot, teleop):
    program = teleop(*ONE_KEY_ONE_MESSAGE)
    program.type('\x1b[Ai')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    assert robot.commands == [(0.0, 0.0), (0.5, 0.0)]


@pytest.mark.parametrize('name', ['/cmd_vel', 'cmd_vel'])
def test_stamped_and_remapped_as_the_tutorial_types_it(robot, teleop, name):
    topic = '/diff_drive_controller/cmd_vel'
    remap = ['-p', 'stamped:=true', '-p', 'frame_id:=base_link', '-r', f'{name}:={topic}']
    program = teleop(*remap, message_type=TwistStamped, topic=topic)
    program.type('i')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    assert robot.messages[-1].header.frame_id == 'base_link'
    assert robot.messages[-1].header.stamp.sec > 0


@pytest.mark.parametrize(
    'leave',
    [
        lambda program: program.type('\x03'),
        lambda program: program.signal(signal.SIGINT),
        lambda program: program.signal(signal.SIGTERM),
        lambda program: program.signal(signal.SIGHUP),
    ],
    ids=['Ctrl-C', 'SIGINT', 'SIGTERM', 'SIGHUP'],
)
def test_every_way_out_stops_the_robot_and_restores_the_terminal(robot, teleop, leave):
    program = teleop('-p', 'key_timeout:=0.0')
    program.type('i')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    assert termios.tcgetattr(program.terminal) != program.before
    leave(program)
    assert program.end() == 0
    robot.until(lambda: robot.commands[-1] == (0.0, 0.0))
    assert termios.tcgetattr(program.terminal) == program.before
    assert 'Traceback' not in program.output


def test_closing_the_terminal_stops_the_robot(robot, teleop):
    program = teleop('-p', 'key_timeout:=0.0')
    program.type('i')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    program.hang_up()
    assert program.process.wait(20.0) == 0
    robot.until(lambda: robot.commands[-1] == (0.0, 0.0))


def test_a_fault_stops_the_robot_and_restores_the_terminal(robot):
    robot.listen(Twist, '/cmd_vel')
    with Program.of(FAULTY, terminal=True) as program:
        before = termios.tcgetattr(program.terminal)
        program.expect('currently:\tspeed')
        robot.until(lambda: program.type('i') or (0.5, 0.0) in robot.commands)
        program.type('!')
        program.expect('ZeroDivisionError: a bug')
        assert program.end() == 1
        robot.until(lambda: robot.commands[-1] == (0.0, 0.0))
        assert termios.tcgetattr(program.terminal) == before


def test_ctrl_z_stops_the_robot_and_gives_the_terminal_back_until_fg(robot):
    robot.listen(Twist, '/cmd_vel')
    teleop = f'{sys.executable} -m amr_description.nodes.teleop_twist_keyboard'
    bash = ['bash', '--norc', '--noediting', '-i']
    with Program(*bash, terminal=True, env={'PS1': 'prompt> '}) as shell:
        shell.expect('prompt> ')
        shell.type(f'{teleop} --ros-args -p key_timeout:=0.0\n')
        shell.expect('currently:\tspeed 0.5')
        robot.until(lambda: shell.type('i') or (0.5, 0.0) in robot.commands)
        shell.type('\x1a')
        stopped = shell.expect(r'Stopped[^\n]*\nprompt> ')
        robot.until(lambda: robot.commands[-1] == (0.0, 0.0))
        shell.type('echo back in the shell\n')
        back = shell.expect('\nback in the shell\r\nprompt> ', since=stopped.end())
        count = len(robot.messages)
        shell.type('fg\n')
        resumed = shell.expect('teleop_twist_keyboard', since=back.end())
        robot.until(lambda: shell.type('j') or (0.0, 1.0) in robot.commands[count:])
        shell.type('\x03')
        shell.expect('prompt> ', since=resumed.end())
        robot.until(lambda: robot.commands[-1] == (0.0, 0.0))
        shell.type('echo it ended with $?\n')
        shell.expect('it ended with 0')


def test_parameters_cannot_be_changed_while_it_runs(robot, teleop):
    teleop()
    for name, value in [('speed', 1.0), ('stamped', True), ('repeat_rate', 5.0)]:
        request = SetParameters.Request(
            parameters=[Parameter(name, value=value).to_parameter_msg()]
        )
        (result,) = call(
            robot, SetParameters, '/teleop_twist_keyboard/set_parameters', request
        ).results
        assert not result.successful
        assert 'Trying to set a read-only parameter' in result.reason


@pytest.mark.parametrize(
    ('arguments', 'terminal', 'words'),
    [
        ([], False, 'standard input is not a terminal.*ros2 topic pub -r 10'),
        (['-p', 'frame_id:=base'], True, "'frame_id' can only be set when 'stamped' is True"),
        (['-p', 'repeat_rate:=-1.0'], True, "repeat_rate out of range"),
        (['-p', 'speed:=fast'], True, "Trying to set parameter 'speed' to 'fast'"),
    ],
)
def test_it_does_not_start_on_what_it_cannot_use(arguments, terminal, words):
    with Program.module(
        'teleop_twist_keyboard', '--ros-args', *arguments, terminal=terminal
    ) as program:
        program.expect(words)
        assert program.end() == 1
        assert 'Traceback' not in program.output
        assert program.output.count('[FATAL]') == 1
