# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mock_components/GenericSystem``: hardware that does at once what it is told.

For testing controllers without physics. Parameters of its ``<hardware>`` block:

=========================================== =====================================================
``calculate_dynamics``                      integrate velocity and acceleration commands (false)
``position_state_following_offset``         added to the position state, rad or m (0.0)
``custom_interface_with_following_offset``  the state that gets position + offset instead ('')
``disable_commands``                        leave all states as they are (false)
``mock_sensor_commands``                    every sensor state can also be commanded (false)
``mock_gpio_commands``                      every GPIO state can also be commanded (false)
=========================================== =====================================================
"""

from collections.abc import Sequence
import math

from amr_description.control.contracts import HardwareComponent, Log, Severity, World
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    NANOSECONDS,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.errors import HardwareError
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo

_MODES = (POSITION, VELOCITY, ACCELERATION)
_TRUTH_VALUES = {'true': True, '1': True, 'false': False, '0': False}


class MockSystem(HardwareComponent):
    """States follow commands; see the module for the parameters."""

    def __init__(self, info: HardwareInfo, log: Log, world: World | None = None) -> None:
        """Needs no world. Raises HardwareError for a parameter that cannot be read."""
        super().__init__(info, log, world)
        self._with_dynamics = self._flag('calculate_dynamics')
        self._is_disabled = self._flag('disable_commands')
        offset = self._number('position_state_following_offset')
        custom = info.parameters.get('custom_interface_with_following_offset', '')
        mock_sensors, mock_gpios = map(self._flag, ('mock_sensor_commands', 'mock_gpio_commands'))
        self._joints = {joint.name: MockPart(joint, offset, custom) for joint in info.joints}
        self._parts = [
            *self._joints.values(),
            *(MockPart(sensor, commands_states=mock_sensors) for sensor in info.sensors),
            *(MockPart(gpio, commands_states=mock_gpios) for gpio in info.gpios),
        ]

    def state_interfaces(self) -> Sequence[StateInterface]:
        """As the tag declares them: joints, sensors, GPIOs."""
        return [state for part in self._parts for state in part.states.values()]

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """As the tag declares them, with the mocked ones of sensors and GPIOs."""
        return [command for part in self._parts for command in part.commands.values()]

    def configure(self) -> None:
        """Set every state to its initial value, 0.0 without one."""
        for part in self._parts:
            part.set_initial_values()
        if self._is_disabled:
            self.log(
                Severity.WARN,
                'Command propagation has been disabled - no values will be returned!',
            )

    def activate(self) -> None:
        """Forget commands of an earlier life."""
        for command in self.command_interfaces():
            command.value = math.nan

    def deactivate(self) -> None:
        """Stand still."""
        for joint in self._joints.values():
            joint.stop()

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """With dynamics, two modes on one joint are refused."""
        modes = self._modes(start)
        for joint, mode in modes:
            others = [other for name, other in modes if name == joint and other != mode]
            if self._with_dynamics and others:
                raise HardwareError(
                    f"hardware component '{self.info.name}': joint '{joint}' is to be commanded "
                    f'by {mode} and {others[0]} at once; with calculate_dynamics one of them will '
                    'do'
                )

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Integrate from what is claimed; what is released stands still."""
        for name in stop:
            joint, _ = name.rsplit('/', 1)
            if joint in self._joints:
                self._joints[joint].stop()
        for joint, mode in self._modes(start):
            self._joints[joint].mode = mode

    def _modes(self, names: Sequence[str]) -> list[tuple[str, str]]:
        """Joint and mode of each command that has one."""
        wanted = [name.rsplit('/', 1) for name in names]
        return [(j, mode) for j, mode in wanted if j in self._joints and mode in _MODES]

    def read(self, time: int, period: int) -> None:
        """Let the states follow. Raises HardwareError for an infinite command."""
        if self._is_disabled:
            return
        for part in self._parts:
            self._refuse_infinite(part)
        for part in self._parts:
            if not (self._with_dynamics and part.mode):
                part.follow()
            elif period > 0:
                part.integrate(period / NANOSECONDS)
            part.show()
        for joint in self._joints.values():
            self._follow_mimic(joint)

    def write(self, time: int, period: int) -> None:
        """Nothing to do: commands are taken by the next ``read``."""

    def _refuse_infinite(self, part: 'MockPart') -> None:
        for command in part.commands.values():
            if math.isinf(command.value):
                raise HardwareError(
                    f"hardware component '{self.info.name}': command '{command.name}' is "
                    f'{command.value}; a finite number is needed'
                )

    def _follow_mimic(self, joint: 'MockPart') -> None:
        """Position = offset + multiplier · source; its derivatives without the offset."""
        mimic = joint.info.mimic
        if mimic is None:
            return
        source = self._joints[mimic.joint].states
        for name, state in joint.states.items():
            if name in source:
                offset = mimic.offset if name == POSITION else 0.0
                state.value = offset + mimic.multiplier * source[name].value

    def _flag(self, name: str) -> bool:
        text = self.info.parameters.get(name, 'false')
        if text.lower() in _TRUTH_VALUES:
            return _TRUTH_VALUES[text.lower()]
        raise self._unreadable(name, text, 'true or false')

    def _number(self, name: str) -> float:
        text = self.info.parameters.get(name, '0.0')
        try:
            return float(text)
        except ValueError:
            raise self._unreadable(name, text, 'a number') from None

    def _unreadable(self, name: str, text: str, expected: str) -> HardwareError:
        return HardwareError(
            f"hardware component '{self.info.name}': parameter '{name}' is '{text}'; {expected} "
            'is needed'
        )


