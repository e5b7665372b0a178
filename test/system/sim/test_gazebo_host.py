# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the ``<gazebo>`` block that hosts ros2_control says is done, in a running simulator.

Parameters, namespace, remappings, the manager's name; for hold_joints see test_mujoco_system.py.
"""

import re

import pytest
from simulation_interfaces.srv import DeleteEntity, SpawnEntity
from support.ros_processes import PATIENCE, run
from support.simulator import simulator, URDF

from amr_description.control.ros.client import ManagerClient

YAML = """
/**/cm:
  ros__parameters:
    update_rate: 50
    drive: {type: diff_drive_controller/DiffDriveController}
/**/drive:
  ros__parameters:
    left_wheel_names: [joint_wheel_front_left, joint_wheel_back_left]
    right_wheel_names: [joint_wheel_front_right, joint_wheel_back_right]
    wheel_separation: 0.3
    wheel_radius: 0.1
    base_frame_id: base_footprint
"""


def urdf(inside):
    plugin = (
        '<plugin filename="libgz_ros2_control-system.so" '
        f'name="gz_ros2_control::GazeboSimROS2ControlPlugin">{inside}</plugin>'
    )
    return URDF.replace('</robot>', f'<gazebo>{plugin}</gazebo></robot>')


@pytest.fixture(scope='module')
def sim():
    with simulator() as asked:
        yield asked


@pytest.fixture
def hosted(tmp_path):
    path = tmp_path / 'drive.yaml'
    path.write_text(YAML)
    return urdf(f"""<parameters>{path}</parameters>
        <controller_manager_name>cm</controller_manager_name>
        <ros><namespace>left</namespace><remapping>~/odom:=wheel_odom</remapping>
        <remapping>/tf:=my_tf</remapping></ros>""")


def test_the_block_is_obeyed(sim, hosted):
    sim.do(SpawnEntity, name='amr', resource_string=hosted)
    ended = run('spawner', 'drive', '-c', '/left/cm')
    assert ended.returncode == 0, ended.stderr
    states = ManagerClient(sim.node, '/left/cm', timeout=PATIENCE).states()
    assert states == {'drive': 'active'}
    for topic in ('/left/wheel_odom', '/left/my_tf'):
        sim.wait(lambda topic=topic: sim.node.count_publishers(topic))
    assert not sim.node.count_publishers('/left/drive/odom')
    # The pose of the truth is where the robot's own topics are.
    sim.wait(lambda: sim.node.count_publishers('/left/ground_truth/odom'))
    sim.do(DeleteEntity, entity='amr')


def test_the_namespace_of_a_request_prevails(sim, hosted):
    sim.do(SpawnEntity, name='amr', resource_string=hosted, entity_namespace='right')
    ManagerClient(sim.node, '/right/cm', timeout=PATIENCE).states()
    sim.do(DeleteEntity, entity='amr')


@pytest.mark.parametrize(
    'inside, reason',
    [
        ('<ros><namespace>left wing</namespace></ros>', "namespace is 'left wing', which ROS"),
        ('<controller_manager_name>c m</controller_manager_name>', "Invalid node name: .*'c m'"),
        ('<ros><remapping>a b</remapping></ros>', 'a b'),
        ('<hold_joints>perhaps</hold_joints>', '<hold_joints>: found "perhaps"'),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(sim, inside, reason):
    _, said = sim.refused(SpawnEntity, name='odd', resource_string=urdf(inside))
    assert re.search(reason, said), said


def test_a_parameter_file_that_is_not_there_is_no_reason_to_refuse(sim):
    inside = '<ros><namespace>odd</namespace></ros><parameters>/no/such.yaml</parameters>'
    sim.do(SpawnEntity, name='odd', resource_string=urdf(inside))
    sim.do(DeleteEntity, entity='odd')
