# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Wheels are recognised from the model."""

from fixtures.sim.driving import AMR, LEFT, RIGHT
import pytest

from amr_description.model.kinematics import link_poses
from amr_description.model.urdf import parse
from amr_description.model.wheels import (
    find_wheels,
    is_passive_wheel_joint,
    Wheel,
    wheel_of,
)

ONE_WHEEL = """
<robot name="cart">
  <link name="base"/>
  <link name="tyre">
    <collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{shape}</geometry></collision>
  </link>
  <joint name="axle" type="{type}">
    <parent link="base"/><child link="tyre"/><axis xyz="{axis}"/>
    <limit lower="0" upper="1" effort="0" velocity="0"/>
  </joint>
</robot>
"""
CYLINDER = '<cylinder radius="0.1" length="0.04"/>'


def wheels_of(
    xyz='0 0 0', rpy='0 0 0', shape=CYLINDER, type='continuous', axis='0 0 1', driven=('axle',)
):
    urdf = ONE_WHEEL.format(xyz=xyz, rpy=rpy, shape=shape, type=type, axis=axis)
    return find_wheels(parse(urdf), driven)


def test_the_shipped_robot_has_four():
    wheels = find_wheels(parse(AMR), {*LEFT, *RIGHT})
    assert {wheel.joint for wheel in wheels} == {*LEFT, *RIGHT}
    assert {(wheel.radius, wheel.half_width) for wheel in wheels} == {(0.1, 0.02)}


@pytest.mark.parametrize(
    'options',
    [
        {},
        {'axis': '0 0 -2'},
        {'axis': '0 1 0', 'rpy': '-1.5708 0 0'},
        {'axis': '1 0 0', 'rpy': '0 1.5708 0'},
        {'xyz': '0 0 0.05'},  # off along the axle
    ],
)
def test_cylinder_round_about_the_axle_is_a_wheel(options):
    assert wheels_of(**options) == (Wheel('tyre', 'axle', 0.1, 0.02),)


def test_sphere_is_a_wheel_about_any_axis():
    sphere = '<sphere radius="0.1"/>'
    assert wheels_of(shape=sphere, axis='1 2 3') == (Wheel('tyre', 'axle', 0.1, 0.1),)


@pytest.mark.parametrize(
    'options',
    [
        {'axis': '0 1 0'},  # tumbles
        {'xyz': '0.02 0 0'},  # a crank
        {'shape': '<box size="0.1 0.1 0.1"/>'},
        {'shape': '<sphere radius="0.1"/>', 'xyz': '0.1 0 0'},
        {'type': 'revolute'},
        {'driven': ()},
    ],
)
def test_links_that_are_not_wheels(options):
    assert wheels_of(**options) == ()


def passive(commanded=(), **options):
    form = {'xyz': '0 0 0', 'rpy': '0 0 0', 'shape': CYLINDER, 'type': 'continuous'} | options
    robot = parse(ONE_WHEEL.format(**form))
    (joint,) = robot.joints
    if not is_passive_wheel_joint(joint, link_poses(robot, {}), commanded):
        return None
    return wheel_of(robot, joint)


def test_the_wheel_of_a_caster_is_a_passive_wheel():
    level = {'axis': '0 1 0', 'rpy': '-1.5708 0 0'}
    assert passive(**level) == Wheel('tyre', 'axle', 0.1, 0.02)
    assert passive(['axle'], **level) is None


def test_what_turns_about_a_vertical_axis_is_no_passive_wheel():
    assert passive(axis='0 0 1') is None


def test_of_several_round_shapes_the_largest_rolls():
    """A tyre is often drawn as a wide hub and a narrower tread that stands out."""
    hub = '<cylinder radius="0.057" length="0.07"/>'
    tread = '</geometry></collision><collision><geometry><cylinder radius="0.0625" length="0.04"/>'
    assert wheels_of(shape=hub + tread) == (Wheel('tyre', 'axle', 0.0625, 0.02),)
