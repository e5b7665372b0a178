# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``~/spawned/NAME``: with what each entity was spawned, for as long as it is in the world."""

from dataclasses import dataclass

from fixtures.sim.driving import AMR
import pytest
import rclpy
from rclpy.node import Node
from simulation_interfaces.msg import SpawnEntity
from support.running_programs import PATIENCE

from amr_description.model.frames import Transform
from amr_description.model.gazebo.translation import translate
from amr_description.model.urdf import parse
from amr_description.ros.messages import transform_of
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import wait_until
from amr_description.sim.ros.spawned_topics import SpawnedTopics
from amr_description.simulation.engine import Spawned

POSE = Transform((1.0, 2.0, 0.5), (0.0, 0.0, 1.0, 0.0))
ROBOT = parse(AMR)


@dataclass
class Entity:
    """What is asked of one of the simulator's."""

    name: str
    origin: Spawned


def spawned(name, namespace='/'):
    return Entity(name, Spawned(name, ROBOT, namespace, POSE, translate(ROBOT), None))


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('sim')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def topics(node):
    return sorted(
        name for name, _ in node.get_topic_names_and_types() if name.startswith('/sim/spawned/')
    )


def test_who_comes_later_is_told_too(node):
    SpawnedTopics(node, lambda: [spawned('robot-1', '/r1')]).update()
    heard = []
    node.create_subscription(SpawnEntity, '/sim/spawned/robot_1', heard.append, LATCHED)
    (message,) = wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert (message.name, message.entity_namespace) == ('robot-1', '/r1')
    assert message.entity_resource.resource_string == AMR
    assert transform_of(message.initial_pose.pose) == POSE
    assert message.initial_pose.header.frame_id == 'world'


def test_each_entity_has_a_topic_of_its_own_which_goes_with_it(node):
    world = [spawned(name) for name in ('a.b', 'a-b', 'a_b', '7', 'a__b')]
    published = SpawnedTopics(node, lambda: world)
    published.update()
    names = {'a_b', 'a_b_2', 'a_b_3', 'a_b_4', '_7'}
    assert {each.rpartition('/')[2] for each in topics(node)} == names
    published.update()
    assert len(topics(node)) == 5
    del world[1:]
    published.update()
    assert topics(node) == ['/sim/spawned/a_b']
    world[0] = spawned('a.b', '/other')  # it was deleted, and spawned again
    heard = []
    published.update()
    node.create_subscription(SpawnEntity, '/sim/spawned/a_b', heard.append, LATCHED)
    assert wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert [each.entity_namespace for each in heard] == ['/other']
