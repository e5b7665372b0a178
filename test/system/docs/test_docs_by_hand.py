# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Lines of docs/ros2_control.md and docs/simulator.md that start a robot of their own, part by part.

They take half a minute, and run with ``--long``; what they start is tested in every run by
test/system/hardware/test_serial_stack.py and test/system/sim/test_mujoco_sim.py.
"""

import pytest
from support import shells
from support.doc_pages import Page
from support.shells import line_of

CONTROL, SIMULATOR = (Page(name).text for name in ('ros2_control.md', 'simulator.md'))
ACTIVATE = 'source scripts/activate\n'


@pytest.fixture
def terminal(tmp_path):
    """A function that opens a new terminal for one who reads the book."""
    return lambda book='': shells.newcomer(ACTIVATE + book, tmp_path)


@pytest.mark.long
def test_a_motor_board_is_unplugged_and_plugged_in_again(terminal, tmp_path):
    """docs/ros2_control.md; by the services: test/system/hardware/test_serial_stack.py."""
    port = tmp_path / 'board'
    board = f'ros2 run amr_description motor_board --link {port}'
    with terminal() as bench, terminal() as robot, terminal(CONTROL) as shell:
        bench.type(board)
        bench.see('linked as')
        robot.type(f'{line_of(CONTROL, "ros2 launch amr_description serial")} port:={port}')
        robot.see(r'ready in \d+\.\d s')
        bench.interrupt()
        robot.see(f'the motor board on {port} is gone')
        assert ' active' not in shell.run('ros2 control list_controllers')
        bench.type(board)
        bench.see('linked as')
        shell.run('ros2 control set_hardware_component_state AmrSystem active')
        shell.run('ros2 control switch_controllers --activate joint_state_broadcaster diff')
        assert shell.run('ros2 control list_controllers').count(' active') == 2
        robot.interrupt()
        bench.interrupt()


@pytest.mark.long
def test_the_simulator_without_a_stack(terminal):
    """The last section of docs/simulator.md: two programs that go on, and two that end."""
    with terminal(SIMULATOR) as first, terminal(SIMULATOR) as second, terminal(SIMULATOR) as shell:
        first.start('ros2 run amr_description mujoco_sim')
        first.see("World 'ramp'")
        second.start('ros2 run amr_description robot_state_publisher')
        second.see('Robot initialized')
        shell.run('ros2 run amr_description create')
        shell.run('ros2 run amr_description spawner')
        shell.book = 'ros2 control list_controllers'
        assert shell.run('ros2 control').count(' active') == 2
        first.interrupt()
        second.interrupt()
