# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Limits of joints: where they come from, and that no command exceeds them."""

from itertools import pairwise
import math
from types import SimpleNamespace

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import FakeController, FakeHardware, FakeLog, make_manager, MS, start
from support.examples import examples

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.joint_limits import (
    CommandRanges,
    JointLimiter,
    JointLimits,
    JointState,
    limit_acceleration,
    limit_effort,
    limit_position,
    limit_velocity,
    limits_of,
)
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import HardwareError
from amr_description.hardware.mock_system import MockSystem
from amr_description.log import Severity
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse

PERIOD = 10 * MS
URDF = """
<robot name="rig">
  <link name="base"/><link name="a"/>
  <joint name="j" type="{type}">
    <parent link="base"/><child link="a"/>{limit}
  </joint>
  <ros2_control name="Rig" type="system">
    <hardware>
      <plugin>mock_components/GenericSystem</plugin>
      <param name="calculate_dynamics">true</param>
    </hardware>
    <joint name="j">
      {inside}
      <state_interface name="position"/><state_interface name="velocity"/>
    </joint>
  </ros2_control>
</robot>
"""
LIMIT = '<limit lower="-1" upper="2" velocity="3" effort="4"/>'


def command(name, low=None, high=None, inside=''):
    bounds = ''.join(
        f'<param name="{key}">{value}</param>'
        for key, value in (('min', low), ('max', high))
        if value is not None
    )
    return f'<command_interface name="{name}">{bounds}{inside}</command_interface>'


def read_limits(inside, limit=LIMIT, kind='revolute'):
    robot = parse(URDF.format(type=kind, limit=limit, inside=inside))
    (info,) = hardware_of(robot)
    return limits_of(info.joints[0], robot.joint('j'))


# --- whose they are ------------------------------------------------------------------------------

OFF = '<limits enable="false"/>'


@pytest.mark.parametrize(
    ('inside', 'expected'),
    [
        ('', 'position [-1, 2], velocity 3, effort 4'),
        (command('position', -5, 5), 'position [-1, 2], velocity 3, effort 4'),
        (command('position', 0, 5), 'position [0, 2], velocity 3, effort 4'),
        (command('position', high=1), 'position [-1, 1], velocity 3, effort 4'),
        (command('velocity', -2, 9), 'position [-1, 2], velocity 2, effort 4'),
        (command('velocity', high=1), 'position [-1, 2], velocity 1, effort 4'),
        (command('effort', -1, 2), 'position [-1, 2], velocity 3, effort 1'),
        (
            command('acceleration', -5, 6) + command('jerk', -8, 7),
            'position [-1, 2], velocity 3, effort 4, acceleration 6, deceleration 5, jerk 7',
        ),
        (command('position', 0, 1, OFF), 'velocity 3, effort 4'),
        (command('velocity', inside=OFF), 'position [-1, 2], effort 4'),
        (command('effort', inside=OFF), 'position [-1, 2], velocity 3'),
        (command('acceleration', -5, 6, OFF), 'position [-1, 2], velocity 3, effort 4'),
        (command('position') + command('velocity') + command('effort') + OFF, 'none'),
    ],
)
def test_the_most_restrictive_of_urdf_and_parameters_holds(inside, expected):
    assert str(read_limits(inside)) == expected


def test_a_continuous_joint_has_position_limits_only_by_parameters():
    assert read_limits('', kind='continuous').position is None
    limits = read_limits(command('position', -9, 9), kind='continuous')
    assert limits.position == (-9.0, 9.0)
    assert read_limits('', limit='', kind='continuous') == JointLimits()
    one_sided = read_limits(command('position', -9), kind='continuous')
    assert one_sided.position == (-9.0, math.inf)


def test_without_a_robot_the_parameters_hold():
    (info,) = hardware_of(parse(URDF.format(type='revolute', limit=LIMIT, inside='')))
    assert limits_of(info.joints[0], None) == JointLimits()


def test_limits_that_exclude_each_other_are_refused():
    message = r"joint 'j': no position is within all its limits; .* leave from 3 to 2"
    with pytest.raises(HardwareError, match=message):
        read_limits(command('position', 3, 5))


# --- what is let through: laws -------------------------------------------------------------------

