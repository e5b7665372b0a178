# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Why trajectories are refused, in the original's words."""

import math

import pytest

from amr_description.clock import NANOSECONDS as S
from amr_description.control.trajectory_samples import TrajectoryPoint, TrajectorySample
from amr_description.controllers.joint_trajectory.checks import TrajectoryRules

JOINTS = ('a', 'b')
STRICT = TrajectoryRules(JOINTS)
GOOD = (TrajectoryPoint((1.0, 2.0), (0.5, 0.5)), TrajectoryPoint((2.0, 3.0), (0.0, 0.0)))
VELOCITIES = (TrajectoryPoint((), (0.0, 0.0)),)


def sample(points=GOOD, names=JOINTS, times=None, stamp=0):
    return TrajectorySample(
        stamp, names, tuple(points), times or tuple(S * k for k in range(1, len(points) + 1))
    )


@pytest.mark.parametrize(
    ('rules', 'trajectory'),
    [
        (STRICT, sample()),
        (STRICT, sample(names=('b', 'a'))),
        (STRICT, sample(stamp=8 * S)),
        (
            TrajectoryRules(JOINTS, allow_partial_joints=True),
            sample([TrajectoryPoint((1.0,))], ('b',)),
        ),
        (TrajectoryRules(JOINTS, allow_integration=True), sample(VELOCITIES)),
        (TrajectoryRules(JOINTS, allow_nonzero_end_velocity=True), sample(GOOD[:1])),
        (
            TrajectoryRules(JOINTS, has_effort=True),
            sample([TrajectoryPoint((1.0, 1.0), effort=(1.0, 1.0))]),
        ),
    ],
)
def test_good_trajectories_are_taken(rules, trajectory):
    assert rules.complaint(trajectory, 10 * S) == ''


@pytest.mark.parametrize(
    ('trajectory', 'text'),
    [
        (sample(names=('a',)), "Joints on incoming trajectory don't match the controller joints."),
        (sample([]), 'Empty trajectory received.'),
        (sample(names=('a', 'x')), "Incoming joint x doesn't match the controller's joints."),
        (sample(names=('a', 'a')), 'Incoming joints a, a name one of them twice.'),
        (
            sample(GOOD[:1]),
            'Velocity of last trajectory point of joint a is not zero: 0.500000000000000',
        ),
        (
            sample(stamp=7 * S),
            'Received trajectory with non-zero start time (7.000000) that ends in the past '
            '(9.000000)',
        ),
        (
            sample(times=(S, S)),
            'Time between points 0 and 1 is not strictly increasing, it is 1.000000 and 1.000000 '
            'respectively',
        ),
        (
            sample([TrajectoryPoint((1.0,))]),
            'Mismatch between joint_names size (2) and positions (1) at point #0.',
        ),
        (
            sample([GOOD[1], TrajectoryPoint((1.0, 1.0), (0.0,))]),
            'Mismatch between joint_names size (2) and velocities (1) at point #1.',
        ),
        (
            sample([TrajectoryPoint((1.0, 1.0), (), (0.0,))]),
            'Mismatch between joint_names size (2) and accelerations (1) at point #0.',
        ),
        (
            sample(VELOCITIES),
            'Mismatch between joint_names size (2) and positions (0) at point #0.',
        ),
        (
            sample([TrajectoryPoint((1.0, 1.0), effort=(1.0, 1.0))]),
            'Trajectories with effort fields are only supported for controllers using the '
            "'effort' command interface.",
        ),
        (
            sample([TrajectoryPoint((1.0, math.nan))]),
            'Point #0 has a number that is not finite.',
        ),
    ],
)
def test_wrong_trajectories_are_refused_in_these_words(trajectory, text):
    assert STRICT.complaint(trajectory, 10 * S) == text


@pytest.mark.parametrize(
    ('rules', 'trajectory', 'text'),
    [
        (
            TrajectoryRules(JOINTS, allow_partial_joints=True),
            sample(names=()),
            'Empty joint names on incoming trajectory.',
        ),
        (
            TrajectoryRules(JOINTS, allow_integration=True),
            sample([TrajectoryPoint()]),
            'The given trajectory has no position, velocity, or acceleration points.',
        ),
        (
            TrajectoryRules(JOINTS, has_effort=True),
            sample([TrajectoryPoint((1.0, 1.0), effort=(1.0,))]),
            'Mismatch between joint_names size (2) and effort (1) at point #0.',
        ),
    ],
)
def test_what_is_allowed_has_limits_too(rules, trajectory, text):
    assert rules.complaint(trajectory, 10 * S) == text
