# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot for Gazebo, without ros2_control, in a running simulator: by its own topics."""

from fixtures.sim.plugin_robot import cart, classic_drive, gz_drive, plugin
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
import pytest
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import DeleteEntity, SpawnEntity
from support.ros_processes import PATIENCE
from support.simulator import simulator

from amr_description.control.ros.client import ManagerClient


@pytest.fixture(scope='module')
def sim():
    with simulator('real_time_factor:=0.0') as asked:
        yield asked


def spawn(sim, urdf, **fields):
    request = SpawnEntity.Request()
    request.initial_pose.pose.position.z = 0.01
    sim.do(SpawnEntity, resource_string=urdf, initial_pose=request.initial_pose, **fields)


def newest(sim, message_type, topic):
    got = []
    subscription = sim.node.create_subscription(message_type, topic, got.append, 10)
    return got, lambda: sim.node.destroy_subscription(subscription)


def test_a_robot_of_new_gazebo_drives_at_once(sim):
    states = plugin('gz-sim-joint-state-publisher-system', 'gz::sim::systems::JointStatePublisher')
    spawn(sim, cart(gz_drive(), states))
    manager = ManagerClient(sim.node, '/controller_manager', timeout=PATIENCE)
    assert manager.states() == {'diff_drive': 'active', 'joint_state_publisher': 'active'}
    odometry, end = newest(sim, Odometry, '/odom')
    states, end_too = newest(sim, JointState, '/joint_states')
    commands = sim.node.create_publisher(Twist, '/cmd_vel', 10)
    sim.wait(commands.get_subscription_count)
    twist = Twist()
    twist.linear.x = 0.2
    commands.publish(twist)
    sim.wait(lambda: odometry and odometry[-1].pose.pose.position.x > 0.5)
    assert odometry[-1].header.frame_id == 'odom'
    assert odometry[-1].child_frame_id == 'base_link'
    assert odometry[-1].twist.twist.linear.x == pytest.approx(0.2, rel=0.01)
    assert states[-1].name == ['left_joint', 'right_joint']
    end(), end_too()
    sim.do(DeleteEntity, entity='cart')


def test_namespaces_and_remapping_rules_of_classic(sim):
    rules = '<ros><namespace>/r1</namespace><remapping>odom:=wheel/odom</remapping></ros>'
    drive = classic_drive(f'<publish_odom>true</publish_odom>{rules}')
    spawn(sim, cart(drive))
    sim.wait(lambda: sim.node.count_publishers('/r1/wheel/odom'))
    assert sim.node.count_subscribers('/r1/cmd_vel')
    sim.do(DeleteEntity, entity='cart')
    spawn(sim, cart(drive), entity_namespace='r2')
    sim.wait(lambda: sim.node.count_publishers('/r2/wheel/odom'))
    assert sim.node.count_subscribers('/r2/cmd_vel')
    sim.do(DeleteEntity, entity='cart')