LAW = examples(100)
FINITE = st.floats(allow_nan=False, allow_infinity=False)
SMALL = st.floats(-100.0, 100.0)
ANY = st.floats(allow_nan=False)
MAGNITUDE = st.floats(0.0, allow_infinity=False)
STEP = st.floats(0.0, allow_infinity=False)


def optional(values):
    return st.none() | values


LIMITS = st.builds(
    JointLimits,
    position=optional(st.tuples(FINITE, FINITE).map(sorted).map(tuple)),
    velocity=optional(MAGNITUDE),
    effort=optional(MAGNITUDE),
    acceleration=optional(MAGNITUDE),
    deceleration=optional(MAGNITUDE),
    jerk=optional(MAGNITUDE),
)
STATES = st.builds(JointState, optional(FINITE), optional(FINITE))


def all_limited(value, limits, state, before, dt):
    return {
        'position': limit_position(value, limits, state, before, dt),
        'velocity': limit_velocity(value, limits, state, before, dt),
        'effort': limit_effort(value, limits, state),
        'acceleration': limit_acceleration(value, limits, state),
    }


@LAW
@given(ANY, LIMITS, STATES, optional(FINITE), STEP)
def test_no_command_exceeds_the_limits(value, limits, state, before, dt):
    limited = all_limited(value, limits, state, before, dt)
    assert not any(map(math.isnan, limited.values()))
    if limits.position is not None:
        assert limits.position[0] <= limited['position'] <= limits.position[1]
    for name in ('velocity', 'effort'):
        if getattr(limits, name) is not None:
            assert abs(limited[name]) <= getattr(limits, name)
    bounds = limits.acceleration, limits.deceleration
    if None not in bounds:
        assert abs(limited['acceleration']) <= max(bounds)


@LAW
@given(ANY, LIMITS, STATES, optional(FINITE), STEP)
def test_what_is_allowed_passes_unchanged(value, limits, state, before, dt):
    limited = all_limited(value, limits, state, before, dt)
    again = {name: all_limited(v, limits, state, before, dt)[name] for name, v in limited.items()}
    assert again == limited
    assert set(all_limited(value, JointLimits(), state, before, dt).values()) == {value}


COMMANDS = ('position', 'velocity', 'effort', 'acceleration', 'jerk', 'gain')


@LAW
@given(
    st.sets(st.sampled_from(COMMANDS), min_size=1),
    LIMITS,
    st.lists(st.lists(st.floats() | st.floats(-2.0, 2.0), min_size=6, max_size=6), max_size=4),
    STEP,
)
def test_what_is_in_range_is_not_limited(names, limits, rows, dt):
    """The comparison that saves most limiting lets nothing through that would be limited."""
    log, commands = FakeLog(), [CommandInterface('j', name) for name in sorted(names)]
    handles = {command.name: command for command in commands}
    states = {f'j/{name}': StateInterface('j', name, 0.5) for name in ('position', 'velocity')}
    limiter = JointLimiter('j', limits, handles, states, log)
    ranges = CommandRanges(SimpleNamespace(commands=handles), [limiter])
    for row in rows:
        for command, value in zip(commands, row, strict=False):
            command.value = value
        are_in_range = ranges.hold()
        before = [command.value for command in commands]
        log.lines.clear()
        limiter.enforce(dt)
        if are_in_range:
            assert log.lines == []
            for command, value in zip(commands, before, strict=True):
                assert command.value is value
                assert not math.isinf(value)


@pytest.mark.parametrize('value', ['1.0', None, 1j, 10**400, math.inf, -math.inf, [1.0]])
def test_what_is_no_finite_number_is_never_in_range(value):
    wheel = CommandInterface('j', 'velocity')
    ranges = CommandRanges(SimpleNamespace(commands={'j/velocity': wheel}), [])
    assert ranges.hold()  # there is no command
    wheel.value = 1.0
    assert ranges.hold()
    wheel.value = value
    assert not ranges.hold()


def test_limits_that_depend_on_the_state_have_no_range():
    hand = {'j/position': CommandInterface('j', 'position', 0.0)}
    limiter = JointLimiter('j', JointLimits(velocity=1.0), hand, {}, FakeLog())
    assert not CommandRanges(SimpleNamespace(commands=hand), [limiter]).hold()


