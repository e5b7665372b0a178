# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Diagnostics of a manager, by the rules of controller_manager and diagnostic_updater."""

import itertools
import math

import pytest
from support.control_fakes import FakeController, FakeHardware, make_manager, MS, start

from amr_description.control.diagnostic_thresholds import DiagnosticThresholds
from amr_description.control.diagnostics import Level, Report, reports, take_measurements
from amr_description.control.interfaces import LifecycleState
from amr_description.control.manager_parameters import ManagerTable
from amr_description.control.switching import Strictness
from amr_description.errors import ParameterError
from amr_description.model.hardware_info import HardwareType
from amr_description.parameters import build

US = 1000
"""ns."""
PERIOD = 10 * MS
CONTROLLERS = 'Controllers Activity'
HARDWARE = 'Hardware Components Activity'
MANAGER = 'Controller Manager Activity'


def reports_on(manager):
    return reports(take_measurements(manager), DiagnosticThresholds(), manager.update_rate)


def running(*components, controllers=(), rate=100):
    manager = make_manager(*components, rate=rate)
    for controller in controllers:
        start(manager, controller)
    return manager


def run(manager, count=4, begin=0):
    for k in range(count):
        manager.tick(begin + k * manager.period)


def fill(statistic, durations, period=PERIOD):
    """Add cycles that take ``durations``, µs."""
    statistic.reset()
    for duration in durations:
        statistic.add(round(duration * US), period)


# --- how lines are merged ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('first', 'second'), list(itertools.product([Level.OK, Level.WARN, Level.ERROR], repeat=2))
)
def test_the_worse_of_two_levels_counts_and_problems_are_joined(first, second):
    report = Report()
    report.merge(first, 'first')
    report.merge(second, 'second')
    assert report.level == max(first, second)
    if first and second:
        assert report.message == 'first; second'
    else:
        assert report.message == ('second' if second > first else 'first')


# --- controllers ---------------------------------------------------------------------------------


def test_all_is_well():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a', update_rate=50)])
    run(manager, 4)
    found = reports_on(manager)
    assert list(found) == [CONTROLLERS, HARDWARE, MANAGER]
    assert {report.level for report in found.values()} == {Level.OK}
    assert found[CONTROLLERS].message == 'All controllers are active'
    assert found[CONTROLLERS].values == [
        ('a.state', 'active'),
        ('a.execution_time', 'Avg: 0.00 [0.00 - 0.00] us, StdDev: 0.00'),
        ('a.periodicity', 'Avg: 50.00 [50.00 - 50.00] Hz, StdDev: 0.00 -> Desired : 50 Hz'),
    ]
    assert found[HARDWARE].message == 'All hardware components are active'
    assert found[HARDWARE].values == [
        ('hardware.state', 'active'),
        ('hardware.read_cycle.execution_time', 'Avg: 0.00 [0.00 - 0.00] us, StdDev: 0.00'),
        ('hardware.write_cycle.execution_time', 'Avg: 0.00 [0.00 - 0.00] us, StdDev: 0.00'),
    ]
    assert found[MANAGER].message == 'Controller Manager is running'
    assert found[MANAGER].values == [
        ('update_rate', '100'),
        ('periodicity.average', '100.000000'),
        ('periodicity.standard_deviation', '0.000000'),
        ('periodicity.min', '100.000000'),
        ('periodicity.max', '100.000000'),
    ]


def test_an_inactive_controller_has_a_state_and_no_times():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a'), FakeController('b')])
    manager.switch([], ['a'], Strictness.STRICT, 0)
    report = reports_on(manager)[CONTROLLERS]
    assert (report.level, report.message) == (Level.OK, 'Not all controllers are active')
    assert [key for key, _ in report.values if key.startswith('a.')] == ['a.state']


def test_without_controllers_there_is_a_warning():
    report = reports_on(running(FakeHardware(['j'])))[CONTROLLERS]
    assert (report.level, report.message) == (Level.WARN, 'No controllers are currently loaded')
    assert report.values == []


