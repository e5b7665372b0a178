# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""tricycle_controller: its kinematics, limits, odometry, and its service."""

import math

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import collect
from support.examples import examples
from support.wheel_bench import WheelBench

from amr_description.control.samples import AckermannSample, EmptySample
from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.tricycle_controller import (
    SteeringLimits,
    TractionLimits,
    TricycleController,
    TricycleParameters,
)
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Severity
from amr_description.parameters import build

VALUES = {
    'traction_joint_name': 'drive',
    'steering_joint_name': 'steer',
    'wheelbase': 0.5,
    'wheel_radius': 0.1,
}
speeds = st.floats(-3.0, 3.0).filter(lambda value: value == 0.0 or abs(value) > 1e-3)


def bench(**values):
    names = {name.replace('__', '.'): value for name, value in values.items()}
    return WheelBench(TricycleController, VALUES | names)


@examples(100)
@given(speeds, speeds)
def test_the_twist_of_its_wheel_is_the_twist(linear, angular):
    speed, angle = bench().controller.wheel(linear, angular)
    rim = speed * 0.1
    assert rim * math.cos(angle) == pytest.approx(linear, abs=1e-9)
    assert rim * math.sin(angle) / 0.5 == pytest.approx(angular, abs=1e-9)


@pytest.mark.parametrize('open_loop', [True, False])
def test_a_circle_closes(open_loop):
    robot = bench(open_loop=open_loop)
    robot.drive(math.pi / 2, angular=math.pi / 2, seconds=2.01)
    x, y, heading = robot.pose('~/odom')
    assert (x, y, heading) == pytest.approx((0.0, 2.0, math.pi), abs=0.05)
    robot.drive(math.pi / 2, angular=math.pi / 2, seconds=2.0)
    later = robot.pose('~/odom')
    assert math.hypot(later[0] - x, later[1] - y) == pytest.approx(2.0, abs=1e-4)


def test_it_turns_on_the_spot():
    robot = bench()
    robot.drive(angular=1.0, seconds=1.02)
    assert robot.commanded == pytest.approx((5.0, math.pi / 2))
    assert robot.pose('~/odom') == pytest.approx((0.0, 0.0, 1.0), abs=0.01)


def test_it_drives_slowly_until_the_steering_angle_is_reached():
    robot = bench()
    robot.follows = False
    for angular, factor in ((0.1, 1.0), (1.0, math.cos(math.pi / 4)), (1e9, 0.01)):
        speed, angle = robot.controller.wheel(0.5, angular)
        robot.states['steer/position'].value = 0.0 if angular < 1e9 else -0.1
        assert robot.drive(0.5, angular=angular) == pytest.approx((speed * factor, angle))


def test_a_command_times_out_and_steers_straight():
    robot = bench()
    robot.send(0.5, angular=1.0)
    robot.update(50)
    assert robot.commanded == pytest.approx((5.0 / math.cos(math.pi / 4), math.pi / 4))
    robot.update(2)
    assert robot.commanded == (0.0, 0.0)
    assert 'timed out. Braking.' in robot.log.texts(Severity.WARN)[0]


def test_a_command_that_is_not_finite_is_none():
    robot = bench()
    assert robot.drive(math.nan) == (0.0, 0.0)


def test_limits_and_what_is_published():
    robot = bench(
        publish_ackermann_command=True,
        enable_odom_tf=True,
        odom_only_twist=True,
        traction__max_acceleration=100.0,
        traction__max_deceleration=200.0,
        steering__max_position=0.5,
        steering__max_velocity=10.0,
    )
    assert set(robot.sent) == {'~/odom', '/tf', '~/cmd_ackermann'}
    # 100 rad/s² and 10 rad/s for 10 ms
    assert robot.drive(0.5, angular=1.0) == pytest.approx((1.0, 0.1))
    assert robot.sent['~/cmd_ackermann'] == [AckermannSample(*robot.commanded)]
    robot.drive(0.5, angular=1.0, seconds=1.0)
    assert robot.commanded[1] == 0.5
    assert robot.sent['~/odom'][-1].x == 0.0
    assert robot.sent['/tf'][-1].x > 0.3
    before = robot.commanded[0]
    assert robot.drive(0.0)[0] == pytest.approx(before - 2.0)


