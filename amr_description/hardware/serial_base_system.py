# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``amr_description/SerialBaseSystem``: a wheeled robot with two motors behind a serial port.

The motor board implements :mod:`amr_description.hardware.serial_protocol`. In the URDF::

    <hardware>
      <plugin>amr_description/SerialBaseSystem</plugin>
      <param name="port">/dev/ttyUSB0</param>
      <param name="left_joints">joint_wheel_front_left joint_wheel_back_left</param>
      <param name="right_joints">joint_wheel_front_right joint_wheel_back_right</param>
    </hardware>

All parameters: :class:`~amr_description.hardware.serial_link.SerialParameters`. To try it
without a board: ``ros2 run amr_description motor_board``.

- **One motor for each side.** All joints of a side have the states of its encoder, and must get
  the same command: a motor cannot turn at two speeds. If they differ, or one is infinite, the
  component asks to be made inactive, and the motors stop. NaN is no command; a side without a
  command keeps the previous one.
- **Limited velocity.** Both sides are slowed down by the same factor, so that the robot keeps its
  curve.
- **Continuous positions.** They go on from where they were if the board comes back with its
  encoders at zero.
- **Lost connection.** ``read`` and ``write`` fail if the board is unplugged, does not answer,
  restarts, disarms its motors or sends noise. The component is then unconfigured;
  ``set_hardware_component_state`` connects it again.
"""

from collections.abc import Iterable, Sequence
import math
from typing import TypeVar

from amr_description.control.contracts import HardwareComponent, World
from amr_description.control.interfaces import (
    CommandInterface,
    Handle,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.errors import HardwareDeactivationError, HardwareError
from amr_description.hardware.serial_link import read_parameters, SerialBoard
from amr_description.hardware.serial_protocol import Arm, BoardMode, Disarm, Get, Set, State
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo

H = TypeVar('H', bound=Handle)

COMMANDS, STATES = (VELOCITY,), (POSITION, VELOCITY)


class SerialBaseSystem(HardwareComponent):
    """Two motors behind a serial port; see the module."""

    def __init__(self, info: HardwareInfo, log: Log, world: World | None = None) -> None:
        """
        Raises HardwareError: a parameter is invalid, or an interface is not supported.

        ``world`` is not used.
        """
        super().__init__(info, log, world)
        self._parameters = parameters = read_parameters(info, log)
        for component in (*info.sensors, *info.gpios):
            log(
                Severity.WARN,
                f"hardware component '{info.name}': {component.type} '{component.name}' is not on "
                'the motor board and has no interfaces',
            )
        left, right = self._joints_of_sides()
        self._left = MotorSide(info.name, left, parameters.left_reduction)
        self._right = MotorSide(info.name, right, parameters.right_reduction)
        self._sides = (self._left, self._right)
        self._board: SerialBoard | None = None
        self._is_active = False

    def _joints_of_sides(self) -> tuple[list[ComponentInfo], list[ComponentInfo]]:
        """Raises HardwareError unless the two lists name each joint once."""
        listed = (self._parameters.left_joints, self._parameters.right_joints)
        joints = {joint.name: joint for joint in self.info.joints}
        if sorted(listed[0] + listed[1]) != sorted(joints):
            raise HardwareError(
                f"hardware component '{self.info.name}': left_joints ({_names(listed[0])}) and "
                f'right_joints ({_names(listed[1])}) must name each joint of the block once; it '
                f'has {_names(joints)}'
            )
        left, right = ([joints[name] for name in names] for names in listed)
        return left, right

    def state_interfaces(self) -> Sequence[StateInterface]:
        """Return those of the tag, in its order."""
        return self._in_order(state for side in self._sides for state in side.states)

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """Return those of the tag, in its order."""
        return self._in_order(command for side in self._sides for command in side.commands)

    def _in_order(self, handles: Iterable[H]) -> list[H]:
        joints = [joint.name for joint in self.info.joints]
        return sorted(handles, key=lambda handle: joints.index(handle.prefix))

    # --- transitions -------------------------------------------------------------------------

    def configure(self) -> None:
        """Open the port, identify the board, and read its encoders. Raises HardwareError."""
        self.cleanup()
        self._board = board = SerialBoard(self._parameters, self.info.name)
        try:
            # An earlier host may have left it armed.
            self._state = board.ask(Disarm)
        except HardwareError:
            self.cleanup()
            raise
        found = board.description
        self._left.set_encoder(self._state.left_ticks, found.ticks)
        self._right.set_encoder(self._state.right_ticks, found.ticks)
        self._update_states(self._state)
        reach = min(found.velocity / abs(side.reduction) for side in self._sides)
        self._fastest = min(reach, self._parameters.max_velocity)
        self.log(
            Severity.INFO,
            f"motor board '{found.name}' on {self._parameters.port}: {found.ticks} ticks a turn; "
            f'wheels may turn at {self._fastest:g} rad/s',
        )

    def activate(self) -> None:
        """Arm the motors at rest, without earlier commands. Raises HardwareError."""
        for side in self._sides:
            side.forget_commands()
        board = self._connected()
        state = board.ask(Arm, round(self._parameters.watchdog_timeout * 1000))
        if state.mode is not BoardMode.ARMED:
            raise board.failure(f'does not arm its motors: it is in the mode {state.mode}')
        self._is_active = True

    def deactivate(self) -> None:
        """Stop the motors; if the board is lost, its watchdog does that."""
        self._is_active = False
        for side in self._sides:
            side.forget_commands()
        if self._board is not None and not self._board.is_lost:
            self._board.ask(Disarm)

    def cleanup(self) -> None:
        """Close the port and end its thread."""
        self._is_active = False
        board, self._board = self._board, None
        if board is not None:
            board.close()

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """A side of which a joint is claimed or released stops until the next command."""
        for side in self._sides:
            if any(command.name in (*start, *stop) for command in side.commands):
                side.forget_commands()

    # --- the cycle ---------------------------------------------------------------------------

    def read(self, time: int, period: int) -> None:
        """Update the states from the latest message. Raises HardwareError: the board is lost."""
        board = self._connected()
        state = board.state
        if state is not None and state is not self._state:
            self._check(state)
            self._update_states(state)
        if not self._is_active:
            board.post(Get)  # while active, every SET is answered by a state

    def write(self, time: int, period: int) -> None:
        """Send the commands, which feeds the board's watchdog. Raises HardwareError."""
        board = self._connected()
        left, right = self._left.target(), self._right.target()
        fastest = max(abs(left), abs(right))
        if fastest > self._fastest:
            self.log(
                Severity.WARN,
                f'wheels are commanded {fastest:.4g} rad/s, they may turn at {self._fastest:g}: '
                'both sides are slowed down',
                throttle=1.0,
            )
        factor = self._fastest / fastest if fastest > self._fastest else 1.0
        board.post(
            Set, left * factor * self._left.reduction, right * factor * self._right.reduction
        )

    def _update_states(self, state: State) -> None:
        self._state = state
        self._left.update_states(state.left_ticks, state.left)
        self._right.update_states(state.right_ticks, state.right)

    def _check(self, state: State) -> None:
        """Raises HardwareError: the board has restarted, or disarmed its motors."""
        if (state.uptime - self._state.uptime) % 2**32 >= 2**31:
            raise self._connected().failure('has restarted by itself, as after a power failure')
        if self._is_active and state.mode in (BoardMode.IDLE, BoardMode.FAULT):
            raise self._connected().failure(
                f'has let go of its motors: it is in the mode {state.mode}'
            )

    def _connected(self) -> SerialBoard:
        if self._board is None:
            raise HardwareError(f'the motor board on {self._parameters.port} is not connected')
        return self._board


