# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``navsat_transform_node`` over DDS: fixes in, odometry out; what its services answer."""

from contextlib import contextmanager
import math

from geographic_msgs.msg import GeoPoint as Point, GeoPose
from geometry_msgs.msg import Point as Place, Quaternion
from nav_msgs.msg import Odometry
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from robot_localization.srv import FromLL, SetDatum, SetUTMZone, ToLL
from sensor_msgs.msg import Imu, NavSatFix
from support.running_programs import PATIENCE

from amr_description.errors import ParameterError
from amr_description.navigation.navsat import GeoPoint, LocalCartesian, Utm
from amr_description.nodes.navsat_transform_node import NavsatTransformNode
from amr_description.ros.runtime import argument_errors

HOME = LocalCartesian(GeoPoint(48.0, 11.0))
KEPT = QoSProfile(depth=10)


@contextmanager
def graph(**parameters):
    """Have a node, and what sends it messages and hears it."""
    words = [f'{name}:={value}' for name, value in parameters.items()]
    rclpy.init(args=['--ros-args', *(word for each in words for word in ('-p', each))])
    executor = SingleThreadedExecutor()
    nodes = []
    try:
        tester = Node('tester', use_global_arguments=False)
        nodes.append(tester)
        nodes.append(NavsatTransformNode())
        for each in nodes:
            executor.add_node(each)
        yield Talk(executor, tester)
    finally:
        executor.shutdown()
        for each in nodes:
            each.destroy_node()
        rclpy.try_shutdown()


class Talk:
    """Sends the newest of each topic until something has come."""

    def __init__(self, executor, tester):
        self._executor, self._tester = executor, tester
        self._send = {
            kind: tester.create_publisher(kind, topic, KEPT).publish
            for kind, topic in (
                (Odometry, 'odometry/filtered'), (NavSatFix, 'gps/fix'), (Imu, 'imu')
            )
        }  # fmt: skip
        self.heard = {Odometry: [], NavSatFix: []}
        tester.create_subscription(Odometry, 'odometry/gps', self.heard[Odometry].append, KEPT)
        tester.create_subscription(NavSatFix, 'gps/filtered', self.heard[NavSatFix].append, KEPT)

    def ask(self, kind, service, **fields):
        """Return the answer of a service."""
        client = self._tester.create_client(kind, service)
        assert client.wait_for_service(PATIENCE)
        future = client.call_async(kind.Request(**fields))
        self._executor.spin_until_future_complete(future, PATIENCE)
        return future.result()

    def until(self, heard, *messages):
        """Send these over and over until a message that satisfies a condition has come."""
        end = self._tester.get_clock().now().nanoseconds + PATIENCE * 1e9
        while True:
            for kind, found in self.heard.items():
                for each in found:
                    if isinstance(each, kind) and heard(each):
                        return each
            assert self._tester.get_clock().now().nanoseconds < end, self.heard
            for each in messages:
                self._send[type(each)](each)
            self._executor.spin_once(timeout_sec=0.02)


def fix(east, north, up=0.0):
    point = HOME.back((east, north, up))
    message = NavSatFix(
        latitude=point.latitude, longitude=point.longitude, altitude=point.altitude
    )
    message.header.frame_id = 'base_link'
    message.position_covariance = [1.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 9.0]
    return message


def odometry(x=0.0, y=0.0):
    message = Odometry(child_frame_id='base_link')
    message.header.frame_id = 'odom'
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.w = 1.0
    return message


def imu(yaw):
    message = Imu()
    message.header.frame_id = 'base_link'
    message.orientation.z, message.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def is_odometry_at(x, y):
    def heard(message):
        place = getattr(message, 'pose', None) and message.pose.pose.position
        return place and math.hypot(place.x - x, place.y - y) < 1e-3

    return heard


