# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot developer's first hour, from an empty home: docs/your_own_robot.md, typed.

Where people fell before, and what types it now:

=================================================  ==============================================
a wrong axle passes everything                     test_a_wrong_axle_is_named,
                                                   test/unit/model/test_rules_controllers.py
an IMU, a third controller                         test_the_robot_in_the_simulator
``import tf2_ros`` and the like                    test_a_node_may_import_tf2,
                                                   test/ros/message_filters/, sensor_msgs_py/
friction tags                                      the caster of the rover; test/unit/sim/
multipliers of odometry                            test_odometry_is_calibrated
mistakes in a YAML file                            test/unit/controllers/test_parameter_faults.py
``urdf:=`` without ``controllers:=``, a fleet      test/unit/bringup/test_bringup_*_files.py
lines of a xacro                                   test/unit/model/test_description_file.py
mm for m                                           test/unit/model/test_urdf_broken.py
a robot that rears up                              test/unit/sim/test_sim_tilt.py
``mock`` without a clock                           test/ros/control/test_description_source.py
two simulators in a domain                         test/ros/sim/test_other_clock.py
lidar, camera                                      test/system/sim/test_sensors.py
=================================================  ==============================================
"""

import math
import re
import shutil

import pytest
from support.doc_pages import Page, ROOT
from support.shells import CTRL_C, newcomer, PROMPT

README, PAGE = Page('../README.md'), Page('your_own_robot.md')


@pytest.fixture(scope='module')
def home(tmp_path_factory):
    """A home with a copy of the example in it."""
    folder = tmp_path_factory.mktemp('home')
    shutil.copytree(ROOT / 'examples/rover', folder / 'rover')
    return folder


def person(book, home):
    """One in the folder of the robot."""
    return newcomer(book.text, home, folder=home / 'rover')


def test_the_description_is_checked_and_dropped(home):
    with person(README, home) as shell:
        assert shell.run('check_urdf urdf/rover.urdf.xacro').endswith('\n    passed\n')
        shell.book = PAGE.text
        assert shell.run('check_urdf urdf/rover.urdf.xacro --con').endswith('\n    passed\n')
        assert '    child(1):  base_link\n' in shell.run('check_urdf urdf/rover.urdf.xacro wheel_')


@pytest.fixture(scope='module')
def robot(home):
    """The terminal in which she looks at the robot with sliders, and then has it simulated."""
    with person(README, home) as shell:
        shell.start('ros2 launch amr_description display ')
        shell.sliders = shell.see(r'The page is at (http://\S+)')[1]
        shell.interrupt()
        shell.start('ros2 launch amr_description simulation ')
        shell.see(r'ready in \d+\.\d s')
        yield shell
        shell.press(CTRL_C)
        shell.see(re.escape(PROMPT))


@pytest.mark.long
def test_the_sliders(robot):
    assert robot.sliders.startswith('http://127.0.0.1:')


def x(printed):
    return float(re.search(r'^x: (\S+)$', printed, re.MULTILINE)[1])


def x_of_truth(shell):
    return x(shell.run('ros2 topic echo --once --field pose.pose.position /ground'))


def x_at_rest(shell):
    """Where the robot stands, m; it rolls until the timeout of its last command."""
    before, truth = math.inf, x_of_truth(shell)
    while abs(truth - before) > 1e-3:
        before = truth
        truth = x_of_truth(shell)
    return truth


def test_the_robot_in_the_simulator(robot, home):
    with person(PAGE, home) as shell:
        shell.run('ros2 topic pub --times 20')
        truth = x_at_rest(shell)
        odometry = x(shell.run('ros2 topic echo --once --field pose.pose.position /odom'))
        assert 0.3 < truth < 1.0
        assert odometry == pytest.approx(truth, abs=0.02)
        turning = shell.run('ros2 topic echo --once --field angular_velocity')
        assert abs(float(re.search(r'^z: (\S+)$', turning, re.MULTILINE)[1])) < 0.1


@pytest.mark.long
def test_odometry_is_calibrated(robot, home):
    """Six drives at real time."""
    with person(PAGE, home) as shell:
        shell.start('ros2 run amr_description calibrate')
        for name in (
            'straight forward',
            'straight backward',
            'spin left',
            'spin right',
            'arc left',
        ):
            shell.see(name)
        multiplier = shell.see(r'wheel_separation_multiplier: (\S+)')[1]
        assert float(multiplier) == pytest.approx(1.0, abs=0.01)
        shell.see(re.escape(PROMPT))


@pytest.mark.parametrize(
    ('axis', 'said'),
    [('1 0 0', 'sideways'), ('0 0 -1', 'backwards')],
)
def test_a_wrong_axle_is_named(home, axis, said):
    with person(README, home) as shell:
        shell.type(f'sed -i.good \'s/<axis xyz=.*/<axis xyz="{axis}"\\/>/\' urdf/rover.urdf.xacro')
        shell.see(re.escape(PROMPT))
        try:
            found = shell.run('check_urdf urdf/rover.urdf.xacro', code=1)
        finally:
            shell.type('mv urdf/rover.urdf.xacro.good urdf/rover.urdf.xacro')
            shell.see(re.escape(PROMPT))
    assert said in found
    assert 'passed' not in found


NODE = """
source scripts/activate
python -c "from tf2_ros import TransformBroadcaster as Broadcaster; print(Broadcaster)"
"""


def test_a_node_may_import_tf2(home):
    with newcomer(NODE, home) as shell:
        assert 'TransformBroadcaster' in shell.run('python -c')
