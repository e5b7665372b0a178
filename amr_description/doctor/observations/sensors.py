# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was seen of sensors, of joints, and of odometry beside the truth. Times are integer ns."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedSource:
    """Where messages come from."""

    topic: str
    publishers: tuple[str, ...] = ()
    """Full names of nodes."""
    frame: str = ''
    """``header.frame_id`` of the messages."""
    age: int | None = None
    """The least of a message when it was received; None: not known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedScan(ObservedSource):
    """A topic of ``sensor_msgs/msg/LaserScan``, and the last message of it."""

    angle_min: float = 0.0
    angle_max: float = 0.0
    angle_increment: float = 0.0
    count: int = 0
    """Of ranges."""
    hits: int = 0
    """Ranges from range_min to range_max."""
    infinite: int = 0
    zeros: int = 0
    invalid: int = 0
    """NaN."""
    messages: int = 1
    """That came."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedImage(ObservedSource):
    """A topic of ``sensor_msgs/msg/Image``, and a message of it."""

    width: int = 0
    height: int = 0
    step: int = 0
    encoding: str = ''
    size: int = 0
    """Bytes of data."""
    info_topic: str = ''
    """That image_transport takes for its ``camera_info``."""
    info_publishers: tuple[str, ...] = ()
    info_size: tuple[int, int] | None = None
    """Width and height there; None: nothing came."""
    focal_length: float | None = None
    """The first number of K there; None: nothing came."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Imu(ObservedSource):
    """A topic of ``sensor_msgs/msg/Imu``, and the last message of it."""

    orientation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    has_orientation: bool = True
    """``orientation_covariance[0]`` is not -1, which says that there is none."""
    acceleration: tuple[float, float, float] = (0.0, 0.0, 9.81)


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedJoints(ObservedSource):
    """A topic of ``sensor_msgs/msg/JointState``, and what one publisher sends."""

    publisher: str = ''
    names: tuple[str, ...] = ()
    positions: int = 0
    """How many."""
    not_numbers: tuple[str, ...] = ()
    """Joints whose position is none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedTravel(ObservedSource):
    """What an odometry says of a span of time, and what the simulator says of it."""

    distance: float = 0.0
    """m from its beginning to its end; ``true_distance`` too."""
    true_distance: float = 0.0
    turn: float = 0.0
    """rad; ``true_turn`` too."""
    true_turn: float = 0.0
    seconds: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedSensors:
    """All sensors."""

    scans: tuple[ObservedScan, ...] = ()
    images: tuple[ObservedImage, ...] = ()
    imus: tuple[Imu, ...] = ()
    joints: tuple[ObservedJoints, ...] = ()
    travels: tuple[ObservedTravel, ...] = ()

    @property
    def framed(self) -> tuple[ObservedSource, ...]:
        """Those whose messages are in a frame."""
        return (*self.scans, *self.images, *self.imus)
