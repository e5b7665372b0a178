# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""mock_components/GenericSystem: states follow commands."""

import math

from fixtures.sim.driving import Lines
import pytest

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
      <state_interface name="position"><param name="initial_value">0.5</param></state_interface>
      <state_interface name="velocity"/>
      <state_interface name="acceleration"/>
      <state_interface name="actual"/>
    </joint>
    <joint name="jb">
      <state_interface name="position"/><state_interface name="velocity"/>
    </joint>
    <sensor name="force"><state_interface name="x"/></sensor>
    <gpio name="relay">
      <command_interface name="coil"/>
      <state_interface name="coil"/><state_interface name="temperature"/>
    </gpio>
  </ros2_control>
</robot>
"""


class Rig:
    """The component, active, with its cells by name."""

    def __init__(self, **parameters):
        texts = (f'<param name="{k}">{v}</param>' for k, v in parameters.items())
        (info,) = hardware_of(parse(URDF.format(parameters=''.join(texts))))
        self.log = Lines()
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
    assert [rig.states[n].value for n in JA] == [0.5, 0.0, 0.0]
    assert rig.states['relay/coil'].value == 0.0
    assert all(math.isnan(command.value) for command in rig.commands.values())


def test_states_follow_commands_and_nan_is_none():
    rig = Rig()
    assert rig.read(*JA) == [0.5, 0.0, 0.0]
    rig.command('ja/position', 2.0)
    rig.command('ja/velocity', 3.0)
    assert rig.read(*JA) == [2.0, 3.0, 0.0]
    rig.command('ja/position', math.nan)
    rig.command('relay/coil', 1.0)
    assert rig.read(*JA, 'relay/coil') == [2.0, 3.0, 0.0, 1.0]


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
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/velocity'], [])
    rig.command('ja/velocity', 2.0)
    # The command acts from the next cycle on: period 0.1 s.
    assert rig.read(*JA) == pytest.approx([0.5, 2.0, 20.0])
    assert rig.read(*JA) == pytest.approx([0.7, 2.0, 0.0])
    rig.command('ja/velocity', 1.0)
    assert rig.read(*JA) == pytest.approx([0.9, 1.0, -10.0])


def test_acceleration_is_integrated_twice():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/acceleration'], [])
    rig.command('ja/acceleration', 10.0)
    assert rig.read(*JA) == pytest.approx([0.5, 0.0, 10.0])
    assert rig.read(*JA) == pytest.approx([0.5, 1.0, 10.0])
    assert rig.read(*JA) == pytest.approx([0.6, 2.0, 10.0])


def test_position_is_differentiated():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/position'], [])
    rig.command('ja/position', 1.0)
    assert rig.read(*JA) == pytest.approx([1.0, 5.0, 50.0])
    assert rig.read(*JA) == pytest.approx([1.0, 0.0, -50.0])


def test_released_joint_stands_still():
    rig = Rig(calculate_dynamics='true')
    rig.system.perform_command_mode_switch(['ja/velocity'], [])
    rig.command('ja/velocity', 2.0)
    rig.read()
    rig.command('ja/velocity', math.nan)
    rig.system.perform_command_mode_switch([], ['ja/velocity'])
    assert rig.read(*JA) == rig.read(*JA) == [0.5, 0.0, 0.0]


def test_two_modes_at_once_are_refused():
    rig = Rig(calculate_dynamics='true')
    with pytest.raises(HardwareError, match="joint 'ja' is to be commanded by position and velo"):
        rig.system.prepare_command_mode_switch(['ja/position', 'ja/velocity'], [])
    Rig().system.prepare_command_mode_switch(['ja/position', 'ja/velocity'], [])


def test_offset_between_command_and_state():
    rig = Rig(position_state_following_offset='0.25')
    rig.command('ja/position', 2.0)
    assert rig.read('ja/position') == rig.read('ja/position') == [2.25]


def test_offset_in_a_state_of_its_own():
    rig = Rig(
        position_state_following_offset='0.25', custom_interface_with_following_offset='actual'
    )
    rig.command('ja/position', 2.0)
    assert rig.read('ja/position', 'ja/actual') == [2.0, 2.25]


def test_disabled_commands_change_nothing():
    rig = Rig(disable_commands='true')
    rig.command('ja/position', 2.0)
    assert rig.read(*JA) == [0.5, 0.0, 0.0]
    assert 'Command propagation has been disabled' in rig.log.text


def test_sensors_and_gpios_can_be_commanded_for_tests():
    assert 'force/x' not in Rig().commands
    rig = Rig(mock_sensor_commands='true', mock_gpio_commands='True')
    rig.command('force/x', 9.0)
    rig.command('relay/temperature', 40.0)
    assert rig.read('force/x', 'relay/temperature', 'relay/coil') == [9.0, 40.0, 0.0]


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
