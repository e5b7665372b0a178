# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Replays the recordings of the C++ stack through the same controllers."""

from dataclasses import replace

from support.control_fakes import (
    bring_up,
    collect,
    FakeLog,
    LEFT,
    load_trace,
    MS,
    RIGHT,
    start,
)
from support.paths import ROOT

from amr_description.control.contracts import ControllerContext
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.samples import TwistSample
from amr_description.controllers.broadcasters.joint_state_broadcaster import (
    BroadcasterParameters,
    JointStateBroadcaster,
)
from amr_description.controllers.drives.diff_drive_controller import (
    DiffDriveController,
    DiffDriveParameters,
)
from amr_description.hardware.mock_system import MockSystem
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import load
from amr_description.parameters import build

URDF = load(ROOT / 'urdf' / 'amr.urdf')
ROBOT = {
    'left_wheel_names': LEFT,
    'right_wheel_names': RIGHT,
    'wheel_separation': 0.3,
    'wheel_radius': 0.1,
    'publish_limited_velocity': True,
}
PERIOD = 10 * MS
LEAD = 60
"""Cycles before the recording starts, after which the timeout without a command has passed."""


def mock_wheels():
    """Return the robot's hardware with another plugin only, as it was recorded."""
    (info,) = hardware_of(URDF)
    return MockSystem(replace(info, parameters={'calculate_dynamics': 'true'}), FakeLog())


class Replay:
    """One trace through both controllers in a manager; dictionaries are by stamp, ns."""

    def __init__(self, name, resources=None, **parameters):
        """``parameters``: of the drive, on top of those of the trace; odometry at every cycle."""
        self.trace = load_trace(name)
        self.resources = resources or bring_up(mock_wheels())
        self.manager = ControllerManager(self.resources, 100, FakeLog())
        self.begin = self.trace['joint_states'][0][0]
        self.end = self.trace['joint_states'][-1][0]
        self.time = self.begin - LEAD * PERIOD
        self._commands = {row[0]: row for row in self.trace['cmd_in']}
        values = ROBOT | {'publish_rate': 1000.0} | self.trace['params'] | parameters
        self.drive = self.add('diff_drive', DiffDriveController, DiffDriveParameters, values)
        broadcaster = self.add('joint_states', JointStateBroadcaster, BroadcasterParameters, {})
        self._sent = [collect(output) for output in self.drive.outputs()]
        self._joint_states = collect(broadcaster.outputs()[0])
        self.wheels = {}

    def add(self, name, kind, table, values):
        controller = kind(ControllerContext(name, FakeLog(), robot=URDF))
        return start(self.manager, controller, build(table, values), self.time)

    def run(self, until=None):
        """Tick up to ``until`` (ns; None: the end of the trace), and return itself."""
        commands = self.resources.available_commands()
        wheels = [command for name, command in commands.items() if command.prefix in LEFT + RIGHT]
        while self.time <= (self.end if until is None else until):
            self.manager.tick(self.time)
            self.wheels[self.time] = {command.prefix: command.value for command in wheels}
            self._hear(self._commands.get(self.time))
            self.time += PERIOD
        return self

    def _hear(self, row):
        if row is not None:
            _, stamp, linear, angular = row
            self.drive.inputs()[0].put(TwistSample(stamp, float(linear), float(angular)))

    @property
    def odometry(self):
        return {sample.stamp: sample for sample in self._sent[0]}

    @property
    def limited(self):
        return {sample.stamp: sample for sample in self._sent[2]}

    @property
    def joint_states(self):
        return {sample.stamp: sample for sample in self._joint_states}
