# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Forwarding: the latest valid command reaches the interfaces unchanged, and nothing else does."""

import math

from hypothesis import given, strategies
import pytest
from support.control_fakes import (
    FakeHardware,
    FakeLog,
    LEFT,
    make_manager,
    MS,
    RIGHT,
    start,
    WHEELS,
)
from support.controller_bench import ControllerBench

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, NO_INTERFACES
from amr_description.control.samples import CommandsSample
from amr_description.control.switching import Strictness
from amr_description.controllers import CONTROLLERS
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Severity
from amr_description.parameters import build

FORWARD = 'forward_command_controller/ForwardCommandController'
PASS = 'passthrough_controller/PassthroughController'
MULTI = 'forward_command_controller/MultiInterfaceForwardCommandController'
GROUPS = {
    'position_controllers/JointGroupPositionController': 'position',
    'velocity_controllers/JointGroupVelocityController': 'velocity',
    'effort_controllers/JointGroupEffortController': 'effort',
}
JOINTS = ('joint1', 'joint2', 'joint3')
NOTHING = pytest.approx([math.nan] * 3, nan_ok=True)


class Bench(ControllerBench):
    """An active controller of that type, with interfaces."""

    def __init__(self, type_name=FORWARD, interface='position', **values):
        if not values:
            values = {'joints': JOINTS}
            values |= {'interface_name': interface} if type_name == FORWARD else {}
        super().__init__(type_name, **values)
        (self.port,) = self.controller.inputs()
        self.activate()

    def command(self, *values):
        self.port.put(CommandsSample(values))
        return self.update()


def test_a_command_is_written_as_it_is_and_stays_in_force():
    bench = Bench()
    assert bench.update() == NOTHING
    assert bench.command(10.0, 20.0, 30.0) == [10.0, 20.0, 30.0]
    bench.commands[0].value = 5.0  # for instance by a limiter
    assert bench.update() == [10.0, 20.0, 30.0]


def test_the_newest_command_counts():
    bench = Bench()
    bench.port.put(CommandsSample((1.0, 2.0, 3.0)))
    assert bench.command(4.0, 5.0, 6.0) == [4.0, 5.0, 6.0]


def test_interfaces_are_joints_times_interface_in_order():
    assert Bench().controller.command_interfaces().names == tuple(f'{j}/position' for j in JOINTS)
    assert Bench().controller.state_interfaces() == NO_INTERFACES


def test_several_interfaces_of_one_joint():
    bench = Bench(MULTI, joint='joint1', interface_names=['position', 'velocity', 'effort'])
    assert bench.command(1.0, 2.0, 3.0) == [1.0, 2.0, 3.0]
    assert [handle.name for handle in bench.commands] == [
        'joint1/position',
        'joint1/velocity',
        'joint1/effort',
    ]
    bench.controller.deactivate(0)
    assert math.isnan(bench.commands[0].value)
    assert [handle.value for handle in bench.commands[1:]] == [0.0, 0.0]


@pytest.mark.parametrize(('type_name', 'interface'), GROUPS.items())
def test_a_joint_group_needs_only_its_joints(type_name, interface):
    bench = Bench(type_name)
    assert [handle.name for handle in bench.commands] == [f'{j}/{interface}' for j in JOINTS]
    assert bench.command(1.0, 2.0, 3.0) == [1.0, 2.0, 3.0]
    with pytest.raises(ParameterError, match=f"'interface_name' must be one of {interface}"):
        Bench(type_name, joints=JOINTS, interface_name='temperature')


def test_the_topic():
    port = Bench().port.port
    assert (port.name, port.message) == ('~/commands', 'std_msgs/msg/Float64MultiArray')
    assert (port.qos.depth, port.qos.reliability) == (0, 'system_default')


@pytest.mark.parametrize('values', [(), (1.0,), (1.0, 2.0, 3.0, 4.0)])
def test_a_command_of_the_wrong_size_is_dropped_and_logged(values):
    bench = Bench()
    assert bench.command(*values) == NOTHING
    bench.command(7.0, 8.0, 9.0)
    assert bench.command(*values) == [7.0, 8.0, 9.0]
    assert (
        bench.log.texts(Severity.ERROR)
        == [f'command size ({len(values)}) does not match number of interfaces (3)'] * 2
    )


