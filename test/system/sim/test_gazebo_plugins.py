# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot for Gazebo, without ros2_control, in a running simulator: by its own topics."""

import math

from fixtures.sim.plugin_robot import cart, classic_drive, gz_drive, plugin
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
import pytest
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import DeleteEntity, GetEntities, SpawnEntity
from support.ros_processes import PATIENCE
from support.simulator import simulator

from amr_description.control.ros.client import ManagerClient
from amr_description.model.frames import Transform
from amr_description.testing.simulation import Simulation


def test_it_goes_as_far_as_it_is_told():
    drive = classic_drive('<publish_odom>true</publish_odom>')
    with Simulation(cart(drive), pose=Transform((0.0, 0.0, 0.001))) as simulation:
        simulation.drive(0.25, 0.0, seconds=2.0)
        assert simulation.truth.x == pytest.approx(0.5, rel=0.02)
        simulation.drive(0.0, math.pi / 4.0, seconds=1.0)
        assert simulation.truth.yaw == pytest.approx(math.pi / 4.0, rel=0.02)
        odometry = simulation.odometry
        assert (odometry.x, odometry.yaw) == pytest.approx((0.5, math.pi / 4.0), rel=0.03)
        assert simulation.joints['left_joint'].position > 0.0


@pytest.fixture(scope='module')
def simulation_process():
    with simulator('real_time_factor:=5.0') as asked:
        yield asked


@pytest.fixture
def sim(simulation_process):
    """A simulator, without robots before and after."""
    yield simulation_process
    for name in simulation_process.do(GetEntities).entities:
        simulation_process.do(DeleteEntity, entity=name)


def spawn(sim, urdf, **fields):
    request = SpawnEntity.Request()
    request.initial_pose.pose.position.z = 0.01
    request.initial_pose.pose.position.x = 0.0 if 'name' not in fields else 3.0
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

    def has_gone():
        commands.publish(twist)  # the simulator may not know the publisher yet
        return states and odometry and odometry[-1].pose.pose.position.x > 0.5

    sim.wait(has_gone)
    assert odometry[-1].header.frame_id == 'odom'
    assert odometry[-1].child_frame_id == 'base_link'
    assert odometry[-1].twist.twist.linear.x == pytest.approx(0.2, rel=0.01)
    assert states[-1].name == ['left_joint', 'right_joint']
    end(), end_too()


def test_namespaces_and_remapping_rules_of_classic(sim):
    rules = '<ros><namespace>/r1</namespace><remapping>odom:=wheel/odom</remapping></ros>'
    drive = classic_drive(f'<publish_odom>true</publish_odom>{rules}')
    spawn(sim, cart(drive))
    sim.wait(lambda: sim.node.count_publishers('/r1/wheel/odom'))
    sim.wait(lambda: sim.node.count_subscribers('/r1/cmd_vel'))
    spawn(sim, cart(drive), name='second', entity_namespace='r2')
    sim.wait(lambda: sim.node.count_publishers('/r2/wheel/odom'))
    sim.wait(lambda: sim.node.count_subscribers('/r2/cmd_vel'))
