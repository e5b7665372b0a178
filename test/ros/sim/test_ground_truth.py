# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""ground_truth/odom and ground_truth/wheels over DDS, of a world that is stepped by hand."""

from contextlib import contextmanager
import math

from control_msgs.msg import DynamicJointState
from fixtures.sim.driving import AMR
from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.node import Node
from support.running_programs import PATIENCE

from amr_description.clock import NANOSECONDS
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, NodeTopics
from amr_description.model.frames import rotate, Transform
from amr_description.ros.messages import nanoseconds, transform_of
from amr_description.ros.service_calls import wait_until
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.ground_truth import GroundTruth

WEIGHT = 7.0 * 9.81
"""N, of the shipped robot."""
TURN = 10_000_000
"""ns, of the loop."""


class Host:
    """World and topics, as the simulator has them; ``turn`` is its loop."""

    def __init__(self, rate):
        self.node = Node('host')
        self.world = MujocoWorld('empty')
        self.loop_publisher = ClockedLoopPublisher(self.node, look_period=0)
        self.truth = GroundTruth(NodeTopics(self.node, self.loop_publisher), self.world, rate)

    def spawn(self, name, namespace, pose=None, urdf=AMR):
        self.world.spawn(name, urdf, pose or Transform())
        self.truth.add(name, namespace)

    def turn(self, count=1):
        for _ in range(count):
            self.loop_publisher.publish(self.world.time)
            self.world.step(TURN // self.world.timestep)

    @contextmanager
    def heard(self, message_type, topic):
        """The list of messages on a topic, from the time on when the publisher knows of us."""
        messages = []
        before = self.node.count_subscribers(topic)
        subscription = self.node.create_subscription(message_type, topic, messages.append, 1000)
        self.wait(lambda: self.node.count_subscribers(topic) > before)
        self.wait(lambda: subscription.get_publisher_count() == self.node.count_publishers(topic))
        publisher = next(p for p in self.node.publishers if p.topic_name == topic)
        self.wait(lambda: publisher.get_subscription_count() > 0)
        yield messages
        self.node.destroy_subscription(subscription)

    def wait(self, condition):
        assert wait_until(self.node, lambda: condition() or None, timeout=PATIENCE)


@pytest.fixture
def host(request):
    rclpy.init(args=[])
    host = Host(getattr(request, 'param', 50.0))
    yield host
    host.node.destroy_node()
    rclpy.try_shutdown()


def linear(message):
    velocity = message.twist.twist.linear
    return (velocity.x, velocity.y, velocity.z)


def test_the_pose_is_in_the_world_and_the_twist_in_the_robots_own_axes(host):
    place = Transform.from_xyz_rpy((1.5, -2.0, 3.0), (math.pi / 2, 0.0, 0.3))
    host.spawn('amr', 'fleet/one', place)
    with host.heard(Odometry, '/fleet/one/ground_truth/odom') as messages:
        host.turn(41)
        host.wait(lambda: len(messages) == 21)
    first, last = messages[0], messages[-1]
    assert (last.header.frame_id, last.child_frame_id) == ('world', 'fleet/one/base_footprint')
    found = transform_of(first.pose.pose)
    assert found.translation == pytest.approx(place.translation)
    assert found.rotation == pytest.approx(place.rotation)
    # On its side it falls along its own -y.
    assert linear(last) == pytest.approx((0.0, -9.81 * 0.4, 0.0), abs=0.02)
    rotation = transform_of(last.pose.pose).rotation
    assert rotate(rotation, linear(last)) == pytest.approx((0.0, 0.0, -9.81 * 0.4), abs=0.02)
    height = transform_of(last.pose.pose).translation[2]
    assert height == pytest.approx(3.0 - 9.81 * 0.4**2 / 2, abs=0.01)


@pytest.mark.parametrize(
    'host, period', [(20.0, 50), (100.0, 10), (1000.0, 10)], indirect=['host']
)
def test_stamps_are_exact_instants_also_after_time_went_back(host, period):
    host.spawn('amr', '')
    with host.heard(Odometry, '/ground_truth/odom') as messages:
        host.turn(21)
        host.world.reset()
        host.turn(21)
        one = list(range(0, 201, period))
        host.wait(lambda: len(messages) == 2 * len(one))
    milliseconds = [nanoseconds(each.header.stamp) / NANOSECONDS * 1e3 for each in messages]
    assert milliseconds == pytest.approx([*one, *one])


def test_the_base_of_a_robot_that_stands_fixed_is_the_first_child_of_the_world(host):
    urdf = AMR.replace(
        '<link name="base_footprint"/>',
        '<link name="world"/><link name="base_footprint"/><joint name="bolts" type="fixed">'
        '<parent link="world"/><child link="base_footprint"/><origin xyz="0 0 2"/></joint>',
    )
    host.spawn('amr', 'one', Transform((1.0, 0.0, 0.0)), urdf)
    with host.heard(Odometry, '/one/ground_truth/odom') as messages:
        host.turn(41)
        host.wait(lambda: len(messages) == 21)
    (pose,) = {transform_of(each.pose.pose).translation for each in messages}
    assert pose == (1.0, 0.0, 2.0)
    assert messages[-1].child_frame_id == 'one/base_footprint'
    assert linear(messages[-1]) == (0.0, 0.0, 0.0)


def test_while_time_stands_still_the_present_instant_is_published_again(host):
    host.spawn('amr', '')
    host.turn(2)
    host.world.step(1)
    with host.heard(Odometry, '/ground_truth/odom') as messages:
        for _ in range(3):
            host.loop_publisher.publish(host.world.time)
        host.wait(lambda: len(messages) == 3)
    assert {nanoseconds(each.header.stamp) for each in messages} == {22_000_000}


def test_wheels_carry_the_robot(host):
    host.spawn('amr', '/')
    host.world.step(500)
    with host.heard(DynamicJointState, '/ground_truth/wheels') as messages:
        host.turn()
        host.wait(lambda: messages)
    (message,) = messages
    assert sorted(message.joint_names) == [
        f'joint_wheel_{end}_{side}' for end in ('back', 'front') for side in ('left', 'right')
    ]
    names = ['contact', 'normal_force', 'slip_along', 'slip_across']
    wheels = [
        dict(zip(each.interface_names, each.values, strict=True))
        for each in message.interface_values
    ]
    assert all(list(wheel) == names for wheel in wheels)
    assert all(wheel['contact'] == 1.0 for wheel in wheels)
    assert sum(wheel['normal_force'] for wheel in wheels) == pytest.approx(WEIGHT, rel=1e-3)


def test_others_in_a_namespace_have_their_names_and_a_removed_one_leaves_no_topic(host):
    host.spawn('amr', 'one')
    host.spawn('box', 'one', Transform((0.0, 3.0, 0.0)))
    with host.heard(Odometry, '/one/box/ground_truth/odom') as messages:
        host.turn()
        host.wait(lambda: messages)
        assert messages[0].pose.pose.position.y == pytest.approx(3.0)
        host.world.remove('box')
        host.turn(5)  # between the removal and that of its topics
        host.truth.remove('box')
        host.turn(5)
        host.wait(lambda: not host.node.count_publishers('/one/box/ground_truth/odom'))
    host.wait(lambda: host.node.count_publishers('/one/ground_truth/odom') == 1)
    host.world.remove('amr')
    host.truth.remove('amr')
    host.spawn('next', 'one')  # the names are free again
    host.wait(lambda: host.node.count_publishers('/one/ground_truth/odom') == 1)


@pytest.mark.parametrize('host', [0.0], indirect=True)
def test_at_rate_0_there_are_no_topics(host):
    host.spawn('amr', 'one')
    host.turn(5)
    assert host.node.count_publishers('/one/ground_truth/odom') == 0
    host.truth.remove('amr')
