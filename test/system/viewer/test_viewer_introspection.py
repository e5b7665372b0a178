# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What joints are commanded, as a controller manager's introspection topics have it."""

import math

from pal_statistics_msgs.msg import StatisticsNames, StatisticsValues
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from support.running_programs import PATIENCE

from amr_description.ros.service_calls import wait_until
from amr_description.viewer.ros.robot_topics import CommandedVelocities

PLACE = '/controller_manager/introspection_data'
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Manager(Node):
    """The introspection of a controller manager, and nothing else of it."""

    def __init__(self):
        super().__init__('manager')
        self.names = self.create_publisher(StatisticsNames, f'{PLACE}/names', LATCHED)
        self.values = self.create_publisher(StatisticsValues, f'{PLACE}/values', 10)

    def name(self, version, *names):
        self.names.publish(StatisticsNames(names=names, names_version=version))

    def heard(self, commanded, version, *values):
        """Publish these values until they are taken; return what was made of them."""

        def look():
            self.values.publish(StatisticsValues(values=values, names_version=version))
            return commanded.take()

        return wait_until(self, look, every=60.0, timeout=PATIENCE)


@pytest.fixture
def manager():
    rclpy.init(args=[])
    manager = Manager()
    yield manager
    manager.destroy_node()
    rclpy.try_shutdown()


def test_a_joint_is_commanded_by_its_interface(manager):
    manager.name(
        1,
        'state_interface.a/velocity',
        'command_interface.b/velocity',
        'command_interface.a/velocity',
        'command_interface.c/position',
    )
    commanded = CommandedVelocities(manager, PLACE, ('a', 'b', 'c'))
    first, second, third = manager.heard(commanded, 1, 9.0, 2.0, 1.0, 3.0)
    assert (first, second) == (1.0, 2.0)
    assert math.isnan(third)
    commanded.destroy()


def test_values_are_of_the_names_of_their_version(manager):
    manager.name(1, 'command_interface.a/velocity', 'command_interface.b/velocity')
    commanded = CommandedVelocities(manager, PLACE, ('a', 'b'))
    assert manager.heard(commanded, 1, 1.0, 2.0) == (1.0, 2.0)
    manager.values.publish(StatisticsValues(values=[5.0, 6.0], names_version=2))
    manager.name(2, 'command_interface.b/velocity', 'command_interface.a/velocity')
    while (heard := manager.heard(commanded, 2, 2.0, 1.0)) != (1.0, 2.0):
        assert heard == (6.0, 5.0)  # never (5, 6), by the names of before
    commanded.destroy()


def test_fewer_values_than_names_are_no_commands(manager):
    manager.name(1, 'command_interface.a/velocity', 'command_interface.b/velocity')
    commanded = CommandedVelocities(manager, PLACE, ('a', 'b'))
    first, second = manager.heard(commanded, 1, 1.0)
    assert first == 1.0
    assert math.isnan(second)
    commanded.destroy()
