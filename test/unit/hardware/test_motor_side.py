# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One motor for the joints of a side: interfaces against ticks."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.errors import HardwareDeactivationError, HardwareError
from amr_description.hardware.serial_base_system import MotorSide
from amr_description.model.hardware_info import ComponentInfo, ComponentType, InterfaceInfo

TICKS = 1000


def joint(name, commands=('velocity',), states=('position', 'velocity')):
    return ComponentInfo(
        name,
        ComponentType.JOINT,
        tuple(map(InterfaceInfo, commands)),
        tuple(map(InterfaceInfo, states)),
    )


def make_side(reduction=1.0, ticks=0):
    side = MotorSide('Rig', [joint('front'), joint('back')], reduction)
    side.set_encoder(ticks, TICKS)
    return side


def wrapped(ticks):
    return (ticks + 2**31) % 2**32 - 2**31


def values(side):
    return {state.name: state.value for state in side.states}


@given(
    st.integers(-(2**31), 2**31 - 1),
    st.lists(st.integers(-(2**31), 2**31 - 1), max_size=10),
    st.floats(0.1, 100.0) | st.floats(-100.0, -0.1),
)
def test_position_is_the_sum_of_moves_however_the_counter_wraps(start, moves, reduction):
    side = make_side(reduction, start)
    count = start
    for move in moves:
        count += move
        side.update_states(wrapped(count), 0.0)
    side.update_states(wrapped(count), 0.0)
    expected = sum(moves) * math.tau / TICKS / reduction
    assert values(side)['front/position'] == pytest.approx(expected, rel=1e-9, abs=1e-6)


@given(st.integers(-(2**31), 2**31 - 1), st.integers(-(2**31), 2**31 - 1))
def test_a_new_counter_moves_nothing(before, after):
    side = make_side()
    side.update_states(500, 0.0)
    side.update_states(before, 0.0)
    position = values(side)['back/position']
    side.set_encoder(after, TICKS)
    side.update_states(after, 0.0)
    assert values(side)['back/position'] == position


@pytest.mark.parametrize('reduction', [1.0, 20.0, -2.5])
def test_all_joints_have_the_states_of_the_wheel_not_of_the_shaft(reduction):
    side = make_side(reduction)
    side.update_states(TICKS, 3.0)
    assert values(side) == {
        'front/position': pytest.approx(math.tau / reduction),
        'front/velocity': 3.0 / reduction,
        'back/position': pytest.approx(math.tau / reduction),
        'back/velocity': 3.0 / reduction,
    }


def test_without_a_command_the_previous_one_is_kept():
    side = make_side()
    assert side.target() == 0.0
    for command in side.commands:
        command.value = 4.0
    assert side.target() == 4.0
    side.commands[0].value = math.nan
    assert side.target() == 4.0
    side.commands[1].value = math.nan
    assert side.target() == 4.0
    side.forget_commands()
    assert side.target() == 0.0


def test_one_motor_cannot_turn_at_two_speeds():
    side = make_side()
    side.commands[0].value, side.commands[1].value = 1.0, 2.0
    expected = r"'front/velocity' \(1.0\) and 'back/velocity' \(2.0\) differ, but one motor turns"
    with pytest.raises(HardwareDeactivationError, match=expected):
        side.target()


@pytest.mark.parametrize('bad', [math.inf, -math.inf])
def test_an_infinite_command_is_refused(bad):
    side = make_side()
    side.commands[1].value = bad
    with pytest.raises(HardwareDeactivationError, match=f"'back/velocity' is {bad}; a finite"):
        side.target()


@pytest.mark.parametrize(
    ('wrong', 'text'),
    [
        (joint('a', commands=('effort',)), "command interface 'effort' is asked; there are: velo"),
        (joint('a', states=('effort',)), "state interface 'effort' is asked; there are: position"),
    ],
)
def test_an_interface_that_a_motor_lacks_is_refused(wrong, text):
    with pytest.raises(HardwareError, match=f"component 'Rig': joint 'a': {text}"):
        MotorSide('Rig', [wrong], 1.0)
