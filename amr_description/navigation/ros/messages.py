# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Grids and poses in the plane ↔ ``nav_msgs`` and ``geometry_msgs``."""

import math

from geometry_msgs.msg import Pose as PoseMessage, Quaternion, TransformStamped
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage
import numpy as np

from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.pose import Pose
from amr_description.model.frames import quaternion_from_yaw, yaw_of

_FINEST = 1e-3
"""m; cells that are smaller are a mistake, and would take all memory along a ray."""

_FARTHEST = 1e9
"""m; what is farther away is a mistake, and too far for numbers of messages and simulators."""


def pose_message(pose: Pose) -> PoseMessage:
    """Return a pose in the plane as a message, at z = 0."""
    message = PoseMessage()
    message.position.x, message.position.y = pose.x, pose.y
    x, y, z, w = quaternion_from_yaw(pose.yaw)
    message.orientation = Quaternion(x=x, y=y, z=z, w=w)
    return message


def is_place(message: PoseMessage) -> bool:
    """Return whether a pose is somewhere on a map: neither NaN nor beyond all maps."""
    place = message.position
    return all(abs(each) < _FARTHEST for each in (place.x, place.y, place.z))


def is_on_map(pose: Pose) -> bool:
    """Return whether a pose in the frame of a map is so; those of TF may be anywhere."""
    return abs(pose.x) < _FARTHEST and abs(pose.y) < _FARTHEST and math.isfinite(pose.yaw)


def pose_of(message: PoseMessage) -> Pose:
    """Return a message's pose seen from above: what lies out of the plane is dropped."""
    turn = message.orientation
    yaw = yaw_of((turn.x, turn.y, turn.z, turn.w))
    return Pose(message.position.x, message.position.y, yaw)


def plane_pose(transform: TransformStamped) -> Pose:
    """Return a transform seen from above."""
    translation, rotation = transform.transform.translation, transform.transform.rotation
    yaw = yaw_of((rotation.x, rotation.y, rotation.z, rotation.w))
    return Pose(translation.x, translation.y, yaw)


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
        ValueError: it is no map; the text says why, as ``3 x 2 cells of 0 m``.
    """
    info = message.info
    origin = pose_of(info.origin)
    what = f'{info.width} x {info.height} cells of {info.resolution:g} m'
    if not (info.width and info.height and _FINEST <= info.resolution < math.inf):
        raise ValueError(what)
    if not all(map(math.isfinite, origin)):
        raise ValueError(f'{what} that begin at {tuple(origin)}')
    if len(message.data) != info.width * info.height:
        raise ValueError(f'{what}, of which {len(message.data)} have come')
    cells = np.array(message.data, dtype=np.int8).reshape(info.height, info.width)
    return OccupancyGrid(cells, info.resolution, origin)
