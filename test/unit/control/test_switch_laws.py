# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The laws of switching, whatever is requested in whatever order and whatever fails meanwhile.

Chains, controllers that compete for a joint or a reference, readers, and fallbacks.
"""

from hypothesis import given, strategies as st
from support.control_fakes import (
    FakeChainable,
    FakeController,
    FakeHardware,
    FakeLog,
    make_manager,
    MS,
)
from support.examples import examples

from amr_description.control.interfaces import LifecycleState
from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError, HardwareError

STRICT, BEST_EFFORT = Strictness.STRICT, Strictness.BEST_EFFORT
PERIOD = 10 * MS
FALLBACKS = {'head': ['direct'], 'middle': ['greedy'], 'direct': ['tail', 'other']}


class Bench:
    """head → middle → tail → a; other → tail; side → tail; direct → a; greedy → a, b; reader."""

    def __init__(self):
        self.hardware = FakeHardware(['a', 'b'])
        self.manager = make_manager(self.hardware, log=FakeLog())
        self.time = 0
        self.controllers = {
            controller.context.name: controller
            for controller in (
                FakeController('head', ['middle/x']),
                FakeController('other', ['tail/x']),
                FakeController('side', ['tail/y']),
                FakeController('direct', ['a/velocity']),
                FakeController('greedy', ['a/velocity', 'b/velocity']),
                FakeController('reader', states=['tail/speed', 'a/position']),
                FakeChainable('middle', ['tail/x'], ['tail/speed']),
                FakeChainable('tail', ['a/velocity'], references='xy', exports=['speed']),
            )
        }
        for name, controller in self.controllers.items():
            self.manager.load(controller, 'a/Type', FALLBACKS.get(name, ()))
            self.manager.configure(name, None)

    @property
    def active(self):
        return set(self.manager.snapshot.active_controllers)

    def during(self, faults, action, *arguments):
        """Do something while these fail; bring back afterwards what failed."""
        for name, method in faults:
            fails = self.hardware if name == 'hardware' else self.controllers[name]
            fails.faults[method] = HardwareError('no') if fails is self.hardware else OSError('no')
        getattr(self, action)(*arguments)
        self.check()  # before the hardware may come back: nobody may have kept what is gone
        for each in (self.hardware, *self.controllers.values()):
            each.faults = {}
        self.manager.set_component_state('hardware', LifecycleState.ACTIVE, self.time)
        for each in self.manager.snapshot.controllers:
            if each.state is LifecycleState.UNCONFIGURED:
                self.manager.configure(each.name, None)

    def tick(self):
        self.time += PERIOD
        self.manager.tick(self.time)

    def reset(self):
        self.time = 0
        self.manager.reset(0)

    def lose_hardware(self, state):
        self.manager.set_component_state('hardware', state, self.time)

    def switch(self, activate, deactivate, strictness):
        before, state = self.active, self.manager.snapshot
        try:
            self.manager.switch(activate, deactivate, strictness, self.time)
        except ControllerError:
            # Under STRICT nothing has come up: refused as a whole, or taken back.
            is_refused = self.manager.snapshot is state
            assert is_refused or strictness is BEST_EFFORT or self.active <= before
        else:
            if strictness is STRICT:
                assert set(activate) <= self.active
                assert not (set(deactivate) - set(activate)) & self.active

    # --- the laws -----------------------------------------------------------------------------

    def check(self):
        self.check_claims()
        self.check_chains()
        self.check_snapshot()

    def check_claims(self):
        """A command has at most one holder, which is active and has the interface."""
        held = {}
        for name in self.active:
            for handle in self.controllers[name].handles:
                assert handle.name not in held
                held[handle.name] = name
        assert self.manager.resources.claims == held

    def check_chains(self):
        """Needed controllers are active; exactly the commanded ones are in chained mode."""
        wanted = {
            name: [each.names for each in controller.requests]
            for name, controller in self.controllers.items()
        }
        for name in self.active:
            for interface in (*wanted[name][0], *wanted[name][1]):
                exporter = interface.partition('/')[0]
                assert exporter not in self.controllers or exporter in self.active
        for name, controller in self.controllers.items():
            commanded = any(
                interface.startswith(f'{name}/')
                for other in self.active
                for interface in wanted[other][0]
            )
            assert controller.is_chained == (name in self.active and commanded)

    def check_snapshot(self):
        snapshot, claims = self.manager.snapshot, self.manager.resources.claims
        for controller in snapshot.controllers:
            is_active = controller.state is LifecycleState.ACTIVE
            assert controller.claimed == (controller.required_commands if is_active else ())
            assert controller.is_chained == self.controllers[controller.name].is_chained
            for offered in (*controller.references, *controller.exported_states):
                assert offered.is_available == is_active
        assert {i.name for i in snapshot.commands if i.is_claimed} == set(claims)
        # Nobody knows whom a controller commands that is unconfigured.
        known = [c for c in snapshot.controllers if c.state is not LifecycleState.UNCONFIGURED]
        chain = [c.name for c in known if c.name in ('head', 'middle', 'tail')]
        if len(chain) == 3:
            assert chain == ['head', 'middle', 'tail']


CHAINS = ('tail', 'tail middle', 'tail middle head', 'middle head', 'tail side', 'tail reader')
names = st.sampled_from(sorted(Bench().controllers))
some = st.lists(names, max_size=3, unique=True)
chosen = st.one_of(some, st.sampled_from([chain.split() for chain in CHAINS]))
strictness = st.sampled_from((STRICT, BEST_EFFORT))
actions = st.one_of(
    st.tuples(st.just('switch'), chosen, some, strictness),
    st.tuples(st.just('switch'), chosen, st.just([]), strictness),
    st.tuples(st.just('switch'), st.just([]), chosen, strictness),
    st.tuples(st.sampled_from(('tick', 'reset'))),
    st.tuples(
        st.just('lose_hardware'),
        st.sampled_from((LifecycleState.INACTIVE, LifecycleState.UNCONFIGURED)),
    ),
)
methods = st.sampled_from(('update', 'deactivate', 'set_chained_mode', 'reset'))
faults = st.one_of(
    st.just([]),
    st.lists(st.tuples(names, st.just('activate')), min_size=1, max_size=2),
    st.lists(st.tuples(names, methods), min_size=1, max_size=2),
    st.tuples(
        st.tuples(st.just('hardware'), st.sampled_from(('prepare', 'perform', 'read', 'write')))
    ),
)


@examples(75)
@given(st.lists(st.tuples(faults, actions), min_size=5, max_size=15))
def test_the_laws_hold_whatever_is_asked_and_whatever_fails(sequence):
    bench = Bench()
    for failing, (action, *arguments) in sequence:
        bench.during(failing, action, *arguments)


@examples(50)
@given(st.lists(st.tuples(chosen, some), max_size=30))
def test_without_faults_a_strict_switch_does_all_or_nothing(requests):
    bench = Bench()
    for activate, deactivate in requests:
        before, snapshot = bench.active, bench.manager.snapshot
        try:
            bench.manager.switch(activate, deactivate, STRICT, 0)
        except ControllerError:
            assert bench.manager.snapshot is snapshot
        else:
            assert bench.active == (before - set(deactivate)) | set(activate)
        bench.check()
