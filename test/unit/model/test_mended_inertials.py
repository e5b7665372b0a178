# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Masses and moments that no solver takes, and what the simulator takes them as."""

from hypothesis import given, strategies as st
import pytest
from support.examples import examples

from amr_description.model.mended_inertials import (
    LEAST_MASS,
    least_moment,
    mended_inertia,
    mended_inertials,
    principal_moments,
)
from amr_description.model.robot import Inertia
from amr_description.model.urdf import parse

SOUND = '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>'


def link(name, mass=None, inertia=SOUND):
    inside = '' if mass is None else f'<inertial><mass value="{mass}"/>{inertia}</inertial>'
    return f'<link name="{name}">{inside}</link>'


def joint(parent, child, kind):
    return (
        f'<joint name="{parent}_{child}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{child}"/></joint>'
    )


def mended(*parts):
    return mended_inertials(parse(f'<robot name="r">{"".join(parts)}</robot>'))


def test_a_sound_robot_stays_as_it_is():
    assert mended(link('a', 1.0), link('b', 1.0), joint('a', 'b', 'continuous')) == {}


def test_a_frame_on_a_sound_body_needs_no_mass():
    assert mended(link('a'), link('b', 1.0), joint('a', 'b', 'fixed')) == {}


def test_mass_0_on_a_fixed_link_is_joined_to_its_parent():
    found = mended(link('a', 1.0), link('b', 0.0), joint('a', 'b', 'fixed'))
    assert found['b'].inertial is None
    assert found['b'].taken == 'it is joined to "a", without mass of its own'


@pytest.mark.parametrize('mass', [None, 0.0, 1e-16])
def test_a_moving_link_without_mass_gets_the_least(mass):
    found = mended(link('a', 1.0), link('b', mass), joint('a', 'b', 'continuous'))
    assert found['b'].inertial.mass == LEAST_MASS
    moments = principal_moments(found['b'].inertial.inertia)
    assert moments == pytest.approx((least_moment(LEAST_MASS),) * 3)


def test_of_a_body_without_mass_the_topmost_link_gets_it():
    """A base_footprint with the chassis below it, neither of which weighs anything."""
    found = mended(
        link('a'), link('b', 0.0), joint('a', 'b', 'fixed'), link('c', 1.0),
        joint('b', 'c', 'continuous'),
    )  # fmt: skip
    assert found['a'].inertial.mass == LEAST_MASS
    assert found['b'].inertial is None


def test_what_is_fixed_to_the_world_needs_neither():
    parts = (link('world'), joint('world', 'a', 'fixed'))
    assert mended(*parts, link('a')) == {}
    bad = SOUND.replace('ixy="0"', 'ixy="1"')
    assert mended(*parts, link('a', 1.0, bad))['a'].inertial is None


def test_inertia_0_becomes_that_of_a_small_ball():
    zero = SOUND.replace('0.1', '0')
    moments = principal_moments(mended(link('a', 2.0, zero))['a'].inertial.inertia)
    assert moments == pytest.approx((least_moment(2.0),) * 3)


def test_a_moment_too_large_is_lowered_to_the_sum_of_the_others():
    """The nearest body is a flat one: 0.1, 0.1, 0.2 would be a disc."""
    low, middle, high = principal_moments(mended_inertia(Inertia(0.1, 0, 0, 0.1, 0, 0.3), 1.0))
    assert (low, middle) == pytest.approx((0.15, 0.15), rel=0.01)
    assert high == pytest.approx(0.3, rel=0.01)


MOMENTS = st.floats(-10.0, 10.0)


@examples(60)
@given(st.tuples(*[MOMENTS] * 6), st.floats(1e-3, 100.0))
def test_what_is_mended_is_a_body_and_is_mended_no_more(values, mass):
    inertia = Inertia(*values)
    better = mended_inertia(inertia, mass)
    if better is not None:
        low, middle, high = principal_moments(better)
        assert low > 0.0
        assert high <= (low + middle) * (1.0 + 1e-9)
        assert mended_inertia(better, mass) is None


def test_what_rounding_has_made_impossible_is_mended_by_as_little():
    """MuJoCo refuses moments whose largest exceeds the others' sum by its last bit."""
    given = Inertia(0.1, 0.0, 0.0, 0.2, 0.0, 0.3 + 1e-4)
    low, middle, high = principal_moments(mended_inertia(given, 1.0))
    assert high < low + middle
    assert (low, middle, high) == pytest.approx((0.1, 0.2, 0.3), abs=2e-4)
    assert mended_inertia(Inertia(low, 0.0, 0.0, middle, 0.0, high), 1.0) is None
