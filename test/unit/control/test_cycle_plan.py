# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A planned tick and a plain one are the same to plugins, logs and statistics, whatever fails."""

from contextlib import suppress

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import FakeChainable, FakeController, FakeHardware, FakeLog, MS
from support.examples import examples

from amr_description.control.controller_manager import ControllerManager, ManagerDefaults
from amr_description.control.cycle_plan import CyclePlan
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.errors import AmrError, HardwareDeactivationError, HardwareError
from amr_description.log import Severity
from amr_description.model.hardware_info import HardwareType

PERIOD = 10 * MS


class Diary:
    """What all plugins of a manager were asked for, by a clock that each call moves on."""

    def __init__(self):
        self.calls, self.now = [], 0

    def note(self, plugin, method, *arguments):
        self.calls.append((plugin, method, *arguments))
        self.now += 1000 * len(self.calls) % 7001


class Hardware(FakeHardware):
    """Notes when it is read and written, and what is commanded then."""

    def __init__(self, diary, *args, **options):
        super().__init__(*args, **options)
        self.diary = diary

    def read(self, time, period):
        self.diary.note(self.info.name, 'read', time, period)
        super().read(time, period)

    def write(self, time, period):
        commands = [repr(command.value) for command in self.commands.values()]
        self.diary.note(self.info.name, 'write', time, period, *commands)
        super().write(time, period)


def noting(kind):
    class Noting(kind):
        """Notes when it is updated."""

        diary = None

        def update(self, time, period):
            self.diary.note(self.context.name, 'update', time, period)
            super().update(time, period)

    return Noting


Controller, Chainable = noting(FakeController), noting(FakeChainable)


class PlainManager(ControllerManager):
    """One that never plans."""

    def _forget_plan(self):
        self._plan, self._is_plan_due = None, False


class Bench:
    """A manager with three components and four controllers."""

    def __init__(self, manager_type, rw_rate=0, update_rate=100, deactivates=True):
        self.diary, self.log, self.time = Diary(), FakeLog(), 0
        self.hardware = {
            'left': Hardware(self.diary, ['a'], 'left', group='base'),
            'right': Hardware(self.diary, ['b', 'c'], 'right', group='base', rw_rate=rw_rate),
            'eye': Hardware(self.diary, [], 'eye', type=HardwareType.SENSOR),
        }
        resources = ResourceManager(self.log, stopwatch=lambda: self.diary.now)
        for name, component in self.hardware.items():
            resources.add(component)
            resources.set_state(name, LifecycleState.ACTIVE)
        defaults = ManagerDefaults(deactivate_controllers_on_hardware_self_deactivate=deactivates)
        self.manager = manager_type(resources, 100, self.log, PERIOD, defaults)
        chain = Chainable('chain', ['b/velocity'])
        self.controllers = {
            each.context.name: each
            for each in (
                Controller('one', ['a/velocity'], update_rate=update_rate),
                Controller('two', ['c/velocity'], ['a/position']),
                Controller('head', ['chain/x']),
                chain,
                Controller('spare', ['a/velocity']),
            )
        }
        for name, controller in self.controllers.items():
            controller.diary = self.diary
            fallbacks = ('spare',) if name == 'one' else ()
            self.manager.load(controller, 'a/Type', fallbacks)
            self.manager.configure(name, None)
        self.switch(['one', 'two', 'chain', 'head'], [])

    def switch(self, start, stop):
        with suppress(AmrError):
            self.manager.switch(start, stop, Strictness.BEST_EFFORT, self.time)

    def tick(self, passed=PERIOD):
        self.time += passed
        self.manager.tick(self.time)

    def fail(self, plugin, method, error):
        """Have a call of a plugin raise from now on; without an error: no longer."""
        faults = (self.hardware.get(plugin) or self.controllers[plugin]).faults
        faults.pop(method, None)
        if error is not None:
            faults[method] = error

    def bring(self, component, state):
        with suppress(AmrError):
            self.manager.set_component_state(component, state, self.time)

    def behind_the_managers_back(self, component, state):
        with suppress(AmrError):
            self.manager.resources.set_state(component, state)

    def jump(self, method, time):
        self.time = time
        getattr(self.manager, method)(time)

    def seen(self):
        """All that is to be the same."""
        components = self.manager.resources.components.values()
        return (
            self.diary.calls,
            self.log.texts(Severity.INFO),
            self.manager.snapshot,
            self.manager.next_tick,
            repr(self.manager.periodicity.result()),
            [repr(each.read_statistic.result()) for each in components],
            [repr(each.write_statistic.result()) for each in components],
            [repr(each.statistic.result()) for each in self.manager.loaded],
        )


