# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Robots spawned, removed, driven, reset, and their controllers switched, in whatever order.

What is asked of a robot is done by it, and by no other one; what is refused changes nothing.
"""

import math

from hypothesis import strategies as st
from hypothesis.stateful import (
    initialize,
    invariant,
    precondition,
    rule,
    RuleBasedStateMachine,
    run_state_machine_as_test,
)
import pytest
from support.examples import examples
from support.paths import ROOT

from amr_description import Simulation
from amr_description.errors import AmrError
from amr_description.model.frames import Transform

URDF = ROOT / 'urdf' / 'amr.urdf'
DRIVE, BROADCASTER = 'diff_drive_controller', 'joint_state_broadcaster'
NAMES = ('one', 'two', 'three')
APART = 4.0
"""m between robots, which drive less than half of it in all steps of an example."""
SPEED, SECONDS = 0.3, 0.3
LEAST = 0.03
"""m that a robot has driven after SECONDS; it speeds up at first."""
STILL = 2e-3
"""m that a robot without a command moves: it settles on its wheels."""
names = st.sampled_from(NAMES)
directions = st.sampled_from([-1.0, 1.0])


class AnyOrder(RuleBasedStateMachine):
    """A simulation, and what is known of each of its robots: its place, the state of its drive."""

    def __init__(self):
        super().__init__()
        self.sim = None
        self.drives = {}

    @initialize(name=names)
    def start(self, name):
        self.sim = Simulation(URDF, robots={name: self.place(name)})
        self.sim.start()
        self.drives = {name: 'active'}

    def teardown(self):
        if self.sim:
            self.sim.close()

    @staticmethod
    def place(name):
        return Transform((0.0, APART * NAMES.index(name), 0.0))

    def manager(self, name):
        return self.sim.robots[name].manager

    def switch(self, name, activate, deactivate):
        return self.manager(name).switch(activate=activate, deactivate=deactivate) is None

    def where(self):
        return {name: (each.truth.x, each.truth.y) for name, each in self.sim.robots.items()}

    # --- robots ---------------------------------------------------------------------------------

    @rule(name=names)
    def come_or_go(self, name):
        before = self.sim.time
        if name in self.drives:
            with pytest.raises(AmrError, match=f"a robot '{name}' cannot be added"):
                self.sim.spawn(name, self.place(name))
            self.sim.remove(name)
            del self.drives[name]
        else:
            with pytest.raises(AmrError, match=f"there is no robot '{name}'"):
                self.sim.remove(name)
            self.sim.spawn(name, self.place(name))
            self.drives[name] = 'active'
        assert self.sim.time == before

    @rule()
    def reset(self):
        self.sim.reset()
        assert self.sim.time == 0.0
        for name, (x, y) in self.where().items():
            assert math.dist((x, y), self.place(name).translation[:2]) < STILL

    # --- motion ---------------------------------------------------------------------------------

    @precondition(lambda self: self.drives)
    @rule(data=st.data(), direction=directions)
    def drive(self, data, direction):
        name = data.draw(st.sampled_from(sorted(self.drives)))
        self.sim.run(0.6)  # longer than the timeout of a command: all stand
        before = self.where()
        robot = self.sim.robots[name]
        robot_is_driven = self.drives[name] == 'active'
        if robot_is_driven:
            self.sim.send(robot.command_topic, robot.twist(direction * SPEED, 0.0))
        self.sim.run(SECONDS)
        for other, place in self.where().items():
            moved = place[0] - before[other][0]
            if other == name and robot_is_driven:
                assert direction * moved > LEAST
            else:
                assert math.dist(place, before[other]) < STILL

    # --- controllers ----------------------------------------------------------------------------

    @precondition(lambda self: self.drives)
    @rule(data=st.data(), is_switched=st.booleans())
    def change_the_drive(self, data, is_switched):
        name = data.draw(st.sampled_from(sorted(self.drives)))
        state = self.drives[name]
        assert not self.switch(name, ['nobody'], [DRIVE]), 'nothing of it is done'
        assert not self.manager(name).load(BROADCASTER), 'it is there'
        if is_switched:
            activate, deactivate = ([], [DRIVE]) if state == 'active' else ([DRIVE], [])
            is_done = self.switch(name, activate, deactivate)
            assert is_done == (state in ('active', 'inactive'))
            after = {'active': 'inactive', 'inactive': 'active'}
        else:
            change = {'unloaded': 'load', 'unconfigured': 'configure'}.get(state, 'unload')
            is_done = getattr(self.manager(name), change)(DRIVE)
            assert is_done == (state != 'active'), 'it has to be deactivated first'
            after = {
                'inactive': 'unloaded',
                'unloaded': 'unconfigured',
                'unconfigured': 'inactive',
            }
        self.drives[name] = after.get(state, state)

    # --- always ---------------------------------------------------------------------------------

    @invariant()
    def everybody_is_as_is_known(self):
        if self.sim is None:
            return
        assert set(self.sim.robots) == set(self.drives)
        for name, robot in self.sim.robots.items():
            states = robot.manager.states()
            assert states.pop(BROADCASTER) == 'active'
            assert states == (
                {} if self.drives[name] == 'unloaded' else {DRIVE: self.drives[name]}
            )
            truth = robot.truth
            assert truth.time == self.sim.time
            assert all(map(math.isfinite, (truth.x, truth.y, truth.yaw)))


def test_whatever_is_asked_in_whatever_order():
    run_state_machine_as_test(AnyOrder, settings=examples(40, stateful_step_count=20))