class MockPart:
    """One joint, sensor or GPIO: its cells, and the true values of a joint behind them."""

    def __init__(
        self,
        info: ComponentInfo,
        offset: float = 0.0,
        custom: str = '',
        commands_states: bool = False,
    ) -> None:
        """
        ``offset``: added to the position state, or to it in the state ``custom`` if that is given.
        ``commands_states``: every state can be commanded.
        """
        self.info = info
        self._offset, self._custom = offset, custom
        self.mode = ''
        self.states = {i.name: StateInterface(info.name, i.name) for i in info.state_interfaces}
        names = [interface.name for interface in info.command_interfaces]
        if commands_states:
            names += [name for name in self.states if name not in names]
        self.commands = {name: CommandInterface(info.name, name) for name in names}
        self._values = dict.fromkeys(_MODES, 0.0)

    def set_initial_values(self) -> None:
        """Go back to the initial values of the tag."""
        for interface in self.info.state_interfaces:
            value = interface.initial_value
            self._values[interface.name] = 0.0 if value is None else value
        self.show()

    def stop(self) -> None:
        """Stand still where it is, in no mode any more."""
        self.mode = ''
        self._values[VELOCITY] = self._values[ACCELERATION] = 0.0

    def follow(self) -> None:
        """Take over every command that is a number."""
        for name, command in self.commands.items():
            if not math.isnan(command.value):
                self._values[name] = command.value

    def integrate(self, dt: float) -> None:
        """
        Advance by ``dt`` (s, positive) in the present mode.

        Explicit Euler: the position moves with the velocity of before, and that with the
        acceleration of before; the command acts from the next call on.
        """
        command = self.commands[self.mode].value
        values = self._values
        before = values[POSITION], values[VELOCITY]
        if self.mode != POSITION:
            values[POSITION] += values[VELOCITY] * dt
        if self.mode == ACCELERATION:
            values[VELOCITY] += values[ACCELERATION] * dt
        if math.isnan(command):
            return
        values[self.mode] = command
        if self.mode == POSITION:
            values[VELOCITY] = (command - before[0]) / dt
        if self.mode != ACCELERATION:
            values[ACCELERATION] = (values[VELOCITY] - before[1]) / dt

    def show(self) -> None:
        """Write the values to the state cells, the offset added where it belongs."""
        for name, state in self.states.items():
            state.value = self._values[name]
        shifted = self._custom or POSITION
        if shifted in self.states:
            self.states[shifted].value = self._values[POSITION] + self._offset
