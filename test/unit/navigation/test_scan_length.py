# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How many ranges slam_toolbox expects: known lidars, and every one that the simulator makes."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.model.sensors import ScanAxis
from amr_description.navigation.contract.observations import ScanGeometry
from amr_description.navigation.contract.scan_length import expected_length, is_full_circle
from amr_description.sim.lidar import scan_angles


def geometry(lower, upper, increment, count):
    return ScanGeometry(lower, upper, increment, 0.1, 12.0, count)


@pytest.mark.parametrize(
    ('lower', 'upper', 'increment', 'count', 'expected', 'is_circle'),
    [
        # A full circle without its first ray again, and with it.
        (-math.pi, math.pi - math.radians(1.0), math.radians(1.0), 360, 360, False),
        (-math.pi, math.pi, math.radians(1.0), 361, 361, False),
        (-math.pi, math.pi, math.radians(1.0), 360, 360, True),
        # Gazebo: angle_increment is (max - min) / (samples - 1).
        (0.0, 6.28, 6.28 / 359, 360, 360, False),
        (-3.14, 3.14, 6.28 / 359, 360, 360, False),
        # LDS-01 of a TurtleBot3: 0 to 2π in 360 steps, and 360 ranges.
        (0.0, math.tau, math.radians(1.0), 360, 360, True),
        # Hokuyo UTM-30LX: 270°.
        (-2.356194, 2.356194, 0.004363323, 1081, 1081, False),
        (-2.356194, 2.356194, 0.004363323, 1080, 1081, False),
        # Mounted the other way round: it goes down.
        (1.0, -1.0, -0.1, 21, 21, False),
    ],
)
def test_known_lidars(lower, upper, increment, count, expected, is_circle):
    shape = geometry(lower, upper, increment, count)
    assert (expected_length(shape), is_full_circle(shape)) == (expected, is_circle)


@pytest.mark.parametrize('angles', [(0.0, 1.0, 0.0), (0.0, math.nan, 0.1), (0.0, math.inf, 0.1)])
def test_angles_of_no_scan(angles):
    assert expected_length(geometry(*angles, 10)) is None


@given(
    lower=st.floats(-math.pi, 0.0),
    span=st.floats(0.01, math.tau),
    samples=st.integers(2, 4000),
)
def test_what_the_simulator_publishes_has_the_length_that_slam_toolbox_expects(
    lower, span, samples
):
    axis = ScanAxis(samples, lower, lower + span)
    assert expected_length(geometry(*scan_angles(axis), samples)) == samples
