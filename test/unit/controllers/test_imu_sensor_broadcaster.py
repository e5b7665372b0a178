# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""imu_sensor_broadcaster: the ten state interfaces of a sensor as one message."""

import math

import pytest
from support.control_fakes import MS
from support.controller_bench import ControllerBench

from amr_description.control.interfaces import IMU_INTERFACES, NO_INTERFACES, StateInterface
from amr_description.controllers.broadcasters.sensor_broadcasters import ImuParameters
from amr_description.errors import ControllerError, ParameterError
from amr_description.parameters import specs

NAMES = {'sensor_name': 'imu', 'frame_id': 'imu_link'}
ORIENTATION = (0.5, 0.5, 0.5, -0.5)
ANGULAR_VELOCITY = (1.0, 2.0, 3.0)
LINEAR_ACCELERATION = (4.0, 5.0, 9.81)


def make_states():
    values = (*ORIENTATION, *ANGULAR_VELOCITY, *LINEAR_ACCELERATION)
    return [
        StateInterface('imu', name, value)
        for name, value in zip(IMU_INTERFACES, values, strict=True)
    ]


class Bench(ControllerBench):
    def __init__(self, **values):
        super().__init__('imu_sensor_broadcaster/IMUSensorBroadcaster', **NAMES | values)
        (self.sent,) = self.sent.values()

    def read(self, states):
        self.activate(states)
        self.update()
        return self.sent[-1]


def test_state_interfaces_have_the_names_of_ros2_control():
    controller = Bench().controller
    assert controller.state_interfaces().names == (
        'imu/orientation.x',
        'imu/orientation.y',
        'imu/orientation.z',
        'imu/orientation.w',
        'imu/angular_velocity.x',
        'imu/angular_velocity.y',
        'imu/angular_velocity.z',
        'imu/linear_acceleration.x',
        'imu/linear_acceleration.y',
        'imu/linear_acceleration.z',
    )
    assert controller.command_interfaces() == NO_INTERFACES


def test_every_reading_has_its_place():
    sample = Bench().read(make_states())
    assert sample.stamp == 10 * MS
    assert sample.constants.frame_id == 'imu_link'
    assert sample.orientation == ORIENTATION
    assert sample.angular_velocity == ANGULAR_VELOCITY
    assert sample.linear_acceleration == LINEAR_ACCELERATION


def test_one_message_an_update_with_the_present_states():
    bench, states = Bench(), make_states()
    bench.read(states)
    states[4].value = 7.0
    bench.controller.update(20 * MS, 10 * MS)
    assert [(s.stamp, s.angular_velocity[0]) for s in bench.sent] == [
        (10 * MS, 1.0),
        (20 * MS, 7.0),
    ]


def test_what_is_not_measured_yet_is_nan():
    states = make_states()
    states[0].value = math.nan
    sample = Bench().read(states)
    assert math.isnan(sample.orientation[0])
    assert sample.angular_velocity == ANGULAR_VELOCITY


def test_covariances_are_those_of_the_parameters():
    fields = ('orientation', 'angular_velocity', 'linear_acceleration')
    given = {
        f'static_covariance_{field}': [first + i for i in range(9)]
        for field, first in zip(fields, (0.0, 10.0, 20.0), strict=True)
    }
    constants = Bench(**given).read(make_states()).constants
    for field in fields:
        found = getattr(constants, f'{field}_covariance')
        assert list(found) == given[f'static_covariance_{field}']


def test_covariances_are_zero_by_default():
    assert Bench().read(make_states()).constants.orientation_covariance == (0.0,) * 9


def test_the_parameters_are_those_of_the_original():
    table = {spec.name: (spec.type, spec.default) for spec in specs(ImuParameters)}
    zeros = ('double_array', (0.0,) * 9)
    assert table == {
        'sensor_name': ('string', ''),
        'frame_id': ('string', ''),
        'static_covariance_orientation': zeros,
        'static_covariance_angular_velocity': zeros,
        'static_covariance_linear_acceleration': zeros,
    }


@pytest.mark.parametrize(
    ('values', 'text'),
    [
        ({'sensor_name': ''}, "'sensor_name' must not be empty"),
        ({'frame_id': ''}, "'frame_id' must not be empty"),
        ({'static_covariance_orientation': [0.0] * 8}, 'must have 9 elements'),
    ],
)
def test_bad_parameters_are_refused(values, text):
    with pytest.raises(ParameterError, match=text):
        Bench(**values)


def test_the_topic():
    port = Bench().controller.outputs()[0].port
    assert (port.name, port.message) == ('~/imu', 'sensor_msgs/msg/Imu')


def test_missing_state_interfaces_are_refused():
    with pytest.raises(ControllerError, match='Expected 10 state interfaces, got 9'):
        Bench().controller.activate((), make_states()[:9], 0)


def test_it_can_be_activated_again():
    bench = Bench()
    bench.read(make_states())
    bench.controller.deactivate(0)
    assert bench.read(make_states()).stamp == 20 * MS
