# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf2_sensor_msgs`` in Python: point clouds from frame to frame.

Importing it registers PointCloud2 for ``Buffer.transform``. Names, arguments and results are those
of Jazzy; of a cloud with normals these are turned, too.
"""

from geometry_msgs.msg import Transform as TransformMessage, TransformStamped
import numpy as np
from sensor_msgs.msg import PointCloud2

from amr_description.model.frames import matrix_from_quaternion
from amr_description.sensor_msgs_py.point_cloud2 import create_cloud, read_points
from amr_description.tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration
from amr_description.tf2_ros.geometry import from_msg_msg, to_msg_msg, unit

__all__ = ['do_transform_cloud', 'from_msg_msg', 'to_msg_msg', 'transform_points']

_POINT = ('x', 'y', 'z')
_NORMAL = ('normal_x', 'normal_y', 'normal_z')


def transform_points(point_cloud: np.ndarray, transform: TransformMessage) -> np.ndarray:
    """
    Return points in the target frame of a transform.

    Args:
        point_cloud: n × 3, m.
        transform: without a header.
    """
    translation = transform.translation
    offset = np.array([translation.x, translation.y, translation.z])
    return np.asarray(point_cloud @ _rotation_of(transform).T + offset)


def do_transform_cloud(cloud: PointCloud2, transform: TransformStamped) -> PointCloud2:
    """Return a cloud in the frame of a transform, with all its fields."""
    points = read_points(cloud).copy()
    _replace(points, _POINT, transform_points(_columns(points, _POINT), transform.transform))
    if all(name in (points.dtype.names or ()) for name in _NORMAL):
        turned = _columns(points, _NORMAL) @ _rotation_of(transform.transform).T
        _replace(points, _NORMAL, turned)
    result = create_cloud(transform.header, cloud.fields, points, cloud.point_step)
    result.height, result.width = cloud.height, cloud.width
    result.row_step = cloud.width * cloud.point_step
    result.is_dense = cloud.is_dense
    return result


def _rotation_of(transform: TransformMessage) -> np.ndarray:
    rotation = transform.rotation
    return np.array(
        matrix_from_quaternion(unit((rotation.x, rotation.y, rotation.z, rotation.w))), dtype=float
    )


def _columns(points: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    return np.stack([points[name] for name in names], axis=-1).astype(float)


def _replace(points: np.ndarray, names: tuple[str, ...], values: np.ndarray) -> None:
    for column, name in enumerate(names):
        points[name] = values[..., column]


ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
TransformRegistration().add(PointCloud2, do_transform_cloud)
