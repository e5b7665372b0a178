# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Joint positions to transforms, and the thinning of messages; no ROS."""

import io
import itertools
import math
import random

from hypothesis import given, strategies as st
import pytest
from support.paths import ROOT
import yourdfpy

from amr_description.model.description_file import description_text
from amr_description.model.frames import Transform
from amr_description.model.urdf import load, parse
from amr_description.nodes.robot_state_publisher.robot_state import (
    Arrivals,
    JointThrottle,
    period_of,
    RobotState,
)

FIXTURES = ROOT / 'test/fixtures/urdf'
ROBOTS = [ROOT / 'urdf/amr.urdf', FIXTURES / 'arm.urdf', FIXTURES / 'gripper.urdf.xacro']
MILLISECOND = 1_000_000
# The gripper's mimic of a mimic, which yourdfpy does not know, and what it amounts to.
CHAIN_AND_LINK = (
    '<mimic joint="right_knuckle" multiplier="0.01" offset="0.001"/>',
    '<mimic joint="left_knuckle" multiplier="-0.01" offset="0.0015"/>',
)


def robot_of(*joints):
    """Return the state of a robot with links a to f and these joints."""
    links = ''.join(f'<link name="{name}"/>' for name in 'abcdef')
    return RobotState(parse(f'<robot name="test">{links}{"".join(joints)}</robot>'))


def joint(name, parent, child, kind='continuous', inside='<axis xyz="0 0 1"/>'):
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'


def mimic(source, multiplier, offset):
    return f'<mimic joint="{source}" multiplier="{multiplier}" offset="{offset}"/>'


REST = [joint(f'j_{child}', 'a', child, 'fixed') for child in 'ef']


def angles(transforms):
    """Return child -> angle about z (rad)."""
    return {
        link.child: 2 * math.atan2(link.transform.rotation[2], link.transform.rotation[3])
        for link in transforms
    }


def poses(transforms, root):
    """Chain transforms up to the root, as a TF listener does; link -> 4x4 matrix."""
    found = {root: Transform()}
    waiting = list(transforms)
    while waiting:
        link = waiting.pop(0)
        if link.parent in found:
            found[link.child] = found[link.parent] @ link.transform
        else:
            waiting.append(link)
    return {name: pose.to_matrix() for name, pose in found.items()}


@pytest.mark.parametrize('path', ROBOTS, ids=lambda path: path.stem)
def test_the_chained_transforms_are_the_forward_kinematics_of_yourdfpy(path):
    robot = parse(description_text(path))
    state = RobotState(robot)
    assert (CHAIN_AND_LINK[0] in robot.text) == (robot.name == 'gripper')
    stream = io.BytesIO(robot.text.replace(*CHAIN_AND_LINK).encode())
    other = yourdfpy.URDF.load(stream, load_meshes=False, build_scene_graph=True)
    chance = random.Random(4)
    for _ in range(30):
        positions = {name: chance.uniform(-2, 2) for name in other.actuated_joint_names}
        other.update_cfg(positions)
        found = poses([*state.static, *state.moving(positions)], robot.root.name)
        assert set(found) == {link.name for link in robot.links}
        for link, matrix in found.items():
            expected = other.get_transform(link, robot.root.name)
            assert [list(row) for row in matrix] == [
                pytest.approx(list(row), abs=1e-9) for row in expected
            ]


def test_transforms_are_sorted_by_joint_and_each_link_is_told_once():
    state = RobotState(load(ROBOTS[0]))
    places = ('front_right', 'back_left', 'front_left', 'back_right')
    wheels = [f'joint_wheel_{place}' for place in places]
    moving = state.moving(dict.fromkeys(wheels, 0.0))
    assert [link.child for link in moving] == [
        'wheel_back_left', 'wheel_back_right', 'wheel_front_left', 'wheel_front_right',
    ]  # fmt: skip
    assert [(link.parent, link.child) for link in state.static] == [
        ('base_footprint', 'base_link')
    ]