@pytest.mark.parametrize('local', [True, False])
def test_a_fix_to_the_north_is_ahead_of_who_looks_north(local):
    with graph(frequency=200.0, use_local_cartesian=str(local).lower()) as talk:
        begin = (odometry(), fix(0.0, 0.0), imu(math.pi / 2))
        talk.until(is_odometry_at(0.0, 0.0), *begin)
        scale = 1.0 if local else math.dist((0, 0), utm_step())
        found = talk.until(is_odometry_at(10.0 * scale, 0.0), odometry(), fix(0.0, 10.0, 3.0))
        assert (found.header.frame_id, found.child_frame_id) == ('odom', '')
        assert found.pose.pose.position.z == pytest.approx(3.0, abs=1e-3)
        assert found.pose.pose.orientation.w == 1.0
        # What was to the north is ahead now.
        assert [found.pose.covariance[i] for i in (0, 7, 14)] == pytest.approx(
            [4.0, 1.0, 9.0], abs=0.01
        )
        back = HOME.back((0.0, 10.0, 0.0))

        def is_back(message):
            return (
                isinstance(message, NavSatFix)
                and abs(message.latitude - back.latitude) < 1e-8
                and abs(message.longitude - back.longitude) < 1e-8
            )

        filtered = talk.until(is_back, odometry(10.0 * scale, 0.0))
        assert filtered.header.frame_id == 'base_link'
        point = Point(latitude=back.latitude, longitude=back.longitude, altitude=2.0)
        place = talk.ask(FromLL, 'fromLL', ll_point=point).map_point
        assert (place.x, place.z) == pytest.approx((10.0 * scale, 2.0), abs=1e-3)
        again = talk.ask(ToLL, 'toLL', map_point=Place(x=10.0 * scale)).ll_point
        assert again.latitude == pytest.approx(back.latitude, abs=1e-8)


def utm_step():
    """How long a metre is in UTM there."""
    zone = Utm(32, True)
    (ax, ay, _), (bx, by, _) = (zone.forward(HOME.back((0.0, n, 0.0))) for n in (0.0, 1.0))
    return (bx - ax, by - ay)


def test_a_datum_of_the_parameters_needs_no_imu():
    with graph(
        frequency=200.0, wait_for_datum='true', datum='[48.0, 11.0, 0.0]',
        use_local_cartesian='true', zero_altitude='true',
    ) as talk:  # fmt: skip
        found = talk.until(is_odometry_at(5.0, 2.0), odometry(), fix(5.0, 2.0, 7.0))
        assert found.pose.pose.position.z == 0.0
        north = Quaternion(z=math.sqrt(0.5), w=math.sqrt(0.5))
        place = Point(latitude=48.0, longitude=11.0)
        talk.ask(SetDatum, 'datum', geo_pose=GeoPose(position=place, orientation=north))
        talk.until(is_odometry_at(2.0, -5.0), odometry(), fix(5.0, 2.0))
        nowhere = GeoPose(position=Point(longitude=math.nan), orientation=north)
        talk.ask(SetDatum, 'datum', geo_pose=nowhere)
        talk.heard[Odometry].clear()
        talk.until(is_odometry_at(2.0, -5.0), odometry(), fix(5.0, 2.0))


def test_a_zone_that_is_kept():
    with graph(frequency=200.0, use_odometry_yaw='true') as talk:
        talk.until(is_odometry_at(0.0, 0.0), odometry(), fix(0.0, 0.0))
        first = talk.ask(ToLL, 'toLL', map_point=Place(y=1000.0)).ll_point
        for zone in ('nowhere', '33U'):
            talk.ask(SetUTMZone, 'setUTMZone', utm_zone=zone)
            talk.heard[Odometry].clear()
            talk.until(is_odometry_at(0.0, 0.0), odometry(), fix(0.0, 0.0))
        # North in the grid of the next zone is elsewhere, and odometry says nothing of it.
        second = talk.ask(ToLL, 'toLL', map_point=Place(y=1000.0)).ll_point
        assert second.longitude == pytest.approx(first.longitude, abs=1e-4)
        assert second.latitude != first.latitude


def test_a_datum_that_is_none_is_one_line():
    with (
        pytest.raises(ParameterError, match="'datum' has 2 elements"),
        argument_errors(),
        graph(wait_for_datum='true', datum='[48.0, 11.0]'),
    ):
        pass
