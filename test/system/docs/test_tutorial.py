# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The tutorial as an executable document: the lines of docs/tutorial.md and of the README, typed; and
as the tutorial itself prints them, where the packages that it names are not installed. Beside the
robot that runs, those of docs/simulator.md and docs/ros2_control.md.

Each terminal is a bash of its own on a pseudo-terminal, with an empty home. What a line must show
stands beside it.
"""

import re

from nav_msgs.msg import Odometry
import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from support import shells
from support.doc_pages import Page
from support.shells import CTRL_C, line_of, PROMPT, ROOT
from support.waiting import until

from amr_description.ros.runtime import ros, spinning

README, PAGE, SIMULATOR, CONTROL = (
    Page(name).text for name in ('../README.md', 'tutorial.md', 'simulator.md', 'ros2_control.md')
)
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
BOOKS = pytest.mark.parametrize('book', [PAGE, TUTORIAL], ids=['page', 'tutorial'])
CHANGE = 'ros2 service call /mujoco_sim/set_simulation_state simulation_interfaces/srv/'


@pytest.fixture(scope='module')
def terminal(tmp_path_factory):
    """A function that opens a new terminal for one who reads the book."""
    home = tmp_path_factory.mktemp('home')

    def opened(book=README, *, activated=True, folder=ROOT):
        activate = 'source install/setup.bash' if book is TUTORIAL else 'source scripts/activate'
        return shells.newcomer(book, home, activate=activate if activated else '', folder=folder)

    return opened


@pytest.fixture(scope='module')
def stack(terminal):
    """Terminal 1: the robot."""
    with terminal(activated=False) as shell:
        assert line_of(README, 'scripts/run ')
        shell.type(line_of(PAGE, 'scripts/run\n').strip())
        shell.see(r'ready in \d+\.\d s: open the page')
        shell.see(re.escape('Ctrl-C stops all.'))
        yield shell
        shell.press(CTRL_C)
        shell.see(re.escape(PROMPT))
        shell.type('jobs; echo "left: $(jobs | wc -l)"')
        shell.see(r'left: 0')


@pytest.mark.parametrize(
    ('book', 'package'),
    [(PAGE, 'amr_description'), (TUTORIAL, 'py_pubsub')],
    ids=['page', 'tutorial'],
)
def test_talker_and_listener(terminal, book, package):
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
    [(PAGE, ROOT, 'check_urdf urdf/amr.urdf'), (TUTORIAL, ROOT / 'urdf', 'check_urdf amr.urdf')],
    ids=['page', 'tutorial'],
)
def test_check_urdf_prints_the_tree(terminal, book, folder, line):
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


def test_the_topics_are_there(stack, terminal):
    with terminal(PAGE) as shell:
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
def test_both_controllers_are_active(stack, terminal, book):
    with terminal(book) as shell:
        said = shell.run('ros2 control list_controllers').splitlines()
        # On a busy machine it says first that it waits, as the original does.
        assert [line for line in said if 'waiting for service' not in line] == [
            'diff_drive_controller   diff_drive_controller/DiffDriveController      active',
            'joint_state_broadcaster joint_state_broadcaster/JointStateBroadcaster  active',
        ]


@pytest.fixture(scope='module')
def odometry(stack):
    """The messages on /odom, of which a terminal shows one at a time."""
    heard = []
    with ros([]):
        node = Node('watcher')
        node.create_subscription(Odometry, '/odom', heard.append, 1)
        with spinning(node, executor=SingleThreadedExecutor):
            until(lambda: heard)
            yield heard


def test_the_odometry_is_shown(odometry, terminal):
    """By the line of the README."""
    with terminal() as shell:
        printed = shell.run('ros2 topic echo /odom --once')
    assert 'frame_id: odom\n' in printed
    assert 'child_frame_id: base_footprint\n' in printed
    assert printed.endswith('---\n')
    assert re.search(r'position:\n +x: \S+\n', printed)


@BOOKS
def test_one_command_moves_the_robot_forward(odometry, terminal, book):
    with terminal(book) as shell:
        before = x_at_rest(odometry)
        printed = shell.run('ros2 topic pub --once /diff_drive_controller/cmd_vel ')
        assert 'publisher: beginning loop\n' in printed
        assert 'publishing #1: geometry_msgs.msg.TwistStamped(header=' in printed
        assert x_at_rest(odometry, moved_from=before) > before + 0.1


@pytest.mark.parametrize(
    ('book', 'package'),
    [(README, 'amr_description'), (TUTORIAL, 'teleop_twist_keyboard')],
    ids=['README', 'tutorial'],
)
def test_the_keyboard_drives(odometry, terminal, book, package):
    with terminal(book) as keyboard:
        before = x_at_rest(odometry)
        keyboard.start(f'ros2 run {package} teleop_twist_keyboard ')
        keyboard.see(r'currently:\s+speed 0\.5\s+turn 1\.0')
        keyboard.press('i')
        until(lambda: x_of(odometry) > before + 0.1 or keyboard.press('i'), every=0.1)
        keyboard.press('k')
        keyboard.interrupt()


def test_the_robot_is_dropped(terminal):
    with terminal(PAGE) as shell:
        line = 'check_urdf urdf/amr.urdf --controllers config/controllers.yaml --drop'
        assert shell.run(line).endswith('\n    passed\n')


def test_time_is_paused_stepped_and_reset(stack, terminal):
    """What the page says of each of the five lines; time goes on afterwards, at rate 1."""
    with terminal(SIMULATOR) as shell:
        assert shell.run('ros2 param set') == 'Set parameter successful\n'
        assert 'result=1' in shell.run(f'{CHANGE}SetSimulationState "{{state: {{state: 2}}}}"')
        shell.book += 'ros2 topic echo --once --field clock /clock\n'
        paused = seconds(shell)
        assert 'result=1' in shell.run('ros2 service call /mujoco_sim/step_simulation')
        stepped = seconds(shell)
        assert paused < stepped < paused + 1.0
        assert 'result=1' in shell.run(f'{CHANGE}SetSimulationState "{{state: {{state: 1}}}}"')
        assert 'result=1' in shell.run('ros2 service call /mujoco_sim/reset_simulation')
        shell.book += 'ros2 param set /mujoco_sim real_time_factor 1.0'
        shell.run('ros2 param set /mujoco_sim real_time_factor 1.0')


def seconds(shell):
    """Simulated time, s, by /clock."""
    found = re.search(r'sec: (\d+)\nnanosec: (\d+)\n', shell.run('ros2 topic echo --once --field'))
    return int(found[1]) + 1e-9 * int(found[2])


def test_a_controller_is_switched_off_and_on(stack, terminal):
    with terminal(CONTROL + PAGE) as shell:
        claimed = '\tjoint_wheel_front_left/velocity [available] [claimed]\n'
        assert claimed in shell.run('ros2 control list_hardware_interfaces')
        assert 'Successfully' in shell.run('ros2 control switch_controllers --deactivate diff')
        assert claimed not in shell.run('ros2 control list_hardware_interfaces')
        assert 'Successfully' in shell.run('ros2 control switch_controllers --activate diff')
        assert ' inactive' not in shell.run('ros2 control list_controllers')


def x_at_rest(odometry, moved_from=None):
    """Where the robot stands, m; it rolls until the timeout of its last command."""
    if moved_from is not None:
        until(lambda: abs(x_of(odometry) - moved_from) > 1e-3)
    until(lambda: abs(odometry[-1].twist.twist.linear.x) < 1e-3)
    return x_of(odometry)


def x_of(odometry):
    """The robot's last x, m."""
    return odometry[-1].pose.pose.position.x
