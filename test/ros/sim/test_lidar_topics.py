# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Lidars over DDS, in a world that is stepped by hand."""

from contextlib import contextmanager
from dataclasses import replace
import math
import threading

from fixtures.sim.driving import AMR
import numpy as np
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data, QoSProfile
from sensor_msgs.msg import LaserScan, PointCloud2, Range
from support.running_programs import PATIENCE

from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, NodeTopics
from amr_description.model.frames import Transform
from amr_description.model.gazebo.tags import Noise
from amr_description.model.sensors import Lidar, ScanAxis, SensorMount
from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import wait_until
from amr_description.sensor_msgs_py.point_cloud2 import read_points
from amr_description.sim.lidar import SimulatedLidar
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics import lidar
from amr_description.simulation.topics.sensor_manager import SensorManager

MS = 1_000_000
TURN = 10 * MS
"""ns, of the loop."""
MOUNT = SensorMount('lidar', 'base_link', Transform((0.0, 0.0, 0.2)), 'base_scan', 10.0)
LIDAR = Lidar(MOUNT, ScanAxis(360, -3.14, 3.14), range_min=0.12, range_max=12.0)


class Host:
    """World and topics, as the simulator has them; ``turn`` is its loop."""

    def __init__(self):
        self.node = Node('host')
        self.lines, self.is_paced = [], False
        self.world = MujocoWorld('warehouse')
        self.loop_publisher = ClockedLoopPublisher(self.node, look_period=0)
        self.sensors = SensorManager(
            NodeTopics(self.node, self.loop_publisher),
            self.world,
            self.log,
            lambda: self.is_paced,
            begin_thread=lambda: None,
        )

    def log(self, severity, text, *, throttle=0.0):
        self.lines.append(text)

    def spawn(self, name, namespace, *sensors, pose=None):
        self.world.spawn(name, AMR, pose or Transform())
        self.sensors.add(name, namespace, sensors)

    def remove(self, name):
        self.world.remove(name)
        self.sensors.remove(name)

    def turn(self, count=1):
        for _ in range(count):
            self.world.advance(TURN)
            self.loop_publisher.publish(self.world.time)

    @contextmanager
    def heard(self, message_type, topic, qos=qos_profile_sensor_data):
        """The list of messages on a topic, from the time on when the publisher knows of us."""
        messages = []
        before = self.node.count_subscribers(topic)
        subscription = self.node.create_subscription(message_type, topic, messages.append, qos)
        self.wait(lambda: self.node.count_subscribers(topic) > before)
        self.wait(lambda: subscription.get_publisher_count() == self.node.count_publishers(topic))
        publisher = next(p for p in self.node.publishers if p.topic_name == topic)
        self.wait(lambda: publisher.get_subscription_count() > 0)
        yield messages
        self.node.destroy_subscription(subscription)

    def wait(self, condition):
        assert wait_until(self.node, lambda: condition() or None, timeout=PATIENCE)

    def next(self, messages, count=1):
        """Turn as long as ``count`` scans at 10 Hz take, and wait for these."""
        already = len(messages)
        self.turn(10 * count)
        self.wait(lambda: len(messages) >= already + count)
        return messages[already:]


@pytest.fixture
def host():
    rclpy.init(args=[])
    host = Host()
    yield host
    host.sensors.close()
    host.node.destroy_node()
    rclpy.try_shutdown()


@pytest.mark.parametrize('topic', ['/clock', '/taken', f'/{"a" * 300}'])
def test_a_topic_that_cannot_be_made_is_a_line_and_the_other_sensors_measure(host, topic):
    host.node.create_publisher(Range, '/taken', 10)
    bad = replace(LIDAR, points_topic=topic, scan_topic='bad')
    host.spawn('amr', '/', bad, LIDAR)
    [line] = host.lines
    assert line.startswith("sensor 'lidar' of 'amr' measures nothing: ")
    assert line.endswith('; give it another <topic>, or its robot a namespace')
    assert topic in line
    assert 'publisher.c' not in line
    assert '\n' not in line
    assert [each.topic_name for each in host.node.publishers].count('/bad') == 0
    with host.heard(LaserScan, '/scan') as scans:
        host.next(scans)


@pytest.mark.parametrize('qos', [qos_profile_sensor_data, QoSProfile(depth=10)])
def test_a_scan_is_what_the_description_says(host, qos):
    host.spawn('amr', '/', LIDAR)
    with host.heard(LaserScan, '/scan', qos) as scans:
        first, second = host.next(scans, 2)
    assert [nanoseconds(each.header.stamp) for each in (first, second)] == [100 * MS, 200 * MS]
    assert first.header.frame_id == 'base_scan'
    assert (first.angle_min, first.angle_max) == pytest.approx((-3.14, 3.14))
    assert first.angle_increment == pytest.approx(6.28 / 359)
    assert (first.range_min, first.range_max) == pytest.approx((0.12, 12.0))
    assert (first.scan_time, first.time_increment) == (0.0, 0.0)
    assert len(first.ranges) == len(first.intensities) == 360
    assert first.ranges[0] == pytest.approx(6.0, abs=0.05), 'the west wall'
    assert min(first.intensities) > 0.0


