# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One page at a time drives a robot, and only while it keeps sending commands."""

from hypothesis import given, strategies as st

from amr_description.viewer.drive_lock import DRIVE_TIMEOUT, DriveLock


def test_the_first_client_acquires_the_lock_and_keeps_it():
    lock = DriveLock(0.4)
    assert lock.acquire('/', 'a', 0.0)
    assert not lock.acquire('/', 'b', 0.1)
    assert lock.acquire('/', 'a', 0.3)
    assert lock.holder('/') == 'a'
    assert lock.next_expiry() == 0.7


def test_each_robot_has_its_own_lock():
    lock = DriveLock(0.4)
    assert lock.acquire('/r1', 'a', 0.0)
    assert lock.acquire('/r2', 'b', 0.0)
    assert (lock.holder('/r1'), lock.holder('/r2')) == ('a', 'b')


def test_a_lock_that_is_not_extended_expires_once():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 1.0)
    assert lock.expire(1.39) == []
    assert lock.expire(1.4) == ['/']
    assert lock.expire(1.5) == []
    assert lock.holder('/') is None
    assert lock.next_expiry() is None


def test_an_expired_lock_can_be_acquired_before_expire_is_called():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    assert lock.acquire('/', 'b', 0.4)
    assert lock.holder('/') == 'b'


def test_release_all_releases_every_lock_of_a_client():
    lock = DriveLock(0.4)
    for robot, client in (('/r1', 'a'), ('/r2', 'b'), ('/r3', 'a')):
        lock.acquire(robot, client, 0.0)
    assert lock.release_all('a') == ['/r1', '/r3']
    assert lock.robots() == ['/r2']
    assert lock.release_all('a') == []


def test_every_client_may_stop_a_robot():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    assert lock.stop('/', 'b', 0.1) == 'a'
    assert lock.stop('/', 'b', 0.1) is None
    assert lock.holder('/') is None
    assert lock.acquire('/', 'b', 0.1)


def test_a_client_stopped_by_another_must_let_go_first():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    lock.stop('/', 'b', 0.1)
    assert not lock.acquire('/', 'a', 0.13)  # a key that is still held
    assert not lock.acquire('/', 'a', 0.5)  # all the time
    assert lock.acquire('/', 'a', 0.9)  # and pressed again


def test_a_client_stopped_by_another_lets_go_by_a_stop():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    lock.stop('/', 'b', 0.1)
    lock.stop('/', 'a', 0.2)
    assert lock.acquire('/', 'a', 0.2)


def test_a_client_whose_lock_has_expired_must_let_go_first_too():
    """Its page was late, and says again that a key is held only after another's stop."""
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    lock.expire(0.45)
    assert lock.stop('/', 'b', 0.5) == 'a'
    assert not lock.acquire('/', 'a', 0.6)
    assert not lock.acquire('/', 'a', 0.9)
    assert lock.acquire('/', 'a', 1.3)


def test_a_client_that_has_let_go_is_not_stopped():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    lock.stop('/', 'a', 0.1)
    assert lock.stop('/', 'b', 0.2) is None
    lock.acquire('/', 'a', 0.3)
    lock.release_all('a')
    assert lock.stop('/', 'b', 0.4) is None


def test_a_client_that_stops_may_drive_at_once():
    lock = DriveLock(0.4)
    lock.acquire('/', 'a', 0.0)
    assert lock.stop('/', 'a', 0.1) is None
    assert lock.acquire('/', 'a', 0.1)


EVENTS = st.lists(
    st.tuples(
        st.floats(0.0, 1.0), st.sampled_from('ab'), st.sampled_from(['drive', 'look', 'leave'])
    )
)


@given(EVENTS)
def test_every_lock_is_released_within_the_timeout(events):
    lock, now, last = DriveLock(), 0.0, None
    for elapsed, client, event in events:
        now += elapsed
        stopped = lock.expire(now)
        assert bool(stopped) == (last is not None and now >= last + DRIVE_TIMEOUT)
        last = None if stopped else last
        if event == 'drive' and lock.acquire('/', client, now):
            last = now
        elif event == 'leave' and lock.release_all(client):
            last = None
        assert (lock.holder('/') is None) == (last is None)
