# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""BufferCore: its laws, agreement with forward kinematics, and the texts of tf2."""

import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.paths import ROOT

from amr_description.clock import NANOSECONDS
from amr_description.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
)
from amr_description.model.frames import normalize, quaternion_from_yaw, Transform
from amr_description.model.kinematics import joint_transform, link_poses
from amr_description.model.urdf import load
from amr_description.tf2_ros.buffer_core import BufferCore
from amr_description.tf2_ros.time_cache import StampedTransform

coordinates = st.floats(-5.0, 5.0)
quaternions = (
    st.tuples(*[st.floats(-1.0, 1.0)] * 4).filter(lambda q: math.hypot(*q) > 0.1).map(normalize)
)
transforms = st.builds(Transform, st.tuples(*[coordinates] * 3), quaternions)


def at_x(parent, child, x, time=0):
    return StampedTransform(parent, child, time, Transform((x, 0.0, 0.0)))


def buffer_of(*moving, static=()):
    buffer = BufferCore()
    for stamped in moving:
        assert buffer.set_transform(stamped) is None
    for stamped in static:
        assert buffer.set_transform(stamped, static=True) is None
    return buffer


def same(a, b):
    """q and -q are one rotation, so transforms are compared as matrices."""
    np.testing.assert_allclose(a.to_matrix(), b.to_matrix(), atol=1e-9)


@st.composite
def trees(draw):
    """A buffer with a tree of static frames f0, f1 …, and each one's pose in f0."""
    buffer, poses = BufferCore(), [Transform()]
    for child in range(1, draw(st.integers(2, 7))):
        parent, step = draw(st.integers(0, child - 1)), draw(transforms)
        poses.append(poses[parent] @ step)
        stamped = StampedTransform(f'f{parent}', f'f{child}', 0, step)
        buffer.set_transform(stamped, static=True)
    return buffer, poses


frames_of_a_tree = st.tuples(*[st.integers(0, 100)] * 3)


@given(trees(), frames_of_a_tree)
def test_a_lookup_is_the_product_of_the_poses(tree, chosen):
    buffer, poses = tree
    target, source = (number % len(poses) for number in chosen[:2])
    found = buffer.lookup_transform(f'f{target}', f'f{source}')
    same(found.transform, poses[target].inverse() @ poses[source])


@given(trees(), frames_of_a_tree)
def test_lookups_form_a_groupoid(tree, chosen):
    """There and back is nothing; by way of a third is the direct way."""
    buffer, poses = tree
    a, b, c = (f'f{number % len(poses)}' for number in chosen)
    back_and_forth = (
        buffer.lookup_transform(a, b).transform @ buffer.lookup_transform(b, a).transform
    )
    same(back_and_forth, Transform())
    same(
        buffer.lookup_transform(a, b).transform @ buffer.lookup_transform(b, c).transform,
        buffer.lookup_transform(a, c).transform,
    )


@given(trees(), frames_of_a_tree)
def test_a_chain_goes_from_neighbour_to_neighbour(tree, chosen):
    buffer, poses = tree
    target, source = (f'f{number % len(poses)}' for number in chosen[:2])
    chain = buffer.chain(target, source)
    assert (chain[0], chain[-1]) == (target, source)
    assert len(set(chain)) == len(chain)
    parents = {record.name: record.parent for record in buffer.records()}
    for one, other in zip(chain, chain[1:], strict=False):
        assert parents.get(one) == other or parents.get(other) == one


@given(transforms, transforms, st.integers(0, NANOSECONDS))
def test_at_a_time_between_a_chain_is_the_product_of_its_parts(start, end, passed):
    base = [
        StampedTransform('odom', 'base', (1 + i) * NANOSECONDS, t)
        for i, t in enumerate((start, end))
    ]
    arm = [
        StampedTransform('base', 'hand', (1 + i) * NANOSECONDS, t)
        for i, t in enumerate((end, start))
    ]
    buffer = buffer_of(*base, *arm)
    time = NANOSECONDS + passed
    ratio = passed / NANOSECONDS
    whole = buffer.lookup_transform('odom', 'hand', time)
    assert (whole.time, whole.parent, whole.child) == (time, 'odom', 'hand')
    same(whole.transform, start.interpolate(end, ratio) @ end.interpolate(start, ratio))


