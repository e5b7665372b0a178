# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Serialized messages, read without making messages of them: a row for each type.

A row names the parts that are wanted of a message (:mod:`amr_description.cdr.fields`), and makes
of them what is read. ``ROW.reader()`` is for the messages of one topic, which are mostly alike: it
takes 2 to 10 µs, where rclpy takes 60. What it raises for broken bytes is ValueError.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Generic, TypeAlias, TypeVar

import numpy as np

from amr_description.cdr.fields import FieldReader
from amr_description.clock import NANOSECONDS
from amr_description.ros.layouts import layout_of
from amr_description.ros.message_types import message_type

Read = TypeVar('Read')
Array: TypeAlias = np.ndarray
Motion: TypeAlias = tuple[float, ...]
"""x y z qx qy qz qw of a pose, linear x, angular z, linear y: m, m/s, rad/s, m/s."""

_HEADER = ('header.stamp.sec', 'header.stamp.nanosec', 'header.frame_id')
_POSE = (
    *(f'position.{axis}' for axis in 'xyz'),
    *(f'orientation.{axis}' for axis in 'xyzw'),
)
_PLANAR = ('linear.x', 'angular.z', 'linear.y')


@dataclass(frozen=True, slots=True)
class Row(Generic[Read]):
    """What is read of the messages of a type."""

    type: str
    """``package/msg/Name``."""
    paths: tuple[str, ...]
    make: Callable[..., Read]
    """Called with the values at the paths."""

    def read(self, data: bytes) -> Read:
        """Read a message of any topic. Raises ValueError."""
        values = _reader(self.type, self.paths)(data)
        return self.make(*values)

    def reader(self) -> Callable[[bytes], Read]:
        """Return a function that reads the messages of one topic. It raises ValueError."""
        read, make = _reader.__wrapped__(self.type, self.paths), self.make
        return lambda data: make(*read(data))


@cache
def _reader(name: str, paths: tuple[str, ...]) -> Callable[[bytes], list[Any]]:
    return FieldReader(layout_of(message_type(name)), paths).read


@dataclass(frozen=True, slots=True)
class Header:
    """``std_msgs/msg/Header``: ns, and the name of a frame."""

    stamp: int
    frame: str


@dataclass(frozen=True, slots=True)
class JointValues:
    """Of a JointState; ``positions`` and ``velocities`` may be empty."""

    stamp: int
    """ns."""
    names: list[str]
    positions: list[float]
    velocities: list[float]


@dataclass(frozen=True, slots=True)
class InterfaceValues:
    """Of a DynamicJointState: for each joint, values by interface."""

    names: list[str]
    values: list[dict[str, float]]


@dataclass(frozen=True, slots=True)
class StatisticNames:
    """Of StatisticsNames."""

    names: list[str]
    version: int


@dataclass(frozen=True, slots=True)
class StatisticValues:
    """Of StatisticsValues, in the order of the names of the same version."""

    values: list[float]
    version: int


@dataclass(frozen=True, slots=True)
class FramePose:
    """Of a TFMessage: where a frame is in its parent."""

    name: str
    parent: str
    pose: tuple[float, ...]
    """x y z qx qy qz qw, m."""
    stamp: int = 0
    """ns."""


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
class GridData:
    """Of an OccupancyGrid: ``origin`` is x y z (m) qx qy qz qw; cells row by row."""

    header: Header
    resolution: float
    width: int
    height: int
    origin: tuple[float, ...]
    cells: Array


@dataclass(frozen=True, slots=True)
class PathData:
    """Of a Path: m, float64 of the shape (poses, 3)."""

    header: Header
    """That of the first pose with a frame, if the path has none."""
    points: Array


@dataclass(frozen=True, slots=True)
class MarkerData:
    """
    A Marker; names are the message's.

    Attributes:
        pose: x y z qx qy qz qw, m.
        scale: x y z.
        color: r g b a.
        lifetime: ns, 0: for ever.
        points: float64 of the shape (n, 3).
        colors: float32 of the shape (n, 4).
        mesh: The name, and the bytes, of the file that it has with it.
    """

    header: Header
    ns: str
    id: int
    type: int
    action: int
    pose: tuple[float, ...]
    scale: tuple[float, ...]
    color: tuple[float, ...]
    lifetime: int
    frame_locked: bool
    points: Array
    colors: Array
    text: str
    mesh_resource: str
    mesh: tuple[str, Array]
    mesh_use_embedded_materials: bool


@dataclass(frozen=True, slots=True)
class PosesData:
    """Of a PoseArray: x y z qx qy qz qw of each, m, float64 of the shape (n, 7)."""

    header: Header
    poses: Array


@dataclass(frozen=True, slots=True)
class PointsData:
    """Of a PolygonStamped, or of a PointStamped: m, of the shape (n, 3)."""

    header: Header
    points: Array


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


def _time(seconds: int, nanoseconds: int) -> int:
    return seconds * NANOSECONDS + nanoseconds


def _header(seconds: int, nanoseconds: int, frame: str) -> Header:
    return Header(_time(seconds, nanoseconds), frame)


