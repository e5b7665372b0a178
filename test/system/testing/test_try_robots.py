# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``try_robots``: our robot comes through all stages; one that does not is a row all the same."""

import json
import shutil
import sys

import pytest
from support.paths import ROOT
from support.running_programs import Program

_INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>'
)
_JOINTS = ('shoulder', 'elbow', 'wrist', 'spinner')
# Joints of an arm, each moved by a plugin of Gazebo that drives no wheels; topics of their own.
ARM = (
    '<robot name="arm"><link name="world"/>'
    + ''.join(
        f'<link name="{joint}_link">{_INERTIAL}</link>'
        f'<joint name="{joint}" type="revolute"><parent link="{parent}"/>'
        f'<child link="{joint}_link"/><axis xyz="0 0 1"/>'
        '<limit lower="-2" upper="2" effort="50" velocity="2"/></joint>'
        for joint, parent in zip(_JOINTS, ('world', *(f'{j}_link' for j in _JOINTS)), strict=False)
    )
    + '<gazebo><plugin filename="x" name="gz::sim::systems::JointTrajectoryController">'
    '<joint_name>shoulder</joint_name><joint_name>elbow</joint_name><topic>way</topic></plugin>'
    '<plugin filename="x" name="gz::sim::systems::JointPositionController">'
    '<joint_name>wrist</joint_name></plugin>'
    '<plugin filename="x" name="gz::sim::systems::JointController">'
    '<joint_name>spinner</joint_name><topic>speed</topic></plugin></gazebo></robot>'
)

# What the demos of ros2_control have as a chain: trajectories, all joints, one joint each.
CHAIN = """
controller_manager:
  ros__parameters:
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    shoulder_controller: {type: passthrough_controller/PassthroughController}
    elbow_controller: {type: passthrough_controller/PassthroughController}
    both: {type: passthrough_controller/PassthroughController}
    trajectories: {type: joint_trajectory_controller/JointTrajectoryController}
shoulder_controller: {ros__parameters: {interfaces: [shoulder/position]}}
elbow_controller: {ros__parameters: {interfaces: [elbow/position]}}
both:
  ros__parameters:
    interfaces: [shoulder_controller/shoulder/position, elbow_controller/elbow/position]
trajectories:
  ros__parameters:
    joints: [shoulder, elbow]
    command_joints: [both/shoulder_controller/shoulder, both/elbow_controller/elbow]
    command_interfaces: [position]
    state_interfaces: [position]
"""


@pytest.mark.long
def test_joints_behind_a_chain_of_passthrough_controllers_follow_a_trajectory(tmp_path):
    file, report = tmp_path / 'arm.urdf', tmp_path / 'report.json'
    joints = ''.join(
        f'<joint name="{each}"><command_interface name="position"/>'
        '<state_interface name="position"/></joint>'
        for each in _JOINTS[:2]
    )
    block = f'<ros2_control name="arm" type="system"><hardware/>{joints}</ros2_control>'
    file.write_text(f'{ARM.partition("<gazebo>")[0]}{block}</robot>')
    file.with_suffix('.yaml').write_text(CHAIN)
    module = 'amr_description.testing.trial'
    with Program(sys.executable, '-m', module, str(file), '--json', str(report)) as program:
        assert program.end() == 0, program.output
    (arm,) = json.loads(report.read_text())
    assert [each['state'] for each in arm['controllers']] == ['active'] * 5
    (motion,) = arm['motions']
    assert (motion['controller'], motion['what']) == ('trajectories', 'trajectory')
    assert '1 moved as told' in program.output


@pytest.mark.long
def test_an_arm_of_plugins_is_moved_by_their_topics(tmp_path):
    file, report = tmp_path / 'arm.urdf', tmp_path / 'report.json'
    file.write_text(ARM)
    module = 'amr_description.testing.trial'
    with Program(sys.executable, '-m', module, str(file), '--json', str(report)) as program:
        assert program.end() == 0, program.output
    (arm,) = json.loads(report.read_text())
    assert (arm['faults'], arm['undriven']) == ([], [])
    motions = sorted(each['what'] for each in arm['motions'])
    assert motions == ['position', 'trajectory', 'velocity']
    assert '1 moved as told' in program.output


def test_a_robot_that_is_fine_and_one_that_is_refused(tmp_path):
    robots = tmp_path / 'robots'
    robots.mkdir()
    shutil.copy(ROOT / 'urdf' / 'amr.urdf', robots)
    shutil.copy(ROOT / 'config' / 'controllers.yaml', robots / 'amr.yaml')
    (robots / 'bad.urdf').write_text('<robot name="bad"><link name="@LINK@"/></robot')
    report = tmp_path / 'report.json'
    options = ['--jobs', '2', '--json', str(report), '--replace', '@LINK@=base']
    module = 'amr_description.testing.trial'
    with Program(sys.executable, '-m', module, str(robots), *options) as program:
        assert program.end() == 1
    good, bad = json.loads(report.read_text())
    assert (good['stage'], good['faults']) == ('done', [])
    assert [each['state'] for each in good['controllers']] == ['active', 'active']
    assert [each['what'] for each in good['motions']] == ['forward', 'turn']
    assert all(abs(each['truth'] / each['asked'] - 1) < 0.02 for each in good['motions'])
    assert good['rest']['seconds'] < 1.0
    assert bad['spawn_seconds'] is None
    assert bad['faults'][0].startswith('spawn: ')
    assert '2 tried: 1 moved as told; 0 moved, off; 1 did not move' in program.output