@pytest.mark.parametrize('path', ['urdf/amr.urdf', 'test/fixtures/urdf/arm.urdf'])
@given(seed=st.floats(-1.0, 1.0))
def test_lookups_agree_with_forward_kinematics(path, seed):
    robot = load(ROOT / path)
    positions = {
        joint.name: seed / (1 + index)
        for index, joint in enumerate(robot.joints)
        if joint.has_position and joint.mimic is None
    }
    poses = link_poses(robot, positions)
    buffer = BufferCore()
    for joint in robot.joints:
        pose = poses[joint.parent].inverse() @ poses[joint.child]
        stamped = StampedTransform(joint.parent, joint.child, NANOSECONDS, pose)
        buffer.set_transform(stamped, static=not joint.has_position)
        if joint.name in positions:
            same(pose, joint_transform(joint, positions[joint.name]))
    root = robot.roots[0].name
    for link in robot.links:
        same(buffer.lookup_transform(root, link.name).transform, poses[link.name])


def test_the_latest_is_the_latest_that_all_on_the_way_know():
    buffer = buffer_of(
        at_x('odom', 'base', 1.0, 1 * NANOSECONDS),
        at_x('odom', 'base', 3.0, 3 * NANOSECONDS),
        at_x('base', 'hand', 0.0, 1 * NANOSECONDS),
        at_x('base', 'hand', 4.0, 2 * NANOSECONDS),
        static=[at_x('hand', 'camera', 0.5)],
    )
    assert buffer.latest_common_time('odom', 'camera') == 2 * NANOSECONDS
    found = buffer.lookup_transform('odom', 'camera')
    assert (found.time, found.transform.translation) == (2 * NANOSECONDS, (6.5, 0.0, 0.0))
    assert buffer.lookup_transform('hand', 'camera').time == 0


def test_what_lies_above_the_meeting_of_the_ways_does_not_matter():
    """The map is late; the laser in the base can be had all the same."""
    buffer = buffer_of(
        at_x('map', 'odom', 1.0, 1 * NANOSECONDS),
        at_x('odom', 'base', 1.0, 9 * NANOSECONDS),
        at_x('base', 'left', 1.0, 9 * NANOSECONDS),
        at_x('base', 'right', -1.0, 9 * NANOSECONDS),
    )
    found = buffer.lookup_transform('left', 'right', 9 * NANOSECONDS)
    assert found.transform.translation == (-2.0, 0.0, 0.0)


def test_the_full_lookup_goes_through_a_frame_that_stands_still():
    """A ball a metre before the robot at 1 s; the robot has turned left by 2 s, on the spot."""
    left = Transform((1.0, 0.0, 0.0), quaternion_from_yaw(math.pi / 2))
    buffer = buffer_of(
        at_x('odom', 'base', 1.0, 1 * NANOSECONDS),
        StampedTransform('odom', 'base', 2 * NANOSECONDS, left),
        static=[at_x('base', 'laser', 0.5)],
    )
    found = buffer.lookup_transform_full('base', 2 * NANOSECONDS, 'laser', 1 * NANOSECONDS, 'odom')
    ball_in_laser = (0.5, 0.0, 0.0)
    assert found.transform.apply(ball_in_laser) == pytest.approx((0.0, -1.0, 0.0), abs=1e-12)
    assert (found.parent, found.child, found.time) == ('base', 'laser', 2 * NANOSECONDS)
    with pytest.raises(LookupException, match='"world" passed to .* argument fixed_frame does'):
        buffer.lookup_transform_full('base', 0, 'laser', 0, 'world')


