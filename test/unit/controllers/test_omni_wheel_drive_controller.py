# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""omni_wheel_drive_controller: its kinematics against the closed form, commands, odometry."""

import math

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import MS
from support.examples import examples
from support.wheel_bench import PERIOD, WheelBench

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.omni_wheel_drive_controller import (
    OmniKinematics,
    OmniWheelDriveController,
    OmniWheelDriveParameters,
)
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Severity
from amr_description.parameters import build

VALUES = {
    'wheel_names': ['a', 'b', 'c'],
    'wheel_offset': 0.0,
    'robot_radius': 0.2,
    'wheel_radius': 0.05,
}
speeds = st.floats(-3.0, 3.0)
sizes = st.floats(0.02, 2.0)


def bench(chained=False, **values):
    return WheelBench(OmniWheelDriveController, VALUES | values, chained=chained)


@examples(100)
@given(st.tuples(speeds, speeds, speeds), st.integers(3, 8), speeds, sizes, sizes)
def test_the_twist_of_its_wheels_is_the_twist(twist, count, offset, robot, wheel):
    kinematics = OmniKinematics(count, offset, robot, wheel)
    assert kinematics.twist(kinematics.wheels(twist)) == pytest.approx(twist, abs=1e-9)


def test_known_speeds():
    """The first wheel, on x, rolls along y; all turn backwards in a turn to the left."""
    robot = bench()
    assert robot.drive(lateral=0.1)[0] == pytest.approx(-2.0)
    assert robot.drive(linear=0.1)[0] == pytest.approx(0.0)
    assert robot.drive(angular=1.0) == pytest.approx((-4.0, -4.0, -4.0))


@pytest.mark.parametrize(
    'values', [{}, {'position_feedback': False}, {'open_loop': True}, {'wheel_offset': 0.7}]
)
def test_a_circle_closes(values):
    robot = bench(**values)
    robot.drive(lateral=math.pi / 2, angular=math.pi / 2, seconds=2.01)
    middle = robot.pose('~/odom')
    # Sideways on a circle of radius 1 about (-1, 0): half of it is done.
    assert middle == pytest.approx((-2.0, 0.0, math.pi), abs=0.03)
    robot.drive(lateral=math.pi / 2, angular=math.pi / 2, seconds=2.0)
    later = robot.pose('~/odom')
    assert math.hypot(later[0] - middle[0], later[1] - middle[1]) == pytest.approx(2.0, abs=1e-6)


def test_wheels_that_do_not_begin_at_zero_make_no_jump():
    robot = bench()
    for state in robot.states.values():
        state.value = 1000.0
    robot.send()
    robot.update(3)
    assert robot.pose('~/odom') == (0.0, 0.0, 0.0)


def test_nothing_is_commanded_before_the_first_command_or_the_timeout():
    robot = bench()
    assert all(map(math.isnan, robot.update(50)))
    assert robot.update() == (0.0, 0.0, 0.0)


def test_a_command_times_out_or_never():
    for timeout, last in ((0.1, 0.0), (0.0, -2.0)):
        robot = bench(cmd_vel_timeout=timeout)
        robot.send(lateral=0.1)
        assert robot.update(11)[0] == pytest.approx(-2.0)
        assert robot.update(100)[0] == pytest.approx(last)


def test_an_outdated_command_is_ignored():
    robot = bench()
    robot.update(100)
    robot.send(lateral=1.0, stamp=robot.time - 600 * MS)
    assert robot.update() == (0.0, 0.0, 0.0)
    assert 'Ignoring the received message' in robot.log.texts(Severity.WARN)[0]


def test_the_preceding_controller_commands():
    robot = bench(chained=True)
    names = [reference.name for reference in robot.controller.references()]
    axes = ('linear/x', 'linear/y', 'angular/z')
    assert names == [f'drive/{axis}/velocity' for axis in axes]
    robot.refer(0.0, 0.0, 1.0)
    robot.send(1.0)
    assert robot.update() == pytest.approx((-4.0, -4.0, -4.0))
    assert robot.update() == pytest.approx((-4.0, -4.0, -4.0))


def test_topics():
    robot = bench(**{'diagonal_covariance.twist': [1.0] * 6, 'tf_frame_prefix': 'r'})
    robot.drive(0.1, 0.2, 0.3)
    robot.update()
    odometry = robot.sent['~/odom'][-1]
    assert (odometry.linear, odometry.lateral, odometry.angular) == pytest.approx((0.1, 0.2, 0.3))
    assert odometry.frames.twist_variances == (1.0,) * 6
    assert odometry.frames.child_frame_id == 'r/base_link'
    assert robot.sent['/tf'][-1] == odometry


def test_deactivation_stops_and_a_reset_goes_to_the_origin():
    robot = bench()
    robot.drive(1.0, seconds=1.0)
    before = robot.pose('~/odom')
    robot.controller.deactivate(robot.time)
    assert robot.commanded == (0.0, 0.0, 0.0)
    robot.follow(PERIOD)
    robot.activate()
    robot.drive()
    assert robot.pose('~/odom') == before
    robot.controller.reset(0)
    robot.drive()
    assert robot.pose('~/odom') == (0.0, 0.0, 0.0)


def test_a_state_that_is_not_there_is_an_error():
    robot = bench()
    robot.states['b/position'].value = math.nan
    with pytest.raises(ControllerError, match=r'index \[1\]: b/position is nan'):
        robot.drive(1.0)


@pytest.mark.parametrize(
    ('values', 'complaint'),
    [
        ({'wheel_offset': math.nan}, "'wheel_offset' must be a finite number"),
        ({'wheel_names': []}, "'wheel_names' must not be empty"),
        ({'robot_radius': 0.0}, "'robot_radius' must be greater than 0"),
    ],
)
def test_values_are_checked(values, complaint):
    with pytest.raises(ParameterError, match=complaint):
        build(OmniWheelDriveParameters, VALUES | values)


def test_two_wheels_are_too_few():
    with pytest.raises(ControllerError, match='The number of wheels is less than 3'):
        bench(wheel_names=['a', 'b'])


def test_it_is_found_by_its_type():
    kind = 'omni_wheel_drive_controller/OmniWheelDriveController'
    assert CONTROLLERS.find(kind) is OmniWheelDriveController
