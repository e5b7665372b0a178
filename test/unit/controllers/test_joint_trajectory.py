# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Splines against closed forms, and the laws of trajectories in time."""

import math

from hypothesis import given, strategies as st
import numpy as np
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.control.trajectory_samples import TrajectoryPoint
from amr_description.controllers.joint_trajectory.splines import (
    decelerating,
    JointOrder,
    Segment,
    shortest_angular_distance,
    Trajectory,
    unwrapped,
)

S = NANOSECONDS
NUMBERS = st.floats(-3.0, 3.0)
DURATIONS = st.floats(0.05, 5.0)
ANGLES = st.floats(-20.0, 20.0)


def values(count, size=2):
    return st.tuples(*[st.tuples(*[NUMBERS] * size)] * count)


def closed_form(a, b, duration, s):
    """The polynomial of least degree by its linear equations, and its derivatives at s."""
    count = len(a)
    powers = np.arange(2 * count)
    rows = []
    for t in (0.0, duration):
        for order in range(count):
            factors = [math.perm(n, order) for n in powers]
            rows.append([f * t ** max(n - order, 0) for f, n in zip(factors, powers, strict=True)])
    coefficients = np.linalg.solve(np.array(rows), np.array([*a, *b]))
    polynomial = np.polynomial.Polynomial(coefficients)
    return [polynomial(s), polynomial.deriv()(s), polynomial.deriv(2)(s)]


@given(values(3), values(3), st.sampled_from([1, 2, 3]), DURATIONS, st.floats(0.0, 1.0))
def test_a_segment_is_the_polynomial_that_meets_both_points(a, b, count, duration, part):
    end = round(duration * S)
    time = round(part * end)
    segment = Segment(5, TrajectoryPoint(*a[:count]), 5 + end, TrajectoryPoint(*b[:count]))
    point = segment.at(5 + time)
    for joint in (0, 1):
        expected = closed_form(
            [row[joint] for row in a[:count]], [row[joint] for row in b[:count]], end / S, time / S
        )
        found = [point.positions[joint], point.velocities[joint], point.accelerations[joint]]
        scale = 1.0 + max(1.0, 1.0 / duration) ** 2
        assert found == pytest.approx(expected, abs=1e-6 * scale)


@given(st.lists(values(3), min_size=2, max_size=6), DURATIONS, st.sampled_from([1, 2, 3]))
def test_a_trajectory_passes_through_its_points_with_all_their_derivatives(rows, step, count):
    points = [TrajectoryPoint(*row[:count]) for row in rows]
    times = [round(step * S) * k for k in range(1, len(rows) + 1)]
    trajectory = Trajectory(points, times, 3 * S)
    trajectory.begin(3 * S, TrajectoryPoint(*[(0.0, 0.0)] * count))
    for point, time in zip(points, times, strict=True):
        before, _ = trajectory.sample(3 * S + time - 1)
        at, _ = trajectory.sample(3 * S + time)
        for name in ('positions', 'velocities', 'accelerations')[:count]:
            assert getattr(at, name) == pytest.approx(getattr(point, name), abs=1e-9)
            in_a_nanosecond = 1e-6 * (1.0 + 1.0 / step) ** 3
            assert getattr(before, name) == pytest.approx(
                getattr(point, name), abs=in_a_nanosecond
            )


@given(values(3), values(2), DURATIONS)
def test_a_trajectory_begins_where_the_joints_are(state, goal, duration):
    end = round(duration * S)
    trajectory = Trajectory([TrajectoryPoint(*goal)], [end])
    trajectory.begin(7 * S, TrajectoryPoint(*state))
    point, segment = trajectory.sample(7 * S)
    assert segment == -1
    assert point.positions == pytest.approx(state[0])
    assert point.velocities == pytest.approx(state[1])