@LAW
@given(ANY, ANY, LIMITS, STATES, optional(FINITE), STEP)
def test_a_greater_command_never_gives_less(one, other, limits, state, before, dt):
    less = all_limited(min(one, other), limits, state, before, dt)
    more = all_limited(max(one, other), limits, state, before, dt)
    for name in ('position', 'velocity', 'effort'):
        assert less[name] <= more[name]


@LAW
@given(st.lists(ANY, min_size=2), SMALL, st.floats(0.001, 100.0), st.floats(0.0001, 1.0))
def test_a_position_never_runs_faster_than_the_velocity_limit(values, start_at, speed, dt):
    limits = JointLimits(velocity=speed)
    before, given_out = start_at, [start_at]
    for value in values:
        before = limit_position(value, limits, JointState(), before, dt)
        given_out.append(before)
    for one, other in pairwise(given_out):
        assert abs(other - one) <= speed * dt + 1e-9


@LAW
@given(
    st.lists(ANY, min_size=1),
    st.floats(-1.0, 1.0),
    st.floats(0.0, 100.0),
    optional(st.floats(0.0, 100.0)),
    st.floats(0.0001, 1.0),
)
def test_a_joint_under_velocity_commands_never_leaves_its_position_limits(
    values, position, speed, acceleration, dt
):
    limits = JointLimits(position=(-1.0, 1.0), velocity=speed, acceleration=acceleration)
    before = 0.0
    for value in values:
        before = limit_velocity(value, limits, JointState(position, before), before, dt)
        position += before * dt
        assert abs(position) <= 1.0 + 1e-9


@LAW
@given(st.lists(ANY, min_size=2), st.floats(0.0, 100.0), st.floats(0.0001, 1.0))
def test_a_velocity_never_changes_faster_than_the_acceleration_limit(values, acceleration, dt):
    limits = JointLimits(acceleration=acceleration)
    before = 0.0
    for value in values:
        after = limit_velocity(value, limits, JointState(), before, dt)
        assert abs(after - before) <= acceleration * dt + 1e-9
        before = after


# --- what is let through: numbers ----------------------------------------------------------------

ARM = JointLimits(position=(-1.0, 2.0), velocity=3.0, effort=4.0)


@pytest.mark.parametrize(
    ('value', 'position', 'expected'),
    [
        (9.0, 0.0, 3.0),
        (9.0, 1.9, 1.0),
        (9.0, 2.0, 0.0),
        (-9.0, -0.95, -0.5),
        (1.0, 2.001, 0.0),
        (-9.0, 2.001, -3.0),
        (-9.0, 2.01, 0.0),
        (math.inf, 0.0, 3.0),
        (9.0, None, 3.0),
    ],
)
def test_a_velocity_brakes_before_a_position_limit(value, position, expected):
    limited = limit_velocity(value, ARM, JointState(position, 0.0), 0.0, 0.1)
    assert limited == pytest.approx(expected)


@pytest.mark.parametrize(
    ('limits', 'velocity', 'expected'),
    [
        (JointLimits(velocity=3.0), 0.0, 0.8),
        (JointLimits(velocity=3.0, acceleration=10.0), 0.0, 0.6),
        (JointLimits(velocity=3.0, acceleration=10.0), -1.0, 0.7),
        (JointLimits(velocity=3.0, position=(-1.0, 0.55)), 0.0, 0.55),
    ],
)
def test_a_position_is_within_reach(limits, velocity, expected):
    state = JointState(0.0, velocity)
    assert limit_position(9.0, limits, state, 0.5, 0.1) == pytest.approx(expected)


@pytest.mark.parametrize(
    ('value', 'position', 'velocity', 'expected'),
    [
        (9.0, 0.0, 0.0, 4.0),
        (9.0, 2.0, 0.0, 0.0),
        (-9.0, 2.0, 0.0, -4.0),
        (9.0, 2.0, -1.0, 4.0),
        (-9.0, -1.5, -1.0, 0.0),
        (9.0, 0.0, 3.5, 0.0),
        (-9.0, 0.0, -3.5, 0.0),
        (-9.0, 0.0, 3.5, -4.0),
    ],
)
def test_no_effort_pushes_outwards_or_faster(value, position, velocity, expected):
    assert limit_effort(value, ARM, JointState(position, velocity)) == expected


