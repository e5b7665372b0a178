# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Free joints, their ranges and zeros, and what follows them; no ROS."""

import math

from hypothesis import given, strategies
import pytest
from support.paths import TESTS

from amr_description.errors import DescriptionError, ParameterError
from amr_description.model.description_file import description_text
from amr_description.model.urdf import parse
from amr_description.nodes.joint_state_publisher.joint_positions import (
    Dependence,
    dependent_joints_of,
    JointOptions,
    JointPositions,
    zeros_of,
)

GRIPPER = TESTS / 'fixtures/urdf/gripper.urdf.xacro'


def robot_of(*joints):
    """A robot whose joints hang on one link, each with a child of its own."""
    body = '<link name="base"/>'
    for name, kind, inside in joints:
        ends = f'<parent link="base"/><child link="{name}_link"/>'
        body += (
            f'<link name="{name}_link"/><joint name="{name}" type="{kind}">{ends}{inside}</joint>'
        )
    return parse(f'<robot name="test">{body}</robot>')


def limits(lower, upper):
    return f'<limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/>'


def mimic(joint, multiplier=1.0, offset=0.0):
    return f'<mimic joint="{joint}" multiplier="{multiplier}" offset="{offset}"/>'


def joints_of(*joints, **options):
    return JointPositions(robot_of(*joints), JointOptions(**options))


def positions(joints):
    sample = joints.sample()
    return dict(zip(sample.names, sample.positions, strict=True))


ARM = [
    ('first', 'revolute', limits(-1, 1)),
    ('second', 'revolute', limits(0.5, 1.5)),
    ('third', 'continuous', ''),
    ('fourth', 'prismatic', limits(-0.3, -0.1)),
]


def test_joints_start_at_zero_or_in_the_middle_of_limits_without_it():
    assert positions(joints_of(*ARM)) == pytest.approx(
        {'first': 0.0, 'second': 1.0, 'third': 0.0, 'fourth': -0.2}
    )
    joints = joints_of(*ARM, zeros={'first': 0.25, 'second': 0.5})
    assert positions(joints)['first'] == 0.25
    assert positions(joints)['second'] == 0.5
    assert joints.warnings == ()


def test_fixed_floating_and_planar_joints_have_no_position():
    joints = joints_of(('a', 'fixed', ''), ('b', 'floating', ''), ('c', 'planar', ''), ARM[0])
    assert joints.names == ('first',)


def test_names_keep_the_order_of_the_description_mimics_among_them():
    joints = JointPositions(parse(description_text(GRIPPER)), JointOptions())
    assert joints.names == ('wrist', 'left_knuckle', 'left_tip', 'right_knuckle', 'right_tip')
    assert list(joints.free) == ['wrist', 'left_knuckle']


def test_the_range_of_a_continuous_joint_is_one_turn():
    third = joints_of(*ARM).free['third']
    assert (third.lower, third.upper, third.is_continuous) == (-math.pi, math.pi, True)


def test_soft_limits_narrow_the_range_if_they_may():
    soft = '<safety_controller soft_lower_limit="0.2" soft_upper_limit="9" k_velocity="1"/>'
    joint = ('joint', 'revolute', limits(-1, 1) + soft)
    free = joints_of(joint).free['joint']
    assert (free.lower, free.upper, free.zero) == (0.2, 1.0, 0.6)
    free = joints_of(joint, use_smallest_joint_limits=False).free['joint']
    assert (free.lower, free.upper, free.zero) == (-1.0, 1.0, 0.0)


def test_soft_limits_without_a_gain_are_refused_as_by_urdfdom():
    soft = '<safety_controller soft_lower_limit="0.2"/>'
    with pytest.raises(DescriptionError, match='joint "a": <safety_controller> has no .*k_veloc'):
        robot_of(('a', 'revolute', limits(-1, 1) + soft))


CHAIN = [
    ('first', 'revolute', limits(-9, 9)),
    ('second', 'revolute', limits(-9, 9) + mimic('first', 2.0, 0.1)),
    ('third', 'revolute', limits(-9, 9) + mimic('second', -1.0, 0.0)),
]


@given(strategies.floats(-5, 5))
def test_mimics_follow_along_the_chain(position):
    joints = joints_of(*CHAIN)
    joints.set(['first'], [position], [position], [3.0])
    sample = joints.sample()
    assert sample.positions == pytest.approx([position, 2 * position + 0.1, -(2 * position + 0.1)])
    assert sample.velocities == pytest.approx([position, 2 * position, -2 * position])
    assert sample.efforts == [3.0, 3.0, 3.0]


def test_mimics_are_free_without_mimic_tags():
    joints = joints_of(*CHAIN, use_mimic_tags=False)
    assert list(joints.free) == ['first', 'second', 'third']
    joints.set(['third'], [1.0])
    assert positions(joints) == {'first': 0.0, 'second': 0.0, 'third': 1.0}


def test_dependent_joints_count_more_than_the_description():
    joints = joints_of(*CHAIN, dependent_joints={'second': Dependence('first', 5.0, 1.0)})
    joints.set(['first'], [0.1])
    assert positions(joints)['second'] == pytest.approx(1.5)
    joints = joints_of(*ARM, dependent_joints={'third': Dependence('first', -1.0)})
    joints.set(['first', 'third'], [0.5, 0.7])
    assert positions(joints)['third'] == -0.5


