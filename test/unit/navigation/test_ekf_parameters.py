# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters as people write them; what is of no use is told, what is wrong is an error."""

import numpy as np
import pytest
from support.paths import ROOT
import yaml

from amr_description.errors import ParameterError
from amr_description.navigation.ekf import NO_THRESHOLD, PROCESS_NOISE, StateMember
from amr_description.navigation.ekf_diagnostics import FilterDiagnostics, Level, RateDiagnostics
from amr_description.navigation.ekf_parameters import read_parameters

NONE = [False] * 15
WHEELS = [False] * 6 + [True, True, False, False, False, True, False, False, False]
GYRO = [False] * 11 + [True] + [False] * 3
IMU = [False] * 3 + [True] * 3 + [False] * 3 + [True] * 6


def test_defaults_are_those_of_the_original():
    found = read_parameters({'odom0': 'odom', 'odom0_config': WHEELS})
    assert not found.notes
    expected = {
        'frequency': 30.0, 'sensor_timeout': 1.0 / 30.0, 'two_d_mode': False,
        'print_diagnostics': False, 'publish_tf': True, 'publish_acceleration': False,
        'map_frame': 'map', 'odom_frame': 'odom', 'base_link_frame': 'base_link',
        'base_link_frame_output': 'base_link', 'world_frame': 'odom',
        'transform_time_offset': 0.0, 'transform_timeout': 0.0,
        'gravitational_acceleration': 9.80665, 'predict_to_current_time': False,
        'smooth_lagged_data': False, 'history_length': 0.0, 'reset_on_time_jump': False,
        'permit_corrected_publication': False, 'disabled_at_startup': False,
        'use_control': False, 'stamped_control': False, 'control_timeout': 0.0,
        'dynamic_process_noise_covariance': False, 'odom0_queue_size': 10,
        'odom0_differential': False, 'odom0_relative': False,
        'odom0_pose_rejection_threshold': NO_THRESHOLD,
    }  # fmt: skip
    assert {name: found.values[name] for name in expected} == expected
    assert np.array_equal(found.tuning.process_noise, np.diag(PROCESS_NOISE))
    assert np.array_equal(found.tuning.initial_covariance, np.eye(15) * 1e-9)
    entry = found.inputs[0]
    assert (entry.topic, entry.pose.is_used, entry.twist.is_used) == ('odom', False, True)


def test_the_file_for_amr_has_nothing_to_complain_of():
    parameters = yaml.safe_load((ROOT / 'config' / 'ekf.yaml').read_text())
    found = read_parameters(parameters['/**/ekf_filter_node']['ros__parameters'])
    assert not found.notes
    assert [entry.name for entry in found.inputs] == ['odom0', 'imu0']
    assert FilterDiagnostics(found).take().level is Level.OK


def test_the_controllers_beside_it_leave_the_transform_to_it():
    plain, beside = (
        yaml.safe_load((ROOT / 'config' / name).read_text())
        for name in ('controllers.yaml', 'controllers_ekf.yaml')
    )
    drive = plain['/**/diff_drive_controller']['ros__parameters']
    assert drive['enable_odom_tf'] is True
    drive['enable_odom_tf'] = False
    assert beside == plain


@pytest.mark.parametrize(
    ('given', 'note'),
    [
        (
            {'odometry0': '/odom'},
            'odometry0 is set, but there is no such parameter: it has no effect; did you mean '
            'odom0?',
        ),
        (
            {'imu0': 'imu', 'imu0_config': GYRO, 'imu0_angular_velocity_rejection_threshold': 1.0},
            'imu0_angular_velocity_rejection_threshold is set, but there is no such parameter: it '
            'has no effect; did you mean imu0_linear_acceleration_rejection_threshold?',
        ),
        ({'odom0_nodelay': True}, 'odom0_nodelay has no effect: it was for TCP, in ROS 1'),
        ({'imu0_config': GYRO}, 'imu0_config has no effect: imu0, the topic, is not set'),
        (
            {'odom0': 'a', 'odom0_config': WHEELS, 'odom2': 'b', 'odom2_config': WHEELS},
            'odom2 is not read: numbers follow each other from 0 on, and odom1 is missing',
        ),
        (
            {'odom0': 'a'},
            'a is listed as an input topic (odom0), but all update variables are false: set some '
            'of odom0_config',
        ),
        (
            {'imu0': 'imu', 'imu0_config': [*[True] * 3, *NONE[3:11], True, *NONE[12:]]},
            'imu0_config: its messages do not hold x, y, z: not used',
        ),
        (
            {'odom0': 'a', 'odom0_config': [True, *NONE[1:]], 'odom0_differential': True,
             'odom0_relative': True},
            'Both odom0_differential and odom0_relative were set to true. Using differential '
            'mode.',
        ),
        ({'debug': True}, 'debug is not offered: no file is written; print_diagnostics tells on '
                          '/diagnostics what is wrong with settings or data'),
        ({'frequency': 30}, 'frequency: taken as doubles; the original ends with an error at an '
                            'integer, write 30.0'),
        ({'world_frame': 'earth'}, 'world_frame is earth: no transform is published; it should be '
                                   'map_frame (map) or odom_frame (odom)'),
        ({'history_length': 1.0}, 'Filter history interval of 1.0 specified, but '
                                  'smooth_lagged_data is set to false. Lagged data will not be '
                                  'smoothed.'),
        ({'use_control': True}, 'use_control is set to true, but control_config is missing. No '
                                'control term will be used.'),
        (
            {'twist0': 't', 'twist0_config': WHEELS, 'twist0_rejection_threshold': 0.0},
            'twist0_rejection_threshold is 0.0: it rejects every measurement; leave it out to '
            'reject none',
        ),
    ],
)  # fmt: skip
def test_what_is_of_no_use_is_told(given, note):
    assert note in read_parameters(given).notes


