# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The sensors of a robot that look at the world: what a simulator needs to know of each.

Lidars, cameras and contact sensors; the result of reading ``<gazebo>`` blocks, whichever Gazebo
they were written for. A sensor of ``<ros2_control>``, such as an IMU, has state interfaces instead
and is published by its broadcaster.

Lengths are in m, angles in rad, times in s. A topic is relative to the namespace of the robot, or
absolute if it begins with ``/``; '' is a topic that is not published.
"""

from dataclasses import dataclass
import math
from typing import TypeAlias

from amr_description.model.findings import Finding
from amr_description.model.frames import Transform
from amr_description.model.gazebo.tags import Noise

NO_NOISE = Noise()
RANGE = 'sensor_msgs/msg/Range'
_CAMERA_INFO = 'sensor_msgs/msg/CameraInfo'
_IMAGE = 'sensor_msgs/msg/Image'
_POINTS = 'sensor_msgs/msg/PointCloud2'

Topics: TypeAlias = tuple[tuple[str, str], ...]
"""(topic, type of its messages) of those that a sensor publishes."""


def _published(*topics: tuple[str, str]) -> Topics:
    return tuple(each for each in topics if each[0])


@dataclass(frozen=True, slots=True)
class SensorMount:
    """Where a sensor is, how often it measures, and how its messages are named."""

    name: str
    link: str
    pose: Transform = Transform()
    """``transform_sensor_to_link``."""
    frame: str = ''
    """The ``frame_id`` of its messages, without the prefix of a namespace."""
    rate: float = 0.0
    """Hz of simulated time; 0: in every control cycle."""
    namespace: str = ''
    """Of its topics, if the robot is spawned without one."""
    line: int = 0
    """Of its tag in the description."""

    @property
    def path(self) -> str:
        """``LINK/NAME``: no other sensor of the robot has it, though one of its name may exist."""
        return f'{self.link}/{self.name}'

    def full_name(self, topic: str, namespace: str) -> str:
        """Return the full name of a topic; see :func:`topic_in`."""
        return topic_in(namespace, topic, self.namespace)


@dataclass(frozen=True, slots=True)
class ScanAxis:
    """The rays of a lidar in one direction: ``samples`` from ``lower`` to ``upper``, rad."""

    samples: int
    lower: float
    upper: float

    @property
    def increment(self) -> float:
        """The angle between two rays, rad; 0 for a single one."""
        return (self.upper - self.lower) / (self.samples - 1) if self.samples > 1 else 0.0


@dataclass(frozen=True, slots=True)
class Lidar:
    """
    A lidar, 2-D or 3-D, or a range finder.

    The axes of the sensor are x forward, y to the left, z up; the angle of ``horizontal`` is
    about z from x to y, that of ``vertical`` is an elevation.
    """

    mount: SensorMount
    horizontal: ScanAxis
    vertical: ScanAxis = ScanAxis(1, 0.0, 0.0)
    range_min: float = 0.0
    range_max: float = math.inf
    range_resolution: float = 0.0
    """Ranges are multiples of it; 0: they are not rounded."""
    noise: Noise = NO_NOISE
    """Of the range, m."""
    sees_robot: bool = True
    """Whether the robot's own parts are seen."""
    scan_topic: str = 'scan'
    """``sensor_msgs/msg/LaserScan``; of several rings the middle one."""
    points_topic: str = ''
    """``sensor_msgs/msg/PointCloud2``."""
    range_topic: str = ''
    """``sensor_msgs/msg/Range``: the nearest of all rays."""
    radiation_type: int = 1
    """Of that message: 0 ultrasound, 1 infrared."""

    @property
    def topics(self) -> Topics:
        """Its topics and their types."""
        return _published(
            (self.scan_topic, 'sensor_msgs/msg/LaserScan'),
            (self.points_topic, _POINTS),
            (self.range_topic, RANGE),
        )


