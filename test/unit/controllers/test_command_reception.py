# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which command is in force, by its stamp, its age and its clock."""

import math

import pytest
from support.control_fakes import FakeLog, MS

from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.command_reception import CommandReception, FOREIGN_CLOCK
from amr_description.log import Severity

TIMEOUT = 500 * MS
T0 = 1_000_000 * MS


class Listener:
    def __init__(self, timeout=TIMEOUT):
        self.log = FakeLog()
        self.reception = CommandReception(timeout, self.log)
        self.reception.forget(T0)

    def receive(self, *twists, stamp, now):
        self.reception.receive([TwistSample(stamp, *twist) for twist in twists], now)

    def at(self, time):
        return self.reception.in_force(time)


@pytest.fixture
def listener():
    return Listener()


def test_before_the_first_command_nothing_is_in_force_until_the_time_out(listener):
    assert listener.at(T0) is None
    assert listener.at(T0 + TIMEOUT) is None
    assert listener.at(T0 + TIMEOUT + 1) == (0.0, 0.0)


def test_a_command_holds_up_to_its_time_out_and_not_a_nanosecond_longer(listener):
    listener.receive((0.5, 0.2), stamp=T0 + 7, now=T0 + 7)
    assert listener.at(T0 + 7 + TIMEOUT) == (0.5, 0.2)
    assert listener.at(T0 + 8 + TIMEOUT) == (0.0, 0.0)


def test_the_age_counts_from_the_stamp_not_from_the_arrival(listener):
    listener.receive((0.5, 0.0), stamp=T0, now=T0 + 400 * MS)
    assert listener.at(T0 + 401 * MS) == (0.5, 0.0)
    assert listener.at(T0 + 501 * MS) == (0.0, 0.0)


def test_the_newest_of_several_counts(listener):
    listener.receive((0.1, 0.0), (0.2, 0.0), (0.3, 0.0), stamp=T0, now=T0)
    assert listener.at(T0) == (0.3, 0.0)


@pytest.mark.parametrize('age', [TIMEOUT, TIMEOUT + 1, 40 * TIMEOUT])
def test_a_command_too_old_on_arrival_is_dropped_and_the_old_one_stays(listener, age):
    listener.receive((0.5, 0.0), stamp=T0 + 1, now=T0 + 1)
    listener.receive((9.0, 0.0), stamp=T0 + 1 - age, now=T0 + 1)
    assert listener.at(T0 + 2) == (0.5, 0.0)
    assert any('Ignoring the received message' in text for text in listener.log.texts())


def test_the_refusal_shows_stamp_age_and_limit(listener):
    listener.receive((9.0, 0.0), stamp=T0, now=T0 + 750 * MS)
    assert listener.log.lines == [
        (
            Severity.WARN,
            'Ignoring the received message (timestamp 1000.0000000000) because it is older than '
            'the current time by 0.7500000000 seconds, which exceeds the allowed timeout (0.5000)',
        )
    ]


def test_a_zero_stamp_means_now_and_is_warned_of(listener):
    listener.receive((0.5, 0.0), stamp=0, now=T0 + 10 * MS)
    assert listener.at(T0 + 510 * MS) == (0.5, 0.0)
    assert listener.at(T0 + 510 * MS + 1) == (0.0, 0.0)
    assert 'zero timestamp' in listener.log.texts(Severity.WARN)[0]


def test_a_stamp_slightly_ahead_keeps_the_command_in_force_for_longer(listener):
    listener.receive((0.5, 0.0), stamp=T0 + FOREIGN_CLOCK, now=T0)
    assert listener.at(T0 + FOREIGN_CLOCK + TIMEOUT) == (0.5, 0.0)
    assert listener.log.lines == []


def test_a_stamp_of_another_clock_counts_as_now_so_that_the_time_out_still_brakes(listener):
    listener.receive((0.5, 0.0), stamp=1_700_000_000_000 * MS, now=T0)
    assert listener.at(T0 + TIMEOUT) == (0.5, 0.0)
    assert listener.at(T0 + TIMEOUT + 1) == (0.0, 0.0)
    text = listener.log.texts(Severity.WARN)[0]
    assert 'stamped 1700000000.000, but the time here is 1000.000' in text
    assert 'another clock (use_sim_time?)' in text


