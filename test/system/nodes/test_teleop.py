# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""teleop_twist_keyboard in a terminal of its own, driving a robot over real DDS."""

from contextlib import contextmanager, ExitStack
import signal
import termios

from geometry_msgs.msg import Twist, TwistStamped
import pytest
from rcl_interfaces.srv import GetParameters, SetParameters
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from support.running_programs import Program
from support.teleop_host import COMMAND, connect, driving, ONE_KEY_ONE_MESSAGE, robot_node, XTERM

from amr_description.nodes.teleop_twist_keyboard.keys import MOVES, SPEEDS
from amr_description.ros.service_calls import call

FAULTY = """
from amr_description.nodes import teleop_twist_keyboard

class FaultyHold(teleop_twist_keyboard.KeyHold):
    def press(self, key, now, **options):
        if key == '!':
            raise ZeroDivisionError('a bug')

teleop_twist_keyboard.KeyHold = FaultyHold
teleop_twist_keyboard.main([])
"""
STAMPED_TOPIC = '/diff_drive_controller/cmd_vel'


@pytest.fixture
def robot():
    with robot_node() as node:
        yield node


@pytest.fixture
def teleop(robot):
    """Start teleop in a terminal; see ``driving``."""
    with ExitStack() as stack:
        yield lambda *words, **options: stack.enter_context(driving(robot, *words, **options))


@contextmanager
def old_robot():
    """One that wants Twist; a participant of its own, as DDS has one type to a topic in each."""
    context = Context()
    rclpy.init(context=context, args=[])
    node = Node('old_robot', context=context)
    node.create_subscription(Twist, '/cmd_vel', print, 10)
    try:
        yield
    finally:
        node.destroy_node()
        rclpy.try_shutdown(context=context)


def stamped_parameter(robot):
    request = GetParameters.Request(names=['stamped'])
    response = call(robot, GetParameters, '/teleop_twist_keyboard/get_parameters', request)
    return parameter_value_to_python(response.values[0])


def test_every_key_of_the_original(robot, teleop):
    program = teleop(*ONE_KEY_ONE_MESSAGE)
    speed, turn = 0.5, 1.0
    expected = [
        (key, (x * speed, y * speed, z * speed, yaw * turn))
        for key, (x, y, z, yaw) in MOVES.items()
    ]
    expected += [('k', (0.0,) * 4), ('K', (0.0,) * 4), ('u', (speed, 0.0, 0.0, turn))]
    for key, (linear, angular) in SPEEDS.items():
        speed, turn = speed * linear, turn * angular
        expected.append((key, (speed, 0.0, 0.0, turn)))
    for count, (key, _) in enumerate(expected, 1):
        program.type(key)
        robot.until(lambda count=count: len(robot.messages) >= count)  # ten wait in a queue
    heard = [(t.linear.x, t.linear.y, t.linear.z, t.angular.z) for t in robot.twists]
    assert heard == [velocity for _, velocity in expected]
    for twist in robot.twists:
        assert (twist.angular.x, twist.angular.y) == (0.0, 0.0)
    program.expect(f'currently:\tspeed {speed}\tturn {turn} ')


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
    program = teleop('-p', 'key_timeout:=1.05')
    program.type('i')
    robot.until(lambda: (0.0, 0.0) in robot.commands)
    *moving, last = robot.commands
    assert moving == [(0.5, 0.0)] * len(moving)
    assert 2 <= len(moving) <= 11
    assert last == (0.0, 0.0)


@pytest.mark.parametrize('key', ['\x1b[A', '\x1b', '\x1c'], ids=['arrow', 'Escape', 'Ctrl-4'])
def test_a_special_key_is_one_stop(robot, teleop, key):
    program = teleop(*ONE_KEY_ONE_MESSAGE)
    program.type(key)
    robot.until(lambda: robot.messages)
    program.type('i')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    assert robot.commands == [(0.0, 0.0), (0.5, 0.0)]


def test_latched_the_robot_drives_on_until_the_next_key(robot, teleop):
    program = teleop(options=['--latch'])
    program.type('i')
    robot.until(lambda: len(robot.messages) == 25)  # far beyond the time a key press holds
    assert {*robot.commands} == {(0.5, 0.0)}
    program.type('k')
    robot.until(lambda: robot.commands[-1] == (0.0, 0.0))
    assert robot.commands.count((0.0, 0.0)) == 1


@pytest.mark.parametrize('name', ['/cmd_vel', 'cmd_vel'])
def test_stamped_and_remapped_as_the_tutorial_types_it(robot, teleop, name):
    remap = ['-p', 'stamped:=true', '-p', 'frame_id:=base_link', '-r', f'{name}:={STAMPED_TOPIC}']
    program = teleop(*remap, message_type=TwistStamped, topic=STAMPED_TOPIC)
    program.type('i')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    assert robot.messages[-1].header.frame_id == 'base_link'
    assert robot.messages[-1].header.stamp.sec > 0


@pytest.mark.parametrize('message_type', [Twist, TwistStamped])
def test_the_type_that_is_not_given_is_the_one_that_is_wanted(robot, teleop, message_type):
    program = teleop(
        '-r', f'cmd_vel:={STAMPED_TOPIC}', message_type=message_type, topic=STAMPED_TOPIC
    )
    name = message_type.__name__
    program.expect(f'publishing {name} on {STAMPED_TOPIC}: /robot wants it')
    program.type('i')
    robot.until(lambda: (0.5, 0.0) in robot.commands)
    assert {type(message) for message in robot.messages} == {message_type}
    assert stamped_parameter(robot) == (message_type is TwistStamped)