def _joint_values(
    seconds: int, nanoseconds: int, names: list[str], *values: list[float]
) -> JointValues:
    return JointValues(_time(seconds, nanoseconds), names, *values)


def _interface_values(
    names: list[str], interfaces: list[list[str]], values: list[list[float]]
) -> InterfaceValues:
    pairs = zip(interfaces, values, strict=True)
    return InterfaceValues(names, [dict(zip(*each, strict=False)) for each in pairs])


def _frame_poses(*columns: list[Any]) -> list[FramePose]:
    return [
        FramePose(name, parent, tuple(pose), _time(seconds, nanoseconds))
        for seconds, nanoseconds, parent, name, *pose in zip(*columns, strict=True)
    ]


def _numbers(*values: float) -> tuple[float, ...]:
    return values


def _scan(*values: Any) -> ScanData:
    return ScanData(_header(*values[:3]), *values[3:])


def _cloud(*values: Any) -> CloudData:
    fields = tuple(CloudField(*each) for each in zip(*values[5:9], strict=True))
    height, width, is_bigendian, *rest = *values[3:5], *values[9:]
    return CloudData(_header(*values[:3]), height, width, fields, bool(is_bigendian), *rest)


def _image(*values: Any) -> ImageData:
    height, width, encoding, is_bigendian, step, data = values[3:]
    return ImageData(_header(*values[:3]), height, width, encoding, bool(is_bigendian), step, data)


def _compressed(*values: Any) -> CompressedData:
    return CompressedData(_header(*values[:3]), *values[3:])


def _range(*values: Any) -> RangeData:
    return RangeData(_header(*values[:3]), *values[3:])


def _grid(*values: Any) -> GridData:
    resolution, width, height, *origin, cells = values[3:]
    return GridData(_header(*values[:3]), resolution, width, height, tuple(origin), cells)


def _path(*values: Any) -> PathData:
    header = _header(*values[:3])
    if not header.frame:
        headers = map(_header, *values[3:6])
        header = next((each for each in headers if each.frame), header)
    return PathData(header, _vectors(*values[6:]))


def _vectors(x: Sequence[float], y: Sequence[float], z: Sequence[float]) -> Array:
    """Return as many vectors, shape (n, 3)."""
    return np.array([x, y, z], dtype=float).reshape(3, -1).T


def _marker(*values: Any) -> MarkerData:
    ns, number, kind, action = values[3:7]
    seconds, nanoseconds, is_locked, points, colors, text, resource, *mesh = values[21:]
    name, data, uses_own = mesh
    return MarkerData(
        header=_header(*values[:3]),
        ns=ns,
        id=number,
        type=kind,
        action=action,
        pose=values[7:14],
        scale=values[14:17],
        color=values[17:21],
        lifetime=_time(seconds, nanoseconds),
        frame_locked=bool(is_locked),
        points=points,
        colors=colors,
        text=text,
        mesh_resource=resource,
        mesh=(name, data),
        mesh_use_embedded_materials=bool(uses_own),
    )


def _markers(*columns: list[Any]) -> list[MarkerData]:
    return [_marker(*each) for each in zip(*columns, strict=True)]


def _poses(*values: Any) -> PosesData:
    return PosesData(_header(*values[:3]), values[3])


def _polygon(*values: Any) -> PointsData:
    return PointsData(_header(*values[:3]), values[3])


def _point(*values: Any) -> PointsData:
    return PointsData(_header(*values[:3]), np.array([values[3:]], float))


def _gz_contacts(*values: Any) -> ContactsData:
    contacts = tuple(
        _contact(first, second, _vectors(*points), _vectors(*normals), _vectors(*forces))
        for first, second, *vectors in zip(*values[3:], strict=True)
        for points, normals, forces in [(vectors[:3], vectors[3:6], vectors[6:])]
    )
    return ContactsData(_header(*values[:3]), contacts)


def _classic_contacts(*values: Any) -> ContactsData:
    contacts = tuple(
        _contact(first, second, _vectors(*points), _vectors(*normals), np.array([force]))
        for first, second, *numbers in zip(*values[3:], strict=True)
        for points, normals, force in [(numbers[:3], numbers[3:6], numbers[6:])]
    )
    return ContactsData(_header(*values[:3]), contacts)


def _contact(first: str, second: str, points: Array, normals: Array, forces: Array) -> ContactData:
    if len(normals) != len(points):
        normals = np.full_like(points, np.nan)
    force = float(np.linalg.norm(forces.sum(axis=0))) if len(forces) else float('nan')
    return ContactData(first, second, points, normals, force)


