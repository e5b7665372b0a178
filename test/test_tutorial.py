# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The tutorial as an executable document: its shell lines typed into terminals, as in the README.

Each terminal is a bash of its own on a pseudo-terminal. What a line must show stands beside it.
"""

from contextlib import contextmanager
from pathlib import Path
import re

import pytest
from running_programs import Program

ROOT = Path(__file__).parents[1]
README = (ROOT / 'README.md').read_text(encoding='utf-8')
PROMPT = 'amr-test> '
COLOUR = re.compile(r'\x1b\[\d*m')
CTRL_C = '\x03'
TELEOP = (
    'ros2 run amr_description teleop_twist_keyboard --ros-args -p stamped:=true '
    '-r /cmd_vel:=/diff_drive_controller/cmd_vel'
)
PUB = (
    'ros2 topic pub --once /diff_drive_controller/cmd_vel geometry_msgs/msg/TwistStamped '
    '"{header: {frame_id: base_link}, twist: {linear: {x: 0.5}, angular: {z: 0.0}}}"'
)


class Shell:
    """A shell in a terminal; the person types a line and looks at what it prints."""

    def __init__(self, program):
        self._program = program
        self._seen = 0

    def type(self, line):
        """Type a line, and Enter."""
        self._seen = len(self._program.output)
        self._program.type(line + '\n')

    def press(self, key):
        """Press a key that needs no Enter."""
        self._program.type(key)

    def see(self, pattern):
        """Wait for what the line prints; return the match."""
        found = self._program.expect(pattern, self._seen)
        self._seen = found.end()
        return found

    def run(self, line, code=0):
        """Type a line and wait until it has ended; return what it printed."""
        assert_in_readme(line)
        self.type(f'{line}; echo "exit=$?"')
        begin = self._program.expect(re.escape('echo "exit=$?"') + r'\r?\n', self._seen).end()
        end = self._program.expect(r'exit=(\d+)\r?\n' + re.escape(PROMPT), begin)
        printed = COLOUR.sub('', self._program.output[begin : end.start()].replace('\r\n', '\n'))
        assert int(end[1]) == code, printed
        return printed


def assert_in_readme(line):
    """A line that is typed here stands in the README, letter for letter."""
    assert re.search(rf'^{re.escape(line)}$', README, re.MULTILINE), f'not in the README: {line}'


@contextmanager
def shell(activated=True):
    environment = {'PS1': PROMPT, 'TERM': 'dumb', 'COLUMNS': '200', 'HISTFILE': ''}
    bash = ['bash', '--norc', '--noprofile', '--noediting', '-i']
    with Program(*bash, terminal=True, env=environment, cwd=ROOT) as program:
        program.expect(re.escape(PROMPT))
        terminal = Shell(program)
        if activated:
            terminal.run('source scripts/activate')
        yield terminal


@pytest.fixture(scope='module')
def stack():
    """Terminal 1: the robot."""
    with shell(activated=False) as terminal:
        assert_in_readme_command('scripts/run')
        terminal.type('scripts/run')
        terminal.see(r'ready in \d+\.\d s: drive with')
        terminal.see(re.escape('Ctrl-C stops all.'))
        yield terminal
        terminal.press(CTRL_C)
        terminal.see(re.escape(PROMPT))
        terminal.type('jobs; echo "left: $(jobs | wc -l)"')
        terminal.see(r'left: 0')


def assert_in_readme_command(command):
    assert re.search(rf'^{re.escape(command)} ', README, re.MULTILINE)


def test_talker_and_listener():
    with shell() as first, shell() as second:
        for terminal, line in (
            (first, 'ros2 run amr_description talker'),
            (second, 'ros2 run amr_description listener'),
        ):
            assert_in_readme(line)
            terminal.type(line)
        first.see(r'\[INFO\] \[[\d.]+\] \[minimal_publisher\]: Publishing: "Hello World: \d+"')
        heard = second.see(r'\[minimal_subscriber\]: I heard: "Hello World: (\d+)"')
        again = second.see(r'\[minimal_subscriber\]: I heard: "Hello World: (\d+)"')
        assert int(again[1]) == int(heard[1]) + 1
        for terminal in (first, second):
            terminal.press(CTRL_C)
            printed = terminal.see(re.escape(PROMPT)).string
            assert 'Traceback' not in printed


def test_check_urdf_prints_the_tree():
    with shell() as terminal:
        assert terminal.run('check_urdf urdf/amr.urdf') == (
            'robot name is: amr\n'
            '---------- Successfully Parsed XML ---------------\n'
            'root Link: base_footprint has 1 child(ren)\n'
            '    child(1):  base_link\n'
            '        child(1):  wheel_back_left\n'
            '        child(2):  wheel_back_right\n'
            '        child(3):  wheel_front_left\n'
            '        child(4):  wheel_front_right\n'
        )


def test_the_topics_are_there(stack):
    with shell() as terminal:
        topics = terminal.run('ros2 topic list').split()
    assert topics == sorted(topics)
    assert set(topics) >= {
        '/clock',
        '/diff_drive_controller/cmd_vel',
        '/joint_states',
        '/odom',
        '/robot_description',
        '/tf',
        '/tf_static',
    }


def test_both_controllers_are_active(stack):
    with shell() as terminal:
        assert terminal.run('ros2 control list_controllers').splitlines() == [
            'diff_drive_controller   diff_drive_controller/DiffDriveController      active',
            'joint_state_broadcaster joint_state_broadcaster/JointStateBroadcaster  active',
        ]


def test_one_command_moves_the_robot_forward(stack):
    with shell() as terminal:
        before = odometry_x(terminal)
        printed = terminal.run(PUB)
        assert 'publisher: beginning loop\n' in printed
        assert 'publishing #1: geometry_msgs.msg.TwistStamped(header=' in printed
        assert odometry_x(terminal) > before + 0.1


def test_the_keyboard_drives(stack):
    with shell() as keyboard, shell() as terminal:
        assert_in_readme(TELEOP)
        before = odometry_x(terminal)
        keyboard.type(TELEOP)
        keyboard.see(r'currently:\s+speed 0\.5\s+turn 1\.0')
        keyboard.press('i')
        while odometry_x(terminal) < before + 0.1:
            keyboard.press('i')
        keyboard.press('k')
        keyboard.press(CTRL_C)
        keyboard.see(re.escape(PROMPT))


def odometry_x(terminal):
    """The robot's x on /odom, m, by the line of the README."""
    printed = terminal.run('ros2 topic echo /odom --once')
    assert 'frame_id: odom\n' in printed
    assert 'child_frame_id: base_footprint\n' in printed
    assert printed.endswith('---\n')
    return float(re.search(r'position:\n +x: (\S+)\n', printed)[1])