def test_a_frame_in_itself_is_nowhere_else():
    buffer = buffer_of(at_x('odom', 'base', 1.0, 5))
    assert buffer.lookup_transform('base', 'base') == StampedTransform(
        'base', 'base', 5, Transform()
    )
    assert buffer.lookup_transform('base', 'base', 3).time == 3
    assert buffer.lookup_transform('odom', 'odom').time == 0
    assert buffer.explain_failure('unheard_of', 'unheard_of') == ''


def test_a_thing_that_is_taken_has_a_new_parent_from_then_on():
    buffer = buffer_of(
        at_x('world', 'table', 1.0, 1 * NANOSECONDS),
        at_x('world', 'table', 1.0, 3 * NANOSECONDS),
        at_x('world', 'hand', 9.0, 1 * NANOSECONDS),
        at_x('world', 'hand', 9.0, 3 * NANOSECONDS),
        at_x('table', 'cup', 0.5, 1 * NANOSECONDS),
        at_x('hand', 'cup', 0.0, 3 * NANOSECONDS),
    )
    assert buffer.lookup_transform('world', 'cup', 2 * NANOSECONDS).transform.translation == (
        1.5,
        0.0,
        0.0,
    )
    assert buffer.lookup_transform('world', 'cup').transform.translation == (9.0, 0.0, 0.0)


def test_a_static_transform_replaces_a_moving_one_and_the_other_way_round():
    buffer = buffer_of(at_x('odom', 'base', 1.0, 5))
    buffer.set_transform(at_x('odom', 'base', 2.0), static=True)
    assert buffer.lookup_transform('odom', 'base', 77).transform.translation == (2.0, 0.0, 0.0)
    buffer.set_transform(at_x('odom', 'base', 3.0, 6))
    with pytest.raises(ExtrapolationException, match='at time 0.000000, but only time 0.000000'):
        buffer.lookup_transform('odom', 'base', 77)


def test_clear_drops_moving_and_keeps_static_transforms():
    buffer = buffer_of(at_x('odom', 'base', 1.0, 5), static=[at_x('base', 'laser', 1.0)])
    buffer.clear()
    assert buffer.lookup_transform('base', 'laser').transform.translation == (1.0, 0.0, 0.0)
    assert 'not part of the same tree' in buffer.explain_failure('odom', 'base')
    assert buffer.set_transform(at_x('odom', 'base', 1.0, 1)) is None


def test_a_missing_frame_is_reported_as_by_tf2():
    buffer = buffer_of(static=[at_x('odom', 'base_link', 1.0)])
    with pytest.raises(
        LookupException,
        match='^"base_lnik" passed to lookupTransform argument source_frame does not exist. '
        "Did you mean 'base_link'\\?$",
    ):
        buffer.lookup_transform('odom', 'base_lnik')
    with pytest.raises(
        LookupException, match='"map" passed .* exist. Known are: odom, base_link$'
    ):
        buffer.lookup_transform('map', 'odom')
    assert buffer.explain_failure('map', 'odom') == (
        'Invalid frame ID "map" passed to canTransform argument target_frame - '
        'frame does not exist. Known are: odom, base_link'
    )
    assert BufferCore().explain_failure('a', 'b').endswith('does not exist. Known are: none yet')


@pytest.mark.parametrize(
    ('name', 'said'), [('', 'cannot be empty'), ('/odom', "cannot start with a '/'")]
)
def test_an_invalid_name_is_reported_as_by_tf2(name, said):
    buffer = buffer_of(static=[at_x('/odom', '/base', 1.0)])
    with pytest.raises(
        InvalidArgumentException,
        match=f'^Invalid argument "{name}" passed to lookupTransform argument target_frame - in '
        f'tf2 frame_ids {said}$',
    ):
        buffer.lookup_transform(name, 'base')
    assert buffer.explain_failure('base', name) == (
        f'Invalid frame ID "{name}" passed to canTransform argument source_frame - in tf2 '
        f'frame_ids {said}'
    )


