# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The first hour of a learner, from an empty home: her first package, then the tutorial's.

Where people fell before, and what types it now:

=================================================  ==============================================
the tutorial's package name ends every command     test_the_tutorials_own_package,
                                                   test/system/cli/test_overlaid_package.py
launch files                                       test_the_tutorials_own_package
that a workspace of your own works                 test_her_first_package
a shell that sources that workspace alone          test_her_first_package, test_tutorial.py
``colcon test`` of a package                       test_her_first_package; with ``tests_require``:
                                                   test/tooling/test_stock_package.py
talker, listener, check_urdf, drive                test_tutorial.py
``--help``                                         test/system/nodes/test_node_help.py
``bringup stop``                                   test_the_tutorials_own_package
Ctrl-C during the start                            test_a_launch_that_is_broken_off
a missing package, ``ros2 bag``                    test/system/cli/
message packages, rqt                              README, "What is not here"
=================================================  ==============================================
"""

import re
import time

import pytest
from support.doc_pages import Page, ROOT
from support.running_programs import PATIENCE
from support.shells import CTRL_C, newcomer, PROMPT

README, PACKAGE, SIMULATOR = map(Page, ('../README.md', 'your_own_package.md', 'simulator.md'))
THEIRS = ROOT / 'test/fixtures/tutorial'


@pytest.fixture
def home(tmp_path):
    """An empty one."""
    folder = tmp_path / 'home'
    folder.mkdir()
    return folder


def test_her_first_package(home):
    """The lines of the README and of the page, her two nodes, a second shell without us, tests."""
    package = home / 'ros2_ws/src/py_pubsub'
    with newcomer(README.text, home) as shell:
        for line in (
            'mkdir -p ~/ros2_ws',
            'ros2 pkg create',
            'cd .. && colcon',
            'source install/',
        ):
            shell.run(line)
        assert shell.run('ros2 run py_pubsub hello') == 'Hi from py_pubsub.\n'
        for node, text in zip(('talker', 'listener'), PACKAGE.blocks('python'), strict=True):
            (package / f'py_pubsub/{node}.py').write_text(text)
        (executables,) = (each for each in PACKAGE.blocks('text') if 'talker' in each)
        setup, scripts = (package / 'setup.py').read_text(), "'console_scripts': [\n"
        (package / 'setup.py').write_text(setup.replace(scripts, scripts + executables))
        shell.book = PACKAGE.text
        shell.run('colcon build')
        shell.start('ros2 run py_pubsub talker')
        seen = shell.see(r'\[minimal_publisher\]: Publishing: "Hello World: \d+"').string
        assert 'is not installed' not in seen  # hers, and no stand-in of ours
        with newcomer(PACKAGE.text, home, activate='source ~/ros2_ws/install/setup.bash') as other:
            other.start('ros2 run py_pubsub listener')
            other.see(r'\[minimal_subscriber\]: I heard: "Hello World: \d+"')
            other.interrupt()
        shell.interrupt()
        assert '2 passed, 1 skipped' in shell.run('colcon test')  # the linters
        assert shell.run('colcon test-result').startswith('Summary: 3 tests, 0 errors, 0 failures')
        shell.book = 'ros2 pkg executables py_pubsub'
        names = ('hello', 'listener', 'talker')
        assert shell.run('ros2 pkg') == ''.join(f'py_pubsub {name}\n' for name in names)


@pytest.fixture
def tutorials_package(home):
    """
    ``amr_description`` as the tutorial makes it, in a workspace of hers: the workspace.

    Its files are those of the tutorial, letter for letter, but for the name of the robot, and for
    the path that it leaves to the reader.
    """
    package = home / 'tut_ws/src/amr_description'
    for folder in ('urdf', 'config', 'launch', 'resource', 'amr_description'):
        (package / folder).mkdir(parents=True)
    text = (ROOT / 'examples/py_pubsub/setup.py').read_text()
    text = re.sub(r"'console_scripts': \[.*?\]", "'console_scripts': []", text, flags=re.DOTALL)
    folders = ''.join(
        f"        ('share/' + package_name + '/{name}', glob('{name}/*')),\n"
        for name in ('urdf', 'config', 'launch')
    )
    text = text.replace('    ],\n    install_', f'{folders}    ],\n    install_')
    text = text.replace('py_pubsub', 'amr_description')
    (package / 'setup.py').write_text(f'from glob import glob\n{text}')
    for name in ('setup.cfg', 'package.xml'):
        given = (ROOT / 'examples/py_pubsub' / name).read_text()
        (package / name).write_text(given.replace('py_pubsub', 'amr_description'))
    (package / 'resource/amr_description').touch()
    (package / 'amr_description/__init__.py').touch()
    for name in ('gazebo', 'display'):
        text = (THEIRS / f'{name}_launch.txt').read_text()
        (package / f'launch/{name}.launch.py').write_text(text)
    parameters = package / 'config/controllers.yaml'
    parameters.write_text((THEIRS / 'controllers.yaml').read_text())
    hers = (THEIRS / 'amr.urdf').read_text().replace('name="amr"', 'name="hers"')
    hers = hers.replace('/absolute/path/to/config/controllers.yaml', str(parameters))
    (package / 'urdf/amr.urdf').write_text(hers)
    return package.parents[1]


TUTORIAL = """
colcon build --symlink-install
source install/setup.bash
ros2 topic list
check_urdf src/amr_description/urdf/amr.urdf
ros2 launch amr_description display.launch.py --print
ros2 launch amr_description gazebo.launch.py
ros2 control list_controllers
ros2 topic pub --once /diff_drive_controller/cmd_vel geometry_msgs/msg/TwistStamped \\
  "{header: {frame_id: base_link}, twist: {linear: {x: 0.5}, angular: {z: 0.0}}}"
