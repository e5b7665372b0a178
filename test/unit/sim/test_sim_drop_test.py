# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The physical test of a description: what passes, what fails and how, the same each time."""

import math
import re

import pytest
from support.paths import ROOT

from amr_description.model import urdf
from amr_description.sim.drop_test import drop_test, ROLL_SPEED, ROLL_TIME

AMR = (ROOT / 'urdf/amr.urdf').read_text()
CART = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()


def dropped(text):
    return drop_test(urdf.parse(text, 'f'))


def test_shipped_robot_in_numbers():
    report = dropped(AMR)
    assert report.failures == report.left_out == ()
    fall = math.sqrt(2.0 * 0.2 / 9.81)
    assert fall < report.rest_time < 1.0
    assert report.fastest == pytest.approx(9.81 * fall, rel=0.02), 'v² = 2 g h'
    assert report.tilt < 1e-3
    assert report.drift < 1e-4
    assert report.push_force == pytest.approx(0.5 * 7.0 * 9.81)
    assert report.push_tilt < 0.01
    # Wheels that have to come up to speed lose some way.
    assert 0.9 < report.ahead / (ROLL_SPEED * ROLL_TIME) < 1.0
    assert abs(report.aside) < 1e-6
    assert abs(report.veer) < 1e-6
    assert report.turn > 0.3


def test_the_same_robot_gives_the_same_numbers():
    assert dropped(AMR) == dropped(AMR)


def test_wheels_driven_by_effort_are_driven_too():
    velocity = '<command_interface name="velocity"/>'
    assert velocity in AMR
    report = dropped(AMR.replace(velocity, velocity.replace('velocity', 'effort')))
    assert report.failures == ()
    assert 0.8 < report.ahead / (ROLL_SPEED * ROLL_TIME) < 1.0
    assert abs(report.veer) < 1e-3
    assert report.turn > 0.2


def test_slow_wheels_are_rolled_as_fast_as_they_may():
    limit = '<limit effort="10" velocity="0.5"/>'
    wheel = r'<joint name="joint_wheel_\w+" type="continuous">'
    text = re.sub(wheel, lambda found: found[0] + limit, AMR)
    assert text.count(limit) == 4
    report = dropped(text)
    assert report.failures == report.left_out == ()
    assert 0.8 < report.ahead / (0.5 * 0.1 * ROLL_TIME) < 1.0


def test_axles_that_point_to_the_right_drive_backwards():
    report = dropped(AMR.replace('<axis xyz="0 0 -1"/>', '<axis xyz="0 0 1"/>'))
    (failure,) = report.failures
    assert failure.startswith('it drives backwards: positive wheel speeds carry it by -0.1')
    assert report.ahead == pytest.approx(-dropped(AMR).ahead)
    assert report.turn == pytest.approx(-dropped(AMR).turn)


def test_one_axle_turned_round_turns_instead_of_rolling():
    place = CART.index('<axis xyz="0 0 1"/>')
    report = dropped(CART[:place] + CART[place:].replace('0 0 1', '0 0 -1', 1))
    assert report.failures[0].startswith('it does not drive: positive wheel speeds carry it by')
    assert abs(report.veer) > 0.1
    assert len(report.failures) == 1, 'that it does not turn either has the same cause'


TYRES = re.compile(r'(<link name="(left|right)_wheel">)\s*(<collision>.*?</collision>)')


def test_wheels_that_are_no_cylinders_about_their_axles_are_driven_too():
    """The tyre of each is a link of its own: what makes it a wheel is that it stands on it."""

    def with_tyre(found):
        return (
            f'<link name="{found[2]}_tyre">{found[3]}'
            '<inertial><mass value="0.01"/><inertia ixx="0.00003" ixy="0" ixz="0" iyy="0.00003" '
            'iyz="0" izz="0.00005"/></inertial></link>'
            f'<joint name="{found[2]}_rim" type="fixed"><parent link="{found[2]}_wheel"/>'
            f'<child link="{found[2]}_tyre"/></joint>{found[1]}'
        )

    text, count = TYRES.subn(with_tyre, CART)
    assert count == 2
    report, plain = dropped(text), dropped(CART)
    assert report.failures == report.left_out == ()
    assert report.ahead == pytest.approx(plain.ahead, rel=0.1)
    assert report.turn > plain.turn / 2.0


def test_the_wheels_that_a_controller_names_are_driven_and_no_others():
    robot = urdf.parse(CART, 'f')
    assert drop_test(robot, ['left_joint', 'right_joint']) == drop_test(robot)
    (failure,) = drop_test(robot, ['left_joint']).failures[-1:]
    assert failure == 'it cannot turn: its driven wheels are on one side, "left_joint"'


def test_a_wheel_in_the_middle_drives_and_cannot_turn():
    """A tricycle: two wheels that nothing drives, and one in front."""
    wheel = CART[
        CART.index('  <joint name="left_joint"') : CART.index('  <joint name="right_joint"')
    ]
    front = wheel.replace('left', 'front').replace('0.1 0.15 0', '0.15 0 0')
    free = CART.replace('<collision><geometry><sphere radius="0.05"/></geometry></collision>', '')
    text = free.replace('  <joint name="caster_joint"', f'{front}  <joint name="caster_joint"')
    driven = text.replace('0.1 0.15 0', '-0.1 0.15 0').replace('0.1 -0.15 0', '-0.1 -0.15 0')
    head, _, tail = driven.partition('<ros2_control')
    block = tail.replace('left_joint', 'front_joint').partition('    <joint name="right_joint"')[0]
    report = dropped(f'{head}<ros2_control{block}  </ros2_control>\n</robot>')
    assert report.failures == ()
    assert report.left_out == ('not turned: its driven wheels are in the middle',)
    assert report.ahead > 0.1
    assert report.turn is None


