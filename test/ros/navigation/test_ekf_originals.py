# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The drives of robot_localization's own test of its node, with what it expects of them.

Its ``test_ekf_localization_node_interfaces`` sends velocities 20 times a second, and poses 50
times, and looks at where the filter is then, within the bounds that stand here. There time is
real; here it is exact.
"""

import math

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistWithCovarianceStamped
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.navigation.ekf import StateMember
from amr_description.navigation.ekf_estimator import Estimator
from amr_description.navigation.ekf_parameters import read_parameters
from amr_description.navigation.ros.ekf_inputs import InputReader
from amr_description.ros.messages import fill_stamp

QUARTER = math.pi / 2 / 5.0
"""rad/s: 90° in 100 messages."""
VARIANCES = [1e-6 if index % 7 == 0 else 0.0 for index in range(36)]


class Filter:
    """A filter of one input, and the time."""

    def __init__(self, kind, config, period):
        name = f'{kind}0'
        parameters = read_parameters({name: 'input', f'{name}_config': config})
        self._entry = parameters.inputs[0]
        self._estimator = Estimator(parameters.tuning, parameters.timing)
        self._reader = InputReader(parameters, self._estimator, lambda *_: None)
        self._period = round(period * NANOSECONDS)
        self._time = 0

    def send(self, message, count):
        """Send a message so many times."""
        for _ in range(count):
            self._time += self._period
            fill_stamp(self._time, message.header.stamp)
            self._reader.read(self._entry, message)
            self._estimator.integrate(self._time)

    def __getitem__(self, name):
        return self._estimator.filter.state[StateMember[name.upper()]]

    def variance(self, name):
        index = StateMember[name.upper()]
        return self._estimator.filter.covariance[index, index]


def twist(**given):
    message = TwistWithCovarianceStamped()
    message.header.frame_id = 'base_link'
    message.twist.covariance = VARIANCES
    velocity = message.twist.twist
    for name, value in given.items():
        part = velocity.angular if name.startswith('w') else velocity.linear
        setattr(part, name[-1], value)
    return message


@pytest.fixture
def drive():
    return Filter('twist', [False] * 6 + [True] * 6 + [False] * 3, 0.05)


@pytest.mark.parametrize(
    ('axis', 'count', 'expected', 'bound'),
    [('x', 400, 100.0, 2.0), ('y', 200, 50.0, 1.0), ('z', 100, 25.0, 1.0)],
)
def test_5_metres_a_second_along_an_axis(drive, axis, count, expected, bound):
    drive.send(twist(**{f'v{axis}': 5.0}), count)
    assert drive[f'v{axis}'] == pytest.approx(5.0, abs=0.1)
    assert drive[axis] == pytest.approx(expected, abs=bound)


def test_a_quarter_of_a_circle(drive):
    drive.send(twist(vx=1.0, wz=QUARTER), 100)
    assert drive['vx'] == pytest.approx(1.0, abs=0.1)
    assert drive['vyaw'] == pytest.approx(QUARTER, abs=0.1)
    assert drive['x'] == pytest.approx(drive['y'], abs=0.5)


def test_on_its_side_it_goes_where_it_faces(drive):
    drive.send(twist(), 1)
    drive.send(twist(wx=-QUARTER), 100)
    drive.send(twist(wy=QUARTER), 100)
    drive.send(twist(vx=3.0), 100)
    assert drive['vx'] == pytest.approx(3.0, abs=0.1)
    assert drive['y'] == pytest.approx(-15.0, abs=1.0)


def test_a_pose_that_stays():
    # Of the original, y is not used.
    each = Filter('pose', [True, False, True, True, True, True] + [False] * 9, 0.02)
    message = PoseWithCovarianceStamped()
    message.header.frame_id = 'odom'
    place = message.pose.pose.position
    place.x, place.y, place.z = 20.0, 10.0, -40.0
    message.pose.pose.orientation.w = 1.0
    message.pose.covariance = VARIANCES
    each.send(message, 50)
    assert each['x'] == pytest.approx(20.0, abs=0.1)
    assert each['y'] == pytest.approx(0.0, abs=0.1)
    assert each['z'] == pytest.approx(-40.0, abs=0.1)
    assert each.variance('x') < 0.5
    assert each.variance('y') < 0.25
    assert each.variance('z') < 0.5
