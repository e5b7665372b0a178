# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Single lines of many pages, each run as it stands: beside one robot, beside an arm, or alone.

The words of a line are those that a shell makes of it. What must be so stands beside it.
"""

import json
import os
import re
import shlex
import shutil
import signal

from fixtures.bringup.running import Bringup
import pytest
from support import preloaded
from support.doc_pages import Page, ROOT
from support.page_lines import command, typed
from support.running_programs import PATIENCE, Program
from support.shells import line_of

CHAIN = Page('chain_a_controller.md')
CONTROLLER = Page('write_your_own_controller.md')
CONTROL = Page('ros2_control.md')
CHECK = Page('check_urdf.md')
GAZEBO = Page('from_gazebo.md')
SENSORS = Page('sensors.md')
SIMULATOR = Page('simulator.md')
WATCH = Page('stacks.md')
CONTROLLERS = Page('controllers.md')
STATE = (
    'ros2 service call /mujoco_sim/set_simulation_state simulation_interfaces/srv/'
    'SetSimulationState "{state: {state: 2}}"',
    'ros2 service call /mujoco_sim/set_simulation_state simulation_interfaces/srv/'
    'SetSimulationState "{state: {state: 1}}"',
)


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    """The reader's: her package, and the parameter files of its controllers."""
    home = tmp_path_factory.mktemp('home')
    package = home / 'my_package'
    package.mkdir()
    (package / 'circle.py').write_text(CHAIN.blocks('python')[0])
    (package / 'my_module.py').write_text(CONTROLLER.blocks('python')[0])
    (home / 'circle.yaml').write_text(CHAIN.blocks('yaml')[0])
    (home / 'spinner.yaml').write_text(CONTROLLER.blocks('yaml')[0])
    return home


@pytest.fixture(scope='module')
def robot(folder):
    """The robot of docs/sensors.md, with the reader's package where Python finds it."""
    _run, *words = shlex.split(line_of(SENSORS.text, 'scripts/run world:=warehouse sensors:=true'))
    variables = {'AMENT_PREFIX_PATH': os.environ['AMENT_PREFIX_PATH'], 'PYTHONPATH': str(folder)}
    with Bringup(folder, 'simulation', *words, 'viewer:=false', **variables) as up:
        up.expect(r'ready in \d+\.\d s')
        yield up
        assert up.end(signal.SIGINT) == 0


def test_a_chain_is_started_and_ended(robot, folder):
    typed(CHAIN, 'ros2 run amr_description spawner circle', folder)
    chained = typed(CHAIN, 'ros2 control list_controllers --chained-interfaces')
    assert re.search(r'circle +my_package\.circle/Circle +active', chained)
    assert '\n\tchained to interfaces:\n\t\tlinear/velocity' in chained
    typed(CHAIN, 'ros2 control view_controller_chains', folder)
    typed(CHAIN, 'ros2 control switch_controllers --deactivate circle')


def test_a_controller_of_ones_own_takes_the_wheel(robot, folder):
    typed(CONTROLLER, 'ros2 control switch_controllers --deactivate diff')
    typed(CONTROLLER, 'ros2 run amr_description spawner spinner', folder)
    typed(CONTROLLER, 'ros2 topic pub --once /spinner/command')
    assert 'data: ' in typed(CONTROLLER, 'ros2 topic echo /spinner/angle --once')
    back = [*command(CONTROL, 'ros2 control switch_controllers --activate diff'), '--deactivate']
    assert preloaded.run([*back, 'spinner'], timeout=PATIENCE).returncode == 0


def test_the_lidar_is_heard(robot):
    with Program(*command(SENSORS, 'ros2 topic hz /scan')) as hz:
        hz.expect(r'average rate: \d')
    pause, go_on = STATE
    typed(SIMULATOR, pause)
    assert 'success=True' in typed(SENSORS, 'ros2 service call /mujoco_sim/measure')
    typed(SIMULATOR, go_on)


def test_the_robot_is_pushed_and_let_go(robot):
    typed(SIMULATOR, 'ros2 topic pub --once /mujoco_sim/wrench/persistent')
    typed(SIMULATOR, 'ros2 topic pub --once /mujoco_sim/wrench/clear')
    typed(CONTROLLERS, 'ros2 topic pub -1 /emergency_stop')


def test_what_gazebo_users_ask(robot):
    entities = typed(GAZEBO, 'ros2 service call /mujoco_sim/get_entities')
    assert "'amr'" in entities
    assert typed(GAZEBO, 'ros2 topic echo --once --field pose.pose.position').startswith('x: ')


def test_the_stack_is_watched(robot, folder):
    variables = os.environ | {'ROS_HOME': str(folder / 'ros_home')}
    runs = json.loads(
        typed(WATCH, 'ros2 run amr_description bringup status --json', env=variables)
    )
    assert robot.process.pid in {run['pid'] for run in runs}


@pytest.fixture
def drawer(tmp_path):
    """A folder with the files that docs/check_urdf.md names."""
    shutil.copy(ROOT / 'urdf/amr.urdf', tmp_path / 'robot.urdf')
    rover = ROOT / 'examples/rover/urdf/rover.urdf.xacro'
    shutil.copy(rover, tmp_path / 'robot.urdf.xacro')
    shutil.copy(ROOT / 'config/controllers.yaml', tmp_path / 'controllers.yaml')
    return tmp_path


@pytest.mark.parametrize(
    ('beginning', 'said'),
    [
        ('check_urdf robot.urdf    ', 'robot name is: amr\n'),
        ('check_urdf robot.urdf.xacro wheel_radius:=0.1', 'robot name is: rover\n'),
        ('check_urdf robot.urdf --controllers controllers.yaml', 'robot name is: amr\n'),
        ('check_urdf robot.urdf --drop', '\n    passed\n'),
        ('check_urdf robot.urdf --strict --json', '"'),
        ('check_urdf robot.urdf --footprint', 'footprint: "[['),
    ],
)
def test_check_urdf(drawer, beginning, said):
    assert said in typed(CHECK, beginning, drawer)


def test_check_urdf_reads_its_input(drawer):
    words = command(CHECK, 'check_urdf - < robot.urdf')
    assert words[-3:] == ['-', '<', 'robot.urdf']
    with (drawer / words[-1]).open() as given:
        done = preloaded.run(words[:-2], timeout=PATIENCE, stdin=given)
    assert done.stdout.startswith('robot name is: amr\n')


def test_check_urdf_weighs_a_link(drawer):
    text = (drawer / 'robot.urdf').read_text()
    (drawer / 'robot.urdf').write_text(text.replace('"wheel_front_left"', '"arm"'))
    assert '<mass value="1.2"/>' in typed(CHECK, 'check_urdf robot.urdf --inertia arm', drawer)
