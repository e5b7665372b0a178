# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Dead reckoning: the motion, and the time, over which odometry is integrated."""

import math

import pytest
from support.control_fakes import MS

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import StateInterface
from amr_description.controllers.drives.odometry import DeadReckoning, Odometry, WheelSide
from amr_description.errors import ControllerError

LATE = 1_000_000 * NANOSECONDS
PERIOD = 10 * MS


class Robot:
    """Radius 0.1 m, separation 1 m; ``left`` and ``right`` are what the encoders read."""

    def __init__(self, source='position', window=10):
        self.left, self.right = (StateInterface(side, source, 0.0) for side in ('left', 'right'))
        self.reckoning = DeadReckoning(
            Odometry(1.0, window),
            is_open_loop=source == 'open loop',
            has_positions=source == 'position',
        )

    def update(self, time, twist=(0.0, 0.0), period=PERIOD):
        sides = WheelSide(0.1, (), [self.left]), WheelSide(0.1, (), [self.right])
        self.reckoning.update(*sides, twist, time, period)
        return self.reckoning.odometry


def test_an_encoder_that_does_not_begin_at_zero_makes_no_jump():
    robot = Robot()
    robot.left.value = robot.right.value = 1234.5
    robot.reckoning.hold(0)
    assert robot.update(PERIOD).x == 0.0
    robot.left.value = robot.right.value = 1235.5
    assert robot.update(2 * PERIOD).x == pytest.approx(0.1)


@pytest.mark.parametrize('source', ['position', 'velocity', 'open loop'])
def test_a_late_start_is_no_motion(source):
    """Upstream integrates the first open-loop command over the whole age of the clock."""
    robot = Robot(source)
    robot.reckoning.hold(LATE - PERIOD)
    for state in (robot.left, robot.right):
        state.value = 5.0
    odometry = robot.update(LATE, (0.5, 0.0))
    assert odometry.x == pytest.approx(0.0 if source == 'position' else 0.005)


@pytest.mark.parametrize('source', ['velocity', 'open loop'])
def test_while_held_nothing_is_integrated(source):
    robot = Robot(source)
    for time in range(0, 100 * PERIOD, PERIOD):
        robot.reckoning.hold(time)
    robot.left.value = robot.right.value = 5.0
    odometry = robot.update(100 * PERIOD, (0.5, 0.0))
    assert odometry.x == pytest.approx(0.005)
    assert odometry.linear == pytest.approx(0.5)


def test_motion_while_held_is_covered_by_positions_over_the_true_time():
    robot = Robot(window=1)
    robot.update(0)
    robot.update(PERIOD)
    robot.left.value = robot.right.value = 10.0
    robot.reckoning.hold(50 * PERIOD)
    odometry = robot.update(101 * PERIOD)
    assert odometry.x == pytest.approx(1.0)
    assert odometry.linear == pytest.approx(1.0)


def test_velocities_are_integrated_over_the_period():
    robot = Robot('velocity')
    robot.left.value, robot.right.value = 1.0, 3.0
    odometry = robot.update(PERIOD)
    assert odometry.x == pytest.approx(0.002, abs=1e-6)
    assert (odometry.linear, odometry.angular) == pytest.approx((0.2, 0.2))


def test_open_loop_believes_the_command():
    robot = Robot('open loop')
    odometry = robot.update(NANOSECONDS, (2.0, 0.5))
    assert odometry.x == pytest.approx(4 * math.sin(0.5))
    assert odometry.y == pytest.approx(4 * (1 - math.cos(0.5)))
    assert (odometry.linear, odometry.angular) == (2.0, 0.5)


@pytest.mark.parametrize('gap', [0, 99_999])
def test_an_update_that_comes_too_soon_is_left_out_but_its_travel_is_not_lost(gap):
    robot = Robot()
    robot.update(0)
    robot.update(PERIOD)
    robot.left.value = robot.right.value = 1.0
    assert robot.update(PERIOD + gap).x == 0.0
    assert robot.update(2 * PERIOD).x == pytest.approx(0.1)


def test_after_a_reset_pose_clock_and_wheels_start_over():
    robot = Robot()
    robot.update(LATE)
    robot.left.value = robot.right.value = 7.0
    robot.update(LATE + PERIOD)
    robot.reckoning.reset(0)
    assert robot.update(PERIOD).x == 0.0
    robot.left.value = robot.right.value = 8.0
    assert robot.update(2 * PERIOD).x == pytest.approx(0.1)


@pytest.mark.parametrize('reading', [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize('source', ['position', 'velocity'])
def test_a_wheel_state_of_nan_is_an_error_with_its_name(source, reading):
    robot = Robot(source)
    robot.right.value = reading
    message = rf'wheel {source} is invalid for index \[0\]: right/{source} is {reading}'
    with pytest.raises(ControllerError, match=message):
        robot.update(PERIOD)


def test_a_side_is_the_mean_of_its_wheels():
    states = [StateInterface(name, 'position', value) for name, value in (('a', 1.0), ('b', 2.0))]
    assert WheelSide(0.1, (), states).travel() == pytest.approx(0.15)
