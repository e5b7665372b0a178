# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Lines of docs/ beside an arm with a gripper, and beside hardware of one's own."""

import os
import signal

from fixtures.bringup.running import Bringup
import pytest
from support.doc_pages import mocked, Page, ROOT
from support.page_lines import command, typed
from support.running_programs import Program
from support.shells import line_of

CONTROLLERS = Page('controllers.md')
HARDWARE = Page('write_your_own_hardware.md')
(MOCK,) = Page('write_your_own_controller.md').blocks('xml')


@pytest.mark.long  # as test/ros/control/test_joint_trajectory_action.py, but typed
def test_an_arm_moves_and_its_gripper_closes(tmp_path):
    finger = '<joint name="finger">\n      <command_interface name="position"/>\n'
    text = (ROOT / 'test/fixtures/sim/arm.urdf').read_text()
    assert finger in text
    speed = f'{finger}      <state_interface name="velocity"/>\n'  # as this gripper wants it
    (tmp_path / 'arm.urdf').write_text(text.replace(finger, speed))
    (tmp_path / 'arm.yaml').write_text(
        CONTROLLERS.blocks('yaml')[0]
        + '/**/gripper_controller:\n  ros__parameters:\n    joint: finger\n'
        + '    type: position_controllers/GripperActionController\n'
    )
    words = (f'urdf:={tmp_path}/arm.urdf', f'controllers:={tmp_path}/arm.yaml', 'viewer:=false')
    prefixes = {'AMENT_PREFIX_PATH': os.environ['AMENT_PREFIX_PATH']}
    with Bringup(tmp_path, 'simulation', *words, **prefixes) as up:
        up.expect(r'ready in \d+\.\d s')
        assert 'SUCCEEDED' in typed(
            CONTROLLERS, 'ros2 action send_goal --feedback /arm_controller'
        )
        typed(CONTROLLERS, 'ros2 topic pub --once /arm_controller/joint_trajectory')
        assert 'position: ' in typed(CONTROLLERS, 'ros2 action send_goal /gripper_controller')
        assert up.end(signal.SIGINT) == 0


@pytest.mark.long  # as test/system/control/, but typed
def test_hardware_without_a_stack(tmp_path):
    """With a mock in place of the reader's motors."""
    (tmp_path / 'my_robot.urdf').write_text(mocked(MOCK).replace('"AmrSystem"', '"MyRobot"'))
    table = (ROOT / 'config/controllers.yaml').read_text()
    (tmp_path / 'controllers.yaml').write_text(table.replace('use_sim_time: true', ''))
    publisher = command(HARDWARE, 'ros2 run amr_description robot_state_publisher')
    manager = command(HARDWARE, 'ros2 run amr_description ros2_control_node')
    with Program(*publisher, cwd=tmp_path) as first, Program(*manager, cwd=tmp_path) as second:
        first.expect('Robot initialized')
        typed(HARDWARE, 'ros2 run amr_description spawner')
        typed(HARDWARE, 'ros2 control set_hardware_component_state MyRobot')
        typed(HARDWARE, 'ros2 control switch_controllers --activate')
        assert second.end(signal.SIGINT) == 0
        assert first.end(signal.SIGINT) == 0


@pytest.mark.long  # as docs/your_own_robot.md in test_walk_robot_developer.py
def test_the_sliders_of_the_tutorial(tmp_path):
    _run, *words = line_of(Page('tutorial.md').text, 'scripts/run display').split()
    prefixes = {'AMENT_PREFIX_PATH': os.environ['AMENT_PREFIX_PATH']}
    with Bringup(tmp_path, *words, **prefixes) as up:
        up.expect('The page is at http://127.0.0.1:')
        assert up.end(signal.SIGINT) == 0
