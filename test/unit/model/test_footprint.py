# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How much of the floor a robot takes."""

import math

import pytest
from support.paths import ROOT

from amr_description.model.shapes import horizontal_reach, REACH_OF_A_MESH
from amr_description.model.urdf import load, parse

TWO_LINKS = """<robot name="r"><link name="base"/>
<joint name="j" type="fixed"><parent link="base"/><child link="part"/><origin xyz="0.3 0.4 2"/>
</joint><link name="part"><collision><geometry>{}</geometry></collision></link></robot>"""


@pytest.mark.parametrize(
    ('shape', 'size'),
    [
        ('<sphere radius="0.1"/>', 0.1),
        ('<box size="0.2 0.4 0.4"/>', 0.3),
        ('<cylinder radius="0.3" length="0.8"/>', math.hypot(0.3, 0.3, 0.4)),
        ('<mesh filename="package://p/part.stl"/>', REACH_OF_A_MESH),
    ],
)
def test_a_part_reaches_as_far_as_it_is_away_and_big(shape, size):
    assert horizontal_reach(parse(TWO_LINKS.format(shape), 'r')) == pytest.approx(0.5 + size)


def test_the_shipped_robot_turns_within_its_reach():
    robot = load(ROOT / 'urdf/amr.urdf')
    # Its wheels, of radius 0.1 m, are 0.25 m from the middle.
    assert 0.35 < horizontal_reach(robot) < 0.6