def test_what_turns_about_a_vertical_axle_in_the_air_is_no_wheel():
    """A lidar that spins; it takes a velocity command, and the robot stands without it."""
    head, _, _ = CART.partition('  <joint name="left_joint"')
    lidar = (
        '<joint name="spin" type="continuous"><parent link="base_link"/><child link="lidar"/>'
        '<origin xyz="0 0 0.2"/><axis xyz="0 0 1"/></joint><link name="lidar"><collision>'
        '<geometry><cylinder radius="0.04" length="0.04"/></geometry></collision><inertial>'
        '<mass value="0.2"/><inertia ixx="0.0001" ixy="0" ixz="0" iyy="0.0001" iyz="0" '
        'izz="0.00016"/></inertial></link><ros2_control name="s" type="system"><hardware>'
        '<plugin>p</plugin></hardware><joint name="spin"><command_interface name="velocity"/>'
        '<state_interface name="position"/></joint></ros2_control></robot>'
    )
    report = dropped(head + lidar)
    assert report.failures == ()
    assert report.left_out == (
        'not driven: it stands on none of the joints that take a command, "spin"',
    )


def test_without_collision_it_falls_through_the_ground():
    start, end = '<collision>', '</collision>'
    text = AMR
    while start in text:
        text = text[: text.index(start)] + text[text.index(end) + len(end) :]
    (failure,) = dropped(text).failures
    assert "robot 'robot' is below the ground" in failure


def test_without_its_caster_it_tips_over():
    caster = '<collision><geometry><sphere radius="0.05"/></geometry></collision>'
    assert caster in CART
    text = CART.replace(caster, '').replace(
        '<box size="0.4 0.2 0.1"/>', '<box size="0.1 0.2 0.1"/>'
    )
    (failure,) = dropped(text).failures
    assert failure.startswith('it tips over')


def test_wheels_that_lie_flat_are_the_cause_of_tipping_over():
    """The robot without its caster, and with wheels that nobody has turned."""
    caster = '<collision><geometry><sphere radius="0.05"/></geometry></collision>'
    text = CART.replace(caster, '').replace(' rpy="-1.5707963267948966 0 0"', '')
    # Low enough for the wheels' rims to be the first to touch, and for its tail to fall deep.
    text = text.replace('<box size="0.4 0.2 0.1"/>', '<box size="0.1 0.2 0.02"/>')
    text = text.replace('0.1 0.15 0"', '0.1 0.15 -0.1"').replace('0.1 -0.15 0"', '0.1 -0.15 -0.1"')
    (failure,) = dropped(text).failures
    assert failure.startswith('it tips over: it rests at a tilt of ')
    assert (
        '; "left_joint", "right_joint": the axle is vertical, so that the wheel cannot' in failure
    )


def test_a_small_robot_turns_by_more_than_half_a_turn():
    """Wheels 12 cm apart that roll at 0.3 m/s turn by 5 rad in a second."""
    near = CART.replace('0.1 0.15 0', '0 0.06 0').replace('0.1 -0.15 0', '0 -0.06 0')
    near = near.replace('<box size="0.4 0.2 0.1"/>', '<box size="0.3 0.06 0.1"/>')
    report = dropped(near)
    assert report.failures == ()
    assert report.turn > math.pi


def test_a_robot_that_stands_on_a_point_does_not_rest_upright():
    text = (
        '<robot name="pin"><link name="pin">'
        '<collision><origin xyz="0.02 0 0.5"/><geometry><cylinder radius="0.01" length="1"/>'
        '</geometry></collision>'
        '<inertial><origin xyz="0.3 0 0.5"/><mass value="1"/>'
        '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>'
        '</link></robot>'
    )
    (failure,) = dropped(text).failures
    assert failure.startswith('it tips over: it rests at a tilt of ')


def test_an_arm_bolted_down_is_not_dropped():
    report = dropped((ROOT / 'test/fixtures/urdf_good/gripper.urdf').read_text())
    assert report.stands_fixed
    assert report.failures == ()
    assert (report.rest_time, report.ahead, report.turn) == (None, None, None)


def test_a_box_without_wheels_is_not_driven():
    text = (
        '<robot name="box"><link name="box">'
        '<collision><geometry><box size="1 1 1"/></geometry></collision>'
        '<inertial><mass value="6"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>'
    )
    report = dropped(text)
    assert report.failures == ()
    assert report.left_out == (
        'not driven: no continuous joint takes a velocity or an effort command',
    )
    assert report.rest_time > 0.2
    assert report.fastest == pytest.approx(math.sqrt(2.0 * 9.81 * 0.2), rel=0.02)
    assert report.ahead is None


def test_a_joint_that_begins_fast_explodes():
    lift = (
        '<joint name="lift_joint"><state_interface name="velocity"><param name="initial_value">'
        '100</param></state_interface></joint></ros2_control>'
    )
    text = (
        CART.replace('</ros2_control>', lift)
        .replace('<origin xyz="0 0 0.2"/>\n    <axis xyz="0 0 1"/>', '<axis xyz="1 0 0"/>')
        .replace('<mass value="0.3"/>', '<mass value="30"/>')
    )
    report = dropped(text)
    (failure,) = report.failures
    assert re.fullmatch(r'it explodes: its root moves at [\d.e+]+ m/s', failure)
    assert report.fastest > 20.0
    assert report.rest_time is None
