# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The sensors of six public descriptions in one simulator: topics, types and frames."""

from fixtures.sim.public_sensors import HUSKY_BRIDGE, ROBOTS
from geometry_msgs.msg import Point, Pose, PoseStamped
import pytest
from rclpy.qos import qos_profile_sensor_data
from simulation_interfaces.srv import DeleteEntity, SpawnEntity
from support.simulator import simulator

from amr_description.ros.message_types import message_type

PACKAGES = {'Contacts': 'ros_gz_interfaces', 'ContactsState': 'gazebo_msgs'}
OUTSIDE = {'/velodyne_points'}
"""Topics that are absolute in their descriptions."""
OF_CONTACT = set(PACKAGES)
"""Messages that come only with a contact, or have the frame of the world."""

pytestmark = pytest.mark.in_order('one simulator, of which a robot is removed at the end')


@pytest.fixture(scope='module')
def sim(tmp_path_factory):
    bridge = tmp_path_factory.mktemp('bridge') / 'bridge.yaml'
    bridge.write_text(HUSKY_BRIDGE)
    with simulator('real_time_factor:=0.0', f'bridge:={bridge}') as asked:
        for number, (name, robot) in enumerate(ROBOTS.items()):
            pose = PoseStamped(pose=Pose(position=Point(x=3.0 * number, z=0.01)))
            fields = {'name': name, 'entity_namespace': name, 'initial_pose': pose}
            asked.do(SpawnEntity, resource_string=robot.urdf(name), **fields)
        yield asked


def full_name(robot, topic):
    return topic if topic in OUTSIDE else f'/{robot}{topic}'


def test_each_topic_that_they_expect_has_its_type_and_its_frame(sim):
    frames, expected, subscriptions = {}, {}, []
    for name, robot in ROBOTS.items():
        for topic, (kind, frame) in robot.topics.items():
            if kind not in OF_CONTACT:
                expected[full_name(name, topic)] = f'{name}/{frame}'
                subscriptions.append(listen(sim, full_name(name, topic), kind, frames))
    sim.wait(lambda: len(frames) == len(expected))
    for each in subscriptions:
        sim.node.destroy_subscription(each)
    assert frames == expected
    types = dict(sim.node.get_topic_names_and_types())
    for name, robot in ROBOTS.items():
        for topic, (kind, _) in robot.topics.items():
            package = PACKAGES.get(kind, 'sensor_msgs')
            assert types[full_name(name, topic)] == [f'{package}/msg/{kind}']


def listen(sim, topic, kind, frames):
    def heard(message):
        frames[topic] = message.header.frame_id

    found = message_type(f'{PACKAGES.get(kind, "sensor_msgs")}/msg/{kind}')
    return sim.node.create_subscription(found, topic, heard, qos_profile_sensor_data)


def test_a_robot_takes_its_topics_away(sim):
    topic = '/waffle/scan'
    sim.wait(lambda: sim.node.count_publishers(topic) == 1)
    sim.do(DeleteEntity, entity='waffle')
    sim.wait(lambda: sim.node.count_publishers(topic) == 0)