def test_only_the_joints_of_the_message_are_told():
    state = robot_of(joint('one', 'a', 'b'), joint('two', 'a', 'c'), *REST, joint('d', 'a', 'd'))
    assert set(angles(state.moving({'two': 1.0, 'unknown': 1.0}))) == {'c'}
    assert state.moving({'unknown': 1.0}) == []
    assert state.moving({}) == []


def test_positions_that_are_no_numbers_are_left_out():
    state = robot_of(joint('one', 'a', 'b'), joint('two', 'a', 'c'), *REST, joint('d', 'a', 'd'))
    positions = {'one': math.nan, 'two': 0.5, 'd': math.inf}
    assert angles(state.moving(positions)) == {'c': pytest.approx(0.5)}


def test_a_mimic_joint_follows_unless_the_message_carries_it():
    state = robot_of(
        joint('source', 'a', 'b'),
        joint('follower', 'a', 'c', inside='<axis xyz="0 0 1"/>' + mimic('source', -2.0, 0.1)),
        joint('d', 'a', 'd'),
        *REST,
    )
    assert angles(state.moving({'source': 0.3})) == {
        'b': pytest.approx(0.3),
        'c': pytest.approx(-0.5),
    }
    assert angles(state.moving({'source': 0.3, 'follower': 0.2}))['c'] == pytest.approx(0.2)
    assert set(angles(state.moving({'d': 0.3}))) == {'d'}


@pytest.mark.parametrize('names', [('x', 'y'), ('y', 'x')])
def test_mimics_follow_mimics_whatever_their_order(names):
    first, second = names
    axis = '<axis xyz="0 0 1"/>'
    state = robot_of(
        joint('source', 'a', 'b'),
        joint(second, 'a', 'd', inside=axis + mimic(first, 3.0, 0.0)),
        joint(first, 'a', 'c', inside=axis + mimic('source', 2.0, 0.0)),
        *REST,
    )
    assert angles(state.moving({'source': 0.1})) == {
        'b': pytest.approx(0.1),
        'c': pytest.approx(0.2),
        'd': pytest.approx(0.6),
    }


def test_a_ring_of_mimics_ends():
    axis = '<axis xyz="0 0 1"/>'
    state = robot_of(
        joint('x', 'a', 'b', inside=axis + mimic('y', 1.0, 0.0)),
        joint('y', 'a', 'c', inside=axis + mimic('x', 1.0, 0.0)),
        joint('d', 'a', 'd'),
        *REST,
    )
    assert state.moving({'d': 0.0})
    assert set(angles(state.moving({'x': 0.2}))) == {'b', 'c'}


def test_moving_leaves_its_argument_alone():
    axis = '<axis xyz="0 0 1"/>'
    state = robot_of(
        joint('x', 'a', 'b'),
        joint('y', 'a', 'c', inside=axis + mimic('x', 1.0, 0.0)),
        joint('d', 'a', 'd'),
        *REST,
    )
    positions = {'x': 0.2}
    state.moving(positions)
    assert positions == {'x': 0.2}


def test_planar_joints_stay_at_their_origin_and_floating_ones_are_left_out():
    origin = '<origin xyz="1 2 3"/>'
    state = robot_of(
        joint('plane', 'a', 'b', 'planar', origin),
        joint('free', 'a', 'c', 'floating', origin),
        joint('d', 'a', 'd', 'fixed', ''),
        *REST,
    )
    told = {link.child: link.transform.translation for link in state.static}
    assert told['b'] == (1.0, 2.0, 3.0)
    assert set(told) == {'b', 'd', 'e', 'f'}
    assert state.moving({'plane': 1.0, 'free': 1.0}) == []
    assert state.warnings == ("Converting unknown joint type of joint 'plane' into a fixed joint",)