@pytest.mark.parametrize(
    ('durations', 'level'),
    [
        ([999.0] * 3, Level.OK),
        ([1001.0] * 3, Level.WARN),
        ([2001.0] * 3, Level.ERROR),
        ([100.0, 298.0], Level.OK),  # they deviate by half their distance
        ([100.0, 302.0], Level.WARN),
        ([100.0, 502.0], Level.ERROR),
    ],
)
def test_slow_and_uneven_updates_are_named(durations, level):
    controllers = [FakeController('good'), FakeController('bad')]
    manager = running(FakeHardware(['j']), controllers=controllers)
    bad = next(each for each in manager.loaded if each.name == 'bad')
    fill(bad.statistic, durations)
    report = reports_on(manager)[CONTROLLERS]
    assert report.level is level
    if level:
        assert report.message == '\nHigh execution jitter or mean error : [ bad ]'
    else:
        assert report.message == 'All controllers are active'


def test_the_worst_controller_gives_the_level_and_all_are_named():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a'), FakeController('b')])
    for loaded, duration in zip(manager.loaded, [1500.0, 2500.0], strict=True):
        fill(loaded.statistic, [duration])
    report = reports_on(manager)[CONTROLLERS]
    names = ' '.join(loaded.name for loaded in manager.loaded)
    assert report.level is Level.ERROR
    assert report.message == f'\nHigh execution jitter or mean error : [ {names} ]'


@pytest.mark.parametrize(
    ('rate', 'level'), [(54, Level.OK), (56, Level.WARN), (39, Level.ERROR), (61, Level.ERROR)]
)
def test_a_rate_of_its_own_is_compared_with_what_was_asked_for(rate, level):
    manager = running(FakeHardware(['j']), controllers=[FakeController('a', update_rate=50)])
    fill(manager.loaded[0].statistic, [10.0] * 3, round(1000 * MS / rate))
    report = reports_on(manager)[CONTROLLERS]
    assert report.level is level
    if level:
        assert report.message == '\nHigh periodicity jitter or mean error : [ a ]'


def test_problems_of_both_kinds_are_joined():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a', update_rate=50)])
    fill(manager.loaded[0].statistic, [1500.0] * 3, 10 * MS)
    report = reports_on(manager)[CONTROLLERS]
    assert report.level is Level.ERROR
    assert report.message == (
        '\nHigh execution jitter or mean error : [ a ]; '
        '\nHigh periodicity jitter or mean error : [ a ]'
    )


def test_a_missing_measurement_is_not_a_problem():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a', update_rate=50)])
    report = reports_on(manager)[CONTROLLERS]
    assert report.level is Level.OK
    assert dict(report.values)['a.execution_time'] == 'Avg: nan [nan - nan] us, StdDev: nan'


# --- hardware ------------------------------------------------------------------------------------


def test_hardware_that_reads_and_writes_slowly_is_named_twice():
    manager = running(FakeHardware(['j']))
    owned = manager.resources.components['hardware']
    fill(owned.read_statistic, [1500.0])
    fill(owned.write_statistic, [1500.0])
    report = reports_on(manager)[HARDWARE]
    assert report.level is Level.WARN
    assert report.message == '\nHigh execution jitter or mean error : [ hardware hardware ]'


def test_hardware_with_a_rate_of_its_own_is_compared_with_it_and_named_once():
    manager = running(FakeHardware(['j'], rw_rate=25))
    owned = manager.resources.components['hardware']
    for statistic in (owned.read_statistic, owned.write_statistic):
        fill(statistic, [10.0] * 3, 100 * MS)
    report = reports_on(manager)[HARDWARE]
    assert report.level is Level.ERROR
    assert report.message == '\nHigh periodicity jitter or mean error : [ hardware ]'
    assert dict(report.values)['hardware.read_cycle.periodicity'] == (
        'Avg: 10.00 [10.00 - 10.00] Hz, StdDev: 0.00 -> Desired : 25 Hz'
    )


