# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Statistics of manager, controllers and components, measured by a given stopwatch."""

from dataclasses import astuple
import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.control_fakes import FakeController, FakeHardware, FakeLog, MS, start

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.statistics import RunningCycleStatistic, RunningStatistic, Statistic
from amr_description.control.switching import Strictness
from amr_description.log import Severity
from amr_description.model.hardware_info import HardwareType

US = 1000
"""ns."""
PERIOD = 10 * MS
SAMPLES = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=60)


def result_of(samples):
    running = RunningStatistic()
    for sample in samples:
        running.add(sample)
    return running.result()


# --- the numbers ---------------------------------------------------------------------------------


@given(SAMPLES)
def test_the_numbers_are_those_of_numpy(samples):
    found = result_of(samples)
    assert found.count == len(samples)
    assert (found.minimum, found.maximum) == (min(samples), max(samples))
    assert found.latest == samples[-1]
    assert found.mean == pytest.approx(np.mean(samples), rel=1e-9, abs=1e-6)
    assert found.standard_deviation == pytest.approx(np.std(samples), rel=1e-6, abs=1e-4)


def counted_one_by_one(samples):
    """Welford's algorithm as it is in the books: mean and Σ(x − mean)²."""
    mean = squares = 0.0
    for count, sample in enumerate(samples, start=1):
        deviation = sample - mean
        mean += deviation / count
        squares += deviation * (sample - mean)
    return mean, squares


@given(st.lists(st.floats(1.0, 1e3), min_size=1, max_size=9), st.integers(1, 600))
def test_the_bits_do_not_depend_on_when_samples_are_counted_in(values, count):
    samples = [values[number % len(values)] * (1 + number % 7) for number in range(count)]
    looked_at = RunningStatistic()
    for number, sample in enumerate(samples):
        looked_at.add(sample)
        if number % 100 == 99:
            looked_at.result()
    found = result_of(samples)
    mean, squares = counted_one_by_one(samples)
    assert looked_at.result() == found
    assert found == Statistic(
        count, mean, math.sqrt(squares / count), min(samples), max(samples), samples[-1]
    )


@given(SAMPLES, st.floats(-1e6, 1e6))
def test_a_shift_moves_the_mean_and_leaves_the_deviation(samples, shift):
    plain, shifted = result_of(samples), result_of([sample + shift for sample in samples])
    assert shifted.mean == pytest.approx(plain.mean + shift, abs=1e-6)
    assert shifted.standard_deviation == pytest.approx(plain.standard_deviation, abs=1e-3)


@given(st.floats(-1e6, 1e6), st.integers(1, 50))
def test_equal_samples_do_not_deviate_at_all(sample, count):
    found = result_of([sample] * count)
    assert astuple(found) == (count, sample, 0.0, sample, sample, sample)


def test_no_digits_are_lost_where_large_samples_are_close_together():
    offset = 1e9
    found = result_of([offset + each for each in (4.0, 7.0, 13.0, 16.0)])
    assert found.mean == offset + 10.0
    assert found.standard_deviation == pytest.approx(math.sqrt(22.5), rel=1e-12)


@given(SAMPLES, SAMPLES)
def test_a_reset_forgets_all(before, after):
    running = RunningStatistic()
    for sample in before:
        running.add(sample)
    running.reset()
    assert math.isnan(running.result().mean)
    for sample in after:
        running.add(sample)
    assert running.result() == result_of(after)


def test_without_samples_all_is_nan():
    count, *numbers = astuple(RunningStatistic().result())
    assert count == 0
    assert all(math.isnan(number) for number in numbers)


def test_a_cycle_has_a_duration_and_from_the_second_on_a_rate():
    running = RunningCycleStatistic()
    running.add(30 * US, None)
    running.add(50 * US, 10 * MS)
    found = running.result()
    assert astuple(found.execution_time) == (2, 40.0, 10.0, 30.0, 50.0, 50.0)
    assert astuple(found.periodicity) == (1, 100.0, 0.0, 100.0, 100.0, 100.0)


@pytest.mark.parametrize('period', [0, -10 * MS])
def test_time_that_stands_still_or_goes_back_is_no_rate(period):
    running = RunningCycleStatistic()
    running.add(30 * US, period)
    assert running.result().periodicity.count == 0


# --- who is measured -----------------------------------------------------------------------------


class HandClock:
    """A stopwatch that is advanced by what it measures."""

    now = 0

    def __call__(self):
        return self.now


class SlowHardware(FakeHardware):
    def __init__(self, clock, **options):
        super().__init__(['j'], **options)
        self.clock = clock

    def read(self, time, period):
        super().read(time, period)
        self.clock.now += 300 * US

    def write(self, time, period):
        super().write(time, period)
        self.clock.now += 20 * US


class SlowController(FakeController):
    clock, duration = None, 50 * US

    def update(self, time, period):
        super().update(time, period)
        self.clock.now += self.duration


@pytest.fixture
def clock():
    return HandClock()


def manager_with(hardware, clock, rate=100, log=None):
    resources = ResourceManager(FakeLog(), stopwatch=clock)
    resources.add(hardware)
    resources.set_state(hardware.info.name, LifecycleState.ACTIVE)
    return ControllerManager(resources, rate, log or FakeLog())


def controller_with(clock, name='fake', **options):
    controller = SlowController(name, **options)
    controller.clock = clock
    return controller


