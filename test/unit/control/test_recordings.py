# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The recordings of the C++ stack, replayed through manager, controllers and mock hardware: the same
commands at the same instants, the same wheels, joint states, limited commands and odometry; but
for the estimated twist, the same bits.
"""

from itertools import pairwise
import math

import pytest
from support.control_fakes import LEFT, MS, RIGHT, TRACES
from support.replaying import Replay


@pytest.fixture(scope='module', params=TRACES)
def replay(request):
    """Odometry at every cycle: in the recordings its phase depends on the start."""
    return Replay(request.param).run()


def test_there_are_recordings():
    assert TRACES == ['arc_0p5_0p5', 'limit_jerk', 'nan_command', 'stale_timeout', 'step_0p5']


def test_wheel_commands(replay):
    for stamp, left, right in replay.trace['wheel_commands']:
        expected = dict.fromkeys(LEFT, left) | dict.fromkeys(RIGHT, right)
        assert replay.wheels[stamp] == expected


def test_limited_commands(replay):
    for stamp, linear, angular in replay.trace['cmd_out']:
        sample = replay.limited[stamp]
        assert (sample.linear, sample.angular) == (linear, angular)


def test_joint_states(replay):
    for stamp, positions, velocities in replay.trace['joint_states']:
        sample = replay.joint_states[stamp]
        assert list(sample.name) == replay.trace['joint_names']
        assert list(sample.position) == positions
        assert list(sample.velocity) == velocities
        assert all(map(math.isnan, sample.effort))


def test_odometry(replay):
    meta = replay.trace['odom_meta']
    for stamp, x, y, z, qx, qy, qz, qw, linear, sideways, angular in replay.trace['odom']:
        sample = replay.odometry[stamp]
        assert (sample.x, sample.y) == (x, y)
        assert (math.sin(sample.heading / 2), math.cos(sample.heading / 2)) == (qz, qw)
        assert (z, qx, qy, sideways) == (0.0, 0.0, 0.0, 0.0)
        # Upstream's dt is the difference of two floating-point numbers of about 1000 s.
        assert (sample.linear, sample.angular) == pytest.approx((linear, angular), abs=1e-11)
        assert sample.frames.frame_id == meta['frame_id']
        assert sample.frames.child_frame_id == meta['child_frame_id']


@pytest.mark.parametrize('name', TRACES)
def test_odometry_comes_as_often_as_recorded(name):
    """Every 20 ms; which of the two phases depends on the start."""
    replay = Replay(name, publish_rate=50.0).run()
    ours = sorted(stamp for stamp in replay.odometry if stamp >= replay.begin)
    recorded = [row[0] for row in replay.trace['odom']]
    assert len(ours) == len(recorded)
    assert {after - before for before, after in pairwise(ours)} == {20 * MS}
