# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated motor board: laws of its motors, and answers of its firmware."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.hardware.serial_protocol import (
    Arm,
    Board,
    BoardMode,
    Disarm,
    encode,
    Error,
    Get,
    Hello,
    LineReader,
    Reason,
    Set,
    State,
    VERSION,
)
from amr_description.hardware.simulated_motor_board import (
    Motor,
    MotorConstants,
    SimulatedMotorBoard,
)

UNLIMITED = MotorConstants(time_constant=0.1, acceleration=math.inf)
SPEEDS = st.floats(-30.0, 30.0)
TIMES = st.lists(st.floats(1e-4, 0.1), min_size=1, max_size=20)
NUMBERS = st.integers(0, 65535)
REQUESTS = st.one_of(
    st.builds(Hello, NUMBERS, st.integers(0, 9)),
    st.builds(Get, NUMBERS),
    st.builds(Arm, NUMBERS, st.integers(0, 6000)),
    st.builds(Set, NUMBERS, st.floats(-40.0, 40.0), st.floats(-40.0, 40.0)),
    st.builds(Disarm, NUMBERS),
)


# --- motors --------------------------------------------------------------------------------------


@given(SPEEDS, SPEEDS, TIMES)
def test_speed_follows_its_closed_form_however_time_is_cut(start, target, times):
    motor = Motor(UNLIMITED)
    motor.velocity, motor.target = start, target
    for dt in times:
        motor.advance(dt)
    expected = target + (start - target) * math.exp(-sum(times) / UNLIMITED.time_constant)
    assert motor.velocity == pytest.approx(expected, abs=1e-9)


@given(SPEEDS, SPEEDS, TIMES)
def test_acceleration_is_bounded_and_nothing_overshoots(start, target, times):
    motor = Motor(MotorConstants())
    motor.velocity, motor.target = start, target
    for dt in times:
        before, position = motor.velocity, motor.position
        motor.advance(dt)
        assert abs(motor.velocity - before) <= MotorConstants().acceleration * dt * (1 + 1e-12)
        low, high = sorted((before, target))
        assert low - 1e-12 <= motor.velocity <= high + 1e-12
        mean = (before + motor.velocity) / 2
        assert motor.position - position == pytest.approx(mean * dt, abs=1e-12)


@given(st.floats(-1e7, 1e7))
def test_encoder_counts_whole_ticks_and_wraps(position):
    motor = Motor(MotorConstants())
    motor.position = position
    exact = position / math.tau * MotorConstants().ticks
    assert -(2**31) <= motor.ticks < 2**31
    # Between no tick and one behind, whichever turn of the counter it is.
    assert abs(math.remainder(exact - motor.ticks - 0.5, 2**32)) <= 0.5 + 1e-6


# --- the firmware --------------------------------------------------------------------------------


class Bench:
    """A board, and the messages on its line."""

    def __init__(self):
        self.events = []
        self.board = SimulatedMotorBoard(self.events.append)

    def ask(self, message):
        (answer,) = LineReader().feed(self.board.receive(encode(message)))
        return answer

    def wait(self, seconds):
        for _ in range(round(seconds / 0.01)):
            self.board.advance(0.01)

    @property
    def mode(self):
        return self.ask(Get(1)).mode


@pytest.fixture
def bench():
    return Bench()


@pytest.fixture
def armed(bench):
    assert bench.ask(Arm(1, 200)).mode is BoardMode.ARMED
    return bench


@given(st.lists(REQUESTS, max_size=20))
def test_every_line_has_one_answer_and_the_motors_never_exceed_their_limit(requests):
    bench = Bench()
    for request in requests:
        answer = bench.ask(request)
        expected = Board if isinstance(request, Hello) else State | Error
        assert isinstance(answer, expected)
        assert isinstance(answer, Error) or answer.number == request.number
        bench.wait(0.1)
        for motor in (bench.board.left, bench.board.right):
            assert abs(motor.target) <= MotorConstants().velocity
        if bench.board.mode is not BoardMode.ARMED:
            assert bench.board.left.target == bench.board.right.target == 0.0


