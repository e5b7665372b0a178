# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Tolerances at their edges, and those of a goal over those of the parameters."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.control.trajectory_samples import (
    FollowTrajectoryGoal,
    JointTolerance,
    TrajectoryPoint,
    TrajectorySample,
)
from amr_description.controllers.joint_trajectory.checks import (
    resolved,
    StateTolerances,
    Tolerances,
    tolerances_of_goal,
    Violation,
)
from amr_description.errors import ControllerError

JOINTS = ('a', 'b')
DEFAULTS = Tolerances(
    StateTolerances(((0.1, 0.0, 0.0), (0.2, 0.0, 0.0))),
    StateTolerances(((0.01, 0.5, 0.0), (0.02, 0.5, 0.0))),
    2.0,
)
EMPTY = TrajectorySample(0, JOINTS, (), ())


def goal(**tolerances):
    return FollowTrajectoryGoal(EMPTY, **tolerances)


@given(st.floats(0.001, 10.0), st.sampled_from(['positions', 'velocities', 'accelerations']))
def test_an_error_as_large_as_its_tolerance_is_within_it(limit, name):
    tolerances = StateTolerances(((0.0, 0.0, 0.0), (limit, limit, limit)))
    for sign in (1.0, -1.0):
        inside = TrajectoryPoint(positions=(9.0, 0.0)), {name: (9.0, sign * limit)}
        at_edge = TrajectoryPoint(**({'positions': (9.0, 0.0)} | inside[1]))
        assert tolerances.violations(at_edge) == []
        beyond = sign * math.nextafter(limit, math.inf)
        outside = TrajectoryPoint(**({'positions': (9.0, 0.0)} | {name: (9.0, beyond)}))
        (found,) = tolerances.violations(outside)
        assert (found.joint, found.error, found.limit) == (1, beyond, limit)


def test_what_is_not_measured_and_what_is_no_number_exceeds_nothing():
    tolerances = StateTolerances(((0.1, 0.1, 0.1),))
    assert tolerances.violations(TrajectoryPoint((0.0,))) == []
    assert tolerances.violations(TrajectoryPoint((math.nan,))) == []


def test_every_violation_is_found():
    tolerances = StateTolerances(((0.1, 0.2, 0.0), (0.3, 0.0, 0.0)))
    error = TrajectoryPoint((1.0, -1.0), (2.0, 2.0))
    assert tolerances.violations(error) == [
        Violation(0, 'position', 1.0, 0.1),
        Violation(1, 'position', -1.0, 0.3),
        Violation(0, 'velocity', 2.0, 0.2),
    ]


@pytest.mark.parametrize(('wanted', 'found'), [(0.0, 0.3), (-1.0, 0.0), (0.7, 0.7)])
def test_zero_is_the_default_and_minus_one_is_none(wanted, found):
    assert resolved(0.3, wanted) == found


@pytest.mark.parametrize('wanted', [-0.5, -2.0, -1.0 - 1e-9])
def test_other_negative_tolerances_are_illegal(wanted):
    with pytest.raises(ControllerError, match='Illegal tolerance value'):
        resolved(0.3, wanted)


def test_a_goal_has_tolerances_of_its_own():
    found, complaint = tolerances_of_goal(
        DEFAULTS,
        goal(
            path_tolerance=(JointTolerance('b', 0.5, 1.0, 2.0),),
            goal_tolerance=(JointTolerance('a', -1.0, 0.0, 0.0),),
            goal_time_tolerance=-1.0,
        ),
        JOINTS,
    )
    assert complaint == ''
    assert found == Tolerances(
        StateTolerances(((0.1, 0.0, 0.0), (0.5, 1.0, 2.0))),
        StateTolerances(((0.0, 0.5, 0.0), (0.02, 0.5, 0.0))),
        0.0,
    )


@pytest.mark.parametrize(
    ('wrong', 'text'),
    [
        (
            {'goal_time_tolerance': -2.0},
            'Illegal goal time tolerance specified: -2.000000. Using default tolerances.',
        ),
        (
            {'path_tolerance': (JointTolerance('c', 1.0),)},
            "Path tolerance specified for unknown joint 'c'. Using default tolerances.",
        ),
        (
            {'goal_tolerance': (JointTolerance('a', 1.0), JointTolerance('c', 1.0))},
            "Goal tolerance specified for unknown joint 'c'. Using default tolerances.",
        ),
        (
            {'path_tolerance': (JointTolerance('a', 1.0, -3.0),)},
            "Illegal velocity path tolerance value specified for joint 'a'. Using default "
            'tolerances.',
        ),
        (
            {'goal_tolerance': (JointTolerance('b', 0.0, 0.0, -3.0),)},
            "Illegal acceleration goal tolerance value specified for joint 'b'. Using default "
            'tolerances.',
        ),
    ],
)
def test_a_mistake_in_them_leaves_the_defaults(wrong, text):
    assert tolerances_of_goal(DEFAULTS, goal(**wrong), JOINTS) == (DEFAULTS, text)