ros2 param get /robot_state_publisher robot_description
"""


@pytest.mark.long
def test_the_tutorials_own_package(home, tutorials_package):
    """Its launch files, too, which import ``launch`` and ``launch_ros``."""
    with newcomer(TUTORIAL, home, activate='') as shell:
        shell.book = f'source scripts/activate\ncd {tutorials_package}\n{TUTORIAL}'
        for line in ('source scripts/', 'cd', 'colcon', 'source install/'):
            shell.run(line)
        assert '/parameter_events' in shell.run('ros2 topic list')
        assert shell.run('check_urdf').startswith('robot name is: hers\n')
        printed = shell.run('ros2 launch amr_description display.launch.py')
        assert 'in place of joint_state_publisher_gui, rviz2: the page' in printed
        assert re.search(r'<robot name=.{0,2}hers', printed)
        shell.start('ros2 launch amr_description gazebo')
        shell.see('overlays this one: its files come first')
        shell.see('not installed, so those of amr_description are started: robot_state_publisher')
        shell.see(r'ready in \d+\.\d s')
        with newcomer(SIMULATOR.text, home) as other:
            status = other.run('ros2 run amr_description bringup status')
            assert 'robot_state_publisher' in status
            other.book = TUTORIAL + SIMULATOR.text + ODOMETRY
            assert '<robot name="hers"' in other.run('ros2 param get')
            controllers = other.run('ros2 control list_controllers')
            assert (
                len(re.findall(r'(?m)^(?:joint_state|diff_drive)_.* active *$', controllers)) == 2
            )
            assert 'publishing #1' in other.run('ros2 topic pub --once /diff_drive')
            deadline = time.monotonic() + PATIENCE
            while abs(x := odometry_x(other)) < 0.05:  # its axes point to the right: back
                assert time.monotonic() < deadline, x
            other.run('ros2 run amr_description bringup stop')
        shell.see(re.escape(PROMPT))


ODOMETRY = 'ros2 topic echo --once --field pose.pose.position.x /diff_drive_controller/odom\n'


def odometry_x(shell):
    """How far the robot has come, m."""
    return float(shell.run(ODOMETRY.strip()).split()[0])


def test_a_launch_that_is_broken_off(home):
    """Ctrl-C while it starts: nothing is left."""
    with newcomer(README.text, home, activate='') as shell:
        shell.start('scripts/run ')
        shell.see(r'\[mujoco_sim-1\]: process started')
        shell.press(CTRL_C)
        shell.see(re.escape(PROMPT))
        shell.type('jobs; echo "left: $(jobs | wc -l)"')
        shell.see('left: 0')