class MotorSide:
    """
    One side of the robot: a motor, its encoder, its gear, and the joints that it turns.

    It converts between the interfaces of the joints (wheels, rad and rad/s) and the motor shaft
    (ticks and rad/s).
    """

    def __init__(self, hardware: str, joints: Sequence[ComponentInfo], reduction: float) -> None:
        """
        Create the interfaces of the joints.

        Args:
            hardware: name of the component.
            joints: of this side.
            reduction: turns of the shaft per turn of a wheel, negative for opposite directions.

        Raises:
            HardwareError: an interface is not supported.
        """
        self.reduction = reduction
        for joint in joints:
            for kind, interfaces, supported in (
                ('command', joint.command_interfaces, COMMANDS),
                ('state', joint.state_interfaces, STATES),
            ):
                for interface in interfaces:
                    if interface.name not in supported:
                        raise HardwareError(
                            f"hardware component '{hardware}': joint '{joint.name}': {kind} "
                            f"interface '{interface.name}' is asked; there are: "
                            f'{", ".join(supported)}'
                        )
        self.commands = [
            CommandInterface(j.name, interface.name)
            for j in joints
            for interface in j.command_interfaces
        ]
        self.states = [
            StateInterface(j.name, interface.name)
            for j in joints
            for interface in j.state_interfaces
        ]
        self._last_target = 0.0
        self._position = 0.0
        self._ticks = 0
        self._angle_per_tick = 0.0

    def set_encoder(self, ticks: int, ticks_per_turn: int) -> None:
        """Take the encoder of a newly connected board, at ``ticks`` for the present position."""
        self._ticks = ticks
        self._angle_per_tick = math.tau / (ticks_per_turn * self.reduction)

    def update_states(self, ticks: int, velocity: float) -> None:
        """
        Update the state interfaces.

        Args:
            ticks: the 32-bit counter of the encoder, which wraps around.
            velocity: of the shaft, rad/s.
        """
        moved = (ticks - self._ticks + 2**31) % 2**32 - 2**31
        self._ticks = ticks
        self._position += moved * self._angle_per_tick
        values = {POSITION: self._position, VELOCITY: velocity / self.reduction}
        for state in self.states:
            state.value = values[state.interface]

    def forget_commands(self) -> None:
        """Stand still until the next command."""
        self._last_target = 0.0
        for command in self.commands:
            command.value = math.nan

    def target(self) -> float:
        """
        Return the commanded velocity of the wheels, rad/s.

        Raises HardwareDeactivationError: it is infinite, or not the same for all joints.
        """
        given = [command for command in self.commands if not math.isnan(command.value)]
        if not given:
            return self._last_target
        first = given[0]
        for command in given:
            if math.isinf(command.value):
                raise HardwareDeactivationError(
                    f"command '{command.name}' is {command.value}; a finite number is needed"
                )
            if command.value != first.value:
                raise HardwareDeactivationError(
                    f"commands '{first.name}' ({first.value}) and '{command.name}' "
                    f'({command.value}) differ, but one motor turns both; give them the same value'
                )
        self._last_target = first.value
        return first.value


def _names(names: Iterable[str]) -> str:
    return ', '.join(names) or 'none'