@pytest.mark.parametrize('twist', [(math.nan, 0.1), (0.1, math.nan), (math.inf, 0.0)])
def test_a_command_of_nan_changes_nothing_but_ages(listener, twist):
    listener.receive(twist, stamp=T0, now=T0)
    assert listener.at(T0) is None
    assert listener.at(T0 + TIMEOUT) is None
    assert listener.at(T0 + TIMEOUT + 1) == (0.0, 0.0)
    assert 'contains NaNs' in listener.log.texts(Severity.WARN)[0]


@pytest.mark.parametrize('twist', [(1e308, 0.0), (0.0, -1e308), (-1.1e12, 0.0)])
def test_a_command_beyond_all_robots_is_ignored_and_the_one_before_stays(listener, twist):
    """It would lose the positions of wheels: the next odometry raised, and that was the end."""
    listener.receive((0.5, 0.0), stamp=T0, now=T0)
    listener.receive(twist, stamp=T0 + MS, now=T0 + MS)
    assert listener.at(T0 + MS) == (0.5, 0.0)
    assert listener.at(T0 + TIMEOUT + 1) == (0.0, 0.0)
    (line,) = [each for each in listener.log.texts(Severity.WARN) if 'over' in each]
    assert line == 'A command of over 1e+12 m/s or rad/s is ignored, as no robot drives so'


def test_braking_is_logged_once_and_only_after_motion(listener):
    def braked():
        return listener.log.texts().count('Velocity command timed out. Braking.')

    listener.at(T0 + 2 * TIMEOUT)
    assert braked() == 0
    now = T0 + 2 * TIMEOUT
    listener.receive((0.5, 0.0), stamp=now, now=now)
    for time in range(now, now + 4 * TIMEOUT, 10 * MS):
        listener.at(time)
    assert braked() == 1
    now += 4 * TIMEOUT
    listener.receive((0.0, 0.0), stamp=now, now=now)
    listener.at(now)
    listener.at(now + 2 * TIMEOUT)
    assert braked() == 1


def test_without_a_time_out_commands_never_age():
    listener = Listener(timeout=0)
    assert listener.at(T0 + 1000 * TIMEOUT) is None
    listener.receive((0.5, 0.0), stamp=T0, now=T0 + 20 * TIMEOUT)
    assert listener.at(T0 + 1000 * TIMEOUT) == (0.5, 0.0)


def test_a_dropped_command_does_not_come_back(listener):
    listener.receive((0.5, 0.0), stamp=T0, now=T0)
    listener.reception.forget(T0 + 1)
    assert listener.at(T0 + 2) is None


# --- time going back -----------------------------------------------------------------------------


def drive_until(listener, end):
    for time in range(T0, end, 10 * MS):
        listener.receive((0.5, 0.0), stamp=time, now=time)
        assert listener.at(time + 10 * MS) == (0.5, 0.0)


@pytest.mark.parametrize('age', [0, 10 * MS, 900 * MS])
def test_a_command_of_before_a_reset_does_not_drive_until_its_time_comes_again(listener, age):
    before = T0 + 30_000 * MS
    drive_until(listener, before)
    listener.reception.forget(0)
    listener.receive((0.5, 0.0), stamp=before - age, now=-10 * MS)
    assert listener.at(0) is None
    assert listener.at(TIMEOUT + 1) == (0.0, 0.0)


def test_commands_after_a_reset_count_at_once(listener):
    drive_until(listener, T0 + 1000 * MS)
    listener.reception.forget(T0)
    for time in range(T0, T0 + 3000 * MS, 10 * MS):
        listener.receive((time / T0, 0.0), stamp=time, now=time - 10 * MS)
        assert listener.at(time) == (time / T0, 0.0)
