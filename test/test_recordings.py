# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The recordings of the C++ stack, replayed through manager, controllers and mock hardware: the same
commands at the same instants, the same wheels, joint states, limited commands and odometry; but
for the estimated twist, the same bits.
"""

from dataclasses import replace
from itertools import pairwise
import math
from pathlib import Path

from control_fakes import (
    collect,
    FakeLog,
    LEFT,
    load_trace,
    make_manager,
    MS,
    RIGHT,
    start,
    TRACES,
)
import pytest

from amr_description.control.contracts import ControllerContext
from amr_description.control.samples import TwistSample
from amr_description.controllers.diff_drive_controller import DiffDriveController
from amr_description.controllers.diff_drive_parameters import DiffDriveParameters
from amr_description.controllers.joint_state_broadcaster import (
    BroadcasterParameters,
    JointStateBroadcaster,
)
from amr_description.hardware.mock_system import MockSystem
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import load
from amr_description.parameters import build

URDF = load(Path(__file__).parents[1] / 'urdf' / 'amr.urdf')
ROBOT = {
    'left_wheel_names': LEFT,
    'right_wheel_names': RIGHT,
    'wheel_separation': 0.3,
    'wheel_radius': 0.1,
    'publish_limited_velocity': True,
}
PERIOD = 10 * MS
LEAD = 60
"""Cycles before the recording begins: the time-out of no command at all has passed by then."""


def mock_wheels():
    """The robot's hardware with nothing but its plugin changed, as it was recorded."""
    (info,) = hardware_of(URDF)
    parameters = {'calculate_dynamics': 'true'}
    return MockSystem(replace(info, parameters=parameters), FakeLog())


class Replay:
    """One trace through the two controllers in a manager; every dictionary is by stamp."""

    def __init__(self, name, publish_rate):
        self.trace = load_trace(name)
        self.hardware = mock_wheels()
        self.manager = make_manager(self.hardware)
        self.time = self.trace['joint_states'][0][0] - LEAD * PERIOD
        values = ROBOT | self.trace['params'] | {'publish_rate': publish_rate}
        self.drive = self.start('diff_drive', DiffDriveController, DiffDriveParameters, values)
        broadcaster = self.start('joint_states', JointStateBroadcaster, BroadcasterParameters, {})
        odometry, _, limited = (collect(output) for output in self.drive.outputs())
        joint_states = collect(broadcaster.outputs()[0])
        self.wheels = {}
        self.run()
        self.odometry = {sample.stamp: sample for sample in odometry}
        self.limited = {sample.stamp: sample for sample in limited}
        self.joint_states = {sample.stamp: sample for sample in joint_states}

    def start(self, name, kind, table, values):
        controller = kind(ControllerContext(name, FakeLog(), robot=URDF))
        return start(self.manager, controller, build(table, values), self.time)

    def run(self):
        commands = {row[0]: row for row in self.trace['cmd_in']}
        for _ in range(LEAD + len(self.trace['joint_states'])):
            self.manager.tick(self.time)
            cells = self.hardware.command_interfaces()
            self.wheels[self.time] = {cell.prefix: cell.value for cell in cells}
            if self.time in commands:
                _, stamp, linear, angular = commands[self.time]
                sample = TwistSample(stamp, float(linear), float(angular))
                self.drive.inputs()[0].put(sample)
            self.time += PERIOD


@pytest.fixture(scope='module', params=TRACES)
def replay(request):
    """Odometry at every cycle: in the recordings its phase depends on the start."""
    return Replay(request.param, publish_rate=1000.0)


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
    replay = Replay(name, publish_rate=50.0)
    first = replay.trace['joint_states'][0][0]
    ours = sorted(stamp for stamp in replay.odometry if stamp >= first)
    recorded = [row[0] for row in replay.trace['odom']]
    assert len(ours) == len(recorded)
    assert {after - before for before, after in pairwise(ours)} == {20 * MS}
