# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""GPIOs: which interfaces are commanded and published, and what a command does."""

import math

import pytest
from support.control_fakes import collect, FakeLog, MS

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.sensor_samples import InterfaceGroup, InterfaceGroupsSample
from amr_description.controllers.gpio_command_controller import (
    GpioCommandController,
    GpioParameters,
)
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.model import urdf
from amr_description.parameters import build

ROBOT = urdf.parse(
    """<robot name="r"><link name="base"/><ros2_control name="s" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <gpio name="lamp"><command_interface name="on"/><state_interface name="on"/>
    <state_interface name="heat"/></gpio>
    <gpio name="valve"><state_interface name="open"/></gpio></ros2_control></robot>"""
)
COMMANDS = {'command_interfaces.lamp.interfaces': ['on', 'colour']}


def make(log=None, robot=ROBOT, **values):
    controller = GpioCommandController(
        ControllerContext('gpio_controller', log or FakeLog(), robot=robot)
    )
    controller.configure(build(GpioParameters, {'gpios': ['lamp', 'valve'], **values}))
    return controller


def test_without_state_interfaces_all_of_the_urdf_are_published():
    controller = make(**COMMANDS)
    assert controller.command_interfaces().names == ('lamp/on', 'lamp/colour')
    assert controller.state_interfaces().names == ('lamp/on', 'lamp/heat', 'valve/open')
    assert [each.port.name for each in controller.inputs()] == ['~/commands']


def test_without_command_interfaces_it_is_a_broadcaster():
    controller = make(**{'state_interfaces.valve.interfaces': ['open']})
    assert controller.inputs() == ()
    assert controller.state_interfaces().names == ('valve/open',)
    sent = collect(controller.outputs()[0])
    controller.activate((), [StateInterface('valve', 'open', True, 'bool')], 0)
    controller.update(10 * MS, 10 * MS)
    assert sent == [
        InterfaceGroupsSample(
            10 * MS, (InterfaceGroup('lamp', (), ()), InterfaceGroup('valve', ('open',), (1.0,)))
        )
    ]


def test_commands_by_name_stay_in_force_and_what_cannot_be_one_is_logged():
    log = FakeLog()
    controller = make(log, **COMMANDS)
    on, colour = (
        CommandInterface('lamp', 'on', data_type='bool'),
        CommandInterface('lamp', 'colour'),
    )
    states = [StateInterface(*name.split('/')) for name in controller.state_interfaces().names]
    controller.activate([on, colour], states, 0)
    (commands,) = controller.inputs()
    commands.open()
    for group in (
        InterfaceGroup('lamp', ('colour', 'on'), (0.5, 1.0)),
        InterfaceGroup('lamp', ('colour',), (0.6, 0.7)),
        InterfaceGroup('lamp', ('on',), (math.nan,)),
        InterfaceGroup('valve', ('open',), (1.0,)),
    ):
        commands.put(InterfaceGroupsSample(0, (group,)))
    controller.update(10 * MS, 10 * MS)
    assert (on.value, colour.value) == (True, 0.5)
    assert log.texts(Severity.WARN) == [
        'For gpio lamp interfaces_names do not match values',
        'Ignoring the command nan to "lamp/on"; command_interfaces has: lamp/on, lamp/colour',
        'Ignoring the command 1.0 to "valve/open"; command_interfaces has: lamp/on, lamp/colour',
    ]
    controller.deactivate(20 * MS)
    assert (on.value, colour.value) == (True, 0.5)


def test_nothing_to_command_or_publish_is_refused():
    with pytest.raises(ControllerError, match='No command or state interfaces are configured'):
        make(robot=None)
    with pytest.raises(
        ControllerError, match='Expected 2 interfaces, got 1; missing: lamp/colour'
    ):
        make(**COMMANDS).activate([CommandInterface('lamp', 'on')], [], 0)
