# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who drives: one page at a time, and never longer than it says so."""

from hypothesis import given, strategies as st

from amr_description.viewer.drive_lock import DRIVE_TIMEOUT, DriveLock


def test_the_first_takes_the_wheel_and_keeps_it():
    driving = DriveLock(0.4)
    assert driving.drive('/', 'a', 0.0)
    assert not driving.drive('/', 'b', 0.1)
    assert driving.drive('/', 'a', 0.3)
    assert driving.driver('/') == 'a'
    assert driving.next_expiry() == 0.7


def test_another_robot_is_another_wheel():
    driving = DriveLock(0.4)
    assert driving.drive('/r1', 'a', 0.0)
    assert driving.drive('/r2', 'b', 0.0)
    assert (driving.driver('/r1'), driving.driver('/r2')) == ('a', 'b')


def test_who_is_silent_loses_the_wheel_once():
    driving = DriveLock(0.4)
    driving.drive('/', 'a', 1.0)
    assert driving.expire(1.39) == []
    assert driving.expire(1.4) == ['/']
    assert driving.expire(1.5) == []
    assert driving.driver('/') is None
    assert driving.next_expiry() is None


def test_whose_time_is_over_can_be_relieved_before_anybody_has_looked():
    driving = DriveLock(0.4)
    driving.drive('/', 'a', 0.0)
    assert driving.drive('/', 'b', 0.4)
    assert driving.driver('/') == 'b'


def test_who_leaves_gives_all_wheels_back():
    driving = DriveLock(0.4)
    for robot, client in (('/r1', 'a'), ('/r2', 'b'), ('/r3', 'a')):
        driving.drive(robot, client, 0.0)
    assert driving.leave('a') == ['/r1', '/r3']
    assert driving.robots() == ['/r2']
    assert driving.leave('a') == []


def test_everybody_may_stop():
    driving = DriveLock(0.4)
    driving.drive('/', 'a', 0.0)
    assert driving.stop('/', 'b', 0.1) == 'a'
    assert driving.stop('/', 'b', 0.1) is None
    assert driving.driver('/') is None
    assert driving.drive('/', 'b', 0.1)


def test_who_was_stopped_by_another_must_let_go_first():
    driving = DriveLock(0.4)
    driving.drive('/', 'a', 0.0)
    driving.stop('/', 'b', 0.1)
    assert not driving.drive('/', 'a', 0.13)  # a key that is still held
    assert not driving.drive('/', 'a', 0.5)  # all the time
    assert driving.drive('/', 'a', 0.9)  # and pressed again


def test_who_was_stopped_by_another_and_stops_has_let_go():
    driving = DriveLock(0.4)
    driving.drive('/', 'a', 0.0)
    driving.stop('/', 'b', 0.1)
    driving.stop('/', 'a', 0.2)
    assert driving.drive('/', 'a', 0.2)


def test_who_stops_may_drive_at_once():
    driving = DriveLock(0.4)
    driving.drive('/', 'a', 0.0)
    assert driving.stop('/', 'a', 0.1) is None
    assert driving.drive('/', 'a', 0.1)


EVENTS = st.lists(
    st.tuples(
        st.floats(0.0, 1.0), st.sampled_from('ab'), st.sampled_from(['drive', 'look', 'leave'])
    )
)


@given(EVENTS)
def test_every_drive_is_ended_by_a_stop_within_the_time(events):
    driving, now, last = DriveLock(), 0.0, None
    for elapsed, client, event in events:
        now += elapsed
        stopped = driving.expire(now)
        assert bool(stopped) == (last is not None and now >= last + DRIVE_TIMEOUT)
        last = None if stopped else last
        if event == 'drive' and driving.drive('/', client, now):
            last = now
        elif event == 'leave' and driving.leave(client):
            last = None
        assert (driving.driver('/') is None) == (last is None)