def test_who_comes_later_gets_the_type_that_it_wants(robot):
    robot.listen(Twist, '/another/cmd_vel')
    with Program.module('teleop_twist_keyboard', terminal=True, env=XTERM) as program:
        program.expect(
            'publishing Twist on /cmd_vel, which has no listener yet; '
            '-r cmd_vel:=/another/cmd_vel has one'
        )
        program.expect('currently:')
        robot.listen(TwistStamped)
        program.expect('publishing TwistStamped on /cmd_vel: /robot wants it')
        connect(robot, program)
        program.type('i')
        robot.until(lambda: (0.5, 0.0) in robot.commands)
        assert stamped_parameter(robot) is True
        with old_robot():
            program.expect('WARNING: /old_robot wants Twist on /cmd_vel, but this publishes Twist')
        program.type('\x03')
        assert program.end() == 0
        robot.until(lambda: robot.commands[-1] == (0.0, 0.0))


def test_a_topic_with_listeners_that_is_found_later_is_told_once(robot):
    with Program.module('teleop_twist_keyboard', terminal=True, env=XTERM) as program:
        program.expect(r'publishing Twist on /cmd_vel, which has no listener yet\r?\n')
        robot.listen(Twist, '/another/cmd_vel')
        program.expect('which has no listener yet; -r cmd_vel:=/another/cmd_vel has')
        robot.listen(TwistStamped, '/third/cmd_vel')
        robot.listen(Twist)
        program.expect('publishing Twist on /cmd_vel: /robot wants it')
        assert program.output.count('no listener yet') == 2
        program.type('\x03')
        assert program.end() == 0


def test_of_a_type_that_is_given_too_it_is_told_when_somebody_listens_at_last(robot):
    words = ['--ros-args', '-p', 'stamped:=true']
    with Program.module('teleop_twist_keyboard', *words, terminal=True, env=XTERM) as program:
        program.expect(r'publishing TwistStamped on /cmd_vel, which has no listener yet\r?\n')
        robot.listen(TwistStamped)
        program.expect('publishing TwistStamped on /cmd_vel: /robot wants it')
        program.type('\x03')
        assert program.end() == 0


def test_a_type_that_is_given_is_kept_and_the_mistake_told(robot):
    robot.listen(TwistStamped)
    words = ['--ros-args', '-p', 'stamped:=false']
    with Program.module('teleop_twist_keyboard', *words, terminal=True) as program:
        program.expect(
            'WARNING: /robot wants TwistStamped on /cmd_vel, but this publishes Twist: nothing '
            'will arrive; use -p stamped:=true'
        )
        assert stamped_parameter(robot) is False


@pytest.mark.parametrize(
    'leave',
    [
        lambda program: program.type('\x03'),
        lambda program: program.signal(signal.SIGINT),
        lambda program: program.signal(signal.SIGTERM),
        lambda program: program.signal(signal.SIGHUP),
        lambda program: program.signal(signal.SIGQUIT),
    ],
    ids=['Ctrl-C', 'SIGINT', 'SIGTERM', 'SIGHUP', 'SIGQUIT'],
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
    robot.listen()
    # From 3.13 on Python colours what it says of a fault.
    with Program.of(FAULTY, terminal=True, env={'PYTHON_COLORS': '0'}) as program:
        before = termios.tcgetattr(program.terminal)
        program.expect('currently:\tspeed')
        robot.until(lambda: program.type('i') or (0.5, 0.0) in robot.commands)
        program.type('!')
        program.expect('ZeroDivisionError: a bug')
        assert program.end() == 1
        robot.until(lambda: robot.commands[-1] == (0.0, 0.0))
        assert termios.tcgetattr(program.terminal) == before


def test_ctrl_z_stops_the_robot_and_gives_the_terminal_back_until_fg(robot):
    robot.listen()
    bash = ['bash', '--norc', '--noediting', '-i']
    with Program(*bash, terminal=True, env={'PS1': 'prompt> '}) as shell:
        shell.expect('prompt> ')
        shell.type(f'{COMMAND} --latch\n')
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
        (
            ['-r', 'cmd_vel:=/robot/cmd_vel'],
            False,
            'standard input is not a terminal.*run teleop_twist_keyboard in a terminal of its own'
            '.*or drive with: ros2 topic pub -r 10 /robot/cmd_vel geometry_msgs/msg/Twist '
            r'"\{linear: \{x: 0.2\}\}"',
        ),
        (['-p', 'frame_id:=base'], True, "'frame_id' can only be set when 'stamped' is True"),
        (['-p', 'repeat_rate:=-1.0'], True, 'repeat_rate out of range'),
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


@pytest.mark.parametrize(
    ('redirection', 'words'),
    [('<&-', 'standard input is not a terminal'), ('| true', 'nobody reads standard output')],
)
def test_a_closed_stream_is_one_line(redirection, words):
    command = f'{COMMAND} --ros-args -p stamped:=false {redirection}'
    with Program('bash', '-o', 'pipefail', '-c', command, terminal=True, env=XTERM) as program:
        before = termios.tcgetattr(program.terminal)
        assert program.end() == 1
        assert words in program.output
        assert 'Traceback' not in program.output
        assert 'Exception ignored' not in program.output
        assert termios.tcgetattr(program.terminal) == before


def test_latch_and_a_timeout_contradict_each_other():
    words = ['--latch', '--ros-args', '-p', 'key_timeout:=0.5']
    with Program.module('teleop_twist_keyboard', *words, terminal=True) as program:
        program.expect("'key_timeout' is 0.5 s, but --latch holds a key until the next one")
        assert program.end() == 1


@pytest.mark.parametrize(('words', 'code'), [(['--help'], 0), (['--lach'], 2)])
def test_the_command_line_is_explained(words, code):
    with Program.module('teleop_twist_keyboard', *words) as program:
        program.expect(r'usage: teleop_twist_keyboard \[-h\] \[--latch\]')
        assert program.end() == code
