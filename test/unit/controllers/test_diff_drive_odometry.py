# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What diff_drive_controller publishes, and when, also after pauses and jumps of time."""

import math

import pytest
from support.control_fakes import MS
from support.diff_drive_bench import Bench, PERIOD

from amr_description.clock import NANOSECONDS
from amr_description.control.samples import TwistSample
from amr_description.errors import ControllerError

# --- what is published ---------------------------------------------------------------------------


def test_odometry_carries_stamp_pose_twist_and_variances():
    bench = Bench(pose_covariance_diagonal=[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).activate()
    bench.drive(0.5)
    (sample,) = bench.odom
    assert sample.stamp == bench.time
    assert (sample.x, sample.y, sample.heading, sample.linear) == (0.0, 0.0, 0.0, 0.0)
    assert sample.frames.pose_variances == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert sample.frames.twist_variances == (0.0,) * 6
    assert bench.tf == bench.odom


def test_nothing_is_published_before_the_first_command_or_the_time_out():
    bench = Bench(publish_limited_velocity=True).activate()
    bench.update(times=50)
    assert (bench.odom, bench.tf, bench.limited) == ([], [], [])
    bench.update()
    assert [sample.stamp for sample in bench.odom] == [510 * MS]
    assert len(bench.tf) == len(bench.limited) == 1


@pytest.mark.parametrize(('pause', 'is_in_force'), [(480 * MS, False), (500 * MS, True)])
def test_after_a_pause_the_time_out_counts_from_the_deactivation(pause, is_in_force):
    """As the original resets its buffers then, and not at activation: odometry comes at once."""
    bench = Bench().activate(time=1000 * MS)
    bench.drive(1.0)
    bench.deactivate()
    bench.odom.clear()
    bench.activate(time=bench.time + pause).update()
    assert [sample.stamp for sample in bench.odom] == ([bench.time] if is_in_force else [])
    assert bench.wheels == (0.0, 0.0)


def test_the_first_time_out_counts_from_the_activation_after_a_new_configure_too():
    bench = Bench().activate()
    bench.deactivate()
    bench.configure()
    bench.activate(time=3600 * NANOSECONDS).update(times=50)
    assert bench.odom == []
    bench.update()
    assert len(bench.odom) == 1


def test_without_a_time_out_nothing_is_published_before_the_first_command():
    bench = Bench(cmd_vel_timeout=0.0, publish_limited_velocity=True).activate()
    bench.update(times=1000)
    assert (bench.odom, bench.tf, bench.limited) == ([], [], [])
    bench.drive(0.0)
    assert len(bench.odom) == len(bench.tf) == len(bench.limited) == 1


def test_the_transform_can_be_switched_off():
    bench = Bench(enable_odom_tf=False).activate()
    bench.drive(0.5)
    assert len(bench.odom) == 1
    assert bench.tf == []


def test_the_limited_command_is_published_at_every_update_with_its_time():
    bench = Bench(publish_limited_velocity=True, **{'linear.x.max_acceleration': 1.0}).activate()
    for _ in range(3):
        bench.drive(1.0, 0.5)
    assert bench.limited == [
        TwistSample(k * PERIOD, pytest.approx(0.01 * k), 0.5, 'base_link') for k in (1, 2, 3)
    ]


def test_topics_are_those_of_ros2_controllers_and_the_lock():
    controller = Bench(publish_limited_velocity=True).controller
    assert [(port.port.name, port.port.message) for port in controller.inputs()] == [
        ('~/cmd_vel', 'geometry_msgs/msg/TwistStamped'),
        ('emergency_stop', 'std_msgs/msg/Bool'),  # the one that is ours
    ]
    assert [(port.port.name, port.port.message) for port in controller.outputs()] == [
        ('~/odom', 'nav_msgs/msg/Odometry'),
        ('/tf', 'tf2_msgs/msg/TFMessage'),
        ('~/cmd_vel_out', 'geometry_msgs/msg/TwistStamped'),
    ]
    assert len(Bench().controller.outputs()) == 2


# --- better than upstream ------------------------------------------------------------------------


def test_a_late_start_and_an_encoder_away_from_zero_make_no_jump():
    late = 1_000_000 * NANOSECONDS
    bench = Bench().activate(time=late)
    bench.drive(0.5)
    assert (bench.odom[0].x, bench.odom[0].linear) == (0.0, 0.0)
    bench = Bench(open_loop=True).activate(feedback=None, time=late)
    bench.update(times=40)
    bench.drive(0.5)
    assert bench.odom[0].x == pytest.approx(0.005)


def test_after_time_went_back_it_brakes_and_publishes_at_once_from_the_origin():
    bench = Bench(publish_limited_velocity=True).activate(time=1000 * NANOSECONDS)
    for _ in range(10):
        bench.drive(0.5)
        bench.states['position'][0].value += 0.05
    assert bench.odom[-1].x != 0.0
    bench.send(0.5)
    bench.odom.clear()
    bench.controller.reset(0)
    bench.time = 0
    assert bench.update() == (0.0, 0.0)
    (sample,) = bench.odom
    assert (sample.stamp, sample.x, sample.y, sample.heading) == (PERIOD, 0.0, 0.0, 0.0)
    assert bench.drive(0.5) == (5.0, 5.0)


@pytest.mark.parametrize('jump', [3600, -3600])
def test_a_jump_of_the_clock_keeps_pose_speed_and_publication(jump):
    bench = Bench().activate(time=10_000 * NANOSECONDS)
    for _ in range(10):
        bench.drive(0.5)
        bench.states['position'][0].value += 0.05
        bench.states['position'][1].value += 0.05
    before = bench.odom[-1].x
    assert before > 0.0
    bench.odom.clear()
    bench.time += jump * NANOSECONDS
    bench.controller.set_clock(bench.time)
    assert bench.update() == (5.0, 5.0)
    assert bench.odom[0].stamp == bench.time
    assert before <= bench.odom[0].x <= before + 0.01
    for _ in range(60):
        wheels = bench.update()
    assert wheels == (0.0, 0.0)


def test_time_that_went_back_while_inactive_does_not_silence_the_odometry():
    bench = Bench().activate(time=1000 * NANOSECONDS)
    bench.drive(0.5)
    bench.deactivate()
    bench.controller.reset(0)
    bench.odom.clear()
    bench.activate(time=0)
    bench.drive(0.5)
    assert [sample.stamp for sample in bench.odom] == [PERIOD]


def test_after_activation_speed_is_limited_from_rest():
    """The wheels stand then, whatever they did before."""
    bench = Bench(**{'linear.x.max_acceleration': 1.0}).activate()
    for _ in range(100):
        bench.drive(1.0)
    assert bench.wheels == pytest.approx((10.0, 10.0))
    bench.deactivate()
    bench.activate(time=bench.time)
    assert bench.drive(1.0) == pytest.approx((0.1, 0.1))


def test_after_activation_jerk_is_limited_from_rest():
    bench = Bench(**{'linear.x.max_jerk': 50.0, 'angular.z.max_jerk': 50.0}).activate()
    first = bench.drive(1.0, 1.0)
    assert first == pytest.approx((0.025, 0.075))
    for _ in range(100):
        bench.drive(1.0, 1.0)
    bench.deactivate()
    bench.activate(time=bench.time)
    assert bench.drive(1.0, 1.0) == first


def test_the_pose_stays_over_deactivation():
    bench = Bench(publish_rate=1000.0).activate()
    bench.drive(0.5)
    for state in bench.states['position']:
        state.value += 1.0
    bench.drive(0.5)
    bench.deactivate()
    bench.activate(time=bench.time)
    bench.drive(0.5)
    assert bench.odom[-1].x == pytest.approx(0.1)


@pytest.mark.parametrize('reading', [math.nan, math.inf])
def test_a_wheel_state_of_nan_raises_with_its_name(reading):
    bench = Bench().activate()
    bench.states['position'][1].value = reading
    with pytest.raises(ControllerError, match=r'right_wheel/position is (nan|inf)'):
        bench.drive(0.5)
