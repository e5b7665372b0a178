# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""map → odom by scans of a room, over DDS, with amcl's topics."""

from math import radians

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid
import numpy as np
import pytest
from rclpy.qos import qos_profile_sensor_data, QoSProfile
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from support.localizer_host import hosted, MS
from support.scanned_room import ANGLES, room, scan

from amr_description.maps.pose import Pose
from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.navigation.ros.messages import grid_message
from amr_description.nodes import scan_localizer
from amr_description.nodes.scan_localizer import ScanLocalizer
from amr_description.ros.messages import fill_stamp, nanoseconds
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import ask_until_answered

TOLERANCE = 200 * MS
LIDAR = Pose(0.2, 0.0, 0.0)
"""In the frame of the base."""
BEGIN = Pose(-2.0, 1.5, 0.3)


class Room:
    """The robot in the room: its scans and its odometry, at a stamp."""

    def __init__(self, host, *, has_map=True):
        self.host = host
        self.begin = BEGIN
        """Where odometry began, in the frame of the map."""
        self.maps = host.node.create_publisher(OccupancyGrid, 'map', LATCHED)
        self.scans = host.node.create_publisher(LaserScan, 'scan', qos_profile_sensor_data)
        host.send_static('base_footprint', 'lidar_link', Transform((LIDAR.x, LIDAR.y, 0.25)))
        host.wait_for_subscribers(self.scans, self.maps)
        if has_map:
            self.maps.publish(grid_message(room()))

    def send(self, stamp, pose, odometry=None, ranges=None):
        """Scan at a pose of the base in the room; odometry is exact unless it is given."""
        message = LaserScan(
            angle_min=ANGLES[0], angle_max=ANGLES[-1], angle_increment=ANGLES[1] - ANGLES[0]
        )
        message.range_min, message.range_max = 0.1, 12.0
        fill_stamp(stamp, message.header.stamp)
        message.header.frame_id = 'lidar_link'
        seen = scan(pose.compose(LIDAR)) if ranges is None else ranges
        message.ranges.frombytes(np.asarray(seen, np.float32).tobytes())
        self.scans.publish(message)
        known = self.begin.inverse().compose(pose) if odometry is None else odometry
        self.host.send_odometry(stamp, known)

    def localized(self, stamp, pose, **arguments):
        """Scan at later and later stamps until there is a pose; return its stamp."""
        sent, found = [], []

        def send():
            sent.append(stamp + len(sent) * 100 * MS)
            self.send(sent[-1], pose, **arguments)

        def is_there():
            stamps = {nanoseconds(each.header.stamp) for each in self.host.poses}
            found[:] = sorted(stamps.intersection(sent))
            return found

        send()
        # Again only while map or initial pose have not been heard: none is to be under way still.
        self.host.wait(is_there, send)
        return found[0]


def near(pose: Pose, angle: float = 0.01):
    return pytest.approx(pose, abs=max(0.02, angle))


def test_an_initial_pose_and_a_scan_give_the_pose_with_amcls_qos():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        host.send_initial_pose(Pose(-1.6, 1.2, 0.1), variances=(0.25, 0.25, 0.07))
        stamp = robot.localized(1000 * MS, BEGIN)
        assert host.pose(stamp) == near(BEGIN)
        assert host.map_to_odom(stamp + TOLERANCE) == near(BEGIN)
        late = []
        host.node.create_subscription(
            PoseWithCovarianceStamped,
            'amcl_pose',
            late.append,
            QoSProfile(depth=1, durability=LATCHED.durability),
        )
        host.wait(lambda: late)
        covariance = late[0].pose.covariance
        assert 0.0 < covariance[0] < 0.03**2
        assert 0.0 < covariance[35] < radians(1.0) ** 2
        assert (late[0].header.frame_id, host.transforms[0].child_frame_id) == ('map', 'odom')


def test_a_drive_whose_odometry_errs_is_followed_from_the_parameters_on():
    begin = ['set_initial_pose:=true', 'initial_pose.x:=-2.0', 'initial_pose.y:=1.5']
    words = [word for each in (*begin, 'initial_pose.yaw:=0.3') for word in ('-p', each)]
    with hosted(ScanLocalizer, *words, hears_truth=False) as host:
        robot = Room(host)
        stamp = robot.localized(1000 * MS, BEGIN) + 100_000 * MS
        true, odometry = BEGIN, Pose(0.0, 0.0, 0.0)
        for _ in range(20):
            stamp += 100 * MS
            true = true.compose(Pose(0.08, 0.0, -0.04))
            odometry = odometry.compose(Pose(0.088, 0.0, -0.05))
            robot.send(stamp, true, odometry)
            assert host.pose(stamp) == near(true)
            assert host.map_to_odom(stamp + TOLERANCE).compose(odometry) == near(true)


def test_the_lidar_may_hang_upside_down():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        turned = quaternion_from_rpy(radians(180.0), 0.0, 0.0)
        host.send_static('base_footprint', 'lidar_link', Transform((0.2, 0.0, 0.9), turned))
        host.send_initial_pose(BEGIN, variances=(0.01, 0.01, 0.01))
        seen = scan(BEGIN.compose(LIDAR))
        # The angles are about the lidar's own z axis, which points down.
        upside_down = np.concatenate([seen[:1], seen[:0:-1]])
        stamp = robot.localized(1000 * MS, BEGIN, ranges=upside_down)
        assert host.pose(stamp) == near(BEGIN)


