# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``navsat_transform_node``: fixes of a satellite receiver as odometry, as of robot_localization.

=======================  =================  ====================================================
topic                    type               QoS
=======================  =================  ====================================================
``odometry/filtered``    Odometry           subscribed: best effort, depth 1
``gps/fix``              NavSatFix          subscribed: best effort, depth 1
``imu``                  Imu                the same, until the datum is known; not with
                                            ``use_odometry_yaw`` or ``wait_for_datum``
``odometry/gps``         Odometry           reliable, depth 10
``gps/filtered``         NavSatFix          the same, with ``publish_filtered_gps``
``/tf_static``           TFMessage          world → ``utm`` or ``local_enu``, with
                                            ``broadcast_cartesian_transform``
=======================  =================  ====================================================

Services of robot_localization/srv: ``datum`` SetDatum, ``toLL`` ToLL, ``fromLL`` FromLL,
``setUTMZone`` SetUTMZone.
"""

from dataclasses import dataclass, replace
import math
import re
from typing import Any

from nav_msgs.msg import Odometry
import numpy as np
from numpy.typing import NDArray
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile, QoSReliabilityPolicy
from robot_localization.srv import FromLL, SetDatum, SetUTMZone, ToLL
from sensor_msgs.msg import Imu, NavSatFix, NavSatStatus

from amr_description.clock import NANOSECONDS
from amr_description.errors import ParameterError
from amr_description.model.frames import (
    matrix_from_quaternion,
    Quaternion,
    quaternion_from_yaw,
    rotate,
    Transform,
    Vector,
)
from amr_description.navigation.navsat import (
    Datum,
    GeoPoint,
    Grid,
    heading_of,
    LocalCartesian,
    Utm,
    without_mounting,
    world_from_grid,
)
from amr_description.navigation.ros.transform_queue import transform_at
from amr_description.parameters import parameter
from amr_description.ros.messages import fill_pose, nanoseconds, transform_of
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import run
from amr_description.tf2_ros.broadcaster import StaticTransformBroadcaster
from amr_description.tf2_ros.buffer import Buffer, transform_message
from amr_description.tf2_ros.listener import TransformListener
from amr_description.tf2_ros.time_cache import StampedTransform

PURPOSE = 'Publish the fixes of a satellite receiver as odometry, in the frame of the robot.'
_NEWEST = QoSProfile(depth=1, reliability=QoSReliabilityPolicy.BEST_EFFORT)
_ZONE = re.compile('(0?[1-9]|[1-5][0-9]|60)([C-HJ-NP-X])')
_QUIET = 5.0
"""s between two lines about the same."""


@dataclass(frozen=True)
class NavsatParameters:
    """Names and defaults are those of robot_localization 3.8 (Jazzy)."""

    frequency: float = parameter(
        10.0, 'How often is published', unit='Hz', above=0.0, read_only=True
    )
    delay: float = parameter(
        0.0, 'Time until the datum is taken', unit='s', minimum=0.0, read_only=True
    )
    magnetic_declination_radians: float = parameter(
        0.0, 'What an IMU by magnetic north lacks', unit='rad', read_only=True
    )
    yaw_offset: float = parameter(
        0.0, 'What the yaw lacks to be 0 in the east', unit='rad', read_only=True
    )
    zero_altitude: bool = parameter(False, 'Whether z is 0', read_only=True)
    publish_filtered_gps: bool = parameter(
        True, 'Whether gps/filtered is published', read_only=True
    )
    use_odometry_yaw: bool = parameter(
        False, 'Whether the heading is that of the odometry, not of the IMU', read_only=True
    )
    wait_for_datum: bool = parameter(
        False, 'Whether the datum is that of the parameter, not the first fix', read_only=True
    )
    datum: tuple[float, ...] = parameter(
        (), 'Latitude and longitude, degrees; heading, rad', read_only=True
    )
    use_local_cartesian: bool = parameter(
        False, 'Whether the grid is a plane at the datum, not UTM', read_only=True
    )
    broadcast_cartesian_transform: bool = parameter(
        False, 'Whether the frame of the grid is published', read_only=True
    )
    broadcast_cartesian_transform_as_parent_frame: bool = parameter(
        False, 'Whether the frame of the grid is the parent', read_only=True
    )
    broadcast_utm_transform: bool = parameter(
        False, 'Former name of broadcast_cartesian_transform', read_only=True
    )
    broadcast_utm_transform_as_parent_frame: bool = parameter(
        False, 'Former name of broadcast_cartesian_transform_as_parent_frame', read_only=True
    )
    transform_timeout: float = parameter(
        0.0, 'How long a transform is waited for', unit='s', minimum=0.0, read_only=True
    )


class NavsatTransformNode(Node):
    """The node."""

    def __init__(self) -> None:
        super().__init__('navsat_transform_node')
        self._settings = given = declare(self, NavsatParameters)
        self._buffer = Buffer(clock=self.get_clock())
        waits = given.transform_timeout > 0.0
        # Who waits for a transform in a callback must not keep it from being received.
        self._listener = TransformListener(
            self._buffer, None if waits else self, spin_thread=waits
        )
        self._broadcaster = StaticTransformBroadcaster(self)
        self._odometry: Odometry | None = None
        self._odometry_is_new = False
        self._fix: NavSatFix | None = None
        self._fix_is_new = False
        self._first: NavSatFix | None = None
        self._attitude: Quaternion | None = None
        self._manual: Datum | None = self._given_datum()
        self._zone: Utm | None = None
        self._grid: Grid | None = None
        self._world_from_grid = Transform()
        self.create_subscription(Odometry, 'odometry/filtered', self._on_odometry, _NEWEST)
        self.create_subscription(NavSatFix, 'gps/fix', self._on_fix, _NEWEST)
        self._imu = None
        if not (given.use_odometry_yaw or given.wait_for_datum):
            self._imu = self.create_subscription(Imu, 'imu', self._on_imu, _NEWEST)
        self._gps_odometry = self.create_publisher(Odometry, 'odometry/gps', 10)
        self._filtered = (
            self.create_publisher(NavSatFix, 'gps/filtered', 10)
            if given.publish_filtered_gps
            else None
        )
        self._serve()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._begin = steady.now() + Duration(nanoseconds=round(given.delay * NANOSECONDS))
        self._steady = steady
        self.create_timer(1.0 / given.frequency, self._update, clock=steady)

    def _given_datum(self) -> Datum | None:
        """Return the datum of the parameters. Raises ParameterError: one is waited for."""
        given = self._settings
        if not given.wait_for_datum:
            return None
        if len(given.datum) != 3:
            raise ParameterError(
                f"parameter 'datum' has {len(given.datum)} elements; with wait_for_datum 3 are "
                'expected: latitude and longitude in degrees, heading in rad'
            )
        latitude, longitude, heading = given.datum
        return Datum(GeoPoint(latitude, longitude), quaternion_from_yaw(heading))

    def destroy_node(self) -> None:
        """End with all that it has."""
        self._listener.unregister()
        super().destroy_node()

    # --- messages -----------------------------------------------------------------------------

    def _on_odometry(self, message: Odometry) -> None:
        self._odometry, self._odometry_is_new = message, True
        if self._settings.use_odometry_yaw:
            self._attitude = transform_of(message.pose.pose).rotation

    def _on_imu(self, message: Imu) -> None:
        if self._odometry is None:  # which says what the frame of the robot is called
            return
        robot, sensor = self._odometry.child_frame_id, message.header.frame_id
        mounted = self._lookup(robot, sensor, nanoseconds(message.header.stamp))
        if mounted is None:
            self._complain(f"there is no transform from '{sensor}' to '{robot}': no heading")
            return
        turn = message.orientation
        attitude = (turn.x, turn.y, turn.z, turn.w)
        if any(attitude):
            self._attitude = without_mounting(attitude, mounted.rotation)

    def _on_fix(self, message: NavSatFix) -> None:
        place = (message.latitude, message.longitude, message.altitude)
        if message.status.status == NavSatStatus.STATUS_NO_FIX or not all(
            map(math.isfinite, place)
        ):
            return
        self._fix, self._fix_is_new = message, True
        if self._grid is None:
            self._first = message

    # --- cycle --------------------------------------------------------------------------------

    def _update(self) -> None:
        if self._grid is None and self._steady.now() >= self._begin:
            self._find_grid()
        elif self._grid is not None and self._odometry is not None:
            if self._fix_is_new and self._odometry_is_new:
                self._publish_odometry(self._odometry)
            if self._filtered is not None and self._odometry_is_new:
                self._publish_filtered(self._odometry)

    def _find_grid(self) -> None:
        """Take the datum, once all is known of it."""
        datum = self._datum()
        if datum is None:
            return
        given = self._settings
        try:
            grid = (
                LocalCartesian(replace(datum.point, altitude=0.0))
                if given.use_local_cartesian
                else self._zone or Utm.of(datum.point)
            )
        except ParameterError as error:
            self._complain(str(error))
            return
        heading = heading_of(datum, grid, given.magnetic_declination_radians + given.yaw_offset)
        self._grid, self._world_from_grid = grid, world_from_grid(datum, grid, heading)
        if self._imu is not None:
            self.destroy_subscription(self._imu)
            self._imu = None
        point, (x, y, _) = datum.point, grid.forward(datum.point)
        self.get_logger().info(
            f'Datum (latitude, longitude, altitude) is ({point.latitude:.2f}, '
            f'{point.longitude:.2f}, {point.altitude:.2f}); in the grid it is at ({x:.2f}, '
            f'{y:.2f}), and the heading is {heading:g}'
        )
        self._broadcast()

    def _datum(self) -> Datum | None:
        odometry, fix, attitude = self._odometry, self._first, self._attitude
        if odometry is None or self._manual is not None:
            return self._manual if odometry else None
        if fix is None or attitude is None:
            return None
        receiver = self._receiver(odometry, fix, 0)
        point = GeoPoint(fix.latitude, fix.longitude, fix.altitude)
        return Datum(point, attitude, transform_of(odometry.pose.pose), receiver)

    def _receiver(self, odometry: Odometry, fix: NavSatFix, time: int) -> Vector:
        """Return where the receiver is in the robot, m; its origin, if that is not known."""
        robot, frame = odometry.child_frame_id, fix.header.frame_id
        found = self._lookup(robot, frame, time) if frame else None
        if found is None:
            self._complain(
                f'Unable to obtain {robot} -> {frame} transform. '
                'Will assume navsat device is mounted at robots origin'
            )
            return (0.0, 0.0, 0.0)
        return found.translation

    def _broadcast(self) -> None:
        given, odometry = self._settings, self._odometry
        if odometry is None or not (
            given.broadcast_cartesian_transform or given.broadcast_utm_transform
        ):
            return
        parent, child = odometry.header.frame_id, self._grid_frame
        transform = self._world_from_grid
        if (
            given.broadcast_cartesian_transform_as_parent_frame
            or given.broadcast_utm_transform_as_parent_frame
        ):
            parent, child, transform = child, parent, transform.inverse()
        if given.zero_altitude:
            transform = Transform((*transform.translation[:2], 0.0), transform.rotation)
        now = self.get_clock().now().nanoseconds
        self._broadcaster.sendTransform(
            transform_message(StampedTransform(parent, child, now, transform))
        )

    @property
    def _grid_frame(self) -> str:
        return 'local_enu' if self._settings.use_local_cartesian else 'utm'

    def _publish_odometry(self, odometry: Odometry) -> None:
        fix, grid = self._fix, self._grid
        assert fix is not None and grid is not None
        self._fix_is_new = False
        x, y, z = self._world_of(GeoPoint(fix.latitude, fix.longitude, fix.altitude))
        time = nanoseconds(fix.header.stamp)
        receiver = self._receiver(odometry, fix, time)
        if any(receiver):
            robot = self._lookup(odometry.header.frame_id, odometry.child_frame_id, time)
            turn = (robot or transform_of(odometry.pose.pose)).rotation
            dx, dy, dz = rotate(turn, receiver)
            x, y, z = x - dx, y - dy, z - dz
        message = Odometry()
        message.header.frame_id = odometry.header.frame_id
        message.header.stamp = fix.header.stamp
        fill_pose(Transform((x, y, 0.0 if self._settings.zero_altitude else z)), message.pose.pose)
        covariance = np.zeros((6, 6))
        covariance[:3, :3] = _rotated(fix.position_covariance, self._world_from_grid.rotation)
        message.pose.covariance = covariance.ravel()
        self._gps_odometry.publish(message)

    def _publish_filtered(self, odometry: Odometry) -> None:
        self._odometry_is_new = False
        place = odometry.pose.pose.position
        point = self._point_of((place.x, place.y, place.z))
        message = NavSatFix(
            latitude=point.latitude, longitude=point.longitude, altitude=point.altitude
        )
        message.header.frame_id = odometry.child_frame_id
        message.header.stamp = odometry.header.stamp
        message.status.status = NavSatStatus.STATUS_GBAS_FIX
        whole = np.array(odometry.pose.covariance).reshape(6, 6)
        back = self._world_from_grid.inverse().rotation
        message.position_covariance = _rotated(whole[:3, :3], back).ravel()
        message.position_covariance_type = NavSatFix.COVARIANCE_TYPE_KNOWN
        assert self._filtered is not None
        self._filtered.publish(message)

    def _world_of(self, point: GeoPoint) -> Vector:
        assert self._grid is not None
        x, y, _ = self._grid.forward(point)
        return self._world_from_grid.apply((x, y, point.altitude))

    def _point_of(self, place: Vector) -> GeoPoint:
        assert self._grid is not None
        return self._grid.back(self._world_from_grid.inverse().apply(place))

    # --- services -----------------------------------------------------------------------------

    def _serve(self) -> None:
        self.create_service(SetDatum, 'datum', self._on_datum)
        self.create_service(ToLL, 'toLL', self._on_to_ll)
        self.create_service(FromLL, 'fromLL', self._on_from_ll)
        self.create_service(SetUTMZone, 'setUTMZone', self._on_zone)

    def _on_datum(
        self, request: SetDatum.Request, response: SetDatum.Response
    ) -> SetDatum.Response:
        """Take another datum."""
        place, turn = request.geo_pose.position, request.geo_pose.orientation
        point = GeoPoint(place.latitude, place.longitude, place.altitude)
        given = (point.latitude, point.longitude, point.altitude, turn.x, turn.y, turn.z, turn.w)
        if not all(map(math.isfinite, given)):
            self._complain(f'datum: what is no number, as in {point}, is no datum: it stays')
            return response
        self._manual = Datum(point, (turn.x, turn.y, turn.z, turn.w))
        self._grid = None
        return response

    def _on_zone(
        self, request: SetUTMZone.Request, response: SetUTMZone.Response
    ) -> SetUTMZone.Response:
        """Keep to a zone, as 31U, and take the next fix as datum."""
        found = _ZONE.fullmatch(request.utm_zone)
        if found is None:
            self._complain(f"'{request.utm_zone}' is no zone of UTM, as 31U is")
            return response
        self._zone = Utm(int(found[1]), found[2] >= 'N')
        self._grid = self._first = self._manual = None
        return response

    def _on_to_ll(self, request: ToLL.Request, response: ToLL.Response) -> ToLL.Response:
        """Answer where a place of the world is on the earth."""
        if self._grid is not None:
            place = request.map_point
            point = self._point_of((place.x, place.y, place.z))
            found = response.ll_point
            found.latitude, found.longitude = point.latitude, point.longitude
            found.altitude = point.altitude
        return response

    def _on_from_ll(self, request: FromLL.Request, response: FromLL.Response) -> FromLL.Response:
        """Answer where a point of the earth is in the world."""
        if self._grid is not None:
            asked, found = request.ll_point, response.map_point
            point = GeoPoint(asked.latitude, asked.longitude, asked.altitude)
            found.x, found.y, found.z = self._world_of(point)
        return response

    # --- what it needs ------------------------------------------------------------------------

    def _lookup(self, target: str, source: str, time: int) -> Transform | None:
        """Return a transform at a time, else the latest; None: there is none."""
        if target == source:
            return Transform()
        timeout = round(self._settings.transform_timeout * NANOSECONDS)
        return transform_at(self._buffer, target, source, time, timeout)

    def _complain(self, text: str) -> None:
        self.get_logger().error(text, throttle_duration_sec=_QUIET)


def _rotated(covariance: Any, rotation: Quaternion) -> NDArray[np.float64]:
    """Return a covariance of a place, (3, 3), along other axes."""
    turn = np.array(matrix_from_quaternion(rotation))
    return turn @ np.array(covariance, dtype=float).reshape(3, 3) @ turn.T


def main(args: list[str] | None = None) -> int:
    """Publish until Ctrl-C."""
    if print_help(args, 'navsat_transform_node', PURPOSE, NavsatParameters):
        return 0
    return run(NavsatTransformNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