@pytest.mark.parametrize(
    ('given', 'error'),
    [
        (
            {'odom0': 'a', 'odom0_config': [True] * 14},
            "parameter 'odom0_config' has 14 elements; 15 are expected: x, y, z, roll, pitch, "
            'yaw, vx, vy, vz, vroll, vpitch, vyaw, ax, ay, az',
        ),
        (
            {'odom0': 'a', 'odom0_config': [1] * 15},
            f"parameter 'odom0_config' must be of type bool_array, found {[1] * 15}, a list of "
            'integers',
        ),
        (
            {'two_d_mode': 'yes'},
            "parameter 'two_d_mode' must be of type bool, found 'yes', a string",
        ),
        ({'frequency': 0.0}, "parameter 'frequency' must be greater than 0, found 0.0"),
        ({'sensor_timeout': -0.1}, "parameter 'sensor_timeout' must be at least 0, found -0.1"),
        ({'odom0': ''}, "parameter 'odom0' must not be empty, found ''"),
        (
            {'odom0': 'a', 'odom0_queue_size': 0},
            "parameter 'odom0_queue_size' must be at least 1, found 0",
        ),
        (
            {'process_noise_covariance': [0.1] * 16},
            'Invalid process_noise_covariance specified. Expected a length of 15 or 225, received '
            'length 16',
        ),
        (
            {'use_control': True, 'control_config': [True] * 5},
            "parameter 'control_config' has 5 elements; 6 are expected: vx, vy, vz, vroll, "
            'vpitch, vyaw',
        ),
    ],
)
def test_what_is_wrong_is_an_error(given, error):
    with pytest.raises(ParameterError) as raised:
        read_parameters(given)
    assert str(raised.value) == error


def test_all_parameters_of_the_originals_example_are_known():
    six = [1.3, 0.0, 0.0, 0.0, 0.0, 3.4]
    given = {
        'frequency': 30.0, 'sensor_timeout': 0.1, 'two_d_mode': False,
        'transform_time_offset': 0.0, 'transform_timeout': 0.0, 'print_diagnostics': True,
        'debug': False, 'debug_out_file': '/path/to/debug/file.txt', 'publish_tf': True,
        'permit_corrected_publication': False, 'publish_acceleration': False,
        'map_frame': 'map', 'odom_frame': 'odom', 'base_link_frame': 'base_link',
        'world_frame': 'odom',
        'odom0': 'example/odom', 'odom0_config': WHEELS, 'odom0_queue_size': 2,
        'odom0_nodelay': False, 'odom0_differential': False, 'odom0_relative': False,
        'odom0_pose_use_child_frame': False,
        'odom0_pose_rejection_threshold': 5.0, 'odom0_twist_rejection_threshold': 1.0,
        'pose0': 'example/pose', 'pose0_config': [True, True, *NONE[2:]],
        'pose0_differential': True, 'pose0_relative': False, 'pose0_queue_size': 5,
        'pose0_rejection_threshold': 2.0,
        'twist0': 'example/twist', 'twist0_config': WHEELS, 'twist0_queue_size': 3,
        'twist0_rejection_threshold': 2.0,
        'imu0': 'example/imu', 'imu0_config': IMU,
        'imu0_differential': False, 'imu0_relative': True, 'imu0_queue_size': 5,
        'imu0_pose_rejection_threshold': 0.8, 'imu0_twist_rejection_threshold': 0.8,
        'imu0_linear_acceleration_rejection_threshold': 0.8,
        'imu0_remove_gravitational_acceleration': True,
        'use_control': True, 'stamped_control': False, 'control_timeout': 0.2,
        'control_config': [True, False, False, False, False, True],
        'acceleration_limits': six, 'deceleration_limits': six,
        'acceleration_gains': six, 'deceleration_gains': six,
        'process_noise_covariance': [0.05] * 225, 'initial_estimate_covariance': [1e-9] * 225,
        'use_sim_time': True, 'qos_overrides./tf.publisher.depth': 5,
    }  # fmt: skip
    found = read_parameters(given)
    assert found.notes == [
        'X acceleration is being measured from IMU; X velocity control input is disabled',
        'odom0_nodelay has no effect: it was for TCP, in ROS 1',
    ]
    assert [entry.name for entry in found.inputs] == ['odom0', 'pose0', 'twist0', 'imu0']
    assert found.inputs[1].pose.differential
    assert found.inputs[3].acceleration.threshold == 0.8