HARDWARE, CONTROLLERS = ('left', 'right', 'eye'), ('one', 'two', 'head', 'chain', 'spare')
STATES = (LifecycleState.UNCONFIGURED, LifecycleState.INACTIVE, LifecycleState.ACTIVE)
ERRORS = st.sampled_from(
    [None, HardwareError('broken'), HardwareDeactivationError('enough'), ValueError('a bug')]
)
NAMES = st.lists(st.sampled_from(CONTROLLERS), max_size=3)
TICK = st.tuples(st.just('tick'), st.sampled_from([PERIOD, PERIOD, PERIOD, 13 * MS, 0]))
EVENTS = st.one_of(
    TICK,
    TICK,
    TICK,
    st.tuples(
        st.just('fail'), st.sampled_from(HARDWARE), st.sampled_from(['read', 'write']), ERRORS
    ),
    st.tuples(st.just('fail'), st.sampled_from(CONTROLLERS), st.just('update'), ERRORS),
    st.tuples(st.just('switch'), NAMES, NAMES),
    st.tuples(
        st.sampled_from(['bring', 'behind_the_managers_back']),
        st.sampled_from(HARDWARE),
        st.sampled_from(STATES),
    ),
    st.tuples(st.just('jump'), st.sampled_from(['reset', 'set_clock', 'begin']), st.just(0)),
)


@examples(50)
@given(
    st.lists(EVENTS, max_size=25),
    st.sampled_from([0, 0, 50]),
    st.sampled_from([100, 100, 25]),
    st.booleans(),
)
def test_a_planned_tick_is_a_plain_one(events, rw_rate, update_rate, deactivates):
    planned, plain = (
        Bench(kind, rw_rate, update_rate, deactivates)
        for kind in (ControllerManager, PlainManager)
    )
    for bench in (planned, plain):
        for method, *arguments in [('tick',), ('tick',), *events, ('tick',), ('tick',)]:
            getattr(bench, method)(*arguments)
    for one, other in zip(planned.seen(), plain.seen(), strict=True):
        assert one == other


@pytest.mark.parametrize(
    'plugin, method',
    [('left', 'read'), ('right', 'read'), ('eye', 'read'), ('left', 'write'), ('right', 'write')]
    + [(name, 'update') for name in ('one', 'two', 'head', 'chain')],
)
@pytest.mark.parametrize('error', [ValueError('a bug'), HardwareDeactivationError('enough')])
def test_the_tick_of_a_plan_goes_on_plainly_where_a_plugin_raises(plugin, method, error):
    benches = Bench(ControllerManager), Bench(PlainManager)
    for bench in benches:
        for _ in range(3):
            bench.tick()
        assert (bench.manager._plan is None) == (bench is benches[1])
        bench.fail(plugin, method, error)
        bench.tick()
        bench.fail(plugin, method, None)
        for _ in range(3):
            bench.tick()
    planned, plain = (bench.seen() for bench in benches)
    assert planned == plain
    assert str(error) in str(benches[0].log.lines)


def test_ticks_are_planned_once_all_has_been_called_and_anew_after_each_change(monkeypatch):
    made, run = [], CyclePlan.run
    monkeypatch.setattr(CyclePlan, 'run', lambda *args: made.append(args[0]) or run(*args))
    bench = Bench(ControllerManager)
    bench.tick()
    assert made == []  # the first one finds out that all are due
    for _ in range(3):
        bench.tick()
    assert len(made) == 3
    bench.switch([], ['two'])
    bench.tick()
    bench.tick()
    assert len(made) == 4
    assert made[0] is made[2] is not made[3]


def test_what_has_a_rate_of_its_own_is_not_planned():
    for options in ({'rw_rate': 50}, {'update_rate': 25}):
        bench = Bench(ControllerManager, **options)
        for _ in range(3):
            bench.tick()
        assert bench.manager._plan is None
