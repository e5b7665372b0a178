# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
diff_drive_controller: laws, every case that its upstream tests state, and what it does better.

What it publishes, also after jumps of time: ``test_diff_drive_odometry.py``.
"""

import cmath
import math
import random

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import MS, nan_for_none, VECTORS
from support.diff_drive_bench import Bench, PERIOD, SIZES, WHEELS
from support.examples import examples

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import (
    Claim,
    NO_INTERFACES,
)
from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Severity
from amr_description.parameters import build

FRAMES = VECTORS['tf_frame_names']
KINEMATICS = VECTORS['inverse_kinematics']
RAMP = VECTORS['speed_limiter_ramp']
OPEN_LOOP = VECTORS['open_loop_controller']


# --- laws ----------------------------------------------------------------------------------------


def closed_form(legs):
    """(position as x + iy, heading) after twists (v, w) that each hold for t seconds."""
    position, heading = 0j, 0.0
    for v, w, t in legs:
        turn = w * t
        chord = v * t if abs(turn) < 1e-12 else v * (cmath.exp(1j * turn) - 1.0) / (1j * w)
        position += cmath.exp(1j * heading) * chord
        heading += turn
    return position, heading


speeds = st.floats(-2.0, 2.0).filter(lambda value: value == 0.0 or abs(value) > 1e-4)
sizes = st.floats(0.5, 2.0)


@examples(50)
@given(
    st.lists(st.tuples(speeds, speeds, st.integers(1, 40)), min_size=1, max_size=6),
    st.fixed_dictionaries(
        {
            'wheel_separation': sizes,
            'wheel_radius': sizes,
            'wheel_separation_multiplier': sizes,
            'left_wheel_radius_multiplier': sizes,
            'right_wheel_radius_multiplier': sizes,
        }
    ),
    st.sampled_from(('position', 'velocity', None)),
)
def test_odometry_of_random_commands_equals_its_closed_form(legs, values, feedback):
    """Wheels that obey at once; from positions, from velocities and in open loop."""
    bench = Bench(
        **values,
        publish_rate=1000.0,
        velocity_rolling_window_size=1,
        open_loop=feedback is None,
        position_feedback=feedback == 'position',
    ).activate(feedback)
    for states in bench.states.values():
        for state in states:
            state.value = 0.0
    for v, w, ticks in legs:
        for _ in range(ticks):
            bench.drive(v, w)
            for position, velocity, command in zip(
                bench.states['position'], bench.states['velocity'], bench.wheels, strict=True
            ):
                position.value += command * PERIOD / NANOSECONDS
                velocity.value = command
    found = bench.odom[-1]
    if feedback is not None:
        # What the wheels did after the last command is seen at the next update.
        assert found.stamp == bench.time
        bench.drive(0.0)
        found = bench.odom[-1]
    position, heading = closed_form([(v, w, ticks * PERIOD / NANOSECONDS) for v, w, ticks in legs])
    assert (found.x, found.y) == pytest.approx((position.real, position.imag), abs=1e-9)
    assert found.heading == pytest.approx(heading, abs=1e-9)
    assert (found.linear, found.angular) == pytest.approx(legs[-1][:2], abs=1e-9)


def test_a_mirrored_command_gives_mirrored_wheels():
    dice, bench = random.Random(0), Bench().activate()
    for _ in range(50):
        linear, angular = dice.uniform(-1.0, 1.0), dice.uniform(-2.0, 2.0)
        left, right = bench.drive(linear, angular)
        assert bench.drive(linear, -angular) == (right, left)
        assert bench.drive(-linear, -angular) == (-left, -right)


@pytest.mark.parametrize('stamp_phase', range(0, 10, 3))
def test_when_the_publisher_dies_the_wheels_stand_within_the_time_out_and_a_period(stamp_phase):
    bench = Bench().activate()
    bench.update(times=100)
    stamp = bench.time + stamp_phase * MS
    bench.send(0.5, 0.1, stamp)
    while bench.update() != (0.0, 0.0):
        assert bench.time - stamp <= 500 * MS
    assert 500 * MS < bench.time - stamp <= 510 * MS


# --- init and configure --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('values', 'message'),
    [
        ({}, "'left_wheel_names' must not be empty"),
        (SIZES | {'left_wheel_names': ['l']}, "'right_wheel_names' must not be empty"),
        (SIZES | {'right_wheel_names': ['r']}, "'left_wheel_names' must not be empty"),
        (WHEELS, "'wheel_separation' must be greater than 0, found 0.0 m"),
        (WHEELS | SIZES | {'wheel_radius': -0.1}, "'wheel_radius' must be greater than 0"),
        (WHEELS | SIZES | {'wheel_radius': 1}, "'wheel_radius' must be of type double, found 1"),
        (WHEELS | SIZES | {'publish_rate': 0.0}, "'publish_rate' must be greater than 0"),
        (WHEELS | SIZES | {'cmd_vel_timeout': -1.0}, "'cmd_vel_timeout' must be at least 0"),
        (WHEELS | SIZES | {'cmd_vel_timeout': math.inf}, "'cmd_vel_timeout' must be a finite"),
        (WHEELS | SIZES | {'velocity_rolling_window_size': 0}, "window_size' must be at least 1"),
        (WHEELS | SIZES | {'pose_covariance_diagonal': [1.0]}, 'must have 6 elements'),
        (WHEELS | SIZES | {'left_wheel_radius_multiplier': 0.0}, 'must not be zero'),
    ],
)
def test_parameters_that_cannot_be_are_refused(values, message):
    with pytest.raises(ParameterError, match=message):
        build(DiffDriveParameters, values)


@pytest.mark.parametrize('axis', ['linear.x', 'angular.z'])
@pytest.mark.parametrize(
    ('limit', 'sign'),
    [
        ('max_velocity', 1.0),
        ('min_velocity', -1.0),
        ('max_acceleration', 1.0),
        ('max_deceleration', -1.0),
        ('max_acceleration_reverse', -1.0),
        ('max_deceleration_reverse', 1.0),
        ('max_jerk', 1.0),
        ('min_jerk', -1.0),
    ],
)
def test_every_limit_has_its_sign(axis, limit, sign):
    for good in (sign, 0.0, math.nan):
        build(DiffDriveParameters, WHEELS | SIZES | {f'{axis}.{limit}': good})
    with pytest.raises(ParameterError, match=f"'{axis}.{limit}' must be at (most|least) 0"):
        build(DiffDriveParameters, WHEELS | SIZES | {f'{axis}.{limit}': -1e-9 * sign})


def test_configure_refuses_unequal_sides():
    message = r'number of left wheels \[1\] and the number of right wheels \[2\] are different'
    with pytest.raises(ControllerError, match=message):
        Bench(right_wheel_names=['right_wheel', 'other'])


def test_interfaces_are_those_of_the_wheels_left_before_right():
    bench = Bench(left_wheel_names=['a', 'b'], right_wheel_names=['c', 'd'])
    commands, states = bench.controller.command_interfaces(), bench.controller.state_interfaces()
    assert (commands.claim, states.claim) == (Claim.INDIVIDUAL, Claim.INDIVIDUAL)
    assert commands.names == ('a/velocity', 'b/velocity', 'c/velocity', 'd/velocity')
    assert states.names == ('a/position', 'b/position', 'c/position', 'd/position')
    bench.configure(position_feedback=False)
    assert bench.controller.state_interfaces().names == ('left_wheel/velocity',
                                                         'right_wheel/velocity')  # fmt: skip


def test_open_loop_asks_for_no_states():
    bench = Bench(open_loop=True)
    assert len(bench.controller.command_interfaces().names) == 2
    assert bench.controller.state_interfaces() == NO_INTERFACES


@pytest.mark.parametrize('row', FRAMES['rows'], ids=lambda row: f'{row["ns"]} {row["odom"]}')
def test_frame_ids(row):
    bench = Bench(
        row['ns'], tf_frame_prefix_enable=row['enable'], tf_frame_prefix=row['prefix']
    ).activate()
    bench.drive(0.1)
    frames = bench.odom[0].frames
    assert frames.frame_id == row['odom']
    assert frames.child_frame_id == row['odom'].replace(FRAMES['odom'], FRAMES['base'])


@pytest.mark.parametrize(('prefix', 'odom'), [('a/', 'a/odom'), ('/a', 'a/odom'), ('/', 'odom')])
def test_a_prefix_ends_with_one_slash_and_begins_with_none(prefix, odom):
    table = build(DiffDriveParameters, WHEELS | SIZES | {'tf_frame_prefix': prefix})
    assert table.frame_ids('/ignored') == (odom, odom.replace('odom', 'base_link'))


def test_references_are_exported_under_the_controllers_name():
    controller = Bench().controller
    assert controller.is_chainable
    assert [r.name for r in controller.references()] == [
        'drive/linear/velocity', 'drive/angular/velocity'
    ]  # fmt: skip


def test_switched_off_limits_are_off_and_deprecated():
    bench = Bench(**{'linear.x.max_velocity': 0.1, 'linear.x.has_velocity_limits': False})
    assert bench.log.lines == [
        (
            Severity.WARN,
            '[deprecated] has_velocity_limits parameter is deprecated, instead set the respective '
            'limits to NAN',
        )
    ]
    assert bench.activate().drive(1.0) == (10.0, 10.0)


# --- activate ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('values', 'commands', 'feedback', 'missing'),
    [
        ({}, False, None, 'command handle for left_wheel/velocity'),
        ({}, True, None, 'state handle for left_wheel/position'),
        ({}, True, 'velocity', 'state handle for left_wheel/position'),
        ({'position_feedback': False}, True, 'position', 'state handle for left_wheel/velocity'),
    ],
)
def test_activate_refuses_missing_and_wrong_handles(values, commands, feedback, missing):
    bench = Bench(**values)
    handles = [bench.left, bench.right] if commands else []
    states = bench.states[feedback] if feedback else []
    with pytest.raises(ControllerError, match=f'Unable to obtain joint {missing}'):
        bench.controller.activate(handles, states, 0)


@pytest.mark.parametrize('feedback', ['position', 'velocity', None])
def test_open_loop_ignores_states_that_it_did_not_ask_for(feedback):
    assert Bench(open_loop=True).activate(feedback).drive(1.0) == (10.0, 10.0)


# --- the cycle -----------------------------------------------------------------------------------


@pytest.mark.parametrize('row', KINEMATICS['rows'], ids=str)
def test_inverse_kinematics(row):
    bench = Bench(wheel_separation=KINEMATICS['sep'], wheel_radius=KINEMATICS['r']).activate()
    assert bench.drive(row['v'], row['w']) == pytest.approx((row['left'], row['right']))


def test_speed_limiter():
    bench = Bench(**{f'linear.x.{name}': float(v) for name, v in RAMP['limits'].items()})
    bench.activate()
    for phase in RAMP['phases']:
        for step in range(1, phase['steps'] + 1):
            left, right = bench.drive(phase['target'], period=MS)
            assert left == right
            if step == phase['steps'] - 1:
                assert left == pytest.approx(phase['wheel_one_step_before'], abs=1e-6)
        assert left == pytest.approx(phase['wheel_rad_s_at_last'], abs=phase['tol'])
    for _ in range(10):
        assert bench.drive(0.0, period=MS) == pytest.approx((0.0, 0.0), abs=1e-3)


def test_cleanup():
    bench = Bench(wheel_separation=0.4).activate()
    left, right = bench.drive(1.0, 1.0)
    assert 0.0 < left < right
    bench.deactivate()
    assert bench.wheels == (0.0, 0.0)
    bench.controller.cleanup()


def test_correct_initialization_using_parameters():
    bench = Bench(wheel_separation=0.4, wheel_radius=1.0).activate()
    assert bench.drive(1.0) == (1.0, 1.0)
    bench.deactivate()
    assert bench.wheels == (0.0, 0.0)
    bench.controller.cleanup()
    bench.configure(wheel_separation=0.4, wheel_radius=0.5)
    assert bench.activate(time=bench.time).drive(1.0) == (2.0, 2.0)


def test_unchained_mode():
    bench = Bench(wheel_radius=1.0).activate()
    bench.left.value = bench.right.value = 7.0
    assert bench.update() == (7.0, 7.0)
    bench.send(1.0, stamp=bench.time)
    assert bench.update(600 * MS) == (0.0, 0.0)
    assert bench.drive(1.0) == (1.0, 1.0)


def test_chained_mode():
    """The upstream test: references 3.0 and 0.0, radius 1."""
    bench = Bench(wheel_radius=1.0).activate(chained=True)
    assert all(math.isnan(reference.value) for reference in bench.controller.references())
    bench.left.value = bench.right.value = 7.0
    assert bench.update() == (7.0, 7.0)
    bench.refer(3.0, 0.0)
    assert bench.update() == (3.0, 3.0)
    bench.deactivate()
    assert bench.wheels == (0.0, 0.0)
    assert all(math.isnan(reference.value) for reference in bench.controller.references())


def test_in_chained_mode_references_hold_without_a_time_out():
    bench = Bench(wheel_radius=1.0).activate(chained=True)
    bench.refer(1.0, 0.5)
    assert bench.update(100_000 * MS, times=3) == (0.75, 1.25)
    assert bench.log.texts(Severity.WARN) == []


@pytest.mark.parametrize('reference', [(math.nan, 0.0), (0.0, math.nan), (math.inf, 0.0)])
def test_in_chained_mode_a_reference_that_is_no_number_leaves_the_wheels_as_they_are(reference):
    bench = Bench(wheel_radius=1.0).activate(chained=True)
    bench.refer(1.0, 0.0)
    bench.update()
    bench.refer(*reference)
    bench.odom.clear()
    assert bench.update(times=10) == (1.0, 1.0)
    assert bench.odom == []


def test_in_chained_mode_topics_are_ignored_with_a_warning():
    bench = Bench(wheel_radius=1.0, enable_cmd_vel_unstamped=True).activate(chained=True)
    bench.refer(1.0, 0.0)
    bench.send_unstamped(-1.0)
    assert bench.drive(-1.0) == (1.0, 1.0)
    assert bench.log.texts(Severity.WARN) == [
        f"Ignoring commands on '~/{name}': in chained mode the preceding controller commands"
        for name in ('cmd_vel', 'cmd_vel_unstamped')
    ]
    bench.deactivate()
    bench.activate(time=bench.time)
    bench.update()
    assert bench.wheels == (0.0, 0.0)
    assert bench.drive(-1.0) == (-1.0, -1.0)


def test_in_chained_mode_limits_odometry_and_publication_are_the_same():
    values = {'publish_limited_velocity': True, 'linear.x.max_acceleration': 1.0}
    bench, chained = Bench(**values).activate(), Bench(**values).activate(chained=True)
    for linear, angular in ((1.0, 0.5), (1.0, 0.5), (-0.2, 0.0), (0.0, 0.0)):
        bench.drive(linear, angular)
        chained.refer(linear, angular)
        chained.update()
        assert (chained.wheels, chained.limited) == (bench.wheels, bench.limited)
    assert chained.odom == bench.odom
    assert len(chained.odom) == 2


def test_references_of_which_one_is_no_number_are_not_driven():
    for values in ((3.0, math.nan), (math.nan, 3.0), (3.0, math.inf)):
        bench = Bench().activate()
        bench.left.value = bench.right.value = 7.0
        for reference, value in zip(bench.controller.references(), values, strict=True):
            reference.value = value
        assert bench.update() == (7.0, 7.0)


def test_a_wheel_that_was_given_back_is_not_touched():
    bench = Bench().activate()
    bench.deactivate()
    bench.left.value = bench.right.value = 7.0
    bench.controller.reset(0)
    bench.controller.deactivate(0)
    assert bench.wheels == (7.0, 7.0)


def test_deactivate_then_activate():
    bench = Bench(wheel_radius=1.0).activate()
    assert bench.drive(1.0) == (1.0, 1.0)
    bench.deactivate()
    assert bench.wheels == (0.0, 0.0)
    bench.activate(time=bench.time)
    bench.update()
    assert all(math.isnan(reference.value) for reference in bench.controller.references())
    assert bench.wheels == (0.0, 0.0)
    assert bench.drive(1.0) == (1.0, 1.0)


numbers = st.floats(allow_nan=True, allow_infinity=True)


@examples(50)
@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=5), st.booleans())
def test_whatever_is_commanded_the_wheels_get_finite_commands(commands, chained):
    bench = Bench(enable_cmd_vel_unstamped=True, open_loop=True).activate(None, chained=chained)
    bench.left.value = bench.right.value = 0.0
    for linear, angular in commands:
        if chained:
            bench.refer(linear, angular)
        else:
            bench.send_unstamped(linear, angular)
        assert all(map(math.isfinite, bench.update()))


def test_a_command_with_zero_timestamp_is_accepted_with_a_warning():
    bench = Bench().activate()
    bench.send(1.0, stamp=0)
    assert bench.update() == (10.0, 10.0)
    assert 'zero timestamp' in bench.log.texts(Severity.WARN)[0]


def test_zero_cmd_vel_timeout_disables_the_timeout():
    bench = Bench(cmd_vel_timeout=0.0, wheel_radius=1.0).activate()
    bench.send(1.0, stamp=1000 * MS)
    assert bench.update(11_000 * MS) == (1.0, 1.0)


@pytest.mark.parametrize('first', [0, 2], ids=['clamped', 'unclamped'])
def test_open_loop_odometry(first):
    period = round(OPEN_LOOP['dt'] * NANOSECONDS)
    steps = OPEN_LOOP['steps'][first : first + 2]
    linear, angular = nan_for_none(steps[0]['max'])
    bench = Bench(
        open_loop=True,
        publish_rate=1000.0,
        **{'linear.x.max_velocity': linear, 'angular.z.max_velocity': angular},
    ).activate(feedback=None)
    bench.controller.update(OPEN_LOOP['first_update_at_t'], period)
    for step in steps:
        bench.drive(*map(float, step['cmd']), period=period)
        for name in step.keys() - {'max', 'cmd'}:
            assert getattr(bench.odom[-1], name) == pytest.approx(step[name], abs=1e-3)


# --- plain Twist ---------------------------------------------------------------------------------


def test_plain_twists_are_taken_only_if_enabled():
    assert len(Bench().controller.inputs()) == 2
    ports = [port.port for port in Bench(enable_cmd_vel_unstamped=True).controller.inputs()]
    assert [(port.name, port.message) for port in ports] == [
        ('~/cmd_vel', 'geometry_msgs/msg/TwistStamped'),
        ('~/cmd_vel_unstamped', 'geometry_msgs/msg/Twist'),
        ('emergency_stop', 'std_msgs/msg/Bool'),
    ]


def test_a_plain_twist_drives_without_a_warning_and_times_out_from_its_arrival():
    bench = Bench(enable_cmd_vel_unstamped=True, wheel_radius=1.0).activate()
    bench.update(times=200)
    bench.send_unstamped(1.0, 0.5)
    arrival = bench.time
    while bench.update() == (0.75, 1.25):
        assert bench.time - arrival <= 500 * MS
    assert bench.wheels == (0.0, 0.0)
    assert bench.time - arrival == 510 * MS
    assert bench.log.texts(Severity.WARN) == ['Velocity command timed out. Braking.']


def test_the_command_that_came_last_counts_be_it_stamped_or_not():
    bench = Bench(enable_cmd_vel_unstamped=True, wheel_radius=1.0).activate()
    bench.send_unstamped(1.0)
    assert bench.update() == (1.0, 1.0)
    assert bench.drive(2.0) == (2.0, 2.0)
    bench.send_unstamped(3.0)
    assert bench.drive(2.0) == (3.0, 3.0)


def test_a_plain_twist_that_is_no_number_leaves_what_was_in_force():
    bench = Bench(enable_cmd_vel_unstamped=True, wheel_radius=1.0).activate()
    bench.drive(1.0)
    bench.send_unstamped(math.nan)
    assert bench.update(times=10) == (1.0, 1.0)


# --- curvature -----------------------------------------------------------------------------------


def test_a_limited_arc_keeps_its_curvature_only_when_asked_for():
    limits = {'linear.x.max_acceleration': 1.0, 'publish_limited_velocity': True}
    free, kept = Bench(**limits).activate(), Bench(**limits, preserve_curvature=True).activate()
    for bench in (free, kept):
        for _ in range(10):
            bench.drive(1.0, 2.0)
    assert {sample.angular for sample in free.limited} == {2.0}
    for sample in kept.limited:
        assert sample.angular == pytest.approx(2.0 * sample.linear)
