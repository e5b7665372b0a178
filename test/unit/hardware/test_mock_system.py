# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""mock_components/GenericSystem: states follow commands."""

import math

import pytest
from support.control_fakes import FakeLog

from amr_description.errors import HardwareError
from amr_description.hardware import HARDWARE
from amr_description.hardware.mock_system import MockSystem
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse

PERIOD = 100_000_000

URDF = """
<robot name="rig">
  <link name="base"/><link name="a"/><link name="b"/>
  <joint name="ja" type="continuous"><parent link="base"/><child link="a"/></joint>
  <joint name="jb" type="continuous">
    <parent link="base"/><child link="b"/><mimic joint="ja" multiplier="-2" offset="1"/>
  </joint>
  <ros2_control name="Rig" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin>{parameters}</hardware>
    <joint name="ja">
      <command_interface name="position"/>
      <command_interface name="velocity"/>
      <command_interface name="acceleration"/>
      <command_interface name="brake"/>
      <state_interface name="position"><param name="initial_value">0.5</param></state_interface>
      <state_interface name="velocity"/>
      <state_interface name="acceleration"/>
      <state_interface name="actual"/>
      <state_interface name="brake"/>
    </joint>
    <joint name="jb">
      <state_interface name="position"/><state_interface name="velocity"/>
    </joint>
    <sensor name="force"><state_interface name="x"/></sensor>
    <gpio name="relay">
      <command_interface name="coil"/>
      <command_interface name="open" data_type="bool"><param name="initial_value">true</param>
      </command_interface>
      <command_interface name="count" data_type="uint8"/>
      <state_interface name="open" data_type="bool"/>
      <state_interface name="count" data_type="uint8"><param name="initial_value">7</param>
      </state_interface>
      <state_interface name="coil"/><state_interface name="temperature"/>
    </gpio>
  </ros2_control>
</robot>
"""


class Rig:
    """The active component, with its interfaces by name."""

    def __init__(self, **parameters):
        texts = (f'<param name="{k}">{v}</param>' for k, v in parameters.items())
        (info,) = hardware_of(parse(URDF.format(parameters=''.join(texts))))
        self.log = FakeLog()
        self.system = MockSystem(info, self.log, None)
        self.states = {s.name: s for s in self.system.state_interfaces()}
        self.commands = {c.name: c for c in self.system.command_interfaces()}
        self.system.configure()
        self.system.activate()

    def command(self, name, value):
        self.commands[name].value = value

    def read(self, *names):
        self.system.write(0, PERIOD)
        self.system.read(0, PERIOD)
        return [self.states[name].value for name in names]


JA = ('ja/position', 'ja/velocity', 'ja/acceleration')


def test_found_by_its_name():
    assert HARDWARE.find('mock_components/GenericSystem') is MockSystem


def test_starts_at_initial_values():
    rig = Rig()
    assert [rig.states[n].value for n in (*JA, 'ja/actual')] == [0.5, 0.0, 0.0, 0.0]
    assert math.isnan(rig.states['force/x'].value), 'only joints begin at 0.0'
    assert math.isnan(rig.states['relay/coil'].value)
    assert rig.states['relay/open'].value is False
    assert rig.states['relay/count'].value == 7
    initial = {'relay/open': True, 'relay/count': 255}
    for name, command in rig.commands.items():
        assert command.value == initial[name] if name in initial else math.isnan(command.value)


def test_states_follow_commands_and_nan_is_none():
    rig = Rig()
    assert rig.read(*JA) == [0.5, 0.0, 0.0]
    rig.command('ja/position', 2.0)
    rig.command('ja/velocity', 3.0)
    assert rig.read(*JA) == [2.0, 3.0, 0.0]
    rig.command('ja/position', math.nan)
    rig.command('relay/coil', 1.0)
    assert rig.read(*JA, 'relay/coil') == [2.0, 3.0, 0.0, 1.0]