@pytest.mark.parametrize(
    ('value', 'velocity', 'expected'),
    [(9.0, 0.0, 2.0), (9.0, 1.0, 2.0), (9.0, -1.0, 5.0), (-9.0, 1.0, -5.0), (-9.0, None, -2.0)],
)
def test_braking_has_a_limit_of_its_own(value, velocity, expected):
    limits = JointLimits(acceleration=2.0, deceleration=5.0)
    assert limit_acceleration(value, limits, JointState(velocity=velocity)) == expected


# --- a joint -------------------------------------------------------------------------------------


def limiter_of(limits, *names):
    cells = {name: CommandInterface('j', name) for name in names}
    states = {name: StateInterface('j', name) for name in ('position', 'velocity')}
    others = {'other': CommandInterface('other', 'velocity', math.inf)}
    log = FakeLog()
    return JointLimiter('j', limits, cells | others, states, log), cells, states, log


@pytest.mark.parametrize(
    ('name', 'given', 'bounds'),
    [
        ('position', {'position': (-1.0, 2.0)}, (-1.0, 2.0)),
        ('position', {'position': (-1.0, 2.0), 'velocity': 3.0}, None),
        ('velocity', {'velocity': 3.0}, (-3.0, 3.0)),
        ('velocity', {'velocity': 3.0, 'position': (-1.0, 2.0)}, None),
        ('velocity', {'velocity': 3.0, 'acceleration': 6.0}, None),
        ('effort', {'effort': 4.0}, (-4.0, 4.0)),
        ('effort', {'effort': 4.0, 'velocity': 3.0}, None),
        ('acceleration', {'acceleration': 6.0}, (-6.0, 6.0)),
        ('acceleration', {'acceleration': 6.0, 'deceleration': 5.0}, None),
        ('jerk', {'jerk': 7.0}, (-7.0, 7.0)),
    ],
)
def test_bounds_are_fixed_where_they_hang_on_nothing_else(name, given, bounds):
    limiter, *_ = limiter_of(JointLimits(**given), name)
    assert limiter.fixed_bounds() == (bounds and {f'j/{name}': bounds})


def test_a_command_that_is_not_set_stays_so():
    limiter, cells, _, log = limiter_of(ARM, 'position', 'velocity')
    limiter.enforce(0.1)
    assert all(math.isnan(cell.value) for cell in cells.values())
    assert log.lines == []


def test_a_limited_command_is_logged_with_joint_and_limits():
    limiter, cells, _, log = limiter_of(ARM, 'velocity')
    cells['velocity'].value = 50.0
    limiter.enforce(0.1)
    assert log.lines == [
        (
            Severity.ERROR,
            "Command of at least one joint is out of limits. Joint: 'j', velocity command 50 "
            'limited to 3; its limits are position [-1, 2], velocity 3, effort 4',
        )
    ]


def test_a_position_starts_at_the_joint_and_goes_on_from_the_command():
    limiter, cells, states, _ = limiter_of(ARM, 'position')
    states['position'].value = 1.0
    for expected in (0.7, 0.4, 0.1):
        cells['position'].value = -1.0
        limiter.enforce(0.1)
        assert cells['position'].value == pytest.approx(expected)
    cells['position'].value = math.nan
    limiter.enforce(0.1)
    for _ in range(2):
        cells['position'].value = -1.0
        limiter.reset()
        limiter.enforce(0.1)
        assert cells['position'].value == pytest.approx(0.7), 'begins where the joint is, again'


def test_only_floating_point_commands_are_limited():
    steps = CommandInterface('j', 'velocity', 9, data_type='int8')
    limiter = JointLimiter('j', ARM, {steps.name: steps}, {}, FakeLog())
    limiter.enforce(0.1)
    assert steps.value == 9


def test_jerk_is_bounded_and_what_has_no_rule_is_not():
    limiter, cells, _, _ = limiter_of(JointLimits(jerk=7.0), 'jerk', 'brightness')
    for cell in cells.values():
        cell.value = -9.0
    limiter.enforce(0.1)
    assert (cells['jerk'].value, cells['brightness'].value) == (-7.0, -9.0)