@pytest.mark.parametrize('bad', [math.nan, math.inf, -math.inf])
def test_a_command_that_is_not_finite_is_dropped_and_logged(bad):
    bench = Bench()
    assert bench.command(1.0, bad, 3.0) == NOTHING
    bench.command(7.0, 8.0, 9.0)
    assert bench.command(1.0, 2.0, bad) == [7.0, 8.0, 9.0]
    assert set(bench.log.texts(Severity.WARN)) == {'Non-finite value received. Dropping message'}


@given(strategies.lists(strategies.lists(strategies.floats(), max_size=4), max_size=6))
def test_only_finite_commands_of_the_right_size_ever_arrive(commands):
    bench = Bench(FORWARD, 'velocity')
    expected = None
    for values in commands:
        found = bench.command(*values)
        if len(values) == 3 and all(map(math.isfinite, values)):
            expected = values
        assert found == (expected or NOTHING)


@pytest.mark.parametrize(
    ('interface', 'rest'),
    [
        ('velocity', 0.0),
        ('effort', 0.0),
        ('acceleration', 0.0),
        ('position', math.nan),
        ('linear/velocity', 0.0),  # a reference of another controller
    ],
)
@pytest.mark.parametrize('ending', ['deactivate', 'reset'])
def test_nothing_keeps_moving_after_deactivation(interface, rest, ending):
    bench = Bench(FORWARD, interface)
    bench.command(1.0, 2.0, 3.0)
    bench.port.put(CommandsSample((4.0, 5.0, 6.0)))
    getattr(bench.controller, ending)(0)
    at_rest = pytest.approx([rest] * 3, nan_ok=True)
    assert [handle.value for handle in bench.commands] == at_rest
    if ending == 'deactivate':
        bench.port.close()
        bench.activate()
    assert bench.update() == at_rest
    assert bench.command(7.0, 8.0, 9.0) == [7.0, 8.0, 9.0]


def test_a_command_outlives_a_jump_of_the_clock():
    bench = Bench(FORWARD, 'velocity')
    bench.command(1.0, 2.0, 3.0)
    bench.controller.set_clock(3_600_000_000_000)
    assert bench.update() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ('type_name', 'values', 'text'),
    [
        (FORWARD, {'interface_name': 'velocity'}, "'joints' parameter was empty"),
        (FORWARD, {'joints': JOINTS}, "'interface_name' parameter was empty"),
        (MULTI, {'interface_names': ['a']}, "'joint' parameter is empty"),
        (MULTI, {'joint': 'joint1'}, "'interfaces' parameter is empty"),
        (FORWARD, {'joints': ['a', 'b', 'a'], 'interface_name': 'p'}, 'more than once: a/p$'),
        (MULTI, {'joint': 'a', 'interface_names': ['p', 'p']}, 'more than once: a/p$'),
    ],
)
def test_parameters_that_name_nothing_or_a_thing_twice_are_refused(type_name, values, text):
    with pytest.raises(ControllerError, match=text):
        Bench(type_name, **values)


def test_fewer_handles_than_asked_for_are_refused():
    bench = Bench()
    with pytest.raises(ControllerError, match='Expected 3 command interfaces, got 2'):
        bench.controller.activate(bench.commands[:2], (), 0)


def test_an_interface_that_is_not_a_double_is_refused():
    bench = Bench(joints=['gpio'], interface_name='lamp')
    lamp = CommandInterface('gpio', 'lamp', data_type='bool')
    with pytest.raises(ControllerError, match="'gpio/lamp' is of type bool; only doubles"):
        bench.controller.activate([lamp], (), 0)


@pytest.mark.parametrize('type_name', [FORWARD, *GROUPS])
def test_it_cannot_be_preceded_as_in_jazzy(type_name):
    controller = Bench(type_name).controller
    assert not controller.is_chainable
    assert controller.references() == ()