def test_introduces_itself_with_the_number_of_the_question(bench):
    assert bench.ask(Hello(7, 99)) == Board(7, VERSION, 'simulated', 4096, 30.0)


def test_turns_as_commanded_and_answers_with_its_state(armed):
    for _ in range(100):
        answer = armed.ask(Set(1, 5.0, -2.0))
        armed.wait(0.01)
    assert (answer.left, answer.right) == (5.0, -2.0)
    before, after = armed.ask(Get(1)), (armed.wait(0.1), armed.ask(Get(1)))[1]
    assert after.uptime - before.uptime == 100
    assert after.left_ticks - before.left_ticks == pytest.approx(0.5 / math.tau * 4096, abs=1)
    assert after.right_ticks - before.right_ticks == pytest.approx(-0.2 / math.tau * 4096, abs=1)


def test_watchdog_stops_the_motors_and_the_next_command_goes_on(armed):
    armed.ask(Set(1, 5.0, 5.0))
    armed.wait(0.19)
    assert (armed.mode, armed.board.left.target) == (BoardMode.ARMED, 5.0)
    armed.wait(0.02)
    assert (armed.mode, armed.board.left.target) == (BoardMode.TIMEOUT, 0.0)
    assert armed.ask(Set(1, 1.0, 1.0)).mode is BoardMode.ARMED
    assert armed.board.left.target == 1.0
    assert armed.events == [
        'armed; the watchdog waits 200 ms',
        'no SET for 200 ms: the motors stop',
        'a SET came: the motors go on',
    ]


@pytest.mark.parametrize('fodder', [Get(1), Hello(1, 1), Set(1, 31.0, 0.0)])
def test_only_a_valid_command_resets_the_watchdog(armed, fodder):
    for _ in range(30):
        armed.ask(fodder)
        armed.wait(0.01)
    assert armed.mode is BoardMode.TIMEOUT


def test_is_not_moved_before_it_is_armed_nor_after(bench):
    assert bench.ask(Set(1, 1.0, 1.0)).mode is BoardMode.IDLE
    assert bench.board.left.target == 0.0
    bench.ask(Arm(1, 200))
    bench.ask(Set(1, 1.0, 1.0))
    assert bench.ask(Disarm(1)).mode is BoardMode.IDLE
    assert bench.ask(Set(1, 1.0, 1.0)).mode is BoardMode.IDLE
    assert bench.board.left.target == 0.0


def test_a_fault_stops_it_until_it_is_disarmed(armed):
    armed.ask(Set(1, 1.0, 1.0))
    armed.board.fail()
    assert armed.ask(Arm(1, 200)).mode is BoardMode.FAULT
    assert armed.ask(Set(1, 1.0, 1.0)).mode is BoardMode.FAULT
    assert armed.board.left.target == 0.0
    assert armed.ask(Disarm(1)).mode is BoardMode.IDLE


@pytest.mark.parametrize(
    'refused', [Arm(1, 19), Arm(1, 5001), Set(1, 30.0001, 0.0), Set(1, 0.0, -30.0001)]
)
def test_what_is_beyond_its_limits_changes_nothing(armed, refused):
    armed.ask(Set(1, 1.0, 2.0))
    assert armed.ask(refused) == Error(Reason.RANGE)
    assert (armed.mode, armed.board.left.target, armed.board.right.target) == (
        BoardMode.ARMED, 1.0, 2.0
    )  # fmt: skip


def test_noise_and_its_own_messages_are_refused(bench):
    assert LineReader().feed(bench.board.receive(b'noise\n')) == [Error(Reason.CHECKSUM)]
    assert bench.ask(Error(Reason.RANGE)) == Error(Reason.MESSAGE)
