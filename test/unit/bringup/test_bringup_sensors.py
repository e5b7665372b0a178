# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``sensors:=true``: amr with its sensors, and otherwise the stack that it is without."""

import pytest
from support.paths import ROOT

from amr_description.ament_index import path_of
from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.stacks.display import display
from amr_description.bringup.stacks.fleet import fleet
from amr_description.bringup.stacks.simulation import simulation
from amr_description.bringup.stacks.teleop import teleop
from amr_description.errors import UsageError

FILES = [
    path_of(f'package://amr_description/urdf/{name}')
    for name in ('amr.urdf', 'amr_sensors.urdf.xacro')
]
STACKS = pytest.mark.parametrize('function', [simulation, teleop, fleet, display])


def stack(function, **given):
    return function(**resolve(declared(function), given))


def shape(made):
    """The nodes, but for the name of the description's file."""
    return [
        (node.executable, node.namespace, [each for each in node.arguments if each not in FILES])
        for node in made.nodes
    ]


def descriptions(made):
    named = (node.parameters for node in made.nodes if node.executable == 'robot_state_publisher')
    return ''.join(parameters[0]['robot_description'] for parameters in named)


@STACKS
def test_the_robot_has_them_and_comes_up_as_without(function):
    without, made = stack(function), stack(function, sensors='true')
    assert shape(made) == shape(without)
    assert '<sensor' not in descriptions(without)
    assert {'gpu_lidar', 'rgbd_camera', 'imu'} == {
        kind for kind in ('gpu_lidar', 'rgbd_camera', 'imu', 'contact')
        if f'type="{kind}"' in descriptions(made)
    }  # fmt: skip


@STACKS
def test_another_robot_has_its_own(function):
    cart = str(ROOT / 'test/fixtures/urdf_good/cart.urdf')
    with pytest.raises(UsageError, match=r'^sensors:=true is for amr, .*cart\.urdf has the sens'):
        stack(function, urdf=cart, sensors='true')