def run(manager, count, begin=0, period=PERIOD):
    for k in range(count):
        manager.tick(begin + k * period)


def test_reads_and_writes_are_measured(clock):
    manager = manager_with(SlowHardware(clock), clock)
    run(manager, 3)
    owned = manager.resources.components['hardware']
    read, write = owned.read_statistic.result(), owned.write_statistic.result()
    assert astuple(read.execution_time) == (3, 300.0, 0.0, 300.0, 300.0, 300.0)
    assert astuple(write.execution_time) == (3, 20.0, 0.0, 20.0, 20.0, 20.0)
    assert read.periodicity == write.periodicity == Statistic(2, *[100.0, 0.0] + [100.0] * 3)


def test_a_component_with_a_rate_of_its_own_is_measured_when_it_runs(clock):
    manager = manager_with(SlowHardware(clock, rw_rate=25), clock)
    run(manager, 9)
    owned = manager.resources.components['hardware']
    assert owned.read_statistic.result().execution_time.count == 3
    assert owned.read_statistic.result().periodicity.mean == 25.0


def test_a_sensor_is_never_written(clock):
    sensor = FakeHardware([], type=HardwareType.SENSOR)
    manager = manager_with(sensor, clock)
    run(manager, 3)
    owned = manager.resources.components['hardware']
    assert owned.is_sensor
    assert owned.write_statistic.result().execution_time.count == 0


def test_a_component_is_measured_from_its_activation_on(clock):
    manager = manager_with(SlowHardware(clock), clock)
    run(manager, 3)
    for state in (LifecycleState.INACTIVE, LifecycleState.ACTIVE):
        manager.set_component_state('hardware', state, 3 * PERIOD)
    run(manager, 2, begin=3 * PERIOD)
    owned = manager.resources.components['hardware']
    assert owned.read_statistic.result().execution_time.count == 2
    assert owned.read_statistic.result().periodicity.count == 1


def test_updates_are_measured_and_anew_from_each_activation_on(clock):
    manager = manager_with(SlowHardware(clock), clock)
    start(manager, controller_with(clock, update_rate=50))
    run(manager, 6)
    (loaded,) = manager.loaded
    found = loaded.statistic.result()
    assert astuple(found.execution_time) == (3, 50.0, 0.0, 50.0, 50.0, 50.0)
    assert astuple(found.periodicity) == (2, 50.0, 0.0, 50.0, 50.0, 50.0)
    manager.switch(['fake'], ['fake'], Strictness.STRICT, 6 * PERIOD)
    assert loaded.statistic.result().execution_time.count == 0


def test_the_manager_knows_how_regularly_it_ticks(clock):
    manager = manager_with(SlowHardware(clock), clock)
    for time in (0, 10 * MS, 18 * MS, 28 * MS):
        manager.tick(time)
    found = manager.periodicity.result()
    assert (found.count, found.minimum, found.maximum) == (3, 100.0, 125.0)


def test_a_reset_is_not_a_period(clock):
    manager = manager_with(SlowHardware(clock), clock)
    start(manager, controller_with(clock))
    run(manager, 3)
    manager.reset(0)
    run(manager, 3)
    of_controllers = (each.statistic.result().periodicity for each in manager.loaded)
    rates = [manager.periodicity.result(), *of_controllers]
    assert {rate.minimum for rate in rates} == {100.0}
    assert {rate.count for rate in rates} == {4}


# --- overruns ------------------------------------------------------------------------------------


def overruns(log):
    return [text for text in log.texts(Severity.WARN) if 'Overrun' in text]


def test_a_tick_that_takes_longer_than_its_period_is_warned_of(clock):
    log = FakeLog()
    manager = manager_with(SlowHardware(clock), clock, log=log)
    controller = start(manager, controller_with(clock))
    manager.warns_of_overruns = True
    manager.tick(0)
    assert overruns(log) == []
    controller.duration = 9_680 * US + 1
    manager.tick(PERIOD)
    assert overruns(log) == [
        'Overrun might occur, Total time : 10000.001 us (Expected < 10000.000 us) --> '
        'Read time : 300.000 us, Update time : 9680.001 us, Write time : 20.000 us'
    ]


def test_overruns_are_warned_of_only_if_enabled(clock):
    log = FakeLog()
    manager = manager_with(SlowHardware(clock), clock, log=log)
    controller = start(manager, controller_with(clock))
    controller.duration = 50 * MS
    run(manager, 3)
    assert overruns(log) == []


# --- callbacks -----------------------------------------------------------------------------------


def test_every_new_snapshot_is_passed_on(clock):
    manager = manager_with(SlowHardware(clock), clock)
    snapshots = []
    manager.on_change = snapshots.append
    start(manager, controller_with(clock))
    states = [[c.state for c in snapshot.controllers] for snapshot in snapshots]
    assert [LifecycleState.UNCONFIGURED] in states
    assert states[-1] == [LifecycleState.ACTIVE]
    assert snapshots[-1] is manager.snapshot


def test_after_every_tick_its_time_is_passed_on(clock):
    hardware = SlowHardware(clock)
    manager = manager_with(hardware, clock)
    ticks = []
    manager.on_tick = lambda time: ticks.append((time, hardware.count('write')))
    run(manager, 3)
    assert ticks == [(0, 1), (PERIOD, 2), (2 * PERIOD, 3)]
