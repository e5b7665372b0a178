# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A node that is removed from a process that goes on leaves nothing in the graph."""

import pytest
import rclpy
from rclpy.node import Node
from support.ros_processes import PATIENCE

from amr_description.ros.runtime import destroy_node
from amr_description.ros.service_calls import wait_until


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('looks_on')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def services(node, of):
    return [n for n, _ in node.get_service_names_and_types() if n.startswith(f'/{of}/')]


def test_no_service_of_it_stays(node):
    for _ in range(2):
        guest = Node('guest', enable_logger_service=True)
        assert wait_until(node, lambda: len(services(node, 'guest')) > 6 or None, timeout=PATIENCE)
        destroy_node(guest)
        assert wait_until(node, lambda: not services(node, 'guest') or None, timeout=PATIENCE)


def test_what_rclpy_leaves_is_why(node):
    """When this fails, rclpy is newer than 7.1.6, and destroy_type_description_service may go."""
    guest = Node('guest')
    guest.destroy_node()
    assert wait_until(
        node,
        lambda: services(node, 'guest') == ['/guest/get_type_description'] or None,
        timeout=PATIENCE,
    )


def test_one_without_the_service_goes_too(node):
    option = rclpy.parameter.Parameter('start_type_description_service', value=False)
    destroy_node(Node('guest', parameter_overrides=[option]))
    assert wait_until(node, lambda: not services(node, 'guest') or None, timeout=PATIENCE)
