# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The tutorial as an executable document: its shell lines typed into terminals, as in the README.
And as the tutorial itself prints them, where the packages that it names are not installed.

Each terminal is a bash of its own on a pseudo-terminal. What a line must show stands beside it.
"""

import re

import pytest
from support import shells
from support.shells import CTRL_C, line_of, PROMPT, ROOT

README = (ROOT / 'README.md').read_text(encoding='utf-8')
TUTORIAL = r"""
source install/setup.bash

ros2 run py_pubsub talker
ros2 run py_pubsub listener

ros2 topic list          # see 'topic' in the list
ros2 topic echo /topic   # watch the raw messages fly by

check_urdf amr.urdf

ros2 control list_controllers

ros2 run teleop_twist_keyboard teleop_twist_keyboard \
  --ros-args -p stamped:=true -r /cmd_vel:=/diff_drive_controller/cmd_vel

ros2 topic pub --once /diff_drive_controller/cmd_vel geometry_msgs/msg/TwistStamped \
  "{header: {frame_id: base_link}, twist: {linear: {x: 0.5}, angular: {z: 0.0}}}"
"""
BOOKS = pytest.mark.parametrize('book', [README, TUTORIAL], ids=['README', 'tutorial'])


def terminal(book=README, *, activated=True, folder=ROOT):
    """A new terminal for one who reads the book."""
    activate = 'source scripts/activate' if book is README else 'source install/setup.bash'
    return shells.terminal(book, activate=activate if activated else '', folder=folder)


@pytest.fixture(scope='module')
def stack():
    """Terminal 1: the robot."""
    with terminal(activated=False) as shell:
        assert line_of(README, 'scripts/run ')
        shell.type('scripts/run')
        shell.see(r'ready in \d+\.\d s: open the page')
        shell.see(re.escape('Ctrl-C stops all.'))
        yield shell
        shell.press(CTRL_C)
        shell.see(re.escape(PROMPT))
        shell.type('jobs; echo "left: $(jobs | wc -l)"')
        shell.see(r'left: 0')


@pytest.mark.parametrize(
    ('book', 'package'),
    [(README, 'amr_description'), (TUTORIAL, 'py_pubsub')],
    ids=['README', 'tutorial'],
)
def test_talker_and_listener(book, package):
    with terminal(book) as first, terminal(book) as second:
        first.start(f'ros2 run {package} talker')
        second.start(f'ros2 run {package} listener')
        if book is TUTORIAL:
            second.see("package 'py_pubsub' is not installed: running 'listener' of amr_desc")
        first.see(r'\[INFO\] \[[\d.]+\] \[minimal_publisher\]: Publishing: "Hello World: \d+"')
        heard = second.see(r'\[minimal_subscriber\]: I heard: "Hello World: (\d+)"')
        again = second.see(r'\[minimal_subscriber\]: I heard: "Hello World: (\d+)"')
        assert int(again[1]) == int(heard[1]) + 1
        second.interrupt()
        if book is TUTORIAL:
            assert '/topic' in second.run('ros2 topic list').split()
            second.start('ros2 topic echo /topic')
            second.see(r"data: 'Hello World: \d+'\r?\n---\r?\n")
            second.interrupt()
        first.interrupt()


@pytest.mark.parametrize(
    ('book', 'folder', 'line'),
    [(README, ROOT, 'check_urdf urdf/amr.urdf'), (TUTORIAL, ROOT / 'urdf', 'check_urdf amr.urdf')],
    ids=['README', 'tutorial'],
)
def test_check_urdf_prints_the_tree(book, folder, line):
    with terminal(book, folder=folder) as shell:
        assert shell.run(line) == (
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
    with terminal() as shell:
        topics = shell.run('ros2 topic list').split()
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


@BOOKS
def test_both_controllers_are_active(stack, book):
    with terminal(book) as shell:
        said = shell.run('ros2 control list_controllers').splitlines()
        # On a busy machine it says first that it waits, as the original does.
        assert [line for line in said if 'waiting for service' not in line] == [
            'diff_drive_controller   diff_drive_controller/DiffDriveController      active',
            'joint_state_broadcaster joint_state_broadcaster/JointStateBroadcaster  active',
        ]


@BOOKS
def test_one_command_moves_the_robot_forward(stack, book):
    with terminal() as watcher, terminal(book) as shell:
        before = odometry_x(watcher)
        printed = shell.run('ros2 topic pub --once /diff_drive_controller/cmd_vel ')
        assert 'publisher: beginning loop\n' in printed
        assert 'publishing #1: geometry_msgs.msg.TwistStamped(header=' in printed
        assert odometry_x(watcher) > before + 0.1


@pytest.mark.parametrize(
    ('book', 'package'),
    [(README, 'amr_description'), (TUTORIAL, 'teleop_twist_keyboard')],
    ids=['README', 'tutorial'],
)
def test_the_keyboard_drives(stack, book, package):
    with terminal(book) as keyboard, terminal() as watcher:
        before = odometry_x(watcher)
        keyboard.start(f'ros2 run {package} teleop_twist_keyboard ')
        keyboard.see(r'currently:\s+speed 0\.5\s+turn 1\.0')
        keyboard.press('i')
        while odometry_x(watcher) < before + 0.1:
            keyboard.press('i')
        keyboard.press('k')
        keyboard.interrupt()


def odometry_x(shell):
    """The robot's x on /odom, m, by the line of the README."""
    printed = shell.run('ros2 topic echo /odom --once')
    assert 'frame_id: odom\n' in printed
    assert 'child_frame_id: base_footprint\n' in printed
    assert printed.endswith('---\n')
    return float(re.search(r'position:\n +x: (\S+)\n', printed)[1])
