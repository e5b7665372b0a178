# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot's description with another hardware component."""

from dataclasses import replace

import pytest
from support.paths import ROOT

from amr_description.bringup.stacks.hardware import swap_hardware
from amr_description.errors import DescriptionError
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse

URDF = (ROOT / 'urdf' / 'amr.urdf').read_text()


def test_plugin_and_parameters_are_all_that_changes():
    swapped = parse(swap_hardware(URDF, 'a/B', {'port': '/dev/ttyUSB0', 'odd': '<&">'}), 'swapped')
    original = parse(URDF, 'original')
    assert swapped.links == original.links
    (before,), (after,) = hardware_of(original), hardware_of(swapped)
    assert after.plugin == 'a/B'
    assert after.parameters == {'port': '/dev/ttyUSB0', 'odd': '<&">'}
    same = {'plugin': '', 'parameters': {}, 'line': 0, 'joints': ()}
    assert replace(after, **same) == replace(before, **same)
    assert [j.command_interfaces for j in after.joints] == [
        j.command_interfaces for j in before.joints
    ]


@pytest.mark.parametrize(
    ('text', 'reason'),
    [
        ('<robot name="a"/>', '0 <ros2_control> blocks with a <hardware>; exactly one is needed'),
        (URDF.replace('</robot>', URDF[URDF.index('<ros2_control') :]), '2 <ros2_control> blocks'),
        ('<robot', 'robot description: '),
    ],
)
def test_what_cannot_be_swapped_is_refused(text, reason):
    with pytest.raises(DescriptionError, match=reason):
        swap_hardware(text, 'a/B')