def test_after_a_reset_it_begins_where_odometry_began():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        host.send_initial_pose(BEGIN, variances=(0.01, 0.01, 0.01))
        robot.localized(5050 * MS, BEGIN)
        there = BEGIN.compose(Pose(0.5, 0.0, 0.0))
        stamp = robot.localized(100 * MS, there)
        assert host.pose(stamp) == near(there)


def test_a_robot_that_stands_is_matched_again_when_it_is_asked_for():
    with hosted(
        ScanLocalizer, '-p', 'update_min_d:=0.25', '-p', 'update_min_a:=0.2', hears_truth=False
    ) as host:
        robot = Room(host)
        host.send_initial_pose(BEGIN, variances=(0.01, 0.01, 0.01))
        first = robot.localized(1000 * MS, BEGIN)
        stamp = first + 200_000 * MS
        robot.send(stamp, BEGIN)
        host.map_to_odom(stamp + TOLERANCE)  # the transform comes with each scan
        assert nanoseconds(host.poses[-1].header.stamp) == first
        client = host.node.create_client(Empty, 'request_nomotion_update')
        assert ask_until_answered(host.node, client, Empty.Request()) is not None
        robot.send(stamp + 100 * MS, BEGIN)
        assert host.pose(stamp + 100 * MS) == near(BEGIN)


def test_a_scan_that_does_not_fit_is_said():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        host.send_initial_pose(BEGIN, variances=(0.01, 0.01, 0.01))
        robot.localized(1000 * MS, BEGIN)
        robot.localized(300_000 * MS, BEGIN, ranges=np.full(360, 0.6))
        assert 'The pose is that of odometry' in host.line('does not fit the map')


def test_how_well_the_scan_fits_is_said_of_each_pose_that_is_given():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        host.send_initial_pose(BEGIN, variances=(0.01, 0.01, 0.01))
        robot.localized(1000 * MS, BEGIN)
        assert '100% end at something of it' in host.line('the scan fits the map at -2.00 1.50')
        sure = host.poses[-1].pose.covariance[0]
        ranges = scan(BEGIN.compose(LIDAR))
        ranges[:220] = 0.6  # somebody stands around it
        robot.localized(300_000 * MS, BEGIN, ranges=ranges)
        assert '/initialpose says where' in host.line('the scan fits little of the map')
        assert host.poses[-1].pose.covariance[0] > 4 * sure
        host.send_initial_pose(BEGIN, variances=(0.01, 0.01, 0.01))
        robot.localized(600_000 * MS, BEGIN)
        host.wait(lambda: sum('the scan fits the map' in line for line in host.log) == 2)


@pytest.mark.parametrize(
    ('sends', 'said'),
    [
        ([], 'nothing is on /map; map_server publishes it'),
        (['map'], 'nothing is on /scan; scan_topic names another topic'),
        (['map', 'scan'], 'please set the initial pose: on /initialpose'),
    ],
)
def test_what_is_missing_is_said(monkeypatch, sends, said):
    complaints = []
    monkeypatch.setattr(
        scan_localizer, 'after', lambda node, seconds, call: complaints.append((node, call))
    )
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host, has_map='map' in sends)

        def is_said():
            if 'scan' in sends:
                robot.send(1000 * MS, BEGIN)
            complaints[0][1]()
            return any(said in line for line in host.log)

        host.wait(is_said)


@pytest.mark.parametrize('stamp', [(-1, 0), (-(2**31), 7), (5, 10**9), (5, 2**32 - 1)])
def test_a_scan_whose_stamp_is_no_time_is_left_out_with_a_warning(stamp):
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        message = LaserScan()
        message.header.stamp.sec, message.header.stamp.nanosec = stamp
        robot.scans.publish(message)
        line = f'a scan is left out: its stamp, {stamp[0]} s and {stamp[1]} ns, is no time'
        host.wait(lambda: line in host.log)
        host.send_initial_pose(BEGIN)
        assert host.pose(robot.localized(1000 * MS, BEGIN)) == near(BEGIN)


def test_an_initial_pose_whose_stamp_is_no_time_is_left_out():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host)
        host.send_initial_pose(Pose(5.0, 5.0, 0.0), stamp=-1000 * MS)
        line = 'an initial pose is left out: its stamp, -1 s and 0 ns, is no time'
        host.wait(lambda: line in host.log)
        host.send_initial_pose(BEGIN)
        assert host.pose(robot.localized(1000 * MS, BEGIN)) == near(BEGIN)


def test_what_is_no_map_is_ignored():
    with hosted(ScanLocalizer, hears_truth=False) as host:
        robot = Room(host, has_map=False)
        robot.maps.publish(OccupancyGrid())
        host.line('Ignoring a map of 0 x 0 cells of 0 m')
        torn = grid_message(room())
        torn.data.pop()
        robot.maps.publish(torn)
        host.line(' have come')
        robot.maps.publish(grid_message(room()))
        host.send_initial_pose(BEGIN)
        robot.localized(1000 * MS, BEGIN)