@dataclass(frozen=True, slots=True)
class Distortion:
    """The coefficients of the lens by Brown's model (``plumb_bob``)."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    p1: float = 0.0
    p2: float = 0.0

    @property
    def is_none(self) -> bool:
        """Whether straight lines stay straight."""
        return not any((self.k1, self.k2, self.k3, self.p1, self.p2))


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """The matrix K of a camera, pixels: focal lengths and principal point."""

    fx: float
    fy: float
    cx: float
    cy: float


@dataclass(frozen=True, slots=True)
class Camera:
    """
    A camera: colour, depth or both.

    The axes of the sensor are those of Gazebo: x forward, y to the left, z up. Its messages are
    in the optical frame: z forward, x to the right, y down (REP 103), which ``mount.frame`` names.
    """

    mount: SensorMount
    width: int
    height: int
    horizontal_fov: float
    """rad, of the undistorted picture; see :attr:`intrinsics`."""
    near: float = 0.1
    far: float = 100.0
    """What is nearer or farther is not seen in colour, m along the optical axis."""
    depth_near: float = 0.1
    depth_far: float = 100.0
    """Likewise in depth."""
    intrinsics: Intrinsics | None = None
    """None: those that follow from the field of view, with the centre in the middle."""
    distortion: Distortion = Distortion()
    noise: Noise = NO_NOISE
    """Of colours, 0 to 1; of depth, m, if the camera has no colour."""
    encoding: str = 'rgb8'
    """``rgb8``, ``bgr8`` or ``mono8``."""
    baseline: float = 0.0
    """m: of the right camera of a stereo pair, to its left one; makes ``P[3]``."""
    image_topic: str = ''
    """Colour, ``sensor_msgs/msg/Image``; JPEGs are on ``<image_topic>/compressed``."""
    camera_info_topic: str = ''
    depth_topic: str = ''
    """``sensor_msgs/msg/Image``, 32FC1, m along the optical axis."""
    depth_camera_info_topic: str = ''
    points_topic: str = ''
    """``sensor_msgs/msg/PointCloud2``, coloured if the camera has colours."""
    points_frame: str = ''
    """The ``frame_id`` of the points, where it is another one (Gazebo's: x forward)."""
    points_are_optical: bool = True
    """Whether the points have the axes of the optical frame; else those of the sensor."""

    @property
    def topics(self) -> Topics:
        """Its topics and their types, without those of JPEGs."""
        return _published(
            (self.image_topic, _IMAGE),
            (self.camera_info_topic, _CAMERA_INFO),
            (self.depth_topic, _IMAGE),
            (self.depth_camera_info_topic, _CAMERA_INFO),
            (self.points_topic, _POINTS),
        )


@dataclass(frozen=True, slots=True)
class ContactSensor:
    """What touches some collisions of a link: a bumper."""

    mount: SensorMount
    collisions: tuple[str, ...] = ()
    """Names of ``<collision>`` elements of the link; empty: all of them."""
    topic: str = 'contact'
    message: str = 'ros_gz_interfaces/msg/Contacts'
    """Its type: that of ros_gz_bridge, or Gazebo Classic's ``gazebo_msgs/msg/ContactsState``."""

    @property
    def topics(self) -> Topics:
        """Its topic and the type of it."""
        return _published((self.topic, self.message))


WorldSensor: TypeAlias = Lidar | Camera | ContactSensor


@dataclass(frozen=True, slots=True)
class RobotSensors:
    """
    The sensors of one robot.

    Attributes:
        sensors: those that are sound.
        findings: what is wrong with them and with the others, which are left out.
        lacking: (name, type) of those that are declared and not simulated.
        faulty: the names of those that are left out, also of other kinds, such as an IMU.
    """

    sensors: tuple[WorldSensor, ...] = ()
    findings: tuple[Finding, ...] = ()
    lacking: tuple[tuple[str, str], ...] = ()
    faulty: frozenset[str] = frozenset()


def topic_in(namespace: str, topic: str, own_namespace: str) -> str:
    """
    Return the full name of a topic of a sensor or plugin; '' stays ''.

    A topic of new Gazebo that begins with the namespace already has none put before it.

    Args:
        namespace: of the robot, absolute: ``/`` or ``/robot1``. If it has one it counts before
            that of the sensor or plugin, as with Gazebo's spawner.
        topic: relative or absolute.
        own_namespace: of the sensor or plugin, relative; '': none.
    """
    if not topic or topic.startswith('/'):
        return topic
    inside = namespace.rstrip('/') or f'/{own_namespace}'.rstrip('/')
    begins_with_it = bool(inside) and f'/{topic}'.startswith(f'{inside}/')
    return f'/{topic}' if begins_with_it else f'{inside}/{topic}'


def frame_in(namespace: str, name: str) -> str:
    """Return a frame with the prefix that all frames of a robot have: its namespace."""
    prefix = namespace.strip('/')
    return name if not prefix or name.startswith(f'{prefix}/') else f'{prefix}/{name}'
