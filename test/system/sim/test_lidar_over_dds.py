# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The lidar of the shipped robot, in lock-step: when its scans come, and that runs are equal."""

import pytest
from rclpy.qos import QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from support.paths import ROOT

from amr_description.ros.messages import nanoseconds
from amr_description.testing.simulation import Simulation
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

MS = 1_000_000


@pytest.fixture(scope='module')
def sim(tmp_path_factory):
    """The odometry is published in every cycle, not in every second one."""
    text = (ROOT / 'config' / 'controllers.yaml').read_text()
    controllers = tmp_path_factory.mktemp('lidar') / 'controllers.yaml'
    controllers.write_text(text.replace('publish_rate: 50.0', 'publish_rate: 100.0'))
    robot = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
    with Simulation(robot, controllers, world='warehouse') as sim:
        yield sim


class Listener:
    """Scans, and those at whose arrival the pose of the robot at their stamp was not known."""

    def __init__(self, sim):
        self.sim = sim
        self.scans, self.early = [], []
        self.buffer = Buffer()
        self.tf = TransformListener(self.buffer, sim.node, spin_thread=False)
        self.subscription = sim.node.create_subscription(
            LaserScan, '/scan', self.hear, QoSProfile(depth=100)
        )
        sim.wait(self.hears_all_after_a_period, 'scans, and the pose of the robot at their stamps')

    def hear(self, scan):
        self.scans.append(scan)
        if not self.knows(scan):
            self.early.append(nanoseconds(scan.header.stamp))

    def hears_all_after_a_period(self):
        self.sim.run(0.1)
        return bool(self.scans) and self.knows(self.scans[-1])

    def knows(self, scan):
        return self.knows_pose(Time.from_msg(scan.header.stamp))

    def knows_pose(self, time):
        return self.buffer.can_transform('odom', 'base_footprint', time)

    def begin(self):
        """Begin anew at time 0, with nothing heard, and nothing on its way."""
        # The last cycle was that before the present instant.
        last = round(1000 * self.sim.time - 10) // 10 * 10 * MS
        scan = last // (100 * MS) * 100 * MS
        self.sim.wait(lambda: self.stamps()[-1:] == [scan], f'the scan of {scan} ns')
        self.sim.wait(lambda: self.knows_pose(Time(nanoseconds=last)), f'the pose at {last} ns')
        self.sim.reset()
        for each in (self.buffer, self.scans, self.early):
            each.clear()

    def wait_for_scans(self, count):
        self.sim.wait(lambda: len(self.scans) >= count, f'{count} scans')

    def stamps(self):
        return [nanoseconds(scan.header.stamp) for scan in self.scans]


@pytest.fixture(scope='module')
def listener(sim):
    listener = Listener(sim)
    yield listener
    listener.tf.unregister()


def test_a_step_gives_the_scans_that_are_due(listener):
    listener.begin()
    # The tick at the end of a step belongs to the next one.
    listener.sim.run(1.0)
    listener.wait_for_scans(10)
    assert listener.stamps() == [time * MS for time in range(0, 1000, 100)]
    listener.sim.run(0.05)
    listener.wait_for_scans(11)
    listener.sim.run(0.04)
    listener.sim.run(0.01)
    assert listener.stamps()[10:] == [1000 * MS]


def test_the_odometry_of_its_instant_comes_before_a_scan(listener):
    listener.begin()
    for count in range(1, 6):
        # Of a flood of transforms an executor would take one for each scan.
        listener.sim.run(0.01)
        listener.wait_for_scans(count)
        for _ in range(9):
            listener.sim.run(0.01)
    assert listener.stamps() == [time * MS for time in range(0, 500, 100)]
    assert not listener.early


def test_two_runs_give_the_same_bytes(listener):
    runs = []
    for _ in range(2):
        listener.begin()
        listener.sim.drive(0.4, 0.3, seconds=0.65, stop=False)
        listener.wait_for_scans(7)
        runs.append([scan.ranges.tobytes() for scan in listener.scans])
    assert runs[0] == runs[1]
    assert len({*runs[0]}) == 7, 'the robot moves, and the noise is another one each time'
