# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What was seen of a robot.

All times are integer ns. A ``stamp`` or a ``time`` is of the robot's clock, simulated where there
is ``/clock``; ``received`` is of the system clock of the machine that listens.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from amr_description.model.frames import Transform

ODOMETRY_TYPE = 'nav_msgs/msg/Odometry'
SCAN_TYPE = 'sensor_msgs/msg/LaserScan'
GRID_TYPE = 'nav_msgs/msg/OccupancyGrid'
POSE_TYPE = 'geometry_msgs/msg/PoseWithCovarianceStamped'
TWIST_TYPE = 'geometry_msgs/msg/Twist'
STAMPED_TWIST_TYPE = 'geometry_msgs/msg/TwistStamped'


@dataclass(frozen=True, slots=True)
class ContractEndpoint:
    """A publisher or a subscription of another node."""

    node: str
    """Full name."""
    type_name: str
    is_reliable: bool = True
    is_latched: bool = False
    """Its durability is transient local."""


@dataclass(frozen=True, slots=True)
class ContractTopic:
    """Who publishes and who subscribes to a topic."""

    name: str
    """Full, after remapping."""
    publishers: tuple[ContractEndpoint, ...] = ()
    subscriptions: tuple[ContractEndpoint, ...] = ()


@dataclass(frozen=True, slots=True)
class Tick:
    """A message on ``/clock``."""

    time: int
    received: int


@dataclass(frozen=True, slots=True)
class TransformSeen:
    """A transform on ``/tf`` or ``/tf_static``."""

    parent: str
    child: str
    stamp: int
    received: int
    is_static: bool = False
    transform: Transform = Transform()
    sequence: int = 0
    """The number that its publisher gave the message; 0: not known."""


@dataclass(frozen=True, slots=True)
class OdometrySeen:
    """A message on ``odom``."""

    stamp: int
    received: int
    frame: str
    child_frame: str
    x: float
    """m, in ``frame``; ``y`` too."""
    y: float
    yaw: float
    """rad, in ``frame``."""
    linear: tuple[float, float]
    """m/s, along x and y."""
    angular: float
    """rad/s, about z."""
    variances: tuple[float, float, float, float, float]
    """Of x, y and yaw, and of the speeds along x and about z: m², rad², (m/s)², (rad/s)²."""


@dataclass(frozen=True, slots=True)
class ScanGeometry:
    """What a scan says of its rays: rad and m, float32 as in the message."""

    angle_min: float
    angle_max: float
    angle_increment: float
    range_min: float
    range_max: float
    count: int
    """The number of ranges."""


@dataclass(frozen=True, slots=True)
class RangeCounts:
    """How many ranges of a scan are what."""

    hits: int
    """From range_min to range_max."""
    beyond: int = 0
    """Finite, and larger than range_max."""
    nearer: int = 0
    """Finite, and smaller than range_min."""
    infinite: int = 0
    """+inf: nothing met."""
    invalid: int = 0
    """NaN."""


@dataclass(frozen=True, slots=True)
class ScanSeen:
    """A message on ``scan``."""

    stamp: int
    received: int
    frame: str
    geometry: ScanGeometry
    counts: RangeCounts
    wait: int | None = None
    """ns from its reception until ``odom → frame`` was known at its stamp; None: it never was."""
    error: str = ''
    """Why not, as tf2 says it."""


@dataclass(frozen=True, slots=True)
class MapSeen:
    """A message on ``map``."""

    frame: str
    width: int
    height: int
    resolution: float
    """m"""
    cells: int
    """How many the message has."""


@dataclass(frozen=True, slots=True)
class Phase:
    """A command that was given for a while, and what odometry said of it."""

    linear: float
    """m/s that were commanded."""
    angular: float
    """rad/s that were commanded."""
    began: int
    """Stamp of the odometry before the first command."""
    ceased: int
    """Stamp of the first odometry after the last command."""
    odometry: tuple[OdometrySeen, ...]
    """From ``began`` until the robot stood again, or was waited for in vain."""


@dataclass(frozen=True, slots=True)
class ContractFrames:
    """The names of the frames that Nav2 and slam_toolbox are configured for."""

    map: str = 'map'
    odom: str = 'odom'
    base: str = 'base_link'
    footprint: str = 'base_footprint'


@dataclass(frozen=True, slots=True)
class Body:
    """What ``robot_description`` says."""

    moving_links: frozenset[str]
    """The children of joints that move."""
    radius: float | None = None
    """m from the base to the farthest point of the collisions, seen from above; None: unknown."""
    polygon: tuple[tuple[float, float], ...] = ()
    """x and y, m, in the base: the collisions seen from above."""
    fault: str = ''
    """Why these two are unknown."""


@dataclass(frozen=True, slots=True)
class ContractObservations:
    """All that was seen of a robot."""

    clock: ContractTopic
    tf: ContractTopic
    odom: ContractTopic
    scan: ContractTopic
    cmd_vel: ContractTopic
    map: ContractTopic
    initial_pose: ContractTopic
    frames: ContractFrames = ContractFrames()
    seconds: float = 0.0
    """How long was listened, by the system clock."""
    is_stamped: bool = False
    """Whether ``enable_stamped_cmd_vel`` is true in Nav2's parameters."""
    ended: int | None = None
    """When listening ended, as ``received``; None: long after the last message."""
    resets: int = 0
    """How often simulated time began anew; what was seen before is left out."""
    ticks: tuple[Tick, ...] = ()
    transforms: tuple[TransformSeen, ...] = ()
    """In the order of their reception."""
    odometry: tuple[OdometrySeen, ...] = ()
    scans: tuple[ScanSeen, ...] = ()
    map_seen: MapSeen | None = None
    body: Body | None = None
    """None: no ``robot_description`` came, or one that cannot be read."""
    use_sim_time: Mapping[str, bool] = field(default_factory=dict)
    """Of each node that has said so; nodes that publish ``/clock`` are left out."""
    silent_nodes: tuple[str, ...] = ()
    """Those that were asked for it, and did not answer."""
    parameters: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    """Of slam_toolbox and of costmaps, if they are there: node → name → value."""
    drive: tuple[Phase, ...] = ()
    """Empty: the robot was not driven."""
    not_driven: str = 'it takes driving: give --drive where there is room'
    """Why not."""
    elsewhere: Mapping[str, tuple[ContractTopic, ...]] = field(default_factory=dict)
    """Further topics of odometry and of scans: type → topics."""
    other_command_topics: tuple[ContractTopic, ...] = ()
    """Further topics on which somebody subscribes to velocities."""

    @property
    def is_simulated(self) -> bool:
        """Whether somebody publishes ``/clock``."""
        return bool(self.clock.publishers)
