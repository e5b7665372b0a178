# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Calibration recovers the drive that made the runs, whatever was believed of it before."""

import math
import random

from hypothesis import given, strategies as st
import pytest

from amr_description.controllers.checks.drive_calibration import (
    CalibrationRun,
    fit,
    Geometry,
    Path,
    Travel,
    yaw_error,
)
from amr_description.controllers.drives.odometry import Odometry
from amr_description.errors import CalibrationError

SEPARATION = 0.3
multipliers = st.floats(0.3, 4.0)
drives = st.builds(
    Geometry,
    separation=st.just(SEPARATION),
    separation_multiplier=multipliers,
    left_multiplier=multipliers,
    right_multiplier=multipliers,
)
TURNS = (  # travel of the left and the right wheels, m
    ('spin left', -2.0, 2.0),
    ('spin right', 2.0, -2.0),
    ('straight', 2.0, 2.0),
    ('arc left', 1.0, 2.5),
    ('arc right', 2.5, 1.0),
)


def run_of(drive, name, left, right):
    """What a robot with the geometry ``drive`` truly does."""
    return CalibrationRun(
        name, left, right, CalibrationRun(name, left, right, Travel(0, 0)).odometry(drive)
    )


def runs_of(drive, turns=TURNS):
    return [run_of(drive, *turn) for turn in turns]


def fit_to(runs):
    """As the program does: what was commanded straight, and the rest."""
    straight = [run for run in runs if run.name == 'straight']
    return fit(straight, [run for run in runs if run not in straight], SEPARATION)


def multipliers_of(geometry):
    return (
        geometry.separation_multiplier, geometry.left_multiplier, geometry.right_multiplier,
    )  # fmt: skip


@given(drives)
def test_the_geometry_that_made_the_runs_is_recovered(drive):
    found = fit_to(runs_of(drive))
    assert multipliers_of(found) == pytest.approx(multipliers_of(drive), rel=1e-9)
    assert all(
        math.isnan(error) or error < 1e-9
        for error in (yaw_error(run, found) for run in runs_of(drive))
    )


@given(drives, drives)
def test_what_was_believed_before_does_not_matter(drive, believed):
    """Odometry of another geometry holds the same turning of the wheels."""
    for turn in TURNS:
        run = run_of(drive, *turn)
        again = CalibrationRun.from_odometry(run.name, run.odometry(believed), run.truth, believed)
        assert (again.left, again.right) == pytest.approx((run.left, run.right), abs=1e-9)


@given(drives, st.floats(0.2, 5.0))
def test_longer_runs_give_the_same(drive, factor):
    longer = [(name, factor * left, factor * right) for name, left, right in TURNS]
    found = fit_to(runs_of(drive, longer))
    assert multipliers_of(found) == pytest.approx(multipliers_of(drive), rel=1e-8)


def test_runs_that_contradict_each_other_are_balanced_not_followed():
    """A skid-steered robot turns otherwise on the spot than on an arc."""
    drive = Geometry(SEPARATION, 2.8)
    chance = random.Random(1)
    runs = [
        CalibrationRun(
            run.name,
            run.left,
            run.right,
            Travel(
                run.truth.distance * (1.0 if run.name == 'straight' else 0.97),
                run.truth.turn * chance.uniform(0.98, 1.02),
            ),
        )
        for run in runs_of(drive)
    ]
    found = fit_to(runs)
    assert found.separation_multiplier == pytest.approx(2.8, rel=0.02)
    # The straight runs follow the wheels, whatever the turns are.
    assert multipliers_of(found)[1:] == pytest.approx((1.0, 1.0), rel=1e-3)
    errors = [yaw_error(run, found) for run in runs]
    assert max(error for error in errors if not math.isnan(error)) < 0.04


def test_yaw_error_is_a_share_of_the_true_turn_and_none_where_it_goes_straight():
    run = run_of(Geometry(SEPARATION, 2.0), *TURNS[0])
    assert yaw_error(run, Geometry(SEPARATION, 1.0)) == pytest.approx(1.0)
    assert yaw_error(run, Geometry(SEPARATION, 4.0)) == pytest.approx(0.5)
    assert math.isnan(yaw_error(run_of(Geometry(SEPARATION), *TURNS[2]), Geometry(SEPARATION)))


@pytest.mark.parametrize(
    'names, message',
    [
        ({'straight'}, 'the robot did not turn in any of 0 turns'),
        ({'spin left', 'spin right'}, 'the wheels on the left did not turn in any straight run'),
        ((), 'the wheels on the left did not turn in any straight run'),
    ],
)
def test_too_few_kinds_of_runs_are_refused(names, message):
    runs = [run for run in runs_of(Geometry(SEPARATION)) if run.name in names]
    with pytest.raises(CalibrationError, match=message):
        fit_to(runs)


def test_a_robot_that_goes_against_its_wheels_is_refused():
    runs = [
        CalibrationRun(run.name, run.left, run.right, Travel(-run.truth.distance, -run.truth.turn))
        for run in runs_of(Geometry(SEPARATION))
    ]
    with pytest.raises(CalibrationError, match='left_wheel_radius_multiplier = -1: the robot'):
        fit_to(runs)


@given(
    st.floats(-3.0, 3.0),
    st.floats(-7.0, 7.0),
    st.floats(-math.pi, math.pi),
    st.integers(3, 200),
)
def test_the_length_of_an_arc_does_not_depend_on_how_often_one_looks(length, turn, start, looks):
    odometry = Odometry(SEPARATION, 1)
    odometry.heading = start
    path = Path(0.0, 0.0, start)
    for _ in range(looks):
        odometry.update_open_loop(length / looks, turn / looks, 1.0)
        wrapped = math.remainder(odometry.heading, 2.0 * math.pi)
        path.add(odometry.x, odometry.y, wrapped)
    assert path.travel.distance == pytest.approx(length, abs=1e-9)
    assert path.travel.turn == pytest.approx(turn, abs=1e-9)
