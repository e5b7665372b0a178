# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes to a simulator: what its topics get, and one that comes after it has gone."""

from geometry_msgs.msg import Wrench
import pytest
import rclpy
from rclpy.node import Node
from ros_gz_interfaces.msg import Entity, EntityWrench
from support.running_programs import PATIENCE

from amr_description.ros.service_calls import wait_until
from amr_description.viewer.ros.pushing import Pushing

NONE = (0.0, 0.0, 0.0)


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('viewer')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def test_a_link_is_pushed_and_let_go_until_the_simulator_has_gone(node):
    pushes, cleared = [], []
    node.create_subscription(EntityWrench, '/sim/wrench/persistent', pushes.append, 10)
    node.create_subscription(Entity, '/sim/wrench/clear', cleared.append, 10)
    pushing = Pushing(node, '/sim')

    def has_subscribers(*counts):
        def are_equal():
            return (len(pushes), len(cleared)) == counts or None

        return wait_until(node, are_equal, timeout=PATIENCE)

    pushing.push('amr', 'base_link', (1.0, 0.0, 0.0), NONE)
    assert has_subscribers(1, 0)
    assert (pushes[0].entity.name, pushes[0].wrench.force.x) == ('amr::base_link', 1.0)
    pushing.push('amr', 'base_link', NONE, NONE)
    assert has_subscribers(2, 1)
    assert cleared[0] == pushes[1].entity == pushes[0].entity
    assert pushes[1].wrench == Wrench()  # it also ends a push that is taken after what clears it
    pushing.destroy()
    for force in ((1.0, 0.0, 0.0), NONE):
        pushing.push('amr', 'base_link', force, NONE)  # the server's thread may come late