def test_covariances_are_of_15_or_225_numbers():
    diagonal = (np.arange(15) / 10.0).tolist()
    short = read_parameters({'process_noise_covariance': diagonal}).tuning.process_noise
    full = np.diag(diagonal).ravel().tolist()
    assert np.array_equal(short, np.diag(diagonal))
    assert np.array_equal(
        read_parameters({'initial_estimate_covariance': full}).tuning.initial_covariance, short
    )


def test_a_measured_acceleration_goes_before_a_commanded_one():
    found = read_parameters({
        'imu0': 'imu', 'imu0_config': [False] * 12 + [True, False, False],
        'use_control': True, 'control_timeout': 0.2,
        'control_config': [True, False, False, False, False, True],
        'acceleration_limits': [1.3, 0.0, 0.0, 0.0, 0.0, 3.4],
    })  # fmt: skip
    assert found.notes == [
        'X acceleration is being measured from IMU; X velocity control input is disabled'
    ]
    assert found.tuning.control.used == (False, False, False, False, False, True)
    assert found.tuning.control.deceleration_limits == (1.3, 0.0, 0.0, 0.0, 0.0, 3.4)
    assert found.tuning.control.acceleration_gains == (1.0,) * 6


def test_frames_have_the_prefix():
    found = read_parameters({'tf_prefix': 'robot1/', 'base_link_frame': 'base_footprint'})
    frames = (found.map_frame, found.odom_frame, found.base_link_frame_output, found.world_frame)
    assert frames == ('robot1/map', 'robot1/odom', 'robot1/base_footprint', 'robot1/odom')


def test_diagnostics_tell_what_is_measured_twice_or_not_at_all():
    pose = [True, True, False, False, False, True, *NONE[6:]]
    found = read_parameters({
        'odom0': 'a', 'odom0_config': pose, 'odom1': 'b', 'odom1_config': [True, *NONE[1:]],
        'two_d_mode': True,
    })  # fmt: skip
    status = FilterDiagnostics(found).take()
    assert status.level is Level.WARN
    assert dict(status.values) == {
        'X_configuration': '2 absolute pose inputs detected for X. This may result in '
        'oscillations. Please ensure that your variances for each measured variable are set '
        'appropriately.'
    }
    found = read_parameters({'imu0': 'imu', 'imu0_config': GYRO, 'two_d_mode': True})
    diagnostics = FilterDiagnostics(found)
    diagnostics.add('imu0_twist_covariance', 'zero')
    status = diagnostics.take()
    assert status.level is Level.ERROR
    assert list(dict(status.values)) == [
        'X_configuration', 'Y_configuration', 'imu0_twist_covariance',
    ]  # fmt: skip
    assert list(dict(diagnostics.take().values)) == ['X_configuration', 'Y_configuration']


@pytest.mark.parametrize(
    ('messages', 'message'),
    [(0, 'No events recorded.'), (10, 'Frequency too low.'), (30, 'Desired frequency met'),
     (60, 'Frequency too high.')],
)  # fmt: skip
def test_diagnostics_tell_the_rate(messages, message):
    rate = RateDiagnostics(30.0)
    rate.take(0)
    for _ in range(messages):
        rate.tick()
    status = rate.take(1_000_000_000)
    assert status.message == message
    assert dict(status.values)['Actual frequency (Hz)'] == f'{messages:f}'


def test_members_are_in_the_order_of_the_configuration():
    assert [member.name.lower() for member in StateMember] == [
        'x', 'y', 'z', 'roll', 'pitch', 'yaw', 'vx', 'vy', 'vz', 'vroll', 'vpitch', 'vyaw',
        'ax', 'ay', 'az',
    ]  # fmt: skip
