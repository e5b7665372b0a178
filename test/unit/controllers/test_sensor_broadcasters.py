# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Broadcasters of sensors, batteries and interfaces: what of the states is published, and how."""

import math

import pytest
from support.control_fakes import MS
from support.controller_bench import ControllerBench

from amr_description.control.interfaces import NO_INTERFACES, StateInterface
from amr_description.errors import ControllerError
from amr_description.log import Severity

WRENCH = 'force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster'
POSE = 'pose_broadcaster/PoseBroadcaster'
BATTERY = 'battery_state_broadcaster/BatteryStateBroadcaster'
POSES = {'pose_name': 'tool', 'frame_id': 'world'}


class Bench(ControllerBench):
    """A broadcaster, configured, with what it publishes by topic."""

    def read(self, *values):
        """Activate with these values of the states, update once, return the states."""
        assert self.controller.command_interfaces() == NO_INTERFACES
        self.activate()
        for state, value in zip(self.states, values, strict=True):
            state.value = value
        self.update()
        return self.states


def test_a_wrench_is_offset_first_and_then_multiplied():
    bench = Bench(
        WRENCH,
        sensor_name='fts',
        frame_id='tool',
        offset__force__x=1.0,
        offset__torque__z=-2.0,
        multiplier__force__x=10.0,
        multiplier__torque__z=-1.0,
    )
    assert bench.controller.state_interfaces().names == (
        'fts/force.x', 'fts/force.y', 'fts/force.z',
        'fts/torque.x', 'fts/torque.y', 'fts/torque.z',
    )  # fmt: skip
    bench.read(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    sample = bench.sent['~/wrench'][0]
    assert (sample.stamp, sample.frame_id) == (10 * MS, 'tool')
    assert (sample.force, sample.torque) == ((20.0, 2.0, 3.0), (4.0, 5.0, -4.0))
    exported = {each.name: each.value for each in bench.controller.exported_states()}
    assert exported['it/fts/force.x'] == 20.0
    assert exported['it/fts/torque.z'] == -4.0
    assert len(exported) == 6


def test_a_wrench_of_few_axes_is_nan_along_the_others():
    bench = Bench(
        WRENCH,
        frame_id='tool',
        interface_names__force__x='cell/load',
        interface_names__torque__z='motor/effort',
        offset__torque__z=0.5,
    )
    assert bench.controller.state_interfaces().names == ('cell/load', 'motor/effort')
    bench.read(3.0, 4.0)
    sample = bench.sent['~/wrench'][0]
    assert sample.force[0] == 3.0
    assert sample.torque[2] == 4.5
    assert all(map(math.isnan, (*sample.force[1:], *sample.torque[:2])))
    exported = [(each.name, each.value) for each in bench.controller.exported_states()]
    assert exported == [('it/cell/load', 3.0), ('it/motor/effort', 4.5)]


@pytest.mark.parametrize(
    ('names', 'text'),
    [
        ({}, "'sensor_name' or at least one 'interface_names"),
        (
            {'sensor_name': 'fts', 'interface_names__force__x': 'a/b'},
            'can not be specified together',
        ),
    ],
)
def test_a_wrench_needs_one_way_to_name_its_interfaces(names, text):
    with pytest.raises(ControllerError, match=text):
        Bench(WRENCH, frame_id='tool', **names)


def test_a_pose_is_also_the_transform_of_its_child_frame():
    bench = Bench(POSE, **POSES)
    bench.read(1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8)
    assert bench.sent['~/pose'] == bench.sent['/tf']
    sample = bench.sent['/tf'][0]
    assert (sample.frame_id, sample.child_frame_id) == ('world', 'tool')
    assert (sample.position, sample.orientation) == ((1.0, 2.0, 3.0), (0.0, 0.0, 0.6, 0.8))
    assert bench.log.texts(Severity.WARN) == []
    assert list(Bench(POSE, **POSES, tf__enable=False).sent) == ['~/pose']
    named = Bench(POSE, **POSES, tf__child_frame_id='hand', tf__publish_rate=20.0)
    named.read(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    assert named.sent['/tf'][0].child_frame_id == 'hand'
    assert 'tf.publish_rate parameter is deprecated' in named.log.texts(Severity.WARN)[0]


@pytest.mark.parametrize('values', [(math.nan, *[0.0] * 5, 1.0), (*[0.0] * 6, 1.01)])
def test_what_is_no_pose_is_no_transform(values):
    bench = Bench(POSE, **POSES)
    bench.read(*values)
    assert len(bench.sent['~/pose']) == 1
    assert bench.sent['/tf'] == []
    assert bench.log.texts(Severity.ERROR)[0].startswith('Invalid pose [')


def test_batteries_are_published_one_by_one_and_together():
    bench = Bench(
        BATTERY,
        batteries=['a', 'b'],
        interfaces__a__battery_temperature=True,
        interfaces__a__battery_charge=True,
        interfaces__b__battery_percentage=True,
        interfaces__b__battery_power_supply_status=True,
        interfaces__b__battery_present=True,
        a__minimum_voltage=20.0,
        a__maximum_voltage=30.0,
        a__capacity=5.0,
        a__location='left',
        a__power_supply_technology=3,
        b__capacity=7.0,
        b__location='right',
        b__power_supply_technology=2,
    )
    assert bench.controller.state_interfaces().names == (
        'a/battery_voltage', 'a/battery_temperature', 'a/battery_charge',
        'b/battery_voltage', 'b/battery_percentage', 'b/battery_power_supply_status',
        'b/battery_present',
    )  # fmt: skip
    bench.read(22.5, 40.0, 3.0, 24.5, 75.0, 2.0, 0.0)
    one, other = bench.sent['~/raw_battery_states'][0].batteries
    assert (one.frame_id, one.voltage, one.percentage, one.present) == ('a', 22.5, 25.0, True)
    assert (one.power_supply_status, other.power_supply_status) == (0, 2)
    assert math.isnan(one.current)
    assert (other.percentage, other.present) == (75.0, False)
    both = bench.sent['~/battery_state'][0]
    assert (both.voltage, both.temperature, both.percentage) == (23.5, 40.0, 50.0)
    assert (both.charge, both.capacity) == (3.0, 12.0)
    assert math.isnan(both.current)
    assert (both.power_supply_status, both.power_supply_technology) == (2, 0)
    assert both.location == 'left, right'


@pytest.mark.parametrize('voltage', [0.0, math.nan])
def test_a_battery_without_a_voltage_is_not_there(voltage):
    bench = Bench(BATTERY, batteries=['a'])
    bench.read(voltage)
    (battery,) = bench.sent['~/raw_battery_states'][0].batteries
    assert battery.present is False


def test_one_battery_by_the_old_name_of_its_parameter():
    bench = Bench(BATTERY, sensor_name='pack', design_capacity=100.0)
    assert bench.controller.state_interfaces().names == ('pack/voltage',)
    assert "'sensor_name' parameter is deprecated" in bench.log.texts(Severity.WARN)[0]
    bench.read(12.0)
    both = bench.sent['~/battery_state'][0]
    assert (both.voltage, both.design_capacity) == (12.0, 100.0)
    assert math.isnan(both.percentage)


@pytest.mark.parametrize(
    ('values', 'text'),
    [
        ({}, "'batteries' parameter has to be specified"),
        ({'batteries': ['a'], 'sensor_name': 'b'}, "both 'sensor_name' and 'batteries'"),
        (
            {'batteries': ['a'], 'a__minimum_voltage': 2.0, 'a__maximum_voltage': 2.0},
            "'a': Maximum battery voltage level must be greater than minimum voltage level",
        ),
    ],
)
def test_batteries_that_mean_nothing_are_refused(values, text):
    with pytest.raises(ControllerError, match=text):
        Bench(BATTERY, **values)


def test_any_states_are_published_with_their_names_once():
    bench = Bench(
        'state_interfaces_broadcaster/StateInterfacesBroadcaster',
        interfaces=['b/velocity', 'a/position'],
    )
    bench.read(1.0, 2.0)
    bench.controller.update(20 * MS, 10 * MS)
    assert [each.names for each in bench.sent['~/names']] == [('b/velocity', 'a/position')]
    assert [each.values for each in bench.sent['~/values']] == [(1.0, 2.0)] * 2
    with pytest.raises(ControllerError, match=r"'a/b' \(bool\) is not of type double"):
        bench.controller.activate((), [StateInterface('a', 'b', data_type='bool')], 0)


def test_a_fix_has_the_variances_of_the_parameter_or_of_the_sensor():
    names = {'sensor_name': 'gps', 'frame_id': 'antenna'}
    kind = 'gps_sensor_broadcaster/GPSSensorBroadcaster'
    static = tuple(map(float, range(9)))
    bench = Bench(kind, **names, static_position_covariance=static)
    bench.read(math.nan, 70000.0, 48.1, 11.5, 520.0)
    fix = bench.sent['~/gps/fix'][0]
    assert (fix.status, fix.service) == (-1, 0)
    assert (fix.latitude, fix.longitude, fix.altitude) == (48.1, 11.5, 520.0)
    assert (fix.position_covariance, fix.position_covariance_type) == (static, 3)
    bench = Bench(kind, **names, read_covariance_from_interface=True)
    bench.read(2.0, 1.0, 48.1, 11.5, 520.0, 1.0, 2.0, 3.0)
    fix = bench.sent['~/gps/fix'][0]
    assert (fix.status, fix.service, fix.position_covariance_type) == (2, 1, 2)
    assert fix.position_covariance == (1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0)


def test_missing_states_are_refused():
    bench = Bench(
        'range_sensor_broadcaster/RangeSensorBroadcaster', sensor_name='sonar', frame_id='front'
    )
    with pytest.raises(ControllerError, match='Expected 1 state interfaces, got 0'):
        bench.controller.activate((), [], 0)
