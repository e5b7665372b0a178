# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""TimeCache: order, age, interpolation, and the errors for times outside of it."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.errors import ExtrapolationException
from amr_description.model.frames import quaternion_from_yaw, Transform, yaw_of
from amr_description.tf2_ros.time_cache import seconds, StaticCache, TimeCache, TransformStorage

KEPT = 10 * NANOSECONDS
times = st.integers(1, KEPT)


def at_x(time, x, parent='odom'):
    return TransformStorage(time, parent, Transform((x, 0.0, 0.0)))


def frame_of(samples):
    first, *others = samples
    frame = TimeCache(first, KEPT)
    for sample in others:
        assert frame.insert_data(sample)
    return frame


@given(st.lists(times, min_size=1, max_size=20, unique=True), st.randoms(use_true_random=False))
def test_samples_may_come_in_any_order(stamps, chance):
    samples = [at_x(stamp, float(stamp)) for stamp in stamps]
    shuffled = chance.sample(samples, len(samples))
    frame = frame_of(shuffled)
    assert (frame.oldest_time, frame.latest_time) == (min(stamps), max(stamps))
    assert len(frame) == len(stamps)
    for sample in samples:
        assert frame.get_data(sample.time) == sample


@given(st.lists(times, min_size=2, max_size=6, unique=True), st.floats(0.0, 1.0))
def test_between_two_samples_the_way_is_straight(stamps, ratio):
    """A frame whose x is its time, in s, is there at every time."""
    frame = frame_of([at_x(stamp, stamp / NANOSECONDS) for stamp in stamps])
    time = min(stamps) + round(ratio * (max(stamps) - min(stamps)))
    found = frame.get_data(time)
    assert found.time == time
    assert found.transform.translation[0] == pytest.approx(time / NANOSECONDS, rel=1e-12)


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(0.0, 1.0))
def test_rotations_turn_evenly_on_the_shorter_arc(start, turn, ratio):
    end = start + turn
    frame = frame_of(
        [
            TransformStorage(1, 'odom', Transform(rotation=quaternion_from_yaw(start))),
            TransformStorage(
                1 + NANOSECONDS, 'odom', Transform(rotation=quaternion_from_yaw(end))
            ),
        ]
    )
    moved = 1 + round(ratio * NANOSECONDS)
    expected = start + turn * (moved - 1) / NANOSECONDS
    error = yaw_of(frame.get_data(moved).transform.rotation) - expected
    assert math.remainder(error, math.tau) == pytest.approx(0.0, abs=1e-9)


def test_the_opposite_quaternion_is_the_same_rotation():
    turn = quaternion_from_yaw(1.0)
    opposite = tuple(-part for part in turn)
    frame = frame_of(
        [
            TransformStorage(1, 'odom', Transform(rotation=turn)),
            TransformStorage(3, 'odom', Transform(rotation=opposite)),
        ]
    )
    assert yaw_of(frame.get_data(2).transform.rotation) == pytest.approx(1.0)


def test_latest_is_time_zero():
    frame = frame_of([at_x(5, 5.0), at_x(3, 3.0)])
    assert frame.get_data(0) == frame.latest == at_x(5, 5.0)


def test_a_second_sample_of_one_time_replaces_the_first():
    frame = frame_of([at_x(5, 1.0), at_x(5, 2.0)])
    assert (len(frame), frame.latest) == (1, at_x(5, 2.0))


def test_the_past_is_kept_as_long_as_asked_for():
    frame = frame_of([at_x(time * NANOSECONDS, 0.0) for time in range(1, 30)])
    assert (frame.oldest_time, frame.latest_time) == (19 * NANOSECONDS, 29 * NANOSECONDS)
    assert not frame.insert_data(at_x(19 * NANOSECONDS - 1, 0.0))
    assert frame.insert_data(at_x(19 * NANOSECONDS + 1, 0.0))


def test_between_two_parents_the_frame_is_where_the_earlier_sample_says():
    grasp = frame_of([at_x(10, 1.0, 'table'), at_x(20, 2.0, 'gripper')])
    assert grasp.get_data(19) == at_x(10, 1.0, 'table')
    assert grasp.get_data(20) == at_x(20, 2.0, 'gripper')


@pytest.mark.parametrize(
    ('stamps', 'time', 'said'),
    [
        (
            (2, 4),
            5,
            'Lookup would require extrapolation into the future.  Requested time 5.000000 but '
            'the latest data is at time 4.000000',
        ),
        (
            (2, 4),
            1,
            'Lookup would require extrapolation into the past.  Requested time 1.000000 but '
            'the earliest data is at time 2.000000',
        ),
        (
            (2,),
            3,
            'Lookup would require extrapolation at time 3.000000, but only time 2.000000 is in '
            'the buffer',
        ),
    ],
)
def test_extrapolation_is_an_error_as_in_tf2(stamps, time, said):
    frame = frame_of([at_x(stamp * NANOSECONDS, 0.0) for stamp in stamps])
    with pytest.raises(ExtrapolationException, match=f'^{said}$'):
        frame.get_data(time * NANOSECONDS)
    assert frame.gap_to(time * NANOSECONDS) == NANOSECONDS


def test_time_that_went_back_is_a_new_life():
    frame = frame_of([at_x(100 * NANOSECONDS, 0.0)])
    taken = [frame.insert_data(at_x(time * NANOSECONDS, float(time))) for time in (1, 2, 3, 4)]
    assert taken == [False, False, True, True]
    assert (frame.oldest_time, frame.latest_time) == (NANOSECONDS, 4 * NANOSECONDS)


def test_late_messages_are_no_new_life():
    """Neither when new ones come in between, nor when they are not in order."""
    frame = frame_of([at_x(100 * NANOSECONDS, 0.0)])
    for time in (1, 2, 3, 4):
        assert not frame.insert_data(at_x(time * NANOSECONDS, 0.0))
        assert frame.insert_data(at_x((100 + time) * NANOSECONDS, 0.0))
    for time in (4, 3, 2, 1):
        assert not frame.insert_data(at_x(time * NANOSECONDS, 0.0))
    assert frame.latest_time == 104 * NANOSECONDS


def test_a_static_frame_is_there_at_all_times():
    frame = StaticCache(at_x(7, 1.0))
    assert all(frame.get_data(time) == at_x(7, 1.0) for time in (-5, 0, 7, 10**18))
    assert (frame.latest_time, frame.oldest_time, len(frame)) == (0, 0, 1)


@pytest.mark.parametrize(
    ('time', 'text'),
    [
        (0, '0.000000'),
        (1, '0.000000'),
        (1_630_223_704_616_726_499, '1630223704.616726'),
        (999_999_999, '1.000000'),
        (-1_500_000_000, '-1.500000'),
    ],
)
def test_times_are_written_as_tf2_does(time, text):
    assert seconds(time) == text


def test_the_memory_does_not_grow_for_ever():
    """The oldest goes as the newest comes: a day at 100 Hz is still 10 s of memory."""
    frame = TimeCache(at_x(0, 0.0), KEPT)
    for tick in range(1, 3000):
        frame.insert_data(at_x(tick * NANOSECONDS // 100, 0.0))
        assert len(frame) <= 1001