def test_odometry_is_reset_by_the_service():
    robot = bench()
    robot.drive(1.0, seconds=0.5)
    [service] = robot.controller.services()
    assert (service.port.name, service.port.service) == ('~/reset_odometry', 'std_srvs/srv/Empty')
    assert service.answer(EmptySample()) == EmptySample()
    robot.controller.deactivate(robot.time)
    assert robot.commanded == (0.0, 0.0)
    robot.states['drive/velocity'].value = 0.0
    robot.activate()
    robot.update()
    assert robot.pose('~/odom') == (0.0, 0.0, 0.0)


def test_a_state_that_is_not_there_is_an_error():
    robot = bench()
    robot.states['steer/position'].value = math.nan
    with pytest.raises(ControllerError, match='Could not read feedback value: .* is nan'):
        robot.drive(1.0)


def test_only_what_is_enabled_is_advertised():
    assert set(bench().sent) == {'~/odom'}
    assert collect(bench().controller.outputs()[0]) == []


@pytest.mark.parametrize(
    ('values', 'complaint'),
    [
        ({'traction.max_velocity': -1.0}, 'traction limiter: velocity cannot be negative'),
        ({'traction.min_jerk': 2.0, 'traction.max_jerk': 1.0}, 'min_jerk 2 is above max_jerk 1'),
        ({'steering.min_acceleration': -1.0}, 'steering limiter: acceleration cannot be negat'),
        ({'steering.min_position': 0.5}, 'min_position 0.5 is above max_position -0.5'),
    ],
)
def test_limits_have_to_make_sense(values, complaint):
    with pytest.raises(ControllerError, match=complaint):
        WheelBench(TricycleController, VALUES | values)


@pytest.mark.parametrize('name', list(VALUES))
def test_sizes_and_names_are_needed(name):
    with pytest.raises(ParameterError, match=f"'{name}' must"):
        build(TricycleParameters, {key: VALUES[key] for key in VALUES if key != name})


# --- limits --------------------------------------------------------------------------------------


def test_a_traction_limit_holds_in_both_directions():
    limits = TractionLimits(max_velocity=3.0, min_velocity=1.0)
    assert [limits.limit(value, 0.0, 0.0, 0.1) for value in (5.0, -5.0, 0.5, -2.0)] == [
        3.0,
        -3.0,
        1.0,
        -2.0,
    ]


def test_speeding_up_and_slowing_down_have_their_limits():
    limits = TractionLimits(max_acceleration=1.0, max_deceleration=2.0)
    assert limits.limit(5.0, 1.0, 1.0, 0.1) == pytest.approx(1.1)
    assert limits.limit(0.0, 1.0, 1.0, 0.1) == pytest.approx(0.8)
    assert TractionLimits(max_acceleration=1.0).limit(0.0, 1.0, 1.0, 0.1) == 0.0


def test_jerk_counts_twice_the_square_of_the_period():
    limits = TractionLimits(max_jerk=1.0)
    assert limits.limit(5.0, 1.0, 0.9, 0.1) == pytest.approx(1.0 + 0.1 + 0.02)


def test_steering_has_limits_of_angle_speed_and_acceleration():
    assert SteeringLimits(max_position=0.3).limit(-1.0, 0.0, 0.0, 0.1) == -0.3
    assert SteeringLimits(min_position=-0.3).limit(1.0, 0.0, 0.0, 0.1) == 0.3
    assert SteeringLimits(max_velocity=2.0).limit(1.0, 0.1, 0.1, 0.1) == pytest.approx(0.3)
    limits = SteeringLimits(max_acceleration=2.0)
    assert limits.limit(1.0, 0.1, 0.05, 0.1) == pytest.approx(0.1 + 0.05 + 0.04)


def test_it_is_found_by_its_type():
    assert CONTROLLERS.find('tricycle_controller/TricycleController') is TricycleController
