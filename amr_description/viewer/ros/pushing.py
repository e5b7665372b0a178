# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes the robots of a simulator, by the topics of Gazebo's system ApplyLinkWrench."""

from contextlib import suppress

from geometry_msgs.msg import Vector3, Wrench
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from ros_gz_interfaces.msg import Entity, EntityWrench

from amr_description.model.frames import Vector

_DEPTH = 10


class Pushing:
    """
    The publishers of one simulator.

    Made and destroyed on the ROS thread; :meth:`push` is called on the server's thread.
    """

    def __init__(self, node: Node, simulator: str) -> None:
        self._node = node
        topic = f'{simulator}/wrench'
        self._wrench = node.create_publisher(EntityWrench, f'{topic}/persistent', _DEPTH)
        self._clear = node.create_publisher(Entity, f'{topic}/clear', _DEPTH)

    def push(self, entity: str, link: str, force: Vector, torque: Vector) -> None:
        """
        Push a link, N and N m in the axes of the world; without any, let it go.

        To let go is said by a wrench of zeros first. What comes on two topics has no order: a
        simulator that waits for a processor may take the last push after what clears it, and the
        robot would be pushed for ever.
        """
        target = Entity(name=f'{entity}::{link}', type=Entity.LINK)
        wrench = Wrench(force=_vector3(force), torque=_vector3(torque))
        # The ROS thread may have destroyed them in the meantime: the simulator has gone.
        with suppress(InvalidHandle):
            self._wrench.publish(EntityWrench(entity=target, wrench=wrench))
            if not any((*force, *torque)):
                self._clear.publish(target)

    def destroy(self) -> None:
        """Publish no more."""
        self._node.destroy_publisher(self._wrench)
        self._node.destroy_publisher(self._clear)


def _vector3(vector: Vector) -> Vector3:
    x, y, z = vector
    return Vector3(x=x, y=y, z=z)
