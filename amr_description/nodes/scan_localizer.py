# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``scan_localizer``: map → odom by matching scans against the map, in place of amcl.

It has amcl's topics and parameter names, so that a parameter file of amcl will do. It follows one
pose instead of a cloud of particles, the same from run to run, and needs an initial pose that is
right within a metre and 30 degrees or so.

===============  =========================  ====================================================
topic            type                       QoS
===============  =========================  ====================================================
``scan``         LaserScan                  subscribed: best effort, depth 5
``map``          OccupancyGrid              subscribed: reliable, transient local, depth 1
``initialpose``  PoseWithCovarianceStamped  subscribed: reliable, depth 10
``/tf``          TFMessage                  map → odom, with each scan
``amcl_pose``    PoseWithCovarianceStamped  reliable, transient local, depth 1, with each scan
                                            that is matched
===============  =========================  ====================================================

Services: ``request_nomotion_update`` (std_srvs/srv/Empty) has the next scan matched, even if the
robot stands.
"""

from contextlib import suppress
from dataclasses import dataclass
from typing import NamedTuple

from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import OccupancyGrid
import numpy as np
from numpy.typing import NDArray
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty

from amr_description.errors import TransformException
from amr_description.maps.pose import Pose
from amr_description.model.frames import matrix_from_quaternion
from amr_description.navigation.localization import (
    Agreement,
    MotionNoise,
    ray_ends,
    ScanTracker,
)
from amr_description.navigation.ros.localizer import after, LocalizerTopics, plane_covariance
from amr_description.navigation.ros.messages import grid_of, plane_pose, pose_of
from amr_description.navigation.ros.transform_queue import TransformQueue
from amr_description.navigation.scan_matching import Match, ScanMatcher
from amr_description.parameters import group, parameter
from amr_description.ros.messages import nanoseconds, stamp_fault
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import run
from amr_description.tf2_ros.buffer import Buffer, stamped_transform
from amr_description.tf2_ros.listener import TransformListener

PURPOSE = (
    'Publish map -> odom by matching scans against the map, from an initial pose on, with the '
    'topics and parameter names of amcl.'
)

_DEPTH = 10
"""Scans that wait for their odometry, as in amcl."""
_PATIENCE = 5.0
"""s of the wall clock until it is said what is missing."""


@dataclass(frozen=True)
class InitialPose:
    """The pose of the robot at the beginning, in the frame of the map."""

    x: float = parameter(0.0, 'X of the initial pose', unit='m', read_only=True)
    y: float = parameter(0.0, 'Y of the initial pose', unit='m', read_only=True)
    z: float = parameter(0.0, 'Z of the initial pose, which is ignored', unit='m', read_only=True)
    yaw: float = parameter(0.0, 'Heading of the initial pose', unit='rad', read_only=True)


@dataclass(frozen=True)
class ScanLocalizerParameters:
    """Names are those of amcl."""

    base_frame_id: str = parameter('base_footprint', 'The frame of the robot', read_only=True)
    odom_frame_id: str = parameter('odom', 'The frame of odometry', read_only=True)
    global_frame_id: str = parameter('map', 'The frame of the map', read_only=True)
    scan_topic: str = parameter('scan', 'The topic of the scans', read_only=True)
    map_topic: str = parameter('map', 'The topic of the map', read_only=True)
    first_map_only: bool = parameter(False, 'Whether later maps are ignored', read_only=True)
    set_initial_pose: bool = parameter(
        False, 'Begin at initial_pose instead of waiting for /initialpose', read_only=True
    )
    initial_pose: InitialPose = group('initial_pose', InitialPose)
    laser_max_range: float = parameter(
        100.0, "Longer rays are ignored; -1: than the scan's range_max", unit='m', read_only=True
    )
    laser_min_range: float = parameter(
        -1.0, "Shorter rays are ignored; -1: than the scan's range_min", unit='m', read_only=True
    )
    laser_likelihood_max_dist: float = parameter(
        2.0,
        'The end of a ray that is farther from everything says nothing',
        unit='m',
        above=0.0,
        read_only=True,
    )
    max_beams: int = parameter(
        180, 'The most rays of a scan that are matched', minimum=1, read_only=True
    )
    sigma_hit: float = parameter(
        0.05,
        'Standard deviation of where rays end; of the cells of the map more than of the lidar',
        unit='m',
        above=0.0,
        read_only=True,
    )
    alpha1: float = parameter(0.2, 'Error of turning by turning', minimum=0.0, read_only=True)
    alpha2: float = parameter(0.2, 'Error of turning by driving', minimum=0.0, read_only=True)
    alpha3: float = parameter(0.2, 'Error of driving by driving', minimum=0.0, read_only=True)
    alpha4: float = parameter(0.2, 'Error of driving by turning', minimum=0.0, read_only=True)
    tf_broadcast: bool = parameter(True, 'Whether map -> odom is published', read_only=True)
    transform_tolerance: float = parameter(
        0.2,
        'How far into the future a transform is stamped: longer than from scan to scan. What is '
        'looked up now was found so long ago',
        unit='s',
        minimum=0.0,
        read_only=True,
    )
    update_min_d: float = parameter(
        0.0, 'A scan is matched after a way of', unit='m', minimum=0.0, read_only=True
    )
    update_min_a: float = parameter(
        0.0, 'A scan is matched after a turn by', unit='rad', minimum=0.0, read_only=True
    )


class ScanLocalizer(Node):
    """The node."""

    def __init__(self) -> None:
        super().__init__('scan_localizer')
        self._settings = given = declare(self, ScanLocalizerParameters)
        self._noise = MotionNoise(given.alpha1, given.alpha2, given.alpha3, given.alpha4)
        self._tracker: ScanTracker | None = None
        self._initial = _initial_pose(given)
        self._latest = -1
        self._said: Agreement | None = None
        """How well the scan fits, as it was last said; None: a pose was given since."""
        self._buffer = Buffer(clock=self.get_clock())
        self._listener = TransformListener(self._buffer, self)
        self._queue = TransformQueue[LaserScan](self._buffer, self._localize, _DEPTH)
        self._topics = LocalizerTopics(
            self,
            given.global_frame_id,
            tolerance=given.transform_tolerance,
            broadcasts=given.tf_broadcast,
            on_initial_pose=self._on_initial_pose,
        )
        self._maps = self.create_subscription(
            OccupancyGrid, given.map_topic, self._on_map, LATCHED
        )
        self._scans = self.create_subscription(
            LaserScan, given.scan_topic, self._on_scan, qos_profile_sensor_data
        )
        self.create_service(Empty, 'request_nomotion_update', self._on_nomotion_update)
        after(self, _PATIENCE, self._complain)
        self.get_logger().info(
            f'{given.global_frame_id} -> {given.odom_frame_id} from {self._scans.topic_name} in '
            f'{self._maps.topic_name}'
        )

    # --- what comes -----------------------------------------------------------------------------

    def _on_map(self, message: OccupancyGrid) -> None:
        if self._tracker is not None and self._settings.first_map_only:
            return
        info, frame = message.info, self._settings.global_frame_id
        if message.header.frame_id != frame:
            self.get_logger().warning(
                f"the map is in the frame '{message.header.frame_id}', and global_frame_id is "
                f"'{frame}': it is taken to be in '{frame}'"
            )
        try:
            grid = grid_of(message)
        except ValueError as error:
            self.get_logger().warning(f'Ignoring a map of {error}')
            return
        last = self._tracker.estimate if self._tracker else None
        given = self._settings
        matcher = ScanMatcher(
            grid,
            sigma=given.sigma_hit,
            max_distance=given.laser_likelihood_max_dist,
        )
        self._tracker = ScanTracker(
            matcher,
            self._noise,
            update_min_d=given.update_min_d,
            update_min_a=given.update_min_a,
        )
        if last is not None:
            self._tracker.place(last.pose, last.covariance, last.odometry)
        self.get_logger().info(
            f'Received a {info.width} X {info.height} map @ {info.resolution:.3f} m/pix'
        )

    def _on_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        """Take it as the pose at its stamp, from which odometry goes on (0: the latest one)."""
        if fault := stamp_fault(message.header.stamp):
            self.get_logger().warning(f'an initial pose is left out: {fault}')
            return
        pose = pose_of(message.pose.pose)
        frames = (self._settings.odom_frame_id, self._settings.base_frame_id)
        odometry: Pose | None = None
        for time in (Time.from_msg(message.header.stamp), Time()):
            with suppress(TransformException):
                odometry = plane_pose(self._buffer.lookup_transform(*frames, time))
                break
        self._initial = _Initial(pose, plane_covariance(message), odometry)
        self._said = None
        if self._tracker is not None:
            self._tracker.estimate = None
        self.get_logger().info(f'Setting pose: {pose.x:.3f} {pose.y:.3f} {pose.yaw:.3f}')

    def _on_nomotion_update(self, _: Empty.Request, response: Empty.Response) -> Empty.Response:
        if self._tracker is not None:
            self._tracker.match_next()
        return response

    def _on_scan(self, message: LaserScan) -> None:
        if fault := stamp_fault(message.header.stamp):
            self.get_logger().warning(
                f'a scan is left out: {fault}', throttle_duration_sec=_PATIENCE
            )
            return
        stamp = nanoseconds(message.header.stamp)
        if stamp < self._latest:  # the simulation was reset
            self._buffer.clear()
            self._queue.clear()
            if self._tracker is not None:
                self._tracker.estimate = None
        self._latest = stamp
        given = self._settings
        self._queue.add(message, given.odom_frame_id, given.base_frame_id, stamp)

    # --- where the robot is ---------------------------------------------------------------------

    def _localize(self, message: LaserScan, odom_to_base: TransformStamped) -> None:
        tracker, odometry = self._tracker, plane_pose(odom_to_base)
        if tracker is None or not self._has_begun(tracker, odometry):
            return
        points = self._points_of(message)
        if points is None:
            return
        match, stamp = tracker.update(points, odometry), nanoseconds(message.header.stamp)
        if match is not None:
            self._topics.send_pose(stamp, match.pose, match.covariance)
            self._say_how_it_fits(match, len(points))
        assert tracker.estimate is not None, 'it has begun'
        self._topics.send_transform(
            stamp, tracker.estimate.map_to_odom, self._settings.odom_frame_id
        )

    def _has_begun(self, tracker: ScanTracker, odometry: Pose) -> bool:
        """Return whether there is a pose; begin at the initial one if there is none yet."""
        if tracker.estimate is None and self._initial is not None:
            pose, covariance, then = self._initial
            then = odometry if then is None else then
            tracker.place(pose, covariance, then)
            # After a reset of the simulation the robot is where its odometry began.
            begin = pose.compose(then.inverse())
            self._initial = _Initial(begin, covariance, Pose(0.0, 0.0, 0.0))
        return tracker.estimate is not None

    def _points_of(self, scan: LaserScan) -> NDArray[np.float64] | None:
        """Return where the rays of a scan end, in the base frame, seen from above: (n, 2), m."""
        given = self._settings
        try:
            message = self._buffer.lookup_transform(
                given.base_frame_id, scan.header.frame_id, Time.from_msg(scan.header.stamp)
            )
        except TransformException as error:
            self.get_logger().error(
                f'a scan cannot be used without the place of the lidar: {error}',
                throttle_duration_sec=_PATIENCE,
            )
            return None
        transform = stamped_transform(message).transform
        shortest = given.laser_min_range if given.laser_min_range > 0.0 else scan.range_min
        longest = given.laser_max_range if given.laser_max_range > 0.0 else scan.range_max
        ends = ray_ends(
            np.asarray(scan.ranges, dtype=np.float32),
            scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges)),
            nearest=max(shortest, scan.range_min),
            farthest=min(longest, scan.range_max),
            most=given.max_beams,
        )
        turn = np.array(matrix_from_quaternion(transform.rotation))[:2, :2]
        return ends @ turn.T + transform.translation[:2]

    # --- what is said ---------------------------------------------------------------------------

    def _say_how_it_fits(self, match: Match, rays: int) -> None:
        """Say it of a pose that was given, and when it changes."""
        said, self._said = self._said, Agreement.of(match)
        if said is self._said:
            return
        x, y, yaw = match.pose
        where = f'the map at {x:.2f} {y:.2f} {yaw:.2f}: of {rays} rays {match.fit:.0%} end at'
        if self._said is Agreement.GOOD:
            self.get_logger().info(f'the scan fits {where} something of it')
        elif self._said is Agreement.POOR:
            self.get_logger().warning(
                f'the scan fits little of {where} something of it. If the robot is elsewhere, '
                '/initialpose says where'
            )
        else:
            self.get_logger().warning(
                f'the scan does not fit {where} something of it. The pose is that of odometry '
                'until it fits again, or /initialpose says where the robot is'
            )

    def _complain(self) -> None:
        if self._tracker is not None and self._tracker.estimate is not None:
            return
        given = self._settings
        if self._tracker is None:
            missing = (
                f'nothing is on {self._maps.topic_name}; map_server publishes it, reliable and '
                'transient local'
            )
        elif self._latest < 0:
            missing = f'nothing is on {self._scans.topic_name}; scan_topic names another topic'
        elif self._initial is None:
            missing = (
                'please set the initial pose: on /initialpose, as RViz does, or by the parameters '
                'set_initial_pose and initial_pose.x, .y, .yaw'
            )
        else:
            missing = (
                f"TF has no '{given.odom_frame_id}' above '{given.base_frame_id}' at the stamps "
                f'of {self._scans.topic_name}'
            )
        self.get_logger().warning(f'no {given.global_frame_id} frame yet: {missing}')


class _Initial(NamedTuple):
    """Where the robot is to begin."""

    pose: Pose
    covariance: NDArray[np.float64]
    odometry: Pose | None
    """Where odometry said that it was then; None: not known, as at the next scan."""


def _initial_pose(given: ScanLocalizerParameters) -> _Initial | None:
    if not given.set_initial_pose:
        return None
    begin = given.initial_pose
    return _Initial(Pose(begin.x, begin.y, begin.yaw), np.zeros((3, 3)), None)


def main(args: list[str] | None = None) -> int:
    """Localize until Ctrl-C."""
    if print_help(args, 'scan_localizer', PURPOSE, ScanLocalizerParameters):
        return 0
    return run(ScanLocalizer, args)


if __name__ == '__main__':
    raise SystemExit(main())
