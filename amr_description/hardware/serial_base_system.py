# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``amr_description/SerialBaseSystem``: a robot on wheels whose two sides a motor board drives.

The board speaks :mod:`amr_description.hardware.serial_protocol` on a serial port. In the URDF::

    <hardware>
      <plugin>amr_description/SerialBaseSystem</plugin>
      <param name="port">/dev/ttyUSB0</param>
      <param name="left_joints">joint_wheel_front_left joint_wheel_back_left</param>
      <param name="right_joints">joint_wheel_front_right joint_wheel_back_right</param>
    </hardware>

All parameters: :class:`~amr_description.hardware.serial_link.SerialParameters`. To try it
without a board: ``ros2 run amr_description motor_board``.

- **One motor a side.** All joints of a side show its encoder, and must be commanded alike: a motor
  cannot turn at two speeds. Where they differ, or one is infinite, the component asks to be made
  inactive: the motors stop. NaN is no command; a side without one keeps the one of before.
- **Too fast.** Both sides are slowed down by the same factor, so that the robot keeps its curve.
- **Positions do not jump.** They go on where they were when the board comes back with its encoders
  at zero.
- **A board that goes away**, falls silent, restarts, lets its motors go or sends noise makes
  ``read`` and ``write`` fail. The component is then unconfigured; ``set_hardware_component_state``
  connects it again.

