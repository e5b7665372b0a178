# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Odometry: what must hold whatever the path, the rows of upstream, and a computed run."""

import math
import random

import pytest
from support.control_fakes import VECTORS

from amr_description.controllers.drives.odometry import Odometry

ROWS = VECTORS['odometry']['rows']
SEED_ROBOT = VECTORS['seed_robot_perfect_tracking']


def random_travel(dice, count=200):
    """(left, right) in m: straight, spinning, arcs, and turns too small to divide by."""
    for _ in range(count):
        step = dice.uniform(-0.05, 0.05)
        yield dice.choice(
            ((step, step), (-step, step), (step, step * 1.5), (step, step + 1e-8), (0.0, step))
        )


def drive(odometry, travel):
    for left, right in travel:
        odometry.update_from_travel(left, right, 0.01)
    return odometry


# --- laws ----------------------------------------------------------------------------------------


@pytest.mark.parametrize('seed', range(10))
def test_the_same_path_from_a_turned_start_is_the_turned_path(seed):
    dice = random.Random(seed)
    travel, half_turn = list(random_travel(dice)), dice.uniform(-1.0, 1.0)
    plain = drive(Odometry(0.4, 1), travel)
    turned = drive(Odometry(0.4, 1), [(-half_turn, half_turn), *travel])
    angle = 2.0 * half_turn / 0.4
    cos, sin = math.cos(angle), math.sin(angle)
    assert turned.x == pytest.approx(cos * plain.x - sin * plain.y, abs=1e-9)
    assert turned.y == pytest.approx(sin * plain.x + cos * plain.y, abs=1e-9)
    assert turned.heading == pytest.approx(plain.heading + angle, abs=1e-9)


@pytest.mark.parametrize('seed', range(10))
def test_forward_and_the_same_way_back_ends_at_the_start(seed):
    travel = list(random_travel(random.Random(seed)))
    odometry = drive(Odometry(0.4, 1), travel)
    drive(odometry, [(-left, -right) for left, right in reversed(travel)])
    assert (odometry.x, odometry.y, odometry.heading) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize('seed', range(10))
def test_an_arc_does_not_depend_on_into_how_many_steps_it_is_cut(seed):
    dice = random.Random(seed)
    left, right = dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0)
    whole = drive(Odometry(0.4, 1), [(left, right)])
    cut = drive(Odometry(0.4, 1), [(left / 1000, right / 1000)] * 1000)
    assert (cut.x, cut.y, cut.heading) == pytest.approx(
        (whole.x, whole.y, whole.heading), abs=1e-9
    )


def test_small_turns_join_the_exact_arcs_without_a_step():
    """Either side of the threshold of 1e-6 rad the formulas agree."""
    for turn in (0.999_999e-6, 1.000_001e-6):
        odometry = drive(Odometry(1.0, 1), [(1.0, 1.0 + turn)])
        assert odometry.x == pytest.approx(1.0 + turn / 2, abs=1e-9)
        assert odometry.y == pytest.approx(turn / 2, abs=1e-9)


def test_the_mirrored_path_is_the_mirrored_pose():
    travel = list(random_travel(random.Random(0)))
    here, there = drive(Odometry(0.4, 1), travel), Odometry(0.4, 1)
    drive(there, [(right, left) for left, right in travel])
    assert (there.x, there.y, there.heading) == pytest.approx((here.x, -here.y, -here.heading))


def test_open_loop_and_wheels_agree():
    wheels, blind = Odometry(0.4, 1), Odometry(0.4, 1)
    for left, right in random_travel(random.Random(0)):
        wheels.update_from_travel(left, right, 0.01)
        blind.update_open_loop((left + right) / 0.02, (right - left) / 0.4 / 0.01, 0.01)
        assert (blind.linear, blind.angular) == pytest.approx((wheels.linear, wheels.angular))
    assert (blind.x, blind.y, blind.heading) == pytest.approx((wheels.x, wheels.y, wheels.heading))


# --- the estimate of the twist -------------------------------------------------------------------


def test_the_twist_is_the_mean_of_the_window():
    odometry = Odometry(1.0, window=3)
    for distance, mean in ((3.0, 3.0), (0.0, 1.5), (0.0, 1.0), (0.0, 0.0)):
        odometry.update_from_travel(distance, distance, 1.0)
        assert odometry.linear == mean


def test_the_heading_is_not_wrapped():
    odometry = drive(Odometry(1.0, 1), [(-1.0, 1.0)] * 10)
    assert odometry.heading == pytest.approx(20.0)


def test_reset_goes_to_the_origin_and_forgets_the_window():
    odometry = drive(Odometry(0.4, 10), random_travel(random.Random(0)))
    odometry.reset()
    assert (odometry.x, odometry.y, odometry.heading) == (0.0, 0.0, 0.0)
    assert (odometry.linear, odometry.angular) == (0.0, 0.0)
    odometry.update_from_travel(1.0, 1.0, 1.0)
    assert odometry.linear == 1.0


# --- rows ----------------------------------------------------------------------------------------


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row['name'])
def test_rows_of_diff_drive_controller(row):
    odometry, radius = Odometry(row['wheel_separation'], 10), row['wheel_radius']
    for op in row['ops']:
        if op['op'] == 'open':
            odometry.update_open_loop(op['a'], op['b'], op['t'])
        else:
            odometry.update_from_travel(op['a'] * radius, op['b'] * radius, op['t'])
    found = {name: getattr(odometry, name) for name in row['expect']}
    assert found == pytest.approx(row['expect'], abs=1e-9)


def test_ten_seconds_of_the_seed_robot():
    rate, radius = SEED_ROBOT['rate'], 0.1
    odometry = Odometry(0.3, 10)
    left, right = (SEED_ROBOT['wheel_rad_s'][side] * radius / rate for side in ('left', 'right'))
    samples = {round(sample['t'] * rate): sample for sample in SEED_ROBOT['samples']}
    for step in range(1, max(samples) + 1):
        odometry.update_from_travel(left, right, 1.0 / rate)
        if step in samples:
            for name in ('x', 'y', 'heading', 'linear', 'angular'):
                assert getattr(odometry, name) == pytest.approx(samples[step][name], abs=1e-9)