@given(values(3), values(3), values(3), DURATIONS, st.floats(0.05, 0.95))
def test_what_replaces_a_trajectory_in_flight_goes_on_without_a_jump(
    start, first, second, t, part
):
    end = round(t * S)
    old = Trajectory([TrajectoryPoint(*first)], [end])
    old.begin(S, TrajectoryPoint(*start))
    moment = S + round(part * end)
    state, _ = old.sample(moment)
    new = Trajectory([TrajectoryPoint(*second)], [end])
    new.begin(moment, state)
    point, _ = new.sample(moment)
    for name in ('positions', 'velocities', 'accelerations'):
        assert getattr(point, name) == pytest.approx(getattr(state, name), abs=1e-9)


def test_positions_alone_are_joined_linearly_and_velocities_count_from_the_second_on():
    trajectory = Trajectory([TrajectoryPoint((1.0,)), TrajectoryPoint((2.0,), (0.0,))], [S, 2 * S])
    trajectory.begin(S, TrajectoryPoint((0.0,), (5.0,)))
    assert trajectory.sample(S + S // 2)[0] == TrajectoryPoint((0.5,), (1.0,), (0.0,), (0.0,))
    assert trajectory.sample(2 * S + S // 4)[0].positions == (1.25,)


def test_a_state_without_velocities_counts_as_at_rest_where_the_first_point_has_some():
    trajectory = Trajectory([TrajectoryPoint((1.0,), (0.0,))], [S])
    trajectory.begin(S, TrajectoryPoint((0.0,)))
    # Half of a cubic between two rests, s²·(3 − 2·s).
    assert trajectory.sample(S + S // 4)[0].positions == pytest.approx((0.15625,))


def test_velocities_alone_are_integrated():
    trajectory = Trajectory([TrajectoryPoint((), (2.0,)), TrajectoryPoint((), (0.0,))], [S, 3 * S])
    trajectory.begin(S, TrajectoryPoint((1.0,)))
    point, _ = trajectory.sample(S + S // 2)
    assert point.positions == pytest.approx((1.0 + 0.25,))  # half a second of a ramp to 2
    assert point.velocities == pytest.approx((1.0,))
    assert trajectory.sample(2 * S)[0].positions == pytest.approx((2.0,))
    assert trajectory.end_point().positions == pytest.approx((4.0,))
    assert trajectory.sample(9 * S)[0].velocities == (0.0,)


def test_accelerations_alone_are_integrated_twice():
    trajectory = Trajectory([TrajectoryPoint((), (), (1.0,))], [2 * S])
    trajectory.begin(S, TrajectoryPoint((0.0,), (), (1.0,)))
    point, _ = trajectory.sample(3 * S)
    assert point.velocities == pytest.approx((2.0,))
    assert point.positions == pytest.approx((2.0,))


def test_efforts_are_interpolated_and_zero_where_there_are_none():
    trajectory = Trajectory(
        [TrajectoryPoint((1.0,), effort=(4.0,)), TrajectoryPoint((1.0,))], [S, 2 * S]
    )
    trajectory.begin(S, TrajectoryPoint((0.0,), effort=(2.0,)))
    assert trajectory.sample(S + S // 2)[0].effort == (3.0,)
    assert trajectory.sample(2 * S + S // 2)[0].effort == (2.0,)
    assert trajectory.sample(5 * S)[0].effort == (0.0,)


def test_a_start_in_the_past_skips_what_would_have_been():
    trajectory = Trajectory(
        [TrajectoryPoint((float(k),)) for k in range(5)], range(0, 5 * S, S), S
    )
    trajectory.begin(3 * S + S // 2, TrajectoryPoint((9.0,)))
    assert trajectory.sample(3 * S + S // 2) == (
        TrajectoryPoint((2.5,), (1.0,), (0.0,), (0.0,)),
        2,
    )
    assert trajectory.sample(3 * S) is None


def test_a_start_in_the_future_is_reached_from_where_the_joints_are():
    trajectory = Trajectory([TrajectoryPoint((1.0,))], [0], 3 * S)
    trajectory.begin(S, TrajectoryPoint((0.0,)))
    assert trajectory.sample(2 * S)[0].positions == (0.5,)
    assert trajectory.is_over(trajectory.sample(3 * S)[1])


def test_without_splines_the_next_point_counts_at_once():
    trajectory = Trajectory(
        [TrajectoryPoint((1.0,)), TrajectoryPoint((2.0,))], [S, 2 * S], has_splines=False
    )
    trajectory.begin(S, TrajectoryPoint((0.0,)))
    found = [trajectory.sample(time)[0].positions for time in (S, 2 * S, 3 * S - 1, 3 * S)]
    assert found == [(0.0,), (2.0,), (2.0,), (2.0,)]


def test_a_trajectory_has_no_state_before_it_is_begun():
    assert Trajectory([TrajectoryPoint((1.0,))], [S]).sample(5) is None


def test_a_shift_of_the_clock_shifts_it():
    trajectory = Trajectory([TrajectoryPoint((1.0,))], [S])
    trajectory.begin(S, TrajectoryPoint((0.0,)))
    before = trajectory.sample(S + S // 2)
    trajectory.shift(-S // 2)
    assert trajectory.sample(S) == before


@given(ANGLES, ANGLES)
def test_a_joint_that_wraps_takes_the_shortest_way(start, end):
    trajectory = Trajectory([TrajectoryPoint((end, end))], [S])
    trajectory.begin(S, TrajectoryPoint((start, start)), (True, False))
    first = trajectory.sample(S)[0].positions
    assert first[1] == pytest.approx(start)
    assert abs(end - first[0]) <= math.pi + 1e-9
    assert math.remainder(first[0] - start, math.tau) == pytest.approx(0.0, abs=1e-9)
    assert abs(shortest_angular_distance(start, end)) <= math.pi


def test_half_a_turn_goes_the_way_that_the_positions_say():
    assert unwrapped(0.0, math.pi) == pytest.approx(0.0)
    assert unwrapped(0.0, -math.pi) == pytest.approx(0.0)


@given(values(2, 3), st.tuples(*[st.floats(0.1, 10.0)] * 3))
def test_each_joint_comes_to_rest_by_its_own_deceleration(state, decelerations):
    positions, velocities = state
    trajectory = decelerating(TrajectoryPoint(positions, velocities), decelerations)
    trajectory.begin(S, TrajectoryPoint(positions, velocities))
    for joint, (p, v, a) in enumerate(zip(positions, velocities, decelerations, strict=True)):
        stop = abs(v) / a
        end = trajectory.end_point()
        assert end.positions[joint] == pytest.approx(p + v * stop / 2.0, abs=1e-6)
        assert end.velocities[joint] == 0.0
        middle, _ = trajectory.sample(S + round(stop / 2.0 * S))
        if stop > 1e-3:
            assert middle.velocities[joint] == pytest.approx(v / 2.0, abs=1e-4)
            assert middle.accelerations[joint] == pytest.approx(-math.copysign(a, v), rel=1e-3)


def test_points_are_brought_into_the_order_of_the_joints():
    order = JointOrder(('c', 'a'), ('a', 'b', 'c'), (7.0, 8.0, 9.0))
    point = order(TrajectoryPoint((3.0, 1.0), (0.3, 0.1)))
    assert point == TrajectoryPoint((1.0, 8.0, 3.0), (0.1, 0.0, 0.3))
    same = TrajectoryPoint((1.0,))
    assert JointOrder(('a',), ('a',), (0.0,))(same) is same


def test_a_long_trajectory_costs_nothing_until_it_is_followed():
    asked = []

    def order(point):
        asked.append(point)
        return point

    points = [TrajectoryPoint((float(k),)) for k in range(100_000)]
    trajectory = Trajectory(points, range(0, 100_000 * S, S), order=order)
    trajectory.begin(S, TrajectoryPoint((0.0,)))
    assert trajectory.sample(50_000 * S)[0].positions == (49_999.0,)
    assert len(asked) < 5