def test_commands_of_other_types():
    rig = Rig()
    assert rig.read('relay/open', 'relay/count') == [True, 7], 'a count never written is none'
    rig.command('relay/open', False)
    rig.command('relay/count', 3)
    assert rig.read('relay/open', 'relay/count') == [False, 3]


def test_activation_drops_earlier_commands():
    rig = Rig()
    rig.command('ja/velocity', 3.0)
    rig.command('relay/open', False)
    rig.read()
    rig.system.deactivate()
    assert rig.read('ja/velocity') == [0.0]
    rig.system.activate()
    assert math.isnan(rig.commands['ja/velocity'].value)
    assert rig.commands['relay/open'].value is True


def test_a_second_configure_keeps_the_states():
    """Encoders that jumped to zero would make odometry jump."""
    rig = Rig()
    rig.command('ja/position', 2.0)
    rig.command('ja/velocity', 3.0)
    rig.read()
    for transition in ('deactivate', 'cleanup', 'configure', 'activate'):
        getattr(rig.system, transition)()
    assert rig.read(*JA) == [2.0, 0.0, 0.0]


def test_mimic_joint_follows():
    rig = Rig()
    rig.command('ja/position', 2.0)
    rig.command('ja/velocity', 3.0)
    assert rig.read('jb/position', 'jb/velocity') == [1.0 - 2.0 * 2.0, -2.0 * 3.0]


@pytest.mark.parametrize('bad', [math.inf, -math.inf])
def test_infinite_command_fails(bad):
    rig = Rig()
    rig.command('ja/velocity', bad)
    with pytest.raises(HardwareError, match=f"'Rig': command 'ja/velocity' is {bad}; a finite"):
        rig.read()


def test_velocity_is_integrated():
    """Backward Euler, as the recordings show: the new velocity moves the joint at once."""
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/velocity'], [])
    rig.command('ja/velocity', 2.0)
    assert rig.read(*JA) == pytest.approx([0.7, 2.0, 20.0])
    assert rig.read(*JA) == pytest.approx([0.9, 2.0, 0.0])
    rig.command('ja/velocity', 1.0)
    assert rig.read(*JA) == pytest.approx([1.0, 1.0, -10.0])
    rig.command('ja/velocity', math.nan)
    assert rig.read(*JA) == pytest.approx([1.1, 1.0, -10.0])


def test_acceleration_is_integrated_twice():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/acceleration'], [])
    rig.command('ja/acceleration', 10.0)
    assert rig.read(*JA) == pytest.approx([0.6, 1.0, 10.0])
    assert rig.read(*JA) == pytest.approx([0.8, 2.0, 10.0])


def test_position_is_differentiated():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/position'], [])
    rig.command('ja/position', 1.0)
    assert rig.read(*JA) == pytest.approx([1.0, 5.0, 50.0])
    assert rig.read(*JA) == pytest.approx([1.0, 0.0, -50.0])


def test_without_time_nothing_is_integrated():
    rig = Rig(calculate_dynamics='true')
    rig.command('ja/position', 1.0)
    rig.system.read(0, 0)
    assert [rig.states[name].value for name in JA] == [0.5, 0.0, 0.0]


def test_mimic_with_dynamics():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/velocity'], [])
    rig.command('ja/velocity', 2.0)
    assert rig.read('jb/position', 'jb/velocity') == pytest.approx([1.0 - 2.0 * 0.7, -4.0])


@pytest.mark.parametrize('dynamics', ['true', 'false'])
def test_released_joint_stands_still(dynamics):
    rig = Rig(calculate_dynamics=dynamics)
    rig.system.perform_command_mode_switch(['ja/velocity', 'relay/coil'], [])
    rig.command('ja/velocity', 2.0)
    rig.command('relay/coil', 1.0)
    position, *_ = rig.read(*JA)
    rig.system.perform_command_mode_switch([], ['ja/velocity', 'relay/coil'])
    assert rig.read(*JA) == rig.read(*JA) == [position, 0.0, 0.0]
    assert rig.commands['ja/velocity'].value == 0.0
    assert rig.read('relay/coil') == [1.0]


