# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which transforms BufferCore accepts, and when it detects two publishers of one frame."""

import math

import pytest

from amr_description.clock import NANOSECONDS
from amr_description.errors import InvalidArgumentException
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.tf2_ros.buffer_core import ParentConflictDetector, validated
from amr_description.tf2_ros.time_cache import StampedTransform

UP = (0.0, 0.0, 0.0, 1.0)


def stamped(parent='odom', child='base', place=(0.0, 0.0, 0.0), turn=UP, time=0):
    return StampedTransform(parent, child, time, Transform(place, turn))


@pytest.mark.parametrize(
    ('fault', 'said'),
    [
        (
            {'child': 'odom'},
            'TF_SELF_TRANSFORM: Ignoring transform from authority "me" with frame_id and  '
            'child_frame_id "odom" because they are the same',
        ),
        ({'child': ''}, 'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "me"'),
        ({'parent': ''}, 'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "base"'),
        ({'place': (0.0, math.nan, 0.0)}, r'TF_NAN_INPUT: .* \(0.000000 nan 0.000000\)'),
        ({'turn': (0.0, 0.0, math.inf, 1.0)}, r'TF_NAN_INPUT: .* \(0.000000 0.000000 inf 1.0000'),
        ({'turn': (0.0,) * 4}, 'TF_DENORMALIZED_QUATERNION: .* because of an invalid quaternion'),
        ({'turn': (1.0, 0.0, 0.0, 1.0)}, 'TF_DENORMALIZED_QUATERNION: .* "base" from .* "me"'),
    ],
)
def test_an_unusable_transform_is_refused_as_by_tf2(fault, said):
    with pytest.raises(InvalidArgumentException, match=said):
        validated(stamped(**fault), 'me')


def test_a_slash_before_a_name_is_dropped():
    taken = validated(stamped('/odom', '/base'), 'me')
    assert (taken.parent, taken.child) == ('odom', 'base')


def test_a_quaternion_of_about_length_one_is_made_so():
    turn = tuple(1.004 * part for part in quaternion_from_yaw(1.0))
    assert math.hypot(*validated(stamped(turn=turn), 'me').transform.rotation) == pytest.approx(
        1.0
    )


def warnings(*sides, step=NANOSECONDS // 10):
    """What is said as (parent, authority, static) follow one another every 0.1 s."""
    watch = ParentConflictDetector(10 * NANOSECONDS)
    said = []
    for index, (parent, authority, static) in enumerate(sides):
        message = stamped(parent, time=index * step)
        said.append(watch.observe(message, authority, static=static))
    return said


ODOM, MAP = ('odom', 'wheels', False), ('map', 'amcl', False)


def test_two_nodes_that_publish_one_frame_by_turns_are_named():
    *before, last = warnings(ODOM, MAP, ODOM, MAP)
    assert before == ['', '', '']
    assert last == (
        'TF_TWO_PARENTS: frame "base" is published as moving in "odom" (from "wheels") and as '
        'moving in "map" (from "amcl"); the last one heard counts. A frame has one parent: one '
        'node may publish it'
    )


def test_one_parent_from_two_nodes_is_a_conflict_too():
    other = ('odom', 'ekf', False)
    assert (
        '(from "wheels") and as moving in "odom" (from "ekf")' in warnings(*[ODOM, other] * 2)[-1]
    )


def test_a_thing_that_is_taken_and_put_down_is_none():
    taken = [('table', 'a', False)] * 5 + [('hand', 'a', False)] * 5 + [('table', 'a', False)] * 5
    assert set(warnings(*taken)) == {''}


def test_turns_that_take_minutes_are_none():
    assert set(warnings(*[ODOM, MAP] * 3, step=60 * NANOSECONDS)) == {''}


@pytest.mark.parametrize(
    ('first', 'second'),
    [
        (('odom', 'a', True), ('map', 'a', True)),
        (('odom', 'a', True), ('odom', 'a', False)),
        (('odom', 'a', False), ('odom', 'a', True)),
    ],
)
def test_a_static_transform_must_not_change_once(first, second):
    said = warnings(first, second, second)
    assert said[0] == said[2] == ''
    assert said[1].startswith('TF_TWO_PARENTS: frame "base" is published as ')
    assert 'static in "odom"' in said[1]


def test_a_static_transform_that_is_sent_again_is_none():
    assert set(warnings(*[('odom', 'a', True)] * 5)) == {''}
