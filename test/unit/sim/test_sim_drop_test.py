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
    assert report.failures == ()
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
    assert report.rest_time > 0.2
    assert report.fastest == pytest.approx(math.sqrt(2.0 * 9.81 * 0.2), rel=0.02)
    assert report.ahead is None


def test_a_joint_that_begins_far_beyond_its_limits_explodes():
    text = (
        CART.replace('lower="0" upper="0.2"', 'lower="100" upper="101"')
        .replace('<origin xyz="0 0 0.2"/>\n    <axis xyz="0 0 1"/>', '<axis xyz="1 0 0"/>')
        .replace('<mass value="0.3"/>', '<mass value="30"/>')
    )
    report = dropped(text)
    (failure,) = report.failures
    assert re.fullmatch(r'it explodes: its root moves at [\d.e+]+ m/s', failure)
    assert report.fastest > 20.0
    assert report.rest_time is None
