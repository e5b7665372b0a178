# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stacks without the simulator: the order of starts, and the swapped hardware."""

import os

import pytest
from support.paths import ROOT

from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.conditions import PathState
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.stacks.hardware import mock, serial
from amr_description.errors import AmrError
from amr_description.hardware import HARDWARE
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse

FILES = {
    'urdf': str(ROOT / 'urdf/amr.urdf'),
    'controllers': str(ROOT / 'config/controllers.yaml'),
    'viewer': 'false',
}
CONTROLLED = [
    ['ros2_control_node', 'robot_state_publisher', 'spawner'],
    ['spawner'],
]


def stack(function, **given):
    return function(**resolve(declared(function), FILES | given))


def waves(stack):
    scheduler = Scheduler(stack)
    port = hardware(stack).parameters.get('port')
    if port:
        yield [node.executable for node in scheduler.startable()]
        scheduler.observe(paths={port: PathState(True)})
    while wave := scheduler.startable():
        for node in wave:
            scheduler.on_start(node)
        yield [node.executable for node in wave]
        assert not scheduler.ready
        scheduler.on_exit(wave[-1], 0)
    assert scheduler.ready


def hardware(stack):
    (publisher,) = [n for n in stack.nodes if n.executable == 'robot_state_publisher']
    (info,) = hardware_of(parse(publisher.parameters[0]['robot_description'], 'swapped'))
    return info


def test_mock_hardware():
    made = stack(mock)
    assert list(waves(made)) == CONTROLLED
    assert hardware(made).plugin == 'mock_components/GenericSystem'


@pytest.mark.parametrize('function', [mock, serial])
@pytest.mark.parametrize(
    ('line', 'noted'),
    [
        ('    use_sim_time: true', True),
        ('  use_sim_time : True  # s', True),
        ('    rate: 1', False),
    ]
    + [('    use_sim_time: false', False), ('    # use_sim_time: true', False)],
)
def test_the_clock_is_that_of_the_system_whatever_the_file_says(tmp_path, function, line, noted):
    file = tmp_path / 'controllers.yaml'
    file.write_text(f'controller_manager:\n  ros__parameters:\n{line}\n')
    made = stack(function, controllers=str(file))
    (manager,) = [node for node in made.nodes if node.executable == 'ros2_control_node']
    assert manager.parameters == [file, {'use_sim_time': False}]
    assert [text for _, text in made.notes if 'use_sim_time' in text] == (
        [f'use_sim_time: false, though {file} says true: nobody simulates'] if noted else []
    )


def test_a_simulated_board_where_there_is_no_real_one():
    made = stack(serial)
    before_the_port = ['motor_board', 'robot_state_publisher']
    assert list(waves(made)) == [before_the_port, ['motor_board', *CONTROLLED[0]], CONTROLLED[1]]
    info = hardware(made)
    assert info.plugin == 'amr_description/SerialBaseSystem'
    assert made.nodes[0].arguments == ['--link', info.parameters['port']]
    assert info.parameters['answer_timeout'] == '1.0'  # the board shares a busy computer
    sides = info.parameters['left_joints'], info.parameters['right_joints']
    driven = {joint for side in sides for joint in side.split()}
    assert driven == {joint.name for joint in info.joints}


def test_a_real_board():
    made = stack(serial, port='/dev/ttyUSB0')
    assert list(waves(made)) == [['robot_state_publisher'], *CONTROLLED]
    assert hardware(made).parameters['port'] == '/dev/ttyUSB0'
    assert 'answer_timeout' not in hardware(made).parameters


def test_a_simulated_board_of_another_terminal(tmp_path):
    terminal, slave = os.openpty()
    port = tmp_path / 'board'
    port.symlink_to(os.ttyname(slave))
    try:
        info = hardware(stack(serial, port=str(port)))
    finally:
        os.close(terminal)
        os.close(slave)
    assert info.parameters['port'] == str(port)
    assert info.parameters['answer_timeout'] == '1.0'


def test_a_missing_port_is_reported_soon():
    scheduler = Scheduler(stack(serial, port='/dev/nonsense'))
    scheduler.advance_to(0.0)
    assert scheduler.next_time() == 10.0
    scheduler.observe(paths={'/dev/nonsense': PathState(False, frozenset({'ttyACM0', 'null'}))})
    scheduler.advance_to(10.0)
    assert scheduler.failure.text(lambda node: node.executable) == (
        'ros2_control_node waited 10 s in vain: there is no /dev/nonsense; /dev has ttyACM0'
    )


@pytest.mark.parametrize('function', [mock, serial])
def test_their_hardware_is_known(function):
    assert HARDWARE.find(hardware(stack(function)).plugin)


def test_a_robot_without_hardware_is_refused(tmp_path):
    (tmp_path / 'bare.urdf').write_text('<robot name="bare"><link name="base"/></robot>')
    with pytest.raises(AmrError, match='0 <ros2_control> blocks with a <hardware>'):
        stack(mock, urdf=str(tmp_path / 'bare.urdf'))
