# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The filter on a drive in lock-step: wheels that are wrong about the turns, and the IMU that is not.

The robot drives a course with an odometry that ignores how its four wheels scrub. What it and the
IMU have published is then fused as ``ekf_node`` does with ``config/ekf.yaml``, at the instants of
its timer, so that two runs give the same bits.
"""

from dataclasses import dataclass
import math

from nav_msgs.msg import Odometry
import pytest
from rclpy.qos import QoSProfile
from sensor_msgs.msg import Imu
from support.paths import ROOT
import yaml

from amr_description.clock import NANOSECONDS
from amr_description.maps.pose import wrapped
from amr_description.model.frames import Transform
from amr_description.navigation.ekf import StateMember
from amr_description.navigation.ekf_estimator import Estimator
from amr_description.navigation.ekf_parameters import read_parameters
from amr_description.navigation.ros.ekf_inputs import InputReader
from amr_description.ros.messages import nanoseconds
from amr_description.testing.simulation import Simulation

URDF = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
COURSE = [(0.4, 0.0, 1.0), (0.3, 0.6, 3.0), (0.4, -0.4, 2.0), (0.0, 0.8, 2.0), (0.4, 0.0, 1.0)]
"""m/s, rad/s, s"""
KEPT = QoSProfile(depth=10_000)


@dataclass(frozen=True)
class Drive:
    """What a drive left behind."""

    messages: list
    """(stamp, topic, message), in the order of the stamps"""
    truth: object
    odometry: object


@pytest.fixture(scope='module')
def controllers(tmp_path_factory):
    """Return a parameter file with which odometry takes scrubbing wheels for rolling ones."""
    text = (ROOT / 'config' / 'controllers.yaml').read_text()
    parameters = yaml.safe_load(text)
    drive = parameters['/**/diff_drive_controller']['ros__parameters']
    assert drive['wheel_separation_multiplier'] > 2.0
    drive['wheel_separation_multiplier'] = 1.0
    path = tmp_path_factory.mktemp('ekf') / 'controllers.yaml'
    path.write_text(yaml.safe_dump(parameters))
    return path


def driven(controllers):
    """Drive the course; return what was published."""
    with Simulation(URDF, controllers) as sim:
        received = {'odom': {}, 'imu': {}}
        for topic, kind in (('odom', Odometry), ('imu', Imu)):

            def keep(message, topic=topic):
                received[topic][nanoseconds(message.header.stamp)] = message

            sim.node.create_subscription(kind, topic, keep, KEPT)

        def hears_both():
            sim.step(10)
            return all(received.values())

        sim.wait(hears_both, 'odometry and IMU')
        sim.reset()
        for messages in received.values():
            messages.clear()
        for linear, angular, seconds in COURSE:
            sim.drive(linear, angular, seconds=seconds, stop=False)
        sim.drive(0.0, 0.0, seconds=0.5)
        end = round(sim.time * NANOSECONDS)

        def has_all():
            # 50 and 100 Hz, from the first cycle on.
            return (
                len(received['odom']) >= end // 20_000_000
                and len(received['imu']) >= end // 10_000_000
            )

        sim.wait(has_all, 'all odometry and IMU')
        messages = [
            (stamp, topic, message)
            for topic, each in received.items()
            for stamp, message in each.items()
        ]
        return Drive(sorted(messages, key=lambda row: row[:2]), sim.truth, sim.odometry)


def fused(drive):
    """Return the state after all messages, fused at 50 Hz."""
    text = (ROOT / 'config' / 'ekf.yaml').read_text()
    given = yaml.safe_load(text)['/**/ekf_filter_node']['ros__parameters']
    parameters = read_parameters(given)
    estimator = Estimator(parameters.tuning, parameters.timing)
    poses = {'imu_link': Transform((-0.15, 0.0, 0.1525))}
    reader = InputReader(parameters, estimator, lambda target, source, time: poses[source])
    inputs = {entry.topic: entry for entry in parameters.inputs}
    waiting = list(drive.messages)
    period = round(NANOSECONDS / parameters.number('frequency'))
    for now in range(period, drive.messages[-1][0] + period, period):
        while waiting and waiting[0][0] <= now:
            _, topic, message = waiting.pop(0)
            reader.read(inputs[topic], message)
        estimator.integrate(now)
    return estimator.filter


def yaw_error(drive, yaw):
    """Return how far a yaw is from the true one, rad."""
    return abs(wrapped(yaw - drive.truth.yaw))


@pytest.fixture(scope='module')
def drive(controllers):
    return driven(controllers)


def test_the_imu_corrects_the_heading_of_the_wheels(drive):
    state = fused(drive).state
    # Wheels say that it turned as if they rolled: 1 / 0.36 times as far as it did.
    assert yaw_error(drive, drive.odometry.yaw) > 1.0
    assert yaw_error(drive, state[StateMember.YAW]) < math.radians(0.5)
    true = drive.truth.pose.translation[:2]
    assert math.dist(true, drive.odometry.pose.translation[:2]) > 1.0
    # Of 3.9 m: what the wheels slip along, and that between two messages the path is straight.
    assert math.dist(true, state[:2]) < 0.04
    assert not state[
        [StateMember.Z, StateMember.ROLL, StateMember.PITCH, StateMember.VZ, StateMember.AZ]
    ].any()


@pytest.mark.long
def test_two_runs_give_the_same_bits(controllers, drive):
    first, second = fused(drive), fused(driven(controllers))
    assert first.time == second.time
    assert first.state.tobytes() == second.state.tobytes()
    assert first.covariance.tobytes() == second.covariance.tobytes()


def test_wheels_alone_stay_wrong(drive):
    # The correction is by the IMU, not by the filter.
    wheels = Drive([row for row in drive.messages if row[1] == 'odom'], drive.truth, None)
    assert yaw_error(drive, fused(wheels).state[StateMember.YAW]) > math.radians(30)
