# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf2_geometry_msgs`` in Python: geometry messages from frame to frame.

Importing it registers PointStamped, Vector3Stamped, PoseStamped, PoseWithCovarianceStamped and
PolygonStamped for ``Buffer.transform``. Names, arguments and results are those of Jazzy, without
what needs PyKDL.
"""

from collections.abc import Sequence
from typing import TypeVar

from geometry_msgs.msg import (
    Point32,
    PointStamped,
    Polygon,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)
import numpy as np

from amr_description.model.frames import (
    IDENTITY_QUATERNION,
    matrix_from_quaternion,
    normalize,
    Quaternion,
    rotate,
    Transform,
)
from amr_description.ros.messages import fill_pose, transform_of, transform_of_message
from amr_description.tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration

__all__ = [
    'do_transform_point',
    'do_transform_polygon_stamped',
    'do_transform_pose',
    'do_transform_pose_stamped',
    'do_transform_pose_with_covariance_stamped',
    'do_transform_vector3',
    'from_msg_msg',
    'to_msg_msg',
    'transform_covariance',
]

_Message = TypeVar('_Message')


def to_msg_msg(msg: _Message) -> _Message:
    """Return a message as it is: it is one."""
    return msg


def from_msg_msg(msg: _Message) -> _Message:
    """Return a message as it is."""
    return msg


def _move_of(transform: TransformStamped) -> Transform:
    """Return what a message says, with a rotation of length 1."""
    return _with_unit(transform_of_message(transform.transform))


def _with_unit(transform: Transform) -> Transform:
    return Transform(transform.translation, unit(transform.rotation))


def unit(rotation: Quaternion) -> Quaternion:
    """Return a quaternion of length 1, as one typed by hand may not be; zeros are no rotation."""
    return normalize(rotation) if any(rotation) else IDENTITY_QUATERNION


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """Return a point in the frame of a transform."""
    given = point.point
    result = PointStamped(header=transform.header)
    result.point.x, result.point.y, result.point.z = _move_of(transform).apply(
        (given.x, given.y, given.z)
    )
    return result


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """Return a direction in the frame of a transform: it is turned, and not moved."""
    given = vector3.vector
    result = Vector3Stamped(header=transform.header)
    rotation = _move_of(transform).rotation
    turned = rotate(rotation, (given.x, given.y, given.z))
    result.vector.x, result.vector.y, result.vector.z = turned
    return result


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """Return a pose in the frame of a transform."""
    result = Pose()
    moved = _move_of(transform).compose(_with_unit(transform_of(pose)))
    fill_pose(Transform(moved.translation, _with_positive_w(moved.rotation)), result)
    return result


def _with_positive_w(rotation: Quaternion) -> Quaternion:
    """Return the one of the two quaternions of a rotation that the original returns."""
    first = next((part for part in (rotation[3], *rotation[:3]) if part), 0.0)
    x, y, z, w = rotation
    return (-x, -y, -z, -w) if first < 0.0 else rotation


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """Return a pose with a header in the frame of a transform."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """Return a pose and its covariance in the frame of a transform."""
    result = PoseWithCovarianceStamped(header=transform.header)
    result.pose.pose = do_transform_pose(pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def do_transform_polygon_stamped(
    polygon: PolygonStamped, transform: TransformStamped
) -> PolygonStamped:
    """Return a polygon in the frame of a transform."""
    move = _move_of(transform)
    corners = (move.apply((each.x, each.y, each.z)) for each in polygon.polygon.points)
    points = [Point32(x=x, y=y, z=z) for x, y, z in corners]
    return PolygonStamped(header=transform.header, polygon=Polygon(points=points))


def transform_covariance(cov_in: Sequence[float], transform: TransformStamped) -> np.ndarray:
    """
    Return the covariance of a pose in the frame of a transform: both its parts are turned.

    Args:
        cov_in: 6×6, row by row: x, y, z (m²), then rotations about these axes (rad²).
        transform: only its rotation R counts.

    Returns:
        ``J cov Jᵀ`` with ``J = diag(R, R)``, 36 numbers.
    """
    rotation = np.array(matrix_from_quaternion(_move_of(transform).rotation))
    both = np.kron(np.eye(2), rotation)
    return np.asarray(both @ np.reshape(cov_in, (6, 6)) @ both.T).reshape(36)


def _register() -> None:
    converting, transforming = ConvertRegistration(), TransformRegistration()
    for kind, do_transform in (
        (PointStamped, do_transform_point),
        (Vector3Stamped, do_transform_vector3),
        (PoseStamped, do_transform_pose_stamped),
        (PoseWithCovarianceStamped, do_transform_pose_with_covariance_stamped),
        (PolygonStamped, do_transform_polygon_stamped),
    ):
        transforming.add(kind, do_transform)
        converting.add_to_msg(kind, to_msg_msg)
        converting.add_from_msg(kind, from_msg_msg)


_register()
