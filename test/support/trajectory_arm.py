# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A joint trajectory controller over joints without physics, update by update."""

from support.control_fakes import collect, FakeLog

from amr_description.clock import NANOSECONDS as S
from amr_description.control.contracts import ControllerContext, Goal
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.trajectory_samples import (
    FollowTrajectoryGoal,
    TrajectoryPoint,
    TrajectorySample,
)
from amr_description.controllers.joint_trajectory.controller import (
    JointTrajectoryController,
)
from amr_description.controllers.joint_trajectory.parameters import (
    JointTrajectoryParameters,
)
from amr_description.parameters import build

PERIOD = S // 100
BASIC = {
    'joints': ('a', 'b'),
    'command_interfaces': ('position',),
    'state_interfaces': ('position', 'velocity'),
}


class Arm:
    """Two joints whose states are set by hand, or follow the commands one period later."""

    def __init__(self, robot=None, positions=(0.0, 0.0), **parameters):
        self.log = FakeLog()
        self.parameters = build(
            JointTrajectoryParameters,
            BASIC | {name.replace('__', '.'): value for name, value in parameters.items()},
        )
        self.controller = JointTrajectoryController(
            ControllerContext('arm', self.log, update_rate=100, robot=robot)
        )
        self.controller.configure(self.parameters)
        self.commands = [
            CommandInterface(*name.split('/'))
            for name in self.controller.command_interfaces().names
        ]
        self.states = [
            StateInterface(*name.split('/'), 0.0)
            for name in self.controller.state_interfaces().names
        ]
        self.time = 5 * S
        self.is_following = True
        self.sent = collect(self.controller.outputs()[0])
        self.place(*positions)

    def place(self, *positions, velocities=(0.0, 0.0)):
        kinds = {'position': positions, 'velocity': velocities, 'acceleration': (0.0, 0.0)}
        for handle in self.states:
            if handle.prefix in ('a', 'b'):
                handle.value = kinds[handle.interface]['ab'.index(handle.prefix)]

    def activate(self):
        self.controller.activate(self.commands, self.states, self.time)
        for port in (*self.controller.inputs(), *self.controller.actions()):
            port.open()
        return self

    def values(self, kind='position', handles=None):
        return [h.value for h in (handles or self.commands) if h.interface == kind]

    def run(self, seconds=0.01):
        """Return the commanded positions of each update."""
        commands = []
        for _ in range(round(seconds * 100)):
            self.controller.update(self.time, PERIOD)
            commands.append(self.values() or self.values('velocity') or self.values('effort'))
            if self.is_following and self.values():
                self.place(*self.values())
            self.time += PERIOD
        return commands

    def send(self, *points, times=None, stamp=0, names=('a', 'b'), **tolerances):
        """Send a goal; return it."""
        goal = Goal(
            FollowTrajectoryGoal(
                trajectory(*points, times=times, stamp=stamp, names=names), **tolerances
            )
        )
        action = self.controller.actions()[0]
        assert action.check(goal.request, self.time) == ''
        assert action.put(goal)
        return goal


def trajectory(*points, times=None, stamp=0, names=('a', 'b')):
    points = tuple(p if isinstance(p, TrajectoryPoint) else TrajectoryPoint(p) for p in points)
    times = times or [1.0 + k for k in range(len(points))]
    return TrajectorySample(stamp, names, points, tuple(round(t * S) for t in times))


def outcome(goal):
    status, result = goal.outcome
    return status, result.error_code, result.error_string
