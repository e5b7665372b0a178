# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Grids and poses ↔ ``nav_msgs`` and ``geometry_msgs``."""

from geometry_msgs.msg import Pose as PoseMessage, Quaternion
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage
import numpy as np

from amr_description.model.frames import quaternion_from_yaw, yaw_of
from amr_description.navigation.grid import OccupancyGrid
from amr_description.navigation.pose import Pose


def pose_message(pose: Pose) -> PoseMessage:
    """Return a pose in the plane as a message, at z = 0."""
    message = PoseMessage()
    message.position.x, message.position.y = pose.x, pose.y
    x, y, z, w = quaternion_from_yaw(pose.yaw)
    message.orientation = Quaternion(x=x, y=y, z=z, w=w)
    return message


def pose_of(message: PoseMessage) -> Pose:
    """Return a message's pose seen from above: what lies out of the plane is dropped."""
    turn = message.orientation
    yaw = yaw_of((turn.x, turn.y, turn.z, turn.w))
    return Pose(message.position.x, message.position.y, yaw)


def grid_message(grid: OccupancyGrid, frame_id: str = 'map') -> OccupancyGridMessage:
    """Return a grid as a message, its stamp 0."""
    message = OccupancyGridMessage()
    message.header.frame_id = frame_id
    message.info.resolution = grid.resolution
    message.info.width, message.info.height = grid.width, grid.height
    message.info.origin = pose_message(grid.origin)
    message.data.frombytes(np.ascontiguousarray(grid.cells, dtype=np.int8).tobytes())
    return message


def grid_of(message: OccupancyGridMessage) -> OccupancyGrid:
    """
    Return the grid of a message.

    Raises:
        ValueError: the message has not as many cells as it says.
    """
    shape = (message.info.height, message.info.width)
    cells = np.array(message.data, dtype=np.int8).reshape(shape)
    return OccupancyGrid(cells, message.info.resolution, pose_of(message.info.origin))