def test_a_joint_that_changes_its_mode_does_not_go_back():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/position'], [])
    rig.command('ja/position', 1.0)
    rig.read()
    rig.system.perform_command_mode_switch(['ja/velocity'], ['ja/position'])
    assert rig.read(*JA) == [1.0, 0.0, 0.0], 'nothing is commanded yet'
    rig.command('ja/velocity', 2.0)
    rig.read()
    rig.system.perform_command_mode_switch([], ['ja/velocity'])
    assert rig.read(*JA) == rig.read(*JA) == [1.2, 0.0, 0.0]


def test_two_modes_at_once_are_refused():
    rig = Rig(calculate_dynamics='true')
    message = r"Got multiple \(2\) starting interfaces for joint 'ja'.*one of position, velocity"
    with pytest.raises(HardwareError, match=message):
        rig.system.prepare_command_mode_switch(['ja/position', 'ja/velocity'], [])
    Rig().system.prepare_command_mode_switch(['ja/position', 'ja/velocity'], [])


def test_dynamics_need_a_mode():
    rig = Rig(calculate_dynamics='true')
    with pytest.raises(HardwareError, match=r"Joint 'ja' has to have 'position',.*Only brake"):
        rig.system.prepare_command_mode_switch(['ja/brake'], [])
    rig.system.prepare_command_mode_switch(['ja/brake', 'ja/position', 'relay/coil'], [])
    rig.command('ja/brake', 1.0)
    assert rig.read('ja/brake') == [1.0], 'what has no dynamics follows'


@pytest.mark.parametrize('dynamics', ['true', 'false'])
def test_offset_between_command_and_state(dynamics):
    rig = Rig(position_state_following_offset='0.25', calculate_dynamics=dynamics)
    assert rig.states['ja/position'].value == 0.75
    rig.command('ja/position', 2.0)
    assert rig.read('ja/position') == rig.read('ja/position') == [2.25]


@pytest.mark.parametrize('dynamics', ['true', 'false'])
def test_offset_in_a_state_of_its_own(dynamics):
    rig = Rig(
        calculate_dynamics=dynamics,
        position_state_following_offset='0.25',
        custom_interface_with_following_offset='actual',
    )
    assert rig.read('ja/position', 'ja/actual') == [0.5, 0.0]
    rig.command('ja/position', 2.0)
    assert rig.read('ja/position', 'ja/actual') == [2.0, 2.25]
    assert rig.log.texts() == []


def test_an_offset_for_a_state_that_is_not_there_is_warned_of():
    rig = Rig(custom_interface_with_following_offset='reel')
    assert rig.log.texts() == [
        "Custom interface with following offset 'reel' does not exist. Offset will not be applied"
    ]


def test_disabled_commands_change_nothing():
    rig = Rig(disable_commands='true')
    rig.command('ja/position', 2.0)
    assert rig.read(*JA) == [0.5, 0.0, 0.0]
    assert rig.log.texts() == ['Command propagation is disabled - no values will be returned!']


def test_sensors_and_gpios_can_be_commanded_for_tests():
    assert 'force/x' not in Rig().commands
    rig = Rig(mock_sensor_commands='true', mock_gpio_commands='True')
    rig.command('force/x', 9.0)
    rig.command('relay/temperature', 40.0)
    x, temperature, coil = rig.read('force/x', 'relay/temperature', 'relay/coil')
    assert (x, temperature) == (9.0, 40.0)
    assert math.isnan(coil)


@pytest.mark.parametrize(
    'name, value, expected',
    [
        ('calculate_dynamics', 'yes', 'true or false'),
        ('position_state_following_offset', 'far', 'a number'),
    ],
)
def test_unreadable_parameter(name, value, expected):
    with pytest.raises(HardwareError, match=f"'Rig': parameter '{name}' is '{value}'; {expected}"):
        Rig(**{name: value})
