# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``sensor_msgs/msg/PointCloud2`` from and to NumPy arrays and lists of points.

Names, arguments and results are those of sensor_msgs_py of Jazzy. What cannot be done is an
AssertionError, as there. Other than there, a cloud of the other byte order is not changed by being
read, and rows may be longer than their points (``row_step``).
"""

import array
from collections import namedtuple
from collections.abc import Iterable
import sys
from typing import Any

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

from amr_description.errors import PointCloudError
from amr_description.sensor_msgs_py.numpy_compat import (
    structured_to_unstructured,
    unstructured_to_structured,
)

DUMMY_FIELD_PREFIX = 'unnamed_field'

_DATATYPES: dict[int, np.dtype[Any]] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
}


def read_points(
    cloud: PointCloud2,
    field_names: Iterable[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """
    Read points as a structured array.

    Args:
        cloud: the message.
        field_names: of the fields to read; None: all.
        skip_nans: whether to leave out points with a NaN in one of these fields; a cloud that
            ``is_dense`` has none.
        uvs: indices of the points to read, of those that are left; None: all.
        reshape_organized_cloud: whether to return an array of (width, height) points if the cloud
            has more than one row.

    Returns:
        An array of points, with a field for each name.

    Raises:
        PointCloudError: it is no such message, or a field is not there.
    """
    points = _points_of(cloud)
    if field_names is not None:
        names = list(field_names)
        _require_known(names, points.dtype.names or ())
        points = points[names]
    if (sys.byteorder != 'little') != bool(cloud.is_bigendian):
        points = points.byteswap()
    if skip_nans and not cloud.is_dense:
        is_nan = [np.isnan(points[name]) for name in points.dtype.names or ()]
        points = points[~np.logical_or.reduce(is_nan)]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def read_points_numpy(
    cloud: PointCloud2,
    field_names: Iterable[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """
    Read points as a plain array, with a column for each field: of fields that have one type.

    Args and Raises: as for :func:`read_points`.
    """
    names = None if field_names is None else list(field_names)
    wanted = [field for field in cloud.fields if names is None or field.name in names]
    if len({field.datatype for field in wanted}) > 1:
        kinds = ', '.join(f'{f.name}: {_DATATYPES[f.datatype].name}' for f in wanted)
        raise PointCloudError(f'fields of several types ({kinds}); use read_points for those')
    points = read_points(cloud, names, skip_nans, uvs, reshape_organized_cloud)
    return structured_to_unstructured(points)


def read_points_list(
    cloud: PointCloud2,
    field_names: Iterable[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
) -> list[Any]:
    """
    Read points as a list of named tuples; slow.

    Args and Raises: as for :func:`read_points`.
    """
    names = None if field_names is None else list(field_names)
    points = read_points(cloud, names, skip_nans, uvs)
    point = namedtuple('Point', points.dtype.names or ())  # type: ignore[misc]
    return [point(*values) for values in points]


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype:
    """
    Return the type of a point in a structured array.

    A field without a name is called ``unnamed_field_<its index>``; one with a ``count`` above 1
    becomes that many, ``<name>_0``, ``<name>_1`` and so on.

    Args:
        fields: of the cloud.
        point_step: size of a point, bytes; None: up to the end of its last field.

    Raises:
        PointCloudError: two fields have one name, or one has a count of 0.
    """
    names: list[str] = []
    offsets: list[int] = []
    formats: list[str] = []
    for index, field in enumerate(fields):
        datatype = _DATATYPES[field.datatype]
        name = field.name or f'{DUMMY_FIELD_PREFIX}_{index}'
        if field.count < 1:
            raise PointCloudError(f'field {name!r} has a count of {field.count}: 1 at least')
        parts = [name] if field.count == 1 else [f'{name}_{i}' for i in range(field.count)]
        for number, part in enumerate(parts):
            if part in names:
                raise PointCloudError(f'field {part!r} is there twice: names must differ')
            names.append(part)
            offsets.append(field.offset + number * datatype.itemsize)
            formats.append(datatype.str)
    layout: dict[str, Any] = {'names': names, 'formats': formats, 'offsets': offsets}
    if point_step is not None:
        layout['itemsize'] = point_step
    return np.dtype(layout)  # type: ignore[call-overload]


def create_cloud(
    header: Header,
    fields: Iterable[PointField],
    points: Iterable[Any],
    point_step: int | None = None,
) -> PointCloud2:
    """
    Create a cloud.

    Args:
        header: of the cloud.
        fields: of a point.
        points: a structured array of just these fields; an array with a column for each field, of
            one type all; or any points with a value for each field. Of arrays, one dimension more
            makes an organized cloud, of (width, height) points.
        point_step: size of a point, bytes; None: up to the end of its last field.

    Raises:
        PointCloudError: points and fields do not fit together.
    """
    fields = list(fields)
    layout = dtype_from_fields(fields, point_step)
    values = _structured(points, layout)
    if values.ndim > 2:
        raise PointCloudError(f'points of {values.ndim} dimensions: a cloud has one or two')
    width, height = values.shape if values.ndim == 2 else (values.shape[0], 1)
    cloud = PointCloud2(
        header=header,
        height=height,
        width=width,
        is_dense=False,
        is_bigendian=sys.byteorder != 'little',
        fields=fields,
        point_step=layout.itemsize,
        row_step=layout.itemsize * width,
    )
    # Not as an argument: that would check the bytes one by one.
    cloud.data = array.array('B', values.tobytes())
    return cloud


def create_cloud_xyz32(header: Header, points: Iterable[Any]) -> PointCloud2:
    """Create a cloud of points (x, y, z) in 32 bits each; arguments as for `create_cloud`."""
    fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate('xyz')
    ]
    return create_cloud(header, fields, points)


def _points_of(cloud: PointCloud2) -> np.ndarray:
    """Return all points of a cloud, a view of its data where rows follow upon each other."""
    if not isinstance(cloud, PointCloud2):
        raise PointCloudError(f'got a {type(cloud).__name__}, not a sensor_msgs.msg.PointCloud2')
    layout = dtype_from_fields(cloud.fields, cloud.point_step)
    row = cloud.width * cloud.point_step
    needed, there = cloud.height * row, len(cloud.data)
    if there < needed:
        raise PointCloudError(
            f'{cloud.width} x {cloud.height} points of {cloud.point_step} bytes are {needed}, and '
            f'the data has {there}'
        )
    if cloud.height < 2 or cloud.row_step <= row or there < needed + cloud.row_step - row:
        return np.ndarray((cloud.width * cloud.height,), layout, cloud.data)
    strides = (cloud.row_step, cloud.point_step)
    return np.ndarray((cloud.height, cloud.width), layout, cloud.data, strides=strides).reshape(-1)


def _require_known(names: Iterable[str], known: Iterable[str]) -> None:
    for name in names:
        if name not in known:
            raise PointCloudError(f'the cloud has no field {name!r}; it has {", ".join(known)}')


def _structured(points: Iterable[Any], layout: np.dtype) -> np.ndarray:
    """Return points as an array of the type ``layout``."""
    if not isinstance(points, np.ndarray):
        return np.array([tuple(point) for point in points], dtype=layout)
    if points.dtype.names is not None:
        if points.dtype != layout:
            raise PointCloudError(f'points are {points.dtype}, and the fields say {layout}')
        return points
    kinds = {layout[name].name for name in layout.names or ()}
    if len(kinds) > 1:
        raise PointCloudError(
            f'a plain array for fields of several types ({", ".join(sorted(kinds))}); give a '
            'structured one (dtype_from_fields)'
        )
    return unstructured_to_structured(points, dtype=layout)