def test_under_a_manager_the_wheels_turn_as_commanded_and_stop_with_the_controller():
    hardware = FakeHardware()
    manager = make_manager(hardware)
    found = CONTROLLERS.find('velocity_controllers/JointGroupVelocityController')
    controller = found(ControllerContext('wheels', FakeLog()))
    start(manager, controller, build(found.parameters_type, {'joints': WHEELS}))
    (port,) = controller.inputs()
    assert port.put(CommandsSample((1.0, 2.0, 3.0, 4.0)))
    manager.tick(10 * MS)
    assert list(hardware.written.values()) == [1.0, 2.0, 3.0, 4.0]
    manager.switch([], ['wheels'], Strictness.STRICT, 20 * MS)
    manager.tick(20 * MS)
    assert list(hardware.written.values()) == [0.0] * 4


def test_it_can_stand_before_a_diff_drive_controller():
    hardware = FakeHardware()
    manager = make_manager(hardware)
    geometry = {'wheel_separation': 0.3, 'wheel_radius': 0.1}
    for name, type_name, values in (
        (
            'drive',
            'diff_drive_controller/DiffDriveController',
            {'left_wheel_names': LEFT, 'right_wheel_names': RIGHT, **geometry},
        ),
        (
            'forward',
            MULTI,
            {'joint': 'drive', 'interface_names': ['linear/velocity', 'angular/velocity']},
        ),
    ):
        found = CONTROLLERS.find(type_name)
        manager.load(found(ControllerContext(name, FakeLog())), type_name)
        forward = manager.configure(name, build(found.parameters_type, values))
    manager.switch(['drive', 'forward'], [], Strictness.STRICT, 0)
    (port,) = forward.inputs()
    assert port.put(CommandsSample((0.5, 0.0)))
    manager.tick(10 * MS)
    assert list(hardware.written.values()) == pytest.approx([0.5 / 0.1] * 4)
    manager.switch([], ['drive', 'forward'], Strictness.STRICT, 20 * MS)
    manager.tick(20 * MS)
    assert list(hardware.written.values()) == [0.0] * 4


def test_a_passthrough_controller_commands_the_interfaces_that_it_names():
    bench = Bench(PASS, interfaces=['joint1/position', 'drive/linear/velocity'])
    assert bench.update() == pytest.approx([math.nan] * 2, nan_ok=True)
    assert bench.command(1.0, 2.0) == [1.0, 2.0]
    assert bench.command(3.0) == [1.0, 2.0]
    references = bench.controller.references()
    assert [each.name for each in references] == [
        'it/joint1/position',
        'it/drive/linear/velocity',
    ]
    bench.controller.deactivate(0)
    assert [each.value for each in bench.commands] == pytest.approx([math.nan, 0.0], nan_ok=True)
    assert [each.value for each in references] == pytest.approx([math.nan] * 2, nan_ok=True)
    with pytest.raises(ControllerError, match="'interfaces' parameter is empty"):
        Bench(PASS, interfaces=[])


def test_in_a_chain_a_passthrough_controller_passes_on_what_the_preceding_one_commands():
    """The chain of the demos: one for each joint, one for these, one before that."""
    hardware = FakeHardware()
    manager = make_manager(hardware)
    found = CONTROLLERS.find(PASS)
    logs = {}

    def configure(name, interfaces):
        logs[name] = FakeLog()
        manager.load(found(ControllerContext(name, logs[name])), PASS)
        return manager.configure(name, build(found.parameters_type, {'interfaces': interfaces}))

    for index, wheel in enumerate(WHEELS):
        configure(f'joint{index}', [f'{wheel}/velocity'])
    below = [f'joint{index}/{wheel}/velocity' for index, wheel in enumerate(WHEELS)]
    second = configure('second', below)
    third = configure('third', [f'second/{each}' for each in below])
    names = ['joint0', 'joint1', 'joint2', 'joint3', 'second', 'third']
    manager.switch(names, [], Strictness.STRICT, 0)
    assert third.inputs()[0].put(CommandsSample((1.0, 2.0, 3.0, 4.0)))
    assert second.inputs()[0].put(CommandsSample((9.0, 9.0, 9.0, 9.0)))
    manager.tick(10 * MS)
    assert list(hardware.written.values()) == [1.0, 2.0, 3.0, 4.0]
    assert logs['second'].texts(Severity.WARN) == [
        "Ignoring commands on '~/commands': in chained mode the preceding controller commands"
    ]
    manager.switch([], names, Strictness.STRICT, 20 * MS)
    manager.tick(20 * MS)
    assert list(hardware.written.values()) == [0.0] * 4