# --- in the manager ------------------------------------------------------------------------------


class Telling(FakeController):
    """Writes the same value at every update."""

    def __init__(self, name, value):
        super().__init__(commands=[name])
        self.value = value

    def update(self, time, period):
        super().update(time, period)
        for handle in self.handles:
            handle.value = self.value


def rig(inside, enforce, limit=LIMIT, kind='revolute'):
    robot = parse(URDF.format(type=kind, limit=limit, inside=inside))
    (info,) = hardware_of(robot)
    resources = ResourceManager(FakeLog(), robot, enforce_command_limits=enforce)
    resources.load(info, lambda plugin: MockSystem, None)
    resources.start_components()
    return ControllerManager(resources, 100, FakeLog())


def drive(manager, name, value, ticks=500):
    start(manager, Telling(name, value))
    for tick in range(ticks):
        manager.tick(tick * PERIOD)
        yield {n: handle.value for n, handle in manager.resources.available_states().items()}


@pytest.mark.parametrize('value', [0.5, 99.0, 1e308, math.inf, -math.inf])
def test_enforced_limits_hold_from_controller_to_joint(value):
    manager = rig(command('velocity'), enforce=True)
    states = list(drive(manager, 'j/velocity', value))
    assert all(abs(state['j/velocity']) <= 3.0 for state in states)
    assert all(-1.0 - 1e-9 <= state['j/position'] <= 2.0 + 1e-9 for state in states)
    expected = 2.0 if value > 0.0 else -1.0
    assert states[-1]['j/position'] == pytest.approx(expected)
    assert manager.snapshot.active_controllers == ('fake',)


def test_each_limiter_is_logged_at_the_start():
    manager = rig(command('velocity'), enforce=True)
    assert (
        "Using JointLimiter for joint 'j' in hardware 'Rig' : position [-1, 2], velocity 3, "
        'effort 4'
    ) in manager.resources.log.texts()


def test_without_the_parameter_a_finite_command_passes():
    manager = rig(command('velocity'), enforce=False)
    *_, last = drive(manager, 'j/velocity', 99.0, ticks=3)
    assert last['j/velocity'] == 99.0
    assert 'JointLimiter' not in ' '.join(manager.resources.log.texts())


@pytest.mark.parametrize('enforce', [True, False])
@pytest.mark.parametrize('bad', [math.inf, -math.inf, None, 'fast', 1j, 10**400])
@pytest.mark.parametrize(('name', 'stands'), [('velocity', 0.0), ('position', math.nan)])
def test_a_command_that_is_not_finite_stops_its_joint_only(bad, enforce, name, stands):
    """Even without limits no component gets one, which would bring it down, and the robot."""
    manager = rig(command(name), enforce, limit='', kind='continuous')
    states = list(drive(manager, f'j/{name}', bad, ticks=3))
    (cell,) = manager.resources.available_commands().values()
    assert cell.value == pytest.approx(stands, nan_ok=True)
    assert states[-1] == {'j/position': 0.0, 'j/velocity': 0.0}
    assert manager.snapshot.active_controllers == ('fake',)
    text = manager.resources.log.texts(Severity.ERROR)[0]
    assert text == (
        f"The command 'j/{name}' is {bad} by controller 'fake'; a finite number is needed. It is "
        f'set to {stands}'
    )


def test_a_component_that_is_down_is_left_alone():
    hardware = FakeHardware(['j'])
    manager = make_manager(hardware)
    manager.resources.shut_down()
    hardware.commands['j'].value = math.inf
    manager.resources.enforce_limits(PERIOD)
    assert hardware.commands['j'].value == math.inf


def test_a_reset_forgets_previous_commands():
    manager = rig(command('position'), enforce=True)
    *_, last = drive(manager, 'j/position', 2.0, ticks=11)
    assert last['j/position'] == pytest.approx(0.3)
    manager.reset(0)
    manager.tick(0)
    step = 3.0 * PERIOD / NANOSECONDS
    (cell,) = manager.resources.available_commands().values()
    assert cell.value == pytest.approx(last['j/position'] + 2 * step)
