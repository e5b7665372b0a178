# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""STOP: which robots are held, by whom, and whether they stand still."""

import pytest

from amr_description.viewer.stop_latch import Press, StandstillJudge, StopLatch


def test_a_stop_of_all_holds_robots_that_are_not_there_yet():
    latch = StopLatch()
    assert (bool(latch), latch.of('/r1')) == (False, None)
    latch.press(None, 'page 1', 5.0)
    assert latch.of('/r1') == latch.of('/later') == Press('page 1', 5.0)
    assert latch


def test_a_stop_of_one_holds_no_other():
    latch = StopLatch()
    latch.press('/r1', 'page 1', 5.0)
    assert (latch.of('/r1'), latch.of('/r2')) == (Press('page 1', 5.0), None)
    assert latch.everywhere is None


def test_it_stays_that_of_who_pressed_first():
    latch = StopLatch()
    latch.press(None, 'page 1', 5.0)
    latch.press(None, 'page 2', 6.0)
    latch.press('/r1', 'page 2', 6.0)
    assert latch.of('/r1') == latch.everywhere == Press('page 1', 5.0)


def test_one_robot_can_be_released_from_a_stop_of_all_and_stopped_again():
    latch = StopLatch()
    latch.press(None, 'page 1', 5.0)
    latch.release('/r1')
    assert (latch.of('/r1'), latch.of('/r2')) == (None, Press('page 1', 5.0))
    latch.press('/r1', 'page 2', 6.0)
    assert latch.of('/r1') == Press('page 2', 6.0)
    latch.release('/r1')
    latch.press(None, 'page 3', 7.0)
    assert latch.of('/r1') == Press('page 1', 5.0)


@pytest.mark.parametrize('robots', [[None], ['/r1'], [None, '/r1'], ['/r1', '/r2', None]])
def test_a_release_of_all_leaves_nothing(robots):
    latch = StopLatch()
    for robot in robots:
        latch.press(robot, 'page 1', 5.0)
    latch.release(None)
    assert not latch
    assert latch.of('/r1') is latch.everywhere is None


def judged(motions, *, period=0.05, is_locked=False):
    """The states of a robot that moves so, from the press on; None: it is not measured."""
    judge = StandstillJudge(10.0)
    states = []
    for count, motion in enumerate(motions):
        time = 10.0 + count * period
        judge.add(time, motion)
        states.append(judge.state(time, is_locked=is_locked))
    return states


def test_a_robot_brakes_and_then_stands():
    states = judged([max(30.0 - count, 0.2) for count in range(60)])
    assert states[0] == states[30] == 'braking'
    assert set(states[-15:]) == {'holds'}
    assert 'moves' not in states and 'unknown' not in states


def test_one_that_somebody_drives_on_moves():
    states = judged([30.0] * 60)
    assert set(states[:19]) == {'braking'}
    assert set(states[25:]) == {'moves'}


def test_one_that_is_driven_at_times_does_not_hold():
    """A command of a stranger is in force for one cycle, and the next zero ends it."""
    states = judged(([0.0] * 4 + [3.0]) * 20)
    assert set(states[25:]) == {'moves'}


def test_one_that_is_pushed_after_it_stood_moves():
    states = judged([0.0] * 40 + [5.0] * 40)
    assert states[39] == 'holds'
    assert states[-1] == 'moves'


@pytest.mark.parametrize(('is_locked', 'state'), [(True, 'holds'), (False, 'unknown')])
def test_what_nothing_measures_is_believed_of_its_lock(is_locked, state):
    """Time is paused, or the robot has no odometry."""
    assert judged([None] * 3, is_locked=is_locked) == [state] * 3
    assert judged([30.0] * 40 + [None] * 20, is_locked=is_locked)[-1] == state


def test_a_lock_is_not_believed_against_what_is_measured():
    assert judged([30.0] * 60, is_locked=True)[-1] == 'moves'