CLOCK = Row('rosgraph_msgs/msg/Clock', ('clock.sec', 'clock.nanosec'), _time)
TRANSFORMS = Row(
    'tf2_msgs/msg/TFMessage',
    tuple(
        f'transforms[].{path}'
        for path in (
            *_HEADER,
            'child_frame_id',
            *(f'transform.translation.{axis}' for axis in 'xyz'),
            *(f'transform.rotation.{axis}' for axis in 'xyzw'),
        )
    ),
    _frame_poses,
)
JOINT_STATE = Row(
    'sensor_msgs/msg/JointState',
    (*_HEADER[:2], 'name[]', 'position[]', 'velocity[]'),
    _joint_values,
)
DYNAMIC_JOINT_STATE = Row(
    'control_msgs/msg/DynamicJointState',
    ('joint_names[]', 'interface_values[].interface_names[]', 'interface_values[].values[]'),
    _interface_values,
)
STATISTICS_NAMES = Row(
    'pal_statistics_msgs/msg/StatisticsNames', ('names[]', 'names_version'), StatisticNames
)
STATISTICS_VALUES = Row(
    'pal_statistics_msgs/msg/StatisticsValues', ('values[]', 'names_version'), StatisticValues
)
ODOMETRY: Row[Motion] = Row(
    'nav_msgs/msg/Odometry',
    (*(f'pose.pose.{path}' for path in _POSE), *(f'twist.twist.{path}' for path in _PLANAR)),
    _numbers,
)
TWIST: Row[Motion] = Row('geometry_msgs/msg/Twist', _PLANAR, _numbers)
"""linear x, m/s, angular z, rad/s, and linear y, m/s."""
TWIST_STAMPED: Row[Motion] = Row(
    'geometry_msgs/msg/TwistStamped', tuple(f'twist.{path}' for path in _PLANAR), _numbers
)
SCAN = Row(
    'sensor_msgs/msg/LaserScan',
    (*_HEADER, 'angle_min', 'angle_increment', 'range_min', 'range_max', 'ranges'),
    _scan,
)
CLOUD = Row(
    'sensor_msgs/msg/PointCloud2',
    (
        *_HEADER,
        'height',
        'width',
        *(f'fields[].{name}' for name in ('name', 'offset', 'datatype', 'count')),
        'is_bigendian',
        'point_step',
        'row_step',
        'data',
    ),
    _cloud,
)
IMAGE = Row(
    'sensor_msgs/msg/Image',
    (*_HEADER, 'height', 'width', 'encoding', 'is_bigendian', 'step', 'data'),
    _image,
)
COMPRESSED_IMAGE = Row(
    'sensor_msgs/msg/CompressedImage', (*_HEADER, 'format', 'data'), _compressed
)
RANGE = Row(
    'sensor_msgs/msg/Range',
    (*_HEADER, 'field_of_view', 'min_range', 'max_range', 'range'),
    _range,
)
GRID = Row(
    'nav_msgs/msg/OccupancyGrid',
    (
        *_HEADER,
        *(f'info.{name}' for name in ('resolution', 'width', 'height')),
        *(f'info.origin.{path}' for path in _POSE),
        'data',
    ),
    _grid,
)
PATH = Row(
    'nav_msgs/msg/Path',
    (
        *_HEADER,
        *(f'poses[].{path}' for path in _HEADER),
        *(f'poses[].pose.position.{axis}' for axis in 'xyz'),
    ),
    _path,
)
_MARKER = (
    *_HEADER,
    'ns',
    'id',
    'type',
    'action',
    *(f'pose.{path}' for path in _POSE),
    *(f'scale.{axis}' for axis in 'xyz'),
    *(f'color.{part}' for part in 'rgba'),
    'lifetime.sec',
    'lifetime.nanosec',
    'frame_locked',
    'points',
    'colors',
    'text',
    'mesh_resource',
    'mesh_file.filename',
    'mesh_file.data',
    'mesh_use_embedded_materials',
)
MARKER = Row('visualization_msgs/msg/Marker', _MARKER, _marker)
MARKERS = Row(
    'visualization_msgs/msg/MarkerArray', tuple(f'markers[].{path}' for path in _MARKER), _markers
)
POSES = Row('geometry_msgs/msg/PoseArray', (*_HEADER, 'poses'), _poses)
POLYGON = Row('geometry_msgs/msg/PolygonStamped', (*_HEADER, 'polygon.points'), _polygon)
POINT = Row(
    'geometry_msgs/msg/PointStamped', (*_HEADER, *(f'point.{axis}' for axis in 'xyz')), _point
)
CONTACTS = Row(
    'ros_gz_interfaces/msg/Contacts',
    (
        *_HEADER,
        'contacts[].collision1.name',
        'contacts[].collision2.name',
        *(f'contacts[].positions[].{axis}' for axis in 'xyz'),
        *(f'contacts[].normals[].{axis}' for axis in 'xyz'),
        *(f'contacts[].wrenches[].body_1_wrench.force.{axis}' for axis in 'xyz'),
    ),
    _gz_contacts,
)
"""Its points are in the frame ``world``."""
CONTACTS_STATE = Row(
    'gazebo_msgs/msg/ContactsState',
    (
        *_HEADER,
        'states[].collision1_name',
        'states[].collision2_name',
        *(f'states[].contact_positions[].{axis}' for axis in 'xyz'),
        *(f'states[].contact_normals[].{axis}' for axis in 'xyz'),
        *(f'states[].total_wrench.force.{axis}' for axis in 'xyz'),
    ),
    _classic_contacts,
)
