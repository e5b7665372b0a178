# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a tick calls, in which order and how often, whatever fails or is switched between ticks."""

from contextlib import suppress

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import FakeChainable, FakeController, FakeHardware, FakeLog, MS
from support.examples import examples

from amr_description.control.controller_manager import ControllerManager, ManagerDefaults
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.statistics import unmeasured
from amr_description.control.switching import Strictness
from amr_description.errors import AmrError, HardwareDeactivationError, HardwareError
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


class Bench:
    """A manager with three components and four controllers."""

    def __init__(self, rw_rate=0, update_rate=100, deactivates=True):
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
        self.manager = ControllerManager(resources, 100, self.log, PERIOD, defaults)
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

    def states(self):
        """The state of each plugin, by its name."""
        states = {each.name: each.state for each in self.manager.loaded}
        components = self.manager.resources.components
        return states | {name: each.state for name, each in components.items()}


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


@examples(100)
@given(
    st.lists(EVENTS, max_size=25),
    st.sampled_from([0, 0, 50]),
    st.sampled_from([100, 100, 25]),
    st.booleans(),
)
def test_a_tick_calls_what_is_due_once_and_in_order(events, rw_rate, update_rate, deactivates):
    bench = Bench(rw_rate, update_rate, deactivates)
    for method, *arguments in [('tick',), ('tick',), *events, ('tick',), ('tick',)]:
        before, first = bench.states(), len(bench.diary.calls)
        order = [*HARDWARE, *(each.name for each in bench.manager.loaded)]
        getattr(bench, method)(*arguments)
        calls, states = bench.diary.calls[first:], bench.states()
        if method != 'tick':
            continue
        phases = ('read', 'update', 'write')
        places = [(phases.index(call), order.index(plugin)) for plugin, call, *_ in calls]
        assert places == sorted(set(places))  # read, update, write; each in order, and once
        for plugin, call, time, *_ in calls:
            assert time == bench.time
            if plugin in HARDWARE:
                least = LifecycleState.ACTIVE if call == 'write' else LifecycleState.INACTIVE
                assert before[plugin] >= least
        called = {(plugin, call) for plugin, call, *_ in calls}
        stays = [name for name in order if before[name] is states[name] is LifecycleState.ACTIVE]
        for name in stays:
            if name in CONTROLLERS and name != 'one':  # which may have a rate of its own
                assert (name, 'update') in called
            elif name in HARDWARE and not bench.hardware[name].info.rw_rate:
                assert (name, 'read') in called
                assert ((name, 'write') in called) == (name != 'eye')
        for name in CONTROLLERS:
            if before[name] is not LifecycleState.ACTIVE is not states[name]:
                assert (name, 'update') not in called


def after(calls, plugin, method):
    """What was called after this call."""
    names = [each[:2] for each in calls]
    return names[names.index((plugin, method)) + 1 :]


@pytest.mark.parametrize(
    'plugin, method, gone',
    [
        # its group is brought down, and with it the controllers that command it
        ('left', 'read', {'left', 'right', 'one', 'two', 'chain', 'head'}),
        ('right', 'read', {'left', 'right', 'one', 'two', 'chain', 'head'}),
        ('eye', 'read', {'eye'}),
        ('left', 'write', {'left', 'right'}),
        ('right', 'write', set()),
        ('one', 'update', set()),
        ('two', 'update', set()),
        ('head', 'update', set()),
        ('chain', 'update', set()),
    ],
)
def test_a_tick_goes_on_where_a_plugin_raises(plugin, method, gone):
    bench = Bench()
    for _ in range(3):
        bench.tick()
    whole = len(bench.diary.calls) // 3
    usual = after(bench.diary.calls[-whole:], plugin, method)
    bench.fail(plugin, method, ValueError('a bug'))
    bench.tick()
    rest = after(bench.diary.calls[3 * whole :], plugin, method)
    assert [each for each in rest if each[0] != 'spare'] == [
        each for each in usual if each[0] not in gone
    ]
    assert ('spare', 'update') not in rest  # the fallback is updated from the next tick on
    assert 'a bug' in str(bench.log.lines)


def test_a_tick_that_raises_counts_in_no_statistic():
    bench = Bench()
    for _ in range(3):
        bench.tick()
    bench.fail('eye', 'read', ValueError('a bug'))
    bench.fail('two', 'update', ValueError('a bug'))
    bench.tick()
    eye = bench.manager.resources.components['eye']
    two = next(each for each in bench.manager.loaded if each.name == 'two')
    assert eye.read_statistic.result().execution_time.count == 3
    assert two.statistic.result().execution_time.count == 3


def test_a_robot_that_nobody_measures_has_no_statistics():
    resources = ResourceManager(FakeLog(), stopwatch=unmeasured)
    resources.add(FakeHardware(['a'], 'left'))
    resources.set_state('left', LifecycleState.ACTIVE)
    manager = ControllerManager(resources, 100, FakeLog(), PERIOD)
    for time in (PERIOD, 2 * PERIOD):
        manager.tick(time)
    left = resources.components['left']
    assert left.component.faults == {}
    assert left.read_statistic.result().execution_time.count == 0
    assert left.write_statistic.result().periodicity.count == 0
