# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Scan, TF, stamps and odometry fit together: a robot drives through the warehouse in lock-step, and
is localized by its scans, and by the truth.
"""

from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from itertools import islice
from math import degrees, hypot

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from support.paths import ROOT
from support.ros_processes import running
from support.warehouse_tour import tour

from amr_description.maps.pose import Pose, wrapped
from amr_description.model.frames import Transform
from amr_description.navigation.localization import MotionNoise, ray_ends, ScanTracker
from amr_description.navigation.ros.messages import plane_pose, pose_message, pose_of
from amr_description.navigation.scan_matching import ScanMatcher
from amr_description.ros.messages import nanoseconds
from amr_description.sim.occupancy import map_of_world
from amr_description.simulation.readings import Motion
from amr_description.testing.simulation import Simulation
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

URDF = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
CLOSE = 0.03
"""m."""
STRAIGHT = 1.0
"""degrees."""
SCANS, CYCLE = 0.1, 0.01
"""s between two scans, and two control cycles."""
ALL_KEPT = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""Where each message is looked for by its stamp, none may take the place of one before."""

pytest_plugins = ['amr_description.testing.fixtures']


@pytest.fixture
def sim(simulation):
    return simulation(URDF, world='warehouse')


def planar(motion: Motion) -> Pose:
    return Pose(motion.x, motion.y, motion.yaw)


def errors(found: Pose, true: Pose) -> tuple[float, float]:
    """How far apart, m, and turned, degrees."""
    return hypot(found.x - true.x, found.y - true.y), abs(degrees(wrapped(found.yaw - true.yaw)))


@pytest.mark.parametrize('scans', [40, pytest.param(500, marks=pytest.mark.long)])
def test_the_pose_by_scans_is_within_3_cm_and_1_degree_of_the_truth(sim, scans):
    tracker = ScanTracker(ScanMatcher(map_of_world('warehouse')), MotionNoise())
    sim.run(0.1)
    # Odometry is of the beginning of every second control cycle, and there at its end.
    sim.run(sim.odometry.time + 10 * CYCLE - sim.time)
    tracker.place(Pose(0.3, -0.2, 0.1), np.zeros((3, 3)), Pose(0.0, 0.0, 0.0))
    found = []
    for truth in islice(tour(sim, 9 * CYCLE), scans):
        scan = sim.scan
        sim.run(CYCLE)
        odometry = sim.odometry
        assert scan.time == odometry.time == truth.time
        points = ray_ends(
            scan.ranges, scan.angles, nearest=scan.range_min, farthest=scan.range_max, most=180
        )
        match = tracker.update(points, planar(odometry))
        found.append((*errors(match.pose, planar(truth)), match.fit))
    distance, angle, fit = np.array(found).T
    print(f'{len(found)} scans: {distance.max()} m, {angle.max()} degrees, fit {fit.min()}')
    assert len(found) == scans
    assert distance.max() < CLOSE
    assert angle.max() < STRAIGHT
    assert fit.min() > 0.9


class Listener:
    """What a user of map → odom knows, of the robot in a namespace."""

    def __init__(self, sim: Simulation, namespace: str = '') -> None:
        self._sim = sim
        self.buffer = Buffer()
        self._tf = TransformListener(self.buffer, sim.node)
        self.poses: list[PoseWithCovarianceStamped] = []
        self.truths: dict[int, Pose] = {}
        """The ground truth by its stamp, ns."""
        node = sim.node
        node.create_subscription(
            PoseWithCovarianceStamped, f'{namespace}/amcl_pose', self.poses.append, ALL_KEPT
        )
        topic = f'{namespace}/ground_truth/odom'
        node.create_subscription(Odometry, topic, self._note_truth, 100)

    def forget(self) -> None:
        """Drop what was heard before a reset."""
        self.poses.clear()
        self.truths.clear()

    def truth_at(self, stamp: int) -> Pose:
        """Wait for the ground truth of an instant."""
        self._sim.wait(lambda: stamp in self.truths, f'the truth of {stamp} ns')
        return self.truths[stamp]

    def pose_at(self, stamp: int) -> Pose:
        """Wait for amcl_pose of an instant."""

        def found() -> list[PoseWithCovarianceStamped]:
            return [each for each in self.poses if nanoseconds(each.header.stamp) == stamp]

        return pose_of(self._sim.wait(found, f'amcl_pose of {stamp} ns')[-1].pose.pose)

    def transform_at(self, stamp: int) -> Pose:
        """Return where TF has the robot in the map at an instant, without extrapolation."""
        frames = ('map', 'base_footprint', Time(nanoseconds=stamp))
        self._sim.wait(lambda: self.buffer.can_transform(*frames), f'map -> base at {stamp} ns')
        return plane_pose(self.buffer.lookup_transform(*frames))

    def _note_truth(self, message: Odometry) -> None:
        self.truths[nanoseconds(message.header.stamp)] = pose_of(message.pose.pose)


