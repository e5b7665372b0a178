# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mock_components/GenericSystem``: hardware whose states follow commands at once.

For testing controllers without physics: every read sets the states to the commands. The state of a
joint starts at its ``initial_value`` or at 0.0, any other one at its ``initial_value`` or unset. A
command that is not set (NaN) changes nothing; an infinite one is an error.

Parameters of its ``<hardware>`` block:

=========================================== =====================================================
``calculate_dynamics``                      integrate velocity and acceleration commands (false)
``position_state_following_offset``         added to a position command, rad or m (0.0)
``custom_interface_with_following_offset``  the state that gets command + offset instead ('')
``disable_commands``                        leave all states as they are (false)
``mock_sensor_commands``                    every sensor state can also be commanded (false)
``mock_gpio_commands``                      every GPIO state can also be commanded (false)
=========================================== =====================================================
"""

from collections.abc import Sequence
import math

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import HardwareComponent, World
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.joint_limits import value_at_rest
from amr_description.errors import HardwareError
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import ComponentInfo, ComponentType, HardwareInfo
from amr_description.text import truth

MODES = (POSITION, VELOCITY, ACCELERATION)
"""The command interfaces of a joint with ``calculate_dynamics``."""


class MockSystem(HardwareComponent):
    """States follow commands; see the module for the parameters."""

    def __init__(self, info: HardwareInfo, log: Log, world: World | None = None) -> None:
        """Raises HardwareError: a parameter is invalid. ``world`` is not used."""
        super().__init__(info, log, world)
        self._with_dynamics = self._flag('calculate_dynamics')
        self._is_disabled = self._flag('disable_commands')
        self._was_configured = False
        offset = self._number('position_state_following_offset')
        custom = info.parameters.get('custom_interface_with_following_offset', '')
        self._check_custom_interface(custom)
        mock_sensors, mock_gpios = map(self._flag, ('mock_sensor_commands', 'mock_gpio_commands'))
        self._joints = {joint.name: MockPart(joint, offset, custom) for joint in info.joints}
        self._joint_commands = {
            command.name: (name, command.interface)
            for name, joint in self._joints.items()
            for command in joint.commands.values()
        }
        self._parts = [
            *self._joints.values(),
            *(MockPart(sensor, commands_states=mock_sensors) for sensor in info.sensors),
            *(MockPart(gpio, commands_states=mock_gpios) for gpio in info.gpios),
        ]

    def state_interfaces(self) -> Sequence[StateInterface]:
        """Return those of the tag: joints, sensors, GPIOs."""
        return [state for part in self._parts for state in part.states.values()]

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """Return those of the tag, and the mocked ones of sensors and GPIOs."""
        return [command for part in self._parts for command in part.commands.values()]

    def configure(self) -> None:
        """Start at the initial values, the first time; later, keep the states."""
        if not self._was_configured:
            for part in self._parts:
                part.set_initial_states()
        self._was_configured = True

    def activate(self) -> None:
        """Drop earlier commands."""
        for part in self._parts:
            part.set_initial_commands()

    def deactivate(self) -> None:
        """Stop the joints."""
        for joint in self._joints.values():
            joint.stop()
            joint.set_initial_commands()

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Refuse several modes for a joint with dynamics. Raises HardwareError."""
        if not self._with_dynamics:
            return
        for joint, names in self._by_joint(start).items():
            modes = [name for name in names if name in MODES]
            if not modes:
                raise HardwareError(
                    f"Joint '{joint}' has to have 'position', 'velocity', or 'acceleration' "
                    f'interface! Only {", ".join(names)} is to be commanded'
                )
            if len(modes) > 1:
                raise HardwareError(
                    f"Got multiple ({len(modes)}) starting interfaces for joint '{joint}' - this "
                    f'is not supported! With calculate_dynamics one of {", ".join(modes)} will do'
                )

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Set the modes of claimed joints; stop the released ones."""
        for joint, names in self._by_joint(stop).items():
            self._joints[joint].stop()
            for name in names:
                if name != POSITION:
                    self._joints[joint].commands[name].value = value_at_rest(name)
        for joint, names in self._by_joint(start).items():
            modes = [name for name in names if name in MODES]
            self._joints[joint].mode = modes[0] if modes else self._joints[joint].mode

    def _by_joint(self, interfaces: Sequence[str]) -> dict[str, list[str]]:
        """Group command interfaces by joint."""
        found: dict[str, list[str]] = {}
        for interface in interfaces:
            if interface in self._joint_commands:
                joint, name = self._joint_commands[interface]
                found.setdefault(joint, []).append(name)
        return found

    def read(self, time: int, period: int) -> None:
        """Let the states follow. Raises HardwareError for an infinite command."""
        if self._is_disabled:
            self.log(
                Severity.WARN,
                'Command propagation is disabled - no values will be returned!',
                throttle=math.inf,
            )
            return
        for command in self.command_interfaces():
            self._refuse_infinite(command)
        for part in self._parts:
            if not (self._with_dynamics and part.info.type is ComponentType.JOINT):
                part.follow()
            elif period > 0:
                part.integrate(period / NANOSECONDS)
        for joint in self._joints.values():
            if joint.info.mimic is not None:
                joint.mimic(self._joints[joint.info.mimic.joint])

    def write(self, time: int, period: int) -> None:
        """Do nothing: the next ``read`` takes the commands."""

    def _refuse_infinite(self, command: CommandInterface) -> None:
        if math.isinf(command.value):
            raise HardwareError(
                f"hardware component '{self.info.name}': command '{command.name}' is "
                f'{command.value}; a finite number is needed'
            )

    def _check_custom_interface(self, custom: str) -> None:
        states = {state.name for joint in self.info.joints for state in joint.state_interfaces}
        if custom and custom not in states:
            self.log(
                Severity.WARN,
                f"Custom interface with following offset '{custom}' does not exist. Offset will "
                'not be applied',
            )

    def _flag(self, name: str) -> bool:
        text = self.info.parameters.get(name, 'false')
        if (flag := truth(text)) is None:
            raise self._unreadable(name, text, 'true or false')
        return flag

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
    """
    A joint, sensor or GPIO: its interfaces, and how its states follow its commands.

    A joint has a position, velocity and acceleration even without state interfaces for them.
    """

    def __init__(
        self,
        info: ComponentInfo,
        offset: float = 0.0,
        custom: str = '',
        commands_states: bool = False,
    ) -> None:
        """
        Take a description.

        Args:
            info: of the joint, sensor or GPIO.
            offset: added to the position command, rad or m.
            custom: the state that gets command + offset instead of the position.
            commands_states: every state can be commanded.
        """
        self.info = info
        self.mode = POSITION
        self.states = {i.name: StateInterface.of(info, i) for i in info.state_interfaces}
        wanted = {interface.name: interface for interface in info.command_interfaces}
        if commands_states:
            wanted = {i.name: i for i in info.state_interfaces} | wanted
        self._initial = {name: CommandInterface.of(info, i).value for name, i in wanted.items()}
        self.commands = {name: CommandInterface.of(info, i) for name, i in wanted.items()}
        self._offset, self._custom = offset, custom
        self._values = dict.fromkeys(MODES, 0.0)

    def set_initial_states(self) -> None:
        """Set the states to the initial values of the tag; those of joints default to 0.0."""
        is_joint = self.info.type is ComponentType.JOINT
        self._values = dict.fromkeys(MODES, 0.0)
        for interface in self.info.state_interfaces:
            first = StateInterface.of(self.info, interface).value
            self._values[interface.name] = 0.0 if is_joint and math.isnan(first) else first
        if not self._custom:
            self._values[POSITION] += self._offset
        self._update_states()

    def set_initial_commands(self) -> None:
        """Set the commands to the initial values of the tag, or unset."""
        for name, command in self.commands.items():
            command.value = self._initial[name]

    def stop(self) -> None:
        """Stop at the present position."""
        self._values[VELOCITY] = self._values[ACCELERATION] = 0.0

    def follow(self) -> None:
        """Set the states to the commands that are set."""
        self._mirror(skipped=(POSITION,))
        position = self._commanded(POSITION)
        if position is not None:
            self._values[POSITION] = position + self._own_offset
        self._update_states()

    def integrate(self, dt: float) -> None:
        """
        Advance by ``dt`` (s, positive) in the present mode; other commands as in :meth:`follow`.

        Backward Euler, ``v += a·dt; x += v·dt``, after the quantity of the mode was set to its
        command; the derivatives of that quantity are differences over ``dt``.
        """
        self._mirror(skipped=MODES)
        values, command = self._values, self._commanded(self.mode)
        before = values[POSITION], values[VELOCITY]
        if self.mode == POSITION:
            if command is not None:
                values[POSITION] = command + self._own_offset
                values[VELOCITY] = (values[POSITION] - before[0]) / dt
        else:
            if command is not None:
                values[self.mode] = command
            if self.mode == ACCELERATION:
                values[VELOCITY] += values[ACCELERATION] * dt
            values[POSITION] += values[VELOCITY] * dt
        if self.mode != ACCELERATION and command is not None:
            values[ACCELERATION] = (values[VELOCITY] - before[1]) / dt
        self._update_states()

    def mimic(self, source: 'MockPart') -> None:
        """Follow ``source``: offset + multiplier · position; derivatives without the offset."""
        mimic = self.info.mimic
        assert mimic is not None
        for name in MODES:
            offset = mimic.offset if name == POSITION else 0.0
            self._values[name] = offset + mimic.multiplier * source._values[name]
        self._update_states()

    @property
    def _own_offset(self) -> float:
        return 0.0 if self._custom else self._offset

    def _commanded(self, name: str) -> float | None:
        command = self.commands.get(name)
        return command.value if command is not None and command.is_set else None

    def _mirror(self, skipped: tuple[str, ...]) -> None:
        for name, command in self.commands.items():
            if name not in skipped and command.is_set:
                self._values[name] = command.value
        position = self._commanded(POSITION)
        if self._custom in self.states and position is not None:
            self._values[self._custom] = position + self._offset

    def _update_states(self) -> None:
        for name, state in self.states.items():
            state.value = self._values[name]