def test_a_ring_of_mimics_is_refused_with_its_joints():
    ring = [
        ('a', 'continuous', mimic('b')),
        ('b', 'continuous', mimic('a')),
    ]
    words = r"Found an infinite recursive mimic chain: \['a', 'b'\]"
    with pytest.raises(DescriptionError, match=words):
        joints_of(*ring)


@pytest.mark.parametrize('parent', ['nobody', 'bolt', 'a'])
def test_a_mimic_of_what_does_not_move_is_free(parent):
    joints = joints_of(('bolt', 'fixed', ''), ('a', 'continuous', mimic(parent)))
    assert list(joints.free) == ['a']


@pytest.mark.parametrize('parent', ['nobody', 'bolt'])
def test_a_dependence_on_what_does_not_move_is_refused(parent):
    with pytest.raises(DescriptionError, match=f'"a" follows "{parent}", which is no .* "a"'):
        joints_of(
            ('bolt', 'fixed', ''),
            ('a', 'continuous', ''),
            dependent_joints={'a': Dependence(parent)},
        )


def test_sources_move_what_is_free_and_known_and_is_a_number():
    joints = joints_of(*CHAIN, ('last', 'continuous', ''))
    joints.set(['unknown', 'second', 'last', 'first'], [1.0, 2.0, math.nan, 0.5])
    assert positions(joints) == pytest.approx(
        {'first': 0.5, 'second': 1.1, 'third': -1.1, 'last': 0.0}
    )


def test_an_array_is_there_once_something_is_known_for_it():
    joints = joints_of(*ARM, publish_default_positions=False)
    sample = joints.sample()
    assert (sample.positions, sample.velocities, sample.efforts) == ([], [], [])
    joints.set(['third'], [], [2.0])
    assert joints.sample().positions == []
    assert joints.sample().velocities == [0.0, 0.0, 2.0, 0.0]
    joints = joints_of(*ARM, publish_default_velocities=True, publish_default_efforts=True)
    assert joints.sample().velocities == joints.sample().efforts == [0.0] * 4


@given(strategies.floats(1e-3, 7.0), strategies.integers(1, 60))
def test_moving_by_itself_stays_within_the_limits(delta, steps):
    joints = joints_of(*ARM)
    for _ in range(steps):
        joints.advance(delta)
        for name, position in positions(joints).items():
            assert joints.free[name].lower <= position <= joints.free[name].upper


def test_moving_by_itself_turns_round_at_a_limit_and_goes_on_round_the_circle():
    joints = joints_of(ARM[0], ARM[2])
    path = []
    for _ in range(6):
        joints.advance(0.75)
        path.append(positions(joints))
    assert [each['first'] for each in path] == pytest.approx([0.75, 1.0, 0.25, -0.5, -1.0, -0.25])
    assert [each['third'] for each in path] == pytest.approx(
        [0.75, 1.5, 2.25, 3.0, 3.75 - 2 * math.pi, 4.5 - 2 * math.pi]
    )


def test_options_for_joints_that_are_not_there_are_told():
    joints = joints_of(
        *CHAIN,
        zeros={'frist': 1.0, 'second': 1.0, 'first': 10.0},
        dependent_joints={'thrid': Dependence('first')},
    )
    assert joints.warnings == (
        'zeros.frist: the robot has no such joint of its own; these are: "first"',
        'zeros.second: the robot has no such joint of its own; these are: "first"',
        'zeros.first: 10 is not within -9 to 9',
        'dependent_joints.thrid: the robot has no such joint that moves',
    )


def test_parameters_of_single_joints():
    table = {
        'zeros.a.b': 1,
        'zeros.c': 0.5,
        'dependent_joints.d.parent': 'a',
        'dependent_joints.d.factor': -2,
        'dependent_joints.e.f.parent': 'd',
        'dependent_joints.e.f.offset': 0.25,
    }
    assert zeros_of(table) == {'a.b': 1.0, 'c': 0.5}
    assert dependent_joints_of(table) == {
        'd': Dependence('a', -2.0, 0.0),
        'e.f': Dependence('d', 1.0, 0.25),
    }


@pytest.mark.parametrize(
    ('name', 'value', 'words'),
    [
        ('zeros.a', 'x', "'zeros.a' must be a finite number, found 'x'"),
        ('zeros.a', math.nan, 'finite number'),
        ('zeros.a', True, 'finite number'),
        ('dependent_joints.a.factor', 'x', 'finite number'),
        ('dependent_joints.a.factor', 1.0, "dependent_joints.a has no 'parent'"),
        ('dependent_joints.a.parent', 1.0, 'parent, the name of a joint'),
        ('dependent_joints.a.multiplier', 1.0, 'the numbers factor and offset'),
        ('dependent_joints.a', 'b', 'stand parent'),
    ],
)
def test_parameters_of_single_joints_that_make_no_sense_are_refused(name, value, words):
    with pytest.raises(ParameterError, match=words):
        zeros_of({name: value})
        dependent_joints_of({name: value})
