# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The values of a manager for introspection: their names, and that they are live."""

import math

import pytest
from support.control_fakes import (
    FakeChainable,
    FakeController,
    FakeHardware,
    make_manager,
    MS,
    start,
)

from amr_description.control.interfaces import LifecycleState, StateInterface
from amr_description.control.introspection import interfaces_of, statistics_of
from amr_description.model.hardware_info import HardwareType

NUMBERS = ('max', 'min', 'average', 'standard_deviation', 'sample_count', 'current_value')
CYCLE = [f'{kind}/{each}' for kind in ('execution_time', 'periodicity') for each in NUMBERS]


def test_interfaces_of_hardware_are_listed_whether_available_or_not():
    hardware = FakeHardware(['i', 'j'])
    manager = make_manager(hardware)
    manager.set_component_state('hardware', LifecycleState.UNCONFIGURED, 0)
    registry = interfaces_of(manager)
    assert registry.names == (
        'state_interface.i/position',
        'state_interface.j/position',
        'state_interface.i/velocity',
        'state_interface.j/velocity',
        'command_interface.i/velocity',
        'command_interface.j/velocity',
    )
    hardware.positions['j'].value = 4.0
    hardware.commands['i'].value = 5.0
    assert registry.read()[:5] == [0.0, 4.0, 0.0, 0.0, 5.0]


def test_exported_interfaces_are_listed_once_configured():
    manager = make_manager(FakeHardware(['j']))
    plain = interfaces_of(manager).names
    controller = FakeChainable('chained', references=['x'], exports=['y'])
    manager.load(controller, 'a/Type')
    assert interfaces_of(manager).names == plain
    manager.configure('chained', None)
    registry = interfaces_of(manager)
    added = ('state_interface.chained/y', 'command_interface.chained/x')
    assert registry.names == plain + added
    controller.offers[0][0].value = 3.0
    assert registry.read()[-1] == 3.0
    manager.cleanup('chained')
    assert interfaces_of(manager).names == plain


@pytest.mark.parametrize(('data_type', 'value'), [('bool', True), ('uint8', 1)])
def test_every_type_is_a_number(data_type, value):
    hardware = FakeHardware([])
    hardware.positions = {'gate': StateInterface('gate', 'open', value, data_type)}
    (found,) = interfaces_of(make_manager(hardware)).read()
    assert (found, type(found)) == (1.0, float)


@pytest.mark.parametrize('value', [None, 'open', 10**400])
def test_a_plugin_may_write_what_is_not_a_number(value):
    hardware = FakeHardware([])
    hardware.positions = {'gate': StateInterface('gate', 'open')}
    registry = interfaces_of(make_manager(hardware))
    hardware.positions['gate'].value = value
    assert registry.read() == pytest.approx([math.nan], nan_ok=True)


def test_statistics_have_the_names_of_components_and_controllers():
    sensor = FakeHardware([], name='imu', type=HardwareType.SENSOR)
    manager = make_manager(FakeHardware(['j'], name='base'), sensor)
    start(manager, FakeController('driver'))
    cycles = ['base.stats/read_cycle', 'base.stats/write_cycle', 'imu.stats/read_cycle']
    cycles += ['driver.stats']
    expected = tuple(f'{cycle}/{number}' for cycle in cycles for number in CYCLE)
    assert statistics_of(manager).names == expected


def test_statistics_are_those_of_now():
    manager = make_manager(FakeHardware(['j']))
    start(manager, FakeController('driver'))
    registry = statistics_of(manager)
    for k in range(4):
        manager.tick(10 * k * MS)
        found = dict(zip(registry.names, registry.read(), strict=True))
        assert found['driver.stats/execution_time/sample_count'] == k + 1
        assert found['hardware.stats/read_cycle/periodicity/sample_count'] == k
    assert found['driver.stats/periodicity/average'] == 100.0
    assert found['driver.stats/periodicity/standard_deviation'] == 0.0
    assert found['driver.stats/periodicity/current_value'] == 100.0
