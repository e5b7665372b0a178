# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Point clouds, thinned to what a page draws: positions, and a colour or an intensity for each.

The layout is that of ``sensor_msgs/msg/PointCloud2``: records of ``point_step`` bytes, with named
fields. A cloud whose fields or sizes do not fit its bytes is a ViewerError.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias

import numpy as np

from amr_description.errors import ViewerError
from amr_description.viewer.samples import MOST_POINTS

_KINDS = {1: 'i1', 2: 'u1', 3: 'i2', 4: 'u2', 5: 'i4', 6: 'u4', 7: 'f4', 8: 'f8'}
"""``PointField.datatype`` -> type of NumPy."""
_PACKED = {'rgb', 'rgba'}
"""Fields of 4 bytes: blue, green, red, alpha in the order of a little-endian number."""
_INTENSITIES = ('intensity', 'intensities', 'reflectivity', 'i')

Colouring: TypeAlias = Literal['rgb', 'intensity', 'none']


class PointField(Protocol):
    """A field of the points."""

    @property
    def name(self) -> str: ...
    @property
    def offset(self) -> int: ...
    @property
    def datatype(self) -> int: ...


@dataclass(frozen=True, slots=True)
class ThinCloud:
    """
    Some points of a cloud, those with finite coordinates.

    Attributes:
        points: m, in the frame of the message; float32 of the shape (n, 3).
        colouring: What ``colours`` are.
        colours: uint8 of the shape (n, 3), red, green, blue; float32 of the shape (n); or empty.
        low: The least intensity; None: there is none.
        high: The greatest.
        count: Points of the whole cloud, with those that have no coordinates.
    """

    points: np.ndarray
    colouring: Colouring
    colours: np.ndarray
    low: float | None
    high: float | None
    count: int


def thinned(
    count: int,
    step: int,
    fields: Iterable[PointField],
    data: np.ndarray,
    *,
    is_bigendian: bool = False,
    most: int = MOST_POINTS,
) -> ThinCloud:
    """
    Return at most ``most`` points of a cloud, evenly taken from its order.

    Args:
        count: Points.
        step: Bytes of a point.
        fields: Those of a point.
        data: The bytes.
        is_bigendian: Of its numbers.
        most: Points.

    Raises:
        ViewerError: The cloud has no x, y, z, or does not fit its bytes.
    """
    if step <= 0 or count * step > len(data):
        raise ViewerError(
            f'a cloud of {count} points of {step} bytes does not fit its {len(data)} bytes'
        )
    known = {field.name: field for field in fields}
    if not known.keys() >= {'x', 'y', 'z'}:
        raise ViewerError(f'a cloud has no x, y, z; its fields: {", ".join(known) or "none"}')
    thin = max(1, -(-count // most))
    records = data[: count * step].reshape(count, step)[::thin]
    order = '>' if is_bigendian else '<'

    def values(name: str) -> np.ndarray:
        return _column(records, known[name], order)

    with np.errstate(over='ignore', invalid='ignore'):
        points = np.stack([values(axis).astype('<f4') for axis in 'xyz'], axis=1)
    is_finite = np.isfinite(points).all(axis=1)
    points = points[is_finite]
    packed = next((name for name in known if name in _PACKED), None)
    if packed is not None:
        colours = _rgb(records, known[packed], is_bigendian=is_bigendian)[is_finite]
        return ThinCloud(points, 'rgb', colours, None, None, count)
    intensity = next((name for name in _INTENSITIES if name in known), None)
    if intensity is None:
        return ThinCloud(points, 'none', np.empty(0, '<f4'), None, None, count)
    with np.errstate(over='ignore', invalid='ignore'):
        colours = np.nan_to_num(values(intensity)[is_finite].astype('<f4'))
    low, high = (float(colours.min()), float(colours.max())) if len(colours) else (None, None)
    if low == high:  # it says nothing: the height of the points says more
        return ThinCloud(points, 'none', np.empty(0, '<f4'), None, None, count)
    return ThinCloud(points, 'intensity', colours, low, high, count)


def _column(records: np.ndarray, field: PointField, order: str) -> np.ndarray:
    """Return the numbers of a field, one a point."""
    kind = _KINDS.get(field.datatype)
    if kind is None:
        raise ViewerError(f'field {field.name!a} of a cloud is of no known type: {field.datatype}')
    dtype = np.dtype(f'{order}{kind}')
    return _octets(records, field, dtype.itemsize).view(dtype)[:, 0]


def _rgb(records: np.ndarray, field: PointField, *, is_bigendian: bool) -> np.ndarray:
    octets = _octets(records, field, 4)
    return octets[:, 1:4] if is_bigendian else octets[:, 2::-1]


def _octets(records: np.ndarray, field: PointField, size: int) -> np.ndarray:
    if field.offset + size > records.shape[1]:
        raise ViewerError(
            f'field {field.name!a} of a cloud, at byte {field.offset}, is outside its points of '
            f'{records.shape[1]} bytes'
        )
    return np.ascontiguousarray(records[:, field.offset : field.offset + size])