One side of a robot on wheels: a motor, its encoder, its gear, and the joints that it turns.
"""

from collections.abc import Iterable, Sequence
import math

from amr_description.control.contracts import HardwareComponent, Log, Severity, World
from amr_description.control.interfaces import (
    CommandInterface,
    Handle,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.errors import HardwareDeactivationError, HardwareError
from amr_description.hardware.serial_link import read_parameters, SerialBoard
from amr_description.hardware.serial_protocol import Arm, Disarm, Get, Mode, Set, State
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo

COMMANDS, STATES = (VELOCITY,), (POSITION, VELOCITY)


class MotorSide:
    """
    Between the cells of the joints (wheels, rad and rad/s) and the motor shaft (ticks and rad/s).

    ``reduction``: turns of the shaft per turn of a wheel, negative where they turn against each
    other.
    """

    def __init__(self, hardware: str, joints: Sequence[ComponentInfo], reduction: float) -> None:
        """Raises HardwareError for an interface that a motor does not have."""
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
        self._target = 0.0
        self._position = 0.0
        self._ticks = 0
        self._angle_per_tick = 0.0

    def rebase(self, ticks: int, ticks_per_turn: int) -> None:
        """The encoder stands at ``ticks`` where the wheel is now, which does not move by this."""
        self._ticks = ticks
        self._angle_per_tick = math.tau / (ticks_per_turn * self.reduction)

    def show(self, ticks: int, velocity: float) -> None:
        """
        Write what the encoder says to the states.

        ``ticks``: its 32-bit counter, which wraps around. ``velocity``: of the shaft, rad/s.
        """
        moved = (ticks - self._ticks + 2**31) % 2**32 - 2**31
        self._ticks = ticks
        self._position += moved * self._angle_per_tick
        values = {POSITION: self._position, VELOCITY: velocity / self.reduction}
        for state in self.states:
            state.value = values[state.interface]

    def forget(self) -> None:
        """Want to stand still, until the next command."""
        self._target = 0.0
        for command in self.commands:
            command.value = math.nan

    def wanted(self) -> float:
        """
        Return the velocity that the wheels are commanded, rad/s.

        Raises HardwareDeactivationError when it is infinite, or not the same for all.
        """
        given = [command for command in self.commands if not math.isnan(command.value)]
        if not given:
            return self._target
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
        self._target = first.value
        return self._target


class SerialBaseSystem(HardwareComponent):
    """Two motors behind a serial port; see the module."""

    def __init__(self, info: HardwareInfo, log: Log, world: World | None = None) -> None:
        """Needs no world. Raises HardwareError for a parameter or an interface it cannot do."""
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
        """Raises HardwareError unless every joint is on one side, and every name is a joint."""
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
        """As the tag declares them, in its order."""
        return self._in_order(state for side in self._sides for state in side.states)

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """As the tag declares them, in its order."""
        return self._in_order(command for side in self._sides for command in side.commands)

    def _in_order[H: Handle](self, handles: Iterable[H]) -> list[H]:
        joints = [joint.name for joint in self.info.joints]
        return sorted(handles, key=lambda handle: joints.index(handle.prefix))

    # --- transitions -------------------------------------------------------------------------

    def configure(self) -> None:
        """Open the port, learn who is there, and read its encoders. Raises HardwareError."""
        self.cleanup()
        self._board = board = SerialBoard(self._parameters, self.info.name)
        try:
            # A host before us may have left it armed.
            self._state = board.ask(Disarm)
        except HardwareError:
            self.cleanup()
            raise
        found = board.description
        self._left.rebase(self._state.left_ticks, found.ticks)
        self._right.rebase(self._state.right_ticks, found.ticks)
        self._show(self._state)
        reach = min(found.velocity / abs(side.reduction) for side in self._sides)
        self._fastest = min(reach, self._parameters.max_velocity)
        self.log(
            Severity.INFO,
            f"motor board '{found.name}' on {self._parameters.port}: {found.ticks} ticks a turn; "
            f'wheels may turn at {self._fastest:g} rad/s',
        )

    def activate(self) -> None:
        """Arm the motors at rest, and forget commands of an earlier life. Raises HardwareError."""
        for side in self._sides:
            side.forget()
        board = self._connected()
        state = board.ask(Arm, round(self._parameters.watchdog_timeout * 1000))
        if state.mode is not Mode.ARMED:
            raise board.lost(f'does not arm its motors: it is in the mode {state.mode}')
        self._is_active = True

    def deactivate(self) -> None:
        """Stop the motors; nothing to do where the board is lost, as its watchdog does it."""
        self._is_active = False
        for side in self._sides:
            side.forget()
        if self._board is not None and not self._board.is_lost:
            self._board.ask(Disarm)

    def cleanup(self) -> None:
        """Close the port and end its thread."""
        self._is_active = False
        board, self._board = self._board, None
        if board is not None:
            board.close()

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """A side of which a joint is released, or changes hands, stops until the next command."""
        for side in self._sides:
            if any(command.name in (*start, *stop) for command in side.commands):
                side.forget()

    # --- the cycle ---------------------------------------------------------------------------

    def read(self, time: int, period: int) -> None:
        """Show the latest state that came. Raises HardwareError when the board is lost."""
        board = self._connected()
        state = board.state
        if state is not self._state:
            self._check(state)
            self._show(state)
        if not self._is_active:
            board.post(Get)  # while active, the answer to every SET is a state

    def write(self, time: int, period: int) -> None:
        """Send the commands, which feeds the board's watchdog. Raises HardwareError."""
        board = self._connected()
        left, right = self._left.wanted(), self._right.wanted()
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

    def _show(self, state: State) -> None:
        self._state = state
        self._left.show(state.left_ticks, state.left)
        self._right.show(state.right_ticks, state.right)

    def _check(self, state: State) -> None:
        """Raises HardwareError when the board is not in the state that we left it in."""
        if (state.uptime - self._state.uptime) % 2**32 >= 2**31:
            raise self._connected().lost('has restarted by itself, as after a power failure')
        if self._is_active and state.mode in (Mode.IDLE, Mode.FAULT):
            raise self._connected().lost(
                f'has let go of its motors: it is in the mode {state.mode}'
            )

    def _connected(self) -> SerialBoard:
        if self._board is None:
            raise HardwareError(f'the motor board on {self._parameters.port} is not connected')
        return self._board


def _names(names: Iterable[str]) -> str:
    return ', '.join(names) or 'none'