def test_trees_without_a_common_root_are_named():
    buffer = buffer_of(
        at_x('map', 'camera', 1.0, 5),
        *(at_x('odom', f'wheel_{number}', 1.0, 5) for number in range(10)),
    )
    text = (
        "^Could not find a connection between 'odom' and 'camera' because they are not part of "
        'the same tree.Tf has two or more unconnected trees. No common root: the trees are '
        "'map' with camera, and 'odom' with wheel_0, wheel_1, wheel_2, wheel_3, wheel_4, wheel_5, "
        'wheel_6, wheel_7 and 2 more$'
    )
    for time in (0, 5):
        with pytest.raises(ConnectivityException, match=text):
            buffer.lookup_transform('odom', 'camera', time)
    assert buffer.trees()['map'] == ['camera']


def test_the_transform_that_is_late_is_named():
    buffer = buffer_of(
        at_x('map', 'odom', 1.0, 1 * NANOSECONDS),
        at_x('map', 'odom', 1.0, 2 * NANOSECONDS),
        at_x('odom', 'base', 1.0, 1 * NANOSECONDS),
        at_x('odom', 'base', 1.0, 9 * NANOSECONDS),
    )
    said = (
        '^Lookup would require extrapolation into the future.  Requested time 2.500000 but the '
        'latest data is at time 2.000000, when looking up transform from frame \\[{}\\] to frame '
        "\\[{}\\]; it is 'odom' in 'map' that lacks 0.500000 s$"
    )
    for target, source in (('map', 'base'), ('base', 'map')):
        with pytest.raises(ExtrapolationException, match=said.format(source, target)):
            buffer.lookup_transform(target, source, 2 * NANOSECONDS + NANOSECONDS // 2)


@pytest.mark.parametrize('time', [0, NANOSECONDS])
def test_a_loop_is_named_and_does_not_hang(time):
    buffer = buffer_of(
        at_x('b', 'a', 1.0, NANOSECONDS),
        at_x('c', 'b', 1.0, NANOSECONDS),
        at_x('b', 'c', 1.0, NANOSECONDS),
        at_x('map', 'camera', 1.0, NANOSECONDS),
    )
    for target, source in (('a', 'camera'), ('camera', 'a')):
        with pytest.raises(LookupException, match='contains a loop: b is in c is in b$'):
            buffer.lookup_transform(target, source, time)
    assert buffer.trees() == {'b': ['a', 'c'], 'map': ['camera']}


def test_a_refused_transform_is_reported_and_changes_nothing():
    buffer = buffer_of(at_x('odom', 'base', 1.0, 100 * NANOSECONDS))
    for stamped, kind in (
        (at_x('base', '/base', 1.0), 'TF_SELF_TRANSFORM'),
        (at_x('odom', 'base', math.nan), 'TF_NAN_INPUT'),
        (at_x('odom', 'base', 1.0, NANOSECONDS), 'TF_OLD_DATA'),
    ):
        remark = buffer.set_transform(stamped, 'someone')
        assert remark.is_refused
        assert remark.text.startswith(kind)
        assert '"someone"' in remark.text or 'authority someone' in remark.text
    assert [record.samples for record in buffer.records()] == [1]


def test_records_describe_each_frame():
    buffer = BufferCore()
    buffer.set_transform(at_x('odom', 'base', 1.0, 1 * NANOSECONDS), 'wheels')
    buffer.set_transform(at_x('odom', 'base', 1.0, 3 * NANOSECONDS), 'odometry')
    (record,) = buffer.records()
    assert (record.name, record.parent, record.authority) == ('base', 'odom', 'odometry')
    assert (record.samples, record.oldest_time, record.latest_time) == (
        2,
        NANOSECONDS,
        3 * NANOSECONDS,
    )
    assert buffer.names == ['odom', 'base']
