# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Robots of a world that nobody describes are described by the viewer, until somebody does."""

from fixtures.sim.driving import AMR
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from support.running_programs import PATIENCE as WAIT

from amr_description.nodes.viewer import _publish_description
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import wait_until
from amr_description.viewer.entities import SpawnedEntity
from amr_description.viewer.graph import discover
from amr_description.viewer.ros.graph_monitor import names_in_graph
from amr_description.viewer.ros.spawned_robots import PATIENCE, SpawnedRobots
from amr_description.viewer.ros.world_change import residents_of

WORLD = [SpawnedEntity('amr', '/', AMR), SpawnedEntity('two', '/robot2', AMR)]


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('test_spawned_robots')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def spawned():
    executor = SingleThreadedExecutor()
    errors = []
    robots = SpawnedRobots(executor, _publish_description, errors.append)
    yield robots
    robots.retain(())
    executor.shutdown()
    assert errors == []


def described(node):
    return {each.id for each in discover(names_in_graph(node)).robots}


def look(node, spawned, now, expected):
    """Have it look at the graph, which is waited for."""
    robots = discover(names_in_graph(node)).robots
    spawned.look(WORLD, robots, now)
    assert wait_until(node, lambda: described(node) == expected or None, timeout=WAIT), described(
        node
    )


@pytest.mark.parametrize('namespace', ['/', '/robot2'])
def test_a_robot_is_described_after_a_while_unless_somebody_does(node, spawned, namespace):
    other = node.create_publisher(String, f'{namespace.rstrip("/")}/robot_description', LATCHED)
    look(node, spawned, 10.0, {namespace})
    look(node, spawned, 10.0 + 0.9 * PATIENCE, {namespace})
    look(node, spawned, 10.0 + PATIENCE, {'/', '/robot2'})
    node.destroy_publisher(other)  # who has described the other one ends
    look(node, spawned, 20.0, {'/', '/robot2'} - {namespace})
    look(node, spawned, 20.0 + PATIENCE, {'/', '/robot2'})
    texts = []
    topic = f'{namespace.rstrip("/")}/robot_description'
    node.create_subscription(String, topic, lambda message: texts.append(message.data), LATCHED)
    assert wait_until(node, lambda: texts or None, timeout=WAIT) == [AMR]


def test_who_describes_a_robot_himself_is_given_way(node, spawned):
    look(node, spawned, 10.0, set())
    look(node, spawned, 10.0 + PATIENCE, {'/', '/robot2'})
    other = node.create_publisher(String, '/robot2/robot_description', LATCHED)
    found = wait_until(
        node, lambda: node.count_publishers('/robot2/robot_description') == 2 or None, timeout=WAIT
    )
    assert found
    look(node, spawned, 20.0, {'/', '/robot2'})
    found = wait_until(
        node, lambda: node.count_publishers('/robot2/robot_description') == 1 or None, timeout=WAIT
    )
    assert found
    node.destroy_publisher(other)


def test_what_has_just_come_keeps_its_controllers_in_another_world():
    """The graph does not say yet which robot it is: the manager is known by its namespace."""
    found = residents_of('/mujoco_sim', WORLD, (), {})
    assert [(each.entity, each.manager) for each in found] == [
        ('amr', '/controller_manager'),
        ('two', '/robot2/controller_manager'),
    ]
    crate = SpawnedEntity('crate', '/', '<robot name="crate"><link name="box"/></robot>')
    broken = SpawnedEntity('other', '/', '<sdf')
    assert [each.manager for each in residents_of('/mujoco_sim', [crate, broken], (), {})] == [
        None,
        None,
    ]