RINGS = replace(
    LIDAR,
    vertical=ScanAxis(4, -0.15, 0.15),
    points_topic='scan/points',
    range_topic='nearest',
    radiation_type=0,
)


def test_points_are_those_of_the_ranges(host):
    host.spawn('amr', '/', RINGS)
    with (
        host.heard(LaserScan, '/scan') as scans,
        host.heard(PointCloud2, '/scan/points') as clouds,
        host.heard(Range, '/nearest') as ranges,
    ):
        (scan,), (cloud,), (nearest,) = (host.next(each) for each in (scans, clouds, ranges))
    assert (cloud.header.stamp, cloud.header.frame_id) == (scan.header.stamp, 'base_scan')
    assert (cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (4, 360, 32, 360 * 32)
    layout = [(field.name, field.offset, field.datatype, field.count) for field in cloud.fields]
    assert layout == [
        ('x', 0, 7, 1),
        ('y', 4, 7, 1),
        ('z', 8, 7, 1),
        ('intensity', 16, 7, 1),
        ('ring', 24, 4, 1),
    ]
    points = read_points(cloud).reshape(4, 360)
    assert (points['ring'] == np.arange(4)[:, None]).all()
    distances = np.sqrt(points['x'] ** 2 + points['y'] ** 2 + points['z'] ** 2)
    assert distances[2] == pytest.approx(np.array(scan.ranges), rel=1e-5), 'of the middle ring'
    elevations = np.arctan2(points['z'], np.hypot(points['x'], points['y']))
    assert elevations[0] == pytest.approx(np.full(360, -0.15), abs=1e-5)
    assert elevations[3] == pytest.approx(np.full(360, 0.15), abs=1e-5)
    azimuths = np.arctan2(points['y'], points['x'])
    assert azimuths[1] == pytest.approx(np.linspace(-3.14, 3.14, 360), abs=1e-5)
    assert cloud.is_dense

    assert nearest.range == pytest.approx(float(distances.min()), rel=1e-5)
    assert nearest.field_of_view == pytest.approx(6.28)
    assert (nearest.min_range, nearest.max_range) == pytest.approx((0.12, 12.0))
    assert nearest.radiation_type == Range.ULTRASOUND


def test_the_other_thread_measures_the_same(host, monkeypatch):
    noisy = replace(RINGS, noise=Noise(stddev=0.01))
    measured = []
    for most_rays in (10_000, 0):
        monkeypatch.setattr(lidar, 'MOST_RAYS', most_rays)
        host.spawn('amr', '/', noisy)
        with (
            host.heard(LaserScan, '/scan') as scans,
            host.heard(PointCloud2, '/scan/points') as clouds,
        ):
            host.next(scans, 2)
            host.wait(lambda: len(clouds) == 2)
        measured.append([bytes(each.data) for each in clouds])
        measured[-1] += [each.ranges.tobytes() for each in scans]
        host.remove('amr')
        host.world.reset()
        host.turn()
        host.world.reset()
    assert len(measured[0]) == 4
    assert measured[0] == measured[1]


def test_a_lidar_whose_rays_take_long_leaves_the_control_thread(host, monkeypatch):
    monkeypatch.setattr(lidar, 'LONGEST', 0.0)
    threads, measure = [], SimulatedLidar.measure

    def noted(*arguments):
        threads.append(threading.current_thread().name)
        return measure(*arguments)

    monkeypatch.setattr(SimulatedLidar, 'measure', noted)
    host.spawn('amr', '/', LIDAR)
    here = threading.current_thread().name
    with host.heard(LaserScan, '/scan') as scans:
        host.next(scans, 3)
        # Where time waits the order of messages shall not depend on the processor.
        assert threads == [here, here, here]
        host.is_paced = True
        for count in (4, 5):
            # A scan that is due before the thread has noted the end of the last is left out.
            host.wait(lambda count=count: host.turn() or len(scans) >= count)
    assert threads[:5] == [here, here, here, 'sensors', 'sensors']
    assert set(threads[5:]) <= {'sensors'}


def test_lidars_of_many_robots_share_both_threads(host, monkeypatch):
    threads, measure = [], SimulatedLidar.measure

    def noted(*arguments):
        threads.append(threading.current_thread().name)
        return measure(*arguments)

    monkeypatch.setattr(SimulatedLidar, 'measure', noted)
    wide = replace(LIDAR, horizontal=ScanAxis(lidar.MOST_RAYS, -3.0, 3.0))
    host.spawn('one', '/one', wide)
    host.spawn('two', '/two', wide, pose=Transform((2.0, 0.0, 0.2)))
    with host.heard(LaserScan, '/one/scan') as one, host.heard(LaserScan, '/two/scan') as two:
        host.next(one, 2)
        host.wait(lambda: len(two) == 2)
    assert threads == [threading.current_thread().name, 'sensors'] * 2


def test_a_robot_that_goes_while_its_lidar_is_in_work(host, monkeypatch):
    monkeypatch.setattr(lidar, 'MOST_RAYS', 0)
    host.is_paced = True
    may_go_on, made = threading.Event(), []
    measure = SimulatedLidar.measure

    def wait_and_measure(*arguments):
        assert may_go_on.wait(PATIENCE)
        made.append(measure(*arguments))
        return made[-1]

    monkeypatch.setattr(SimulatedLidar, 'measure', wait_and_measure)
    host.spawn('amr', '/', RINGS)
    with host.heard(LaserScan, '/scan') as scans:
        host.turn(40)
    host.remove('amr')
    host.turn()
    may_go_on.set()
    host.wait(lambda: made)
    host.sensors.close()
    assert not scans
    assert host.lines == []  # the first may take its time


def test_points_without_a_range_are_nan(host):
    host.spawn('amr', '/', replace(RINGS, range_max=3.0))
    with (
        host.heard(PointCloud2, '/scan/points') as clouds,
        host.heard(Range, '/nearest') as ranges,
    ):
        (cloud,), _ = host.next(clouds), host.next(ranges)
    assert not cloud.is_dense
    is_nan = np.isnan(read_points(cloud)['x'])
    assert 0 < is_nan.sum() < len(is_nan)
    assert len(read_points(cloud, skip_nans=True)) == (~is_nan).sum()


def test_a_range_finder_that_meets_nothing_says_inf(host):
    up = Transform.from_xyz_rpy((0.0, 0.0, 0.2), (0.0, -math.pi / 2.0, 0.0))
    host.spawn(
        'amr',
        '/',
        Lidar(
            replace(MOUNT, pose=up),
            ScanAxis(3, -0.1, 0.1),
            range_max=4.0,
            scan_topic='',
            range_topic='range',
        ),
    )
    with host.heard(Range, '/range') as ranges:
        (nearest,) = host.next(ranges)
    assert nearest.range == math.inf
    assert host.node.count_publishers('/scan') == 0


def test_a_namespace_is_before_topic_and_frame(host):
    host.spawn('amr', '/robot1', replace(LIDAR, scan_topic='front/scan'))
    with host.heard(LaserScan, '/robot1/front/scan') as scans:
        (scan,) = host.next(scans)
    assert scan.header.frame_id == 'robot1/base_scan'


def test_robots_that_come_and_go_are_seen_and_not_seen(host):
    host.spawn('amr', '/', LIDAR)
    with host.heard(LaserScan, '/scan') as scans:
        (alone,) = host.next(scans)
        host.spawn('other', '/other', LIDAR, pose=Transform((2.0, 0.0, 0.2)))
        (together,) = host.next(scans)
        host.remove('other')
        (again,) = host.next(scans)
    is_nearer = np.array(together.ranges) < np.array(alone.ranges) - 0.1
    assert 5 < is_nearer.sum() < 60
    assert np.array(together.ranges)[is_nearer].min() == pytest.approx(1.7, abs=0.1)
    assert list(again.ranges) == pytest.approx(list(alone.ranges), abs=1e-3)


def test_a_robot_that_goes_takes_its_topics_away(host):
    host.spawn('amr', '/', LIDAR)
    host.wait(lambda: host.node.count_publishers('/scan') == 1)
    host.remove('amr')
    host.wait(lambda: host.node.count_publishers('/scan') == 0)
    host.turn(20)


def test_nothing_is_measured_that_nobody_hears(host, monkeypatch):
    monkeypatch.setattr(MujocoWorld, 'ray_scene', None)
    host.spawn('amr', '/', LIDAR)
    host.turn(30)


def test_a_sensor_without_its_link_is_one_line(host):
    host.spawn('amr', '/', replace(LIDAR, mount=replace(MOUNT, link='nose')))
    host.turn(20)
    (line,) = host.lines
    assert line.startswith("sensor 'lidar' of 'amr' measures nothing: robot 'amr': there is no li")


def test_a_reset_begins_the_noise_anew(host):
    host.spawn('amr', '/', replace(LIDAR, noise=Noise(stddev=0.01)))
    with host.heard(LaserScan, '/scan') as scans:
        host.next(scans, 3)
        host.world.reset()
        host.next(scans, 4)  # one at once
    runs = {}
    for scan in scans:
        runs.setdefault(nanoseconds(scan.header.stamp), []).append(scan.ranges.tobytes())
    for time in (100 * MS, 200 * MS, 300 * MS):
        first, second = runs[time]
        assert first == second
    assert len({first for first, *_ in runs.values()}) == len(runs)
    assert math.isfinite(sum(scans[0].ranges))