def test_a_sensor_has_no_write_cycle():
    sensor = FakeHardware([], name='imu', type=HardwareType.SENSOR)
    keys = [key for key, _ in reports_on(running(sensor))[HARDWARE].values]
    assert keys == ['imu.state', 'imu.read_cycle.execution_time']


def test_some_hardware_is_not_active():
    manager = running(FakeHardware(['i'], name='one'), FakeHardware(['j'], name='two'))
    manager.set_component_state('one', LifecycleState.INACTIVE, 0)
    report = reports_on(manager)[HARDWARE]
    assert (report.level, report.message) == (Level.OK, 'Not all hardware components are active')
    assert ('one.state', 'inactive') in report.values
    assert not any(key.startswith('one.read') for key, _ in report.values)


def test_no_hardware_is_active():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a')])
    manager.set_component_state('hardware', LifecycleState.UNCONFIGURED, 0)
    found = reports_on(manager)
    assert found[HARDWARE].level is Level.WARN
    assert found[HARDWARE].message == 'No hardware components are currently active'
    assert found[CONTROLLERS].level is Level.ERROR
    assert found[CONTROLLERS].message == (
        'No hardware components are currently active to activate controllers'
    )


def test_slow_controllers_without_hardware_are_two_problems():
    manager = running(FakeHardware(['j']), controllers=[FakeController('a')])
    fill(manager.loaded[0].statistic, [1500.0])
    manager.set_component_state('hardware', LifecycleState.INACTIVE, 0)
    report = reports_on(manager)[CONTROLLERS]
    assert report.level is Level.ERROR
    assert report.message == (
        '\nHigh execution jitter or mean error : [ a ]; '
        'No hardware components are currently active to activate controllers'
    )


def test_no_hardware_is_there():
    report = reports_on(make_manager())[HARDWARE]
    assert (report.level, report.message) == (Level.ERROR, 'No hardware components are loaded!')


# --- the manager ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('period', 'level', 'mean'),
    [(PERIOD, Level.OK, 100.0), (10_600_000, Level.WARN, 94.339623), (20 * MS, Level.ERROR, 50.0)],
)
def test_a_manager_at_another_rate_is_reported(period, level, mean):
    manager = running(FakeHardware(['j']))
    for k in range(4):
        manager.tick(k * period)
    report = reports_on(manager)[MANAGER]
    assert report.level is level
    if level:
        assert report.message == (
            f'Controller Manager has bad periodicity : {mean:f} Hz. Expected consistent 100 Hz'
        )


def test_an_uneven_rate_is_bad_though_its_mean_is_good():
    manager = running(FakeHardware(['j']))
    time = 0
    for rate in (100, 92, 108, 92, 108, 100):
        manager.tick(time)
        time += round(1000 * MS / rate)
    report = reports_on(manager)[MANAGER]
    assert math.isclose(manager.periodicity.result().mean, 100.0, abs_tol=1e-3)
    assert report.level is Level.WARN


@pytest.mark.parametrize(
    ('has_description', 'level', 'message'),
    [
        (False, Level.WARN, 'Waiting for robot description....'),
        (True, Level.ERROR, 'Resource Manager is not initialized properly!'),
    ],
)
def test_a_manager_without_hardware_reports_what_it_waits_for(has_description, level, message):
    found = reports(None, DiagnosticThresholds(), 100, has_description=has_description)
    assert (found[MANAGER].level, found[MANAGER].message) == (level, message)
    assert found[MANAGER].values[0] == ('update_rate', '100')
    assert found[HARDWARE].level is Level.ERROR
    assert found[HARDWARE].message == 'Resource manager is not yet initialized!'
    assert found[CONTROLLERS].level is Level.ERROR


def test_their_period_is_from_a_millisecond_to_a_day():
    for period in (1e-3, 1.0, 1e5):
        table = build(ManagerTable, {'diagnostic_updater.period': period})
        assert table.diagnostic_updater.period == period
    for period in (0.0, 9e-4, 1.1e5, math.nan):
        with pytest.raises(ParameterError, match="'diagnostic_updater.period'"):
            build(ManagerTable, {'diagnostic_updater.period': period})
