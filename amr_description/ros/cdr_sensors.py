# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Serialized messages of sensors, read without making messages of them, as in ``cdr.py``.

Of arrays, they return views of the bytes of the message, without a copy. Little is believed:
arrays that end too early raise ValueError, as do strings that are no UTF-8; what the numbers say
is for the caller to check.
"""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from amr_description.ros.cdr import Reader

_BEGIN = 4
"""Bytes before the first field, from whose end on numbers are aligned."""
_WRENCH = 6
"""float64 of a ``geometry_msgs/msg/Wrench``: force (3, N), torque (3, N·m)."""
_VECTOR = 3
_MOST_CONTACTS = 256
"""Contacts of a message that are read, and points of each."""

Array: TypeAlias = np.ndarray


@dataclass(frozen=True, slots=True)
class Header:
    """``std_msgs/msg/Header``: ns, and the name of a frame."""

    stamp: int
    frame: str


@dataclass(frozen=True, slots=True)
class ScanData:
    """Of a LaserScan: rad, m; ``ranges`` are float32."""

    header: Header
    angle_min: float
    angle_increment: float
    range_min: float
    range_max: float
    ranges: Array


@dataclass(frozen=True, slots=True)
class CloudField:
    """``sensor_msgs/msg/PointField``."""

    name: str
    offset: int
    datatype: int
    count: int


@dataclass(frozen=True, slots=True)
class CloudData:
    """Of a PointCloud2; ``data`` are bytes."""

    header: Header
    height: int
    width: int
    fields: tuple[CloudField, ...]
    is_bigendian: bool
    point_step: int
    row_step: int
    data: Array


@dataclass(frozen=True, slots=True)
class ImageData:
    """Of an Image; ``data`` are bytes, ``step`` of them a row."""

    header: Header
    height: int
    width: int
    encoding: str
    is_bigendian: bool
    step: int
    data: Array


@dataclass(frozen=True, slots=True)
class CompressedData:
    """Of a CompressedImage; ``data`` are bytes."""

    header: Header
    format: str
    data: Array


@dataclass(frozen=True, slots=True)
class RangeData:
    """Of a Range: rad, m."""

    header: Header
    field_of_view: float
    min_range: float
    max_range: float
    range: float


@dataclass(frozen=True, slots=True)
class ContactData:
    """
    Two bodies that touch.

    Attributes:
        first: Name of a collision.
        second: Of the other one.
        points: Where they touch, m; shape (n, 3).
        normals: Of the same shape; NaN where the message has none.
        force: That on the first one, N, of all points together; NaN: the message does not say it.
    """

    first: str
    second: str
    points: Array
    normals: Array
    force: float


@dataclass(frozen=True, slots=True)
class ContactsData:
    """Of a Contacts or a ContactsState."""

    header: Header
    contacts: tuple[ContactData, ...]


class SensorReader(Reader):
    """Reads arrays, too."""

    def header(self) -> Header:
        """Read a ``std_msgs/msg/Header``."""
        return Header(self.stamp(), self.text())

    def octet(self) -> int:
        """Read a uint8, or a bool."""
        return self.octets(1)[0]

    def number(self) -> float:
        """Read a float32."""
        return float(self.array('f4', 1)[0])

    def array(self, kind: str, count: int) -> Array:
        """Read so many numbers of a NumPy type of up to 8 bytes; a view of the message."""
        dtype = np.dtype(f'{self._order}{kind}')
        size = dtype.itemsize
        at = (self.at - _BEGIN + size - 1) // size * size + _BEGIN
        self.at = at + count * size
        if self.at > len(self._data):
            raise ValueError(f'{len(self._data)} bytes end within {count} numbers')
        return np.frombuffer(self._data, dtype, count, at)

    def sequence(self, kind: str) -> Array:
        """Read a sequence of numbers; a view of the message."""
        count = self.count()
        return self.array(kind, count) if count else np.empty(0, kind)


def read_scan(data: bytes) -> ScanData:
    """``sensor_msgs/msg/LaserScan``."""
    reader = SensorReader(data)
    header = reader.header()
    angle_min, _, increment, _, _, least, most = map(float, reader.array('f4', 7))
    return ScanData(header, angle_min, increment, least, most, reader.sequence('f4'))


def read_cloud(data: bytes) -> CloudData:
    """``sensor_msgs/msg/PointCloud2``."""
    reader = SensorReader(data)
    header, height, width = reader.header(), reader.count(), reader.count()
    fields = tuple(
        CloudField(reader.text(), reader.count(), reader.octet(), reader.count())
        for _ in range(reader.count())
    )
    is_bigendian, point_step, row_step = bool(reader.octet()), reader.count(), reader.count()
    octets = reader.sequence('u1')
    return CloudData(header, height, width, fields, is_bigendian, point_step, row_step, octets)


def read_image(data: bytes) -> ImageData:
    """``sensor_msgs/msg/Image``."""
    reader = SensorReader(data)
    header, height, width = reader.header(), reader.count(), reader.count()
    encoding, is_bigendian, step = reader.text(), bool(reader.octet()), reader.count()
    octets = reader.sequence('u1')
    return ImageData(header, height, width, encoding, is_bigendian, step, octets)


def read_compressed_image(data: bytes) -> CompressedData:
    """``sensor_msgs/msg/CompressedImage``."""
    reader = SensorReader(data)
    return CompressedData(reader.header(), reader.text(), reader.sequence('u1'))


def read_range(data: bytes) -> RangeData:
    """``sensor_msgs/msg/Range``."""
    reader = SensorReader(data)
    header = reader.header()
    reader.octet()  # ultrasound or infrared
    return RangeData(header, *map(float, reader.array('f4', 4)))


def read_contacts(data: bytes) -> ContactsData:
    """``ros_gz_interfaces/msg/Contacts``; its points are in the frame ``world``."""
    reader = SensorReader(data)
    header = reader.header()
    return ContactsData(header, tuple(_gz_contact(reader) for _ in _some(reader)))


def read_contacts_state(data: bytes) -> ContactsData:
    """``gazebo_msgs/msg/ContactsState``."""
    reader = SensorReader(data)
    header = reader.header()
    return ContactsData(header, tuple(_classic_contact(reader) for _ in _some(reader)))


def _some(reader: SensorReader) -> range:
    return range(min(reader.count(), _MOST_CONTACTS))


def _gz_contact(reader: SensorReader) -> ContactData:
    first, second = _entity(reader), _entity(reader)
    points, normals = _vectors(reader), _vectors(reader)
    reader.sequence('f8')  # depths
    forces = np.zeros(_VECTOR)
    count = reader.count()
    for _ in range(count):
        reader.header()
        for _ in range(2):
            reader.text()
            reader.count()  # id
        forces += reader.array('f8', _WRENCH)[:_VECTOR]
        reader.array('f8', _WRENCH)
    force = float(np.linalg.norm(forces)) if count else float('nan')
    return ContactData(first, second, points, _as_many(normals, points), force)


def _entity(reader: SensorReader) -> str:
    reader.array('u8', 1)  # id
    name = reader.text()
    reader.octet()  # type
    return name


def _classic_contact(reader: SensorReader) -> ContactData:
    reader.text()  # info
    first, second = reader.text(), reader.text()
    count = reader.count()
    if count:
        reader.array('f8', _WRENCH * count)
    force = float(np.linalg.norm(reader.array('f8', _WRENCH)[:_VECTOR]))
    points, normals = _vectors(reader), _vectors(reader)
    reader.sequence('f8')  # depths
    return ContactData(first, second, points, _as_many(normals, points), force)


def _vectors(reader: SensorReader) -> Array:
    count = reader.count()
    if not count:
        return np.empty((0, _VECTOR))
    return reader.array('f8', _VECTOR * count).reshape(-1, _VECTOR)


def _as_many(normals: Array, points: Array) -> Array:
    return normals if len(normals) == len(points) else np.full_like(points, np.nan, dtype='f8')