def test_a_root_with_inertia_is_told():
    inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    text = f'<link name="a"><inertial><mass value="1"/>{inertia}</inertial></link>'
    state = RobotState(parse(f'<robot name="test">{text}</robot>'))
    (warning,) = state.warnings
    assert warning.startswith('The root link a has an inertia specified in the URDF, but KDL')


def test_xacro_that_nobody_has_expanded_is_told():
    text = '<robot name="test"><link name="a"/><xacro:wheel xmlns:xacro="x"/></robot>'
    (warning,) = RobotState(parse(text)).warnings
    assert 'holds <xacro:…> elements, which are left out' in warning
    assert RobotState(parse(description_text(ROBOTS[2]))).warnings == ()
    comment = text.replace('<xacro', '<!-- <xacro').replace('/></robot>', '/> --></robot>')
    assert RobotState(parse(comment)).warnings == ()


@pytest.mark.parametrize(
    ('frequency', 'period'),
    [(20.0, 50_000_000), (30.0, 33_333_333), (1000.0, 1_000_000), (0.0, 0), (0.4, 2_500_000_000)],
)
def test_the_period_of_a_frequency(frequency, period):
    assert period_of(frequency) == period


def published(stamps, period=50 * MILLISECOND, names=('wheel',)):
    """Return the stamps (ns) that are published when messages with these stamps come in."""
    throttle = JointThrottle()
    let_pass = []
    for stamp in stamps:
        if throttle.admit(names, stamp):
            throttle.note(names, stamp, period)
            let_pass.append(stamp)
    return let_pass