def last_scan(sim: Simulation) -> int:
    """Return the latest instant of a scan with odometry before and after it, ns."""
    return round((sim.time - 2 * CYCLE + 1e-6) // SCANS * SCANS * 1e9)


def begin(stack: ExitStack, sim: Simulation, localizer: str, *words: str) -> Listener:
    """Start what publishes the robot's frames, and a localizer; let time pass until it works."""
    ros = ['--ros-args', '-p', 'use_sim_time:=true']
    stack.enter_context(running('robot_state_publisher', str(URDF), *ros, until='Robot'))
    stack.enter_context(running(localizer, *ros, *words, until='map -> odom'))
    listener = Listener(sim)

    def let_time_pass_until(condition: Callable[[], object], what: str) -> None:
        def holds() -> object:
            sim.run(0.1)
            return condition()

        sim.wait(holds, what)

    let_time_pass_until(lambda: listener.truths, 'the ground truth')
    let_time_pass_until(lambda: listener.poses, 'amcl_pose')
    for parent, child in (('map', 'odom'), ('odom', 'lidar_link'), ('map', 'lidar_link')):
        let_time_pass_until(
            partial(listener.buffer.can_transform, parent, child, Time()), f'{parent} -> {child}'
        )
    sim.run(2 * CYCLE)
    return listener


@pytest.mark.long
def test_scan_localizer_is_within_3_cm_and_1_degree_by_its_topics(sim):
    with ExitStack() as stack:
        stack.enter_context(running('map_of_world', 'warehouse', '--publish', until='Published'))
        listener = begin(stack, sim, 'scan_localizer', '-p', 'set_initial_pose:=true')
        found = []
        for _ in islice(tour(sim), 120):
            stamp = last_scan(sim)
            by_topic = errors(listener.pose_at(stamp), listener.truth_at(stamp))
            by_tf = errors(listener.transform_at(stamp), listener.truth_at(stamp))
            found.append((*by_topic, *by_tf))
        worst = np.array(found).max(axis=0)
        print(f'{len(found)} scans: m, degrees by topic, by TF: {worst}')
        assert worst[0] < CLOSE
        assert worst[1] < STRAIGHT
        # map -> odom is that of 0.2 s before, see transform_tolerance.
        assert worst[2] < CLOSE
        assert worst[3] < STRAIGHT


@pytest.mark.parametrize('scans', [40, pytest.param(200, marks=pytest.mark.long)])
def test_truth_localizer_is_right_while_the_robot_drives_and_turns(sim, scans):
    with ExitStack() as stack:
        listener = begin(stack, sim, 'truth_localizer')
        found = []
        for _ in islice(tour(sim), scans):
            stamp = last_scan(sim)
            truth = listener.truth_at(stamp)
            assert listener.pose_at(stamp) == pytest.approx(truth, abs=1e-6)
            found.append(errors(listener.transform_at(stamp), truth))
        distance, angle = np.array(found).max(axis=0)
        print(f'{len(found)} instants: {distance} m, {angle} degrees')
        # map -> odom is that of 0.02 s before, see transform_tolerance.
        assert distance < 0.003
        assert angle < 0.2


def test_an_initial_pose_puts_the_robot_there_in_the_simulator(sim):
    with ExitStack() as stack:
        listener = begin(stack, sim, 'truth_localizer')
        message = PoseWithCovarianceStamped()
        message.header.frame_id = 'map'
        message.pose.pose = pose_message(Pose(-5.0, 0.5, 2.0))
        sender = sim.node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)
        sim.wait(sender.get_subscription_count, 'truth_localizer to hear initialpose')
        height = sim.truth.z
        sender.publish(message)
        sim.wait(lambda: sim.truth.x < -4.0, 'the robot to be moved')
        assert planar(sim.truth) == pytest.approx((-5.0, 0.5, 2.0), abs=1e-3)
        assert sim.truth.z == pytest.approx(height, abs=1e-3)
        sim.drive(0.3, 0.5, seconds=1.0)
        stamp = last_scan(sim)
        assert listener.pose_at(stamp) == pytest.approx(listener.truth_at(stamp), abs=1e-6)
        sim.reset()
        listener.forget()

        def goes_on() -> bool:
            """Drive on; poses of later than now are of before the reset, and have come late."""
            sim.drive(0.2, 0.4, seconds=0.1, stop=False)
            poses = {nanoseconds(each.header.stamp): each.pose.pose for each in listener.poses}
            known = [stamp for stamp in poses if stamp <= last_scan(sim)]
            for stamp in known:
                true = listener.truth_at(stamp)
                assert pose_of(poses[stamp]) == pytest.approx(true, abs=1e-6)
            return bool(known)

        sim.wait(goes_on, 'poses after the reset')
        assert abs(sim.truth.x) < 1.5


def test_a_robot_in_a_namespace_may_be_removed_and_spawned_again(simulation):
    there = Transform((1.5, 0.5, 0.0))
    sim = simulation(URDF, world='warehouse', robots={'robot1': Transform(), 'robot2': there})
    ros = ['--ros-args', '-p', 'use_sim_time:=true', '-r', '__ns:=/robot1']
    with running('truth_localizer', *ros, until='map -> odom'):
        listener = Listener(sim, '/robot1')

        def is_right() -> bool:
            """Drive on until there is a pose of the robot as it is now; compare it."""
            sim.drive_all({'robot1': (0.2, 0.4)}, seconds=0.1, stop=False)
            stamp = last_scan(sim)
            known = [each for each in listener.poses if nanoseconds(each.header.stamp) == stamp]
            frames = ('map', 'robot1/base_footprint', Time(nanoseconds=stamp))
            # The localizer may hear a new robot before this listener does.
            is_heard = known and stamp in listener.truths
            if not (is_heard and listener.buffer.can_transform(*frames)):
                return False
            assert pose_of(known[-1].pose.pose) == pytest.approx(
                listener.truth_at(stamp), abs=1e-6
            )
            distance, _ = errors(
                plane_pose(listener.buffer.lookup_transform(*frames)), listener.truth_at(stamp)
            )
            return distance < CLOSE

        sim.wait(is_right, 'the pose of robot1')
        sim.remove('robot1')
        sim.run(1.0)
        sim.spawn('robot1', Transform((-2.0, 0.0, 0.0)))
        listener.forget()
        sim.wait(is_right, 'the pose of the new robot1')
        assert sim.robots['robot1'].truth.x < -1.0