@pytest.mark.parametrize(
    ('stamps', 'expected'),
    [
        (range(0, 300, 10), [0, 50, 100, 150, 200, 250]),
        (range(0, 310, 30), [0, 60, 120, 150, 210, 270, 300]),
        ([1000, 1000, 1000], [1000]),
        ([7], [7]),
        ([100, 99, 50, 149, 150], [100, 150]),
        ([90_000, 3_000, 3_010, 3_050], [90_000, 3_000, 3_050]),
        ([0, 10_000, 10_010, 10_040, 10_050, 10_090], [0, 10_000, 10_050]),
    ],
    ids=['100 Hz', '33 Hz', 'one stamp', 'the very first', 'out of order', 'anew', 'a gap'],
)
def test_messages_are_thinned_out_by_their_stamps(stamps, expected):
    found = published([stamp * MILLISECOND for stamp in stamps])
    assert [stamp // MILLISECOND for stamp in found] == expected


@pytest.mark.parametrize('frequency', [7.0, 20.0, 30.0, 50.0, 300.0, 999.0, 1000.0])
def test_one_kilohertz_is_published_at_the_configured_rate_and_none_is_lost(frequency):
    stamps = range(0, 10_000 * MILLISECOND, MILLISECOND)
    found = published(stamps, period_of(frequency))
    assert len(found) == pytest.approx(10 * frequency, abs=1)
    if frequency == 1000.0:
        assert found == list(stamps)


@given(
    period=st.integers(1, 10**9),
    share=st.floats(0.01, 1.0),
    jitter=st.floats(0.0, 0.25),
    seed=st.integers(0, 2**32),
)
def test_the_rate_is_kept_on_average_and_no_two_are_too_close(period, share, jitter, seed):
    chance = random.Random(seed)
    step = share * period
    stamps = [round((i + jitter * chance.uniform(-1, 1)) * step) for i in range(400)]
    found = published(stamps, period)
    turns = (stamps[-1] - stamps[0]) / period
    assert turns - 4 <= len(found) <= turns + 4
    assert all(b - a >= period // 2 for a, b in itertools.pairwise(found))


def test_period_zero_lets_every_message_pass_that_is_not_older():
    assert published([0, 1, 1, 2], period=0) == [0, 1, 1, 2]


def test_two_sources_do_not_starve_one_another():
    throttle = JointThrottle()
    passed = {'wheels': 0, 'arm': 0}
    for stamp in range(0, 1000, 10):
        for source in passed:
            if throttle.admit([source], stamp):
                throttle.note([source], stamp, 50)
                passed[source] += 1
    assert passed == {'wheels': 20, 'arm': 20}


def test_a_message_is_due_when_one_of_its_joints_is():
    throttle = JointThrottle()
    throttle.note(['wheel'], 100, 50)
    assert not throttle.admit(['wheel'], 149)
    assert throttle.admit(['wheel', 'unknown'], 149)


def test_a_joint_that_is_published_early_with_another_waits_for_a_whole_period():
    throttle = JointThrottle()
    throttle.note(['wheel'], 100, 50)
    throttle.note(['wheel', 'unknown'], 120, 50)
    assert not throttle.admit(['wheel'], 169)
    assert throttle.admit(['wheel'], 170)


def test_after_forgetting_everything_is_due():
    throttle = JointThrottle()
    throttle.note(['wheel'], 1000, 50)
    assert not throttle.admit(['wheel'], 10)
    throttle.forget()
    assert throttle.admit(['wheel'], 10)


def test_the_earliest_stamp_that_can_be_due_is_known():
    throttle = JointThrottle()
    assert throttle.earliest is None
    for stamp in range(0, 1000, 10):
        if throttle.admit(['wheel', 'arm'], stamp):
            throttle.note(['wheel', 'arm'], stamp, 50)
            continue
        assert stamp < throttle.earliest
    assert throttle.earliest == 1000
    throttle.forget()
    assert throttle.earliest is None


def test_a_joint_that_is_no_longer_published_is_not_waited_for():
    throttle = JointThrottle()
    throttle.note(['arm'], 0, 50 * MILLISECOND)
    throttle.note(['wheel'], 100 * MILLISECOND, 50 * MILLISECOND)
    assert throttle.earliest == 50 * MILLISECOND  # the arm has long been due
    throttle.note(['wheel'], 2000 * MILLISECOND, 50 * MILLISECOND)
    assert throttle.earliest == 2050 * MILLISECOND


def rest_after(arrivals, stamp, now):
    """Return the rest (ms) until a message with this stamp, after messages that came so (ms)."""
    prediction = Arrivals()
    for each, arrival in arrivals:
        prediction.note(each * MILLISECOND, arrival * MILLISECOND)
    return round(prediction.rest(stamp * MILLISECOND, now * MILLISECOND) / MILLISECOND, 1)


STEADY = [(0, 1000), (50, 1050), (100, 1100), (150, 1150)]


@pytest.mark.parametrize(
    ('arrivals', 'stamp', 'now', 'rest'),
    [
        (STEADY, 200, 1150, 50.0),
        (STEADY, 200, 1180, 20.5),
        (STEADY, 200, 1199, 0.0),
        (STEADY, 200, 1300, 0.0),
        (STEADY, 1150, 1150, 50.0),
        ([*STEADY[:3], (150, 1170)], 200, 1170, 30.5),
        ([(0, 1000), (50, 1010), (100, 1020)], 150, 1020, 10.5),
        ([(0, 1000), (50, 1050), (100, 1060)], 150, 1060, 10.5),
        ([(0, 1000), (50, 1500), (100, 2000)], 150, 2000, 0.0),
        ([(0, 1000), (50, 1050), (100, 9100)], 150, 9100, 0.0),
        (STEADY[:1], 50, 1000, 0.0),
        ([*STEADY, (10, 1160)], 60, 1160, 0.0),
        ([(0, 1000), (50, 900)], 100, 900, 0.0),
        ([], 50, 0, 0.0),
    ],
    ids=[
        'steady', 'later', 'nearly there', 'overdue', 'at most 50 ms', 'one was late',
        'five times as fast', 'faster since just now', 'slow', 'stood still', 'too few',
        'restarted', 'clock set back', 'none',
    ],
)  # fmt: skip
def test_nobody_looks_for_a_message_before_it_can_be_there(arrivals, stamp, now, rest):
    assert rest_after(arrivals, stamp, now) == rest
