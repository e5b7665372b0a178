# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The joints and inertial measurement units of a simulated robot as a hardware component.

It knows :class:`~amr_description.control.world.World` and not what is behind it. A joint obeys the
command interface that is claimed, once the first command has come. Until then, and when nobody
commands it, it is held where it stands, as Gazebo's ``hold_joints`` does; with
``<hold_joints>false</hold_joints>`` in the plugin's ``<gazebo>`` block, or
``<param name="hold_joints">false</param>`` in ``<hardware>``, it swings freely.

Which of its command interfaces each joint obeys: the one that is claimed.
"""

from collections.abc import Callable, Iterable, Sequence
import math

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import HardwareComponent, Log, Severity
from amr_description.control.interfaces import (
    CommandInterface,
    EFFORT,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.world import JointGroup, World
from amr_description.errors import HardwareError, SimulationError
from amr_description.hardware.simulated_imu import imus_of
from amr_description.model.gazebo import GAZEBOS_GAIN, ros2_control_host_of
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo, InterfaceInfo
from amr_description.text import truth


class CommandModes:
    """
    The mode of each joint, told by claims.

    A joint with one command interface has no choice: it obeys that, claimed or not.
    """

    def __init__(self, commands: Sequence[CommandInterface]) -> None:
        """``commands``: all command interfaces of the component."""
        self._commands = {command.name: command for command in commands}
        self._claimed: set[str] = set()
        self._by_joint: dict[str, list[CommandInterface]] = {}
        for command in commands:
            self._by_joint.setdefault(command.prefix, []).append(command)

    def check(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Refuse two modes on one joint. Raises HardwareError."""
        modes: dict[str, str] = {}
        for name in sorted(self._after(start, stop)):
            command = self._commands[name]
            other = modes.setdefault(command.prefix, command.interface)
            if other != command.interface:
                raise HardwareError(
                    f"joint '{command.prefix}' is to be commanded by {other} and "
                    f'{command.interface} at once; one of them will do'
                )

    def switch(self, start: Sequence[str], stop: Sequence[str]) -> set[str]:
        """Take over what is claimed and released; return the joints concerned."""
        self._claimed = self._after(start, stop)
        names = self._commands.keys() & {*start, *stop}
        return {self._commands[name].prefix for name in names}

    def forget(self) -> None:
        """Nothing is claimed any more."""
        self._claimed.clear()

    def obeyed(self, joint: str) -> CommandInterface | None:
        """The command that the joint obeys; None if there are several and none is claimed."""
        commands = self._by_joint[joint]
        if len(commands) == 1:
            return commands[0]
        return next((command for command in commands if command.name in self._claimed), None)

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints with a command interface."""
        return tuple(self._by_joint)

    def _after(self, start: Sequence[str], stop: Sequence[str]) -> set[str]:
        return (self._claimed - set(stop)) | (self._commands.keys() & set(start))


STATES = (POSITION, VELOCITY, EFFORT)
COMMANDS = (POSITION, VELOCITY, EFFORT)


class MujocoSystem(HardwareComponent):
    """
    ``amr_description/MujocoSystem``: position, velocity and effort of joints, states and commands.
    """

    def __init__(self, info: HardwareInfo, log: Log, world: World | None) -> None:
        """Raises HardwareError: without a world, or for an interface that it does not have."""
        super().__init__(info, log, world)
        if world is None:
            raise HardwareError(
                f"hardware component '{info.name}': {info.plugin} needs a simulated world and "
                'there is none; start it in the simulator, or use mock_components/GenericSystem'
            )
        self._world = world
        try:
            self._holds_joints = _holds_joints(info, world)
            self._bind(world)
        except (SimulationError, HardwareError) as cause:
            raise HardwareError(f"hardware component '{info.name}': {cause}") from cause

    def _bind(self, world: World) -> None:
        joints = self.info.joints
        self._commands = [
            CommandInterface(joint.name, interface.name)
            for joint in joints
            for interface in _checked(joint, joint.command_interfaces, 'command', COMMANDS)
        ]
        self._states = [
            StateInterface(joint.name, interface.name)
            for joint in joints
            for interface in _checked(joint, joint.state_interfaces, 'state', STATES)
        ]
        self._sources: list[tuple[list[StateInterface], Callable[[], list[float]]]] = []
        for interface in STATES:
            cells = [state for state in self._states if state.interface == interface]
            if cells:
                group = world.joints([cell.prefix for cell in cells])
                read = {
                    POSITION: group.positions,
                    VELOCITY: group.velocities,
                    EFFORT: group.efforts,
                }[interface]
                self._sources.append((cells, read))
        self._imus = imus_of(self.info, world)
        self._warn_unsupported()
        self._states += [state for imu in self._imus for state in imu.states]
        self._modes = CommandModes(self._commands)
        self._followers: list[_Follower] = []
        self._idle: tuple[str, ...] = ()
        self._idle_group = world.joints(self._modes.joints)

    def _warn_unsupported(self) -> None:
        simulated = [imu.info for imu in self._imus]
        others = [sensor for sensor in self.info.sensors if sensor not in simulated]
        host = ros2_control_host_of(self._world.description)
        if host.position_proportional_gain != GAZEBOS_GAIN:
            self.log(
                Severity.WARN,
                f"hardware component '{self.info.name}': <position_proportional_gain> is left "
                'out: positions are approached as fast as the limits of their joints allow',
            )
        for component in (*others, *self.info.gpios):
            self.log(
                Severity.WARN,
                f"hardware component '{self.info.name}': {component.type} '{component.name}' is "
                'not simulated and has no interfaces',
            )

    def state_interfaces(self) -> Sequence[StateInterface]:
        """As the tag declares them, in its order."""
        return self._states

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """As the tag declares them, in its order."""
        return self._commands

    def configure(self) -> None:
        """Fill the state cells, so that what is available is also valid."""
        self.read(0, 0)
        self._restart_noise()

    def activate(self) -> None:
        """Leave the joints idle, and forget commands of an earlier life."""
        self._stop()

    def deactivate(self) -> None:
        """Leave the joints idle."""
        self._stop()

    def cleanup(self) -> None:
        """Nobody has a claim on it any more."""
        self._modes.forget()

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Two modes on one joint are refused. Raises HardwareError."""
        self._modes.check(start, stop)

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Joints that are released, or change hands, are idle until the first command."""
        self._rest(self._modes.switch(start, stop))

    def reset(self, time: int) -> None:
        """The world has put the joints back: forget all targets; what is measured is repeated."""
        self._stop()
        self._restart_noise()

    def read(self, time: int, period: int) -> None:
        """Take the joints' present state, and what the sensors measure."""
        for cells, read in self._sources:
            for cell, value in zip(cells, read(), strict=True):
                cell.value = value
        for imu in self._imus:
            imu.read(period / NANOSECONDS)

    def write(self, time: int, period: int) -> None:
        """Command the joints; NaN keeps the target of before."""
        if any(self._is_called(joint) for joint in self._idle):
            self._gather([joint for joint in self._idle if not self._is_called(joint)])
        try:
            for follower in self._followers:
                follower.write()
            self._keep_idle()
        except SimulationError as cause:
            self._stop()
            raise HardwareError(f"hardware component '{self.info.name}': {cause}") from cause

    def _is_called(self, joint: str) -> bool:
        """Whether there is a command for the joint."""
        command = self._modes.obeyed(joint)
        return command is not None and not math.isnan(command.value)

    def _restart_noise(self) -> None:
        for imu in self._imus:
            imu.restart()

    def _stop(self) -> None:
        self._rest(self._modes.joints)

    def _rest(self, joints: Iterable[str]) -> None:
        """Leave these joints idle, and forget what they were told."""
        resting = set(joints)
        for command in self._commands:
            if command.prefix in resting:
                command.value = math.nan
        resting.update(self._idle)
        self._gather([joint for joint in self._modes.joints if joint in resting])
        self._keep_idle()

    def _gather(self, idle: Sequence[str]) -> None:
        """Sort the joints anew into idle ones and groups that follow one kind of command."""
        targets = {name: target for each in self._followers for name, target in each.targets()}
        busy = [self._modes.obeyed(joint) for joint in self._modes.joints if joint not in idle]
        self._followers = []
        for interface in COMMANDS:
            commands = [each for each in busy if each is not None and each.interface == interface]
            if commands:
                group = self._world.joints([command.prefix for command in commands])
                self._followers.append(_Follower(group, interface, commands, targets))
        self._idle = tuple(idle)
        self._idle_group = self._world.joints(self._idle)

    def _keep_idle(self) -> None:
        if self._holds_joints:
            self._idle_group.hold()
        else:
            self._idle_group.release()


class _Follower:
    """Joints that follow one kind of command."""

    def __init__(
        self,
        group: JointGroup,
        interface: str,
        commands: Sequence[CommandInterface],
        targets: dict[str, float],
    ) -> None:
        """``targets``: the last commands that were numbers, by name, where there were some."""
        self._group, self._interface, self._commands = group, interface, commands
        self._targets = [targets.get(command.name, command.value) for command in commands]

    def write(self) -> None:
        """Raises SimulationError."""
        for index, command in enumerate(self._commands):
            if not math.isnan(command.value):
                self._targets[index] = command.value
        self._group.command(self._interface, self._targets)

    def targets(self) -> Iterable[tuple[str, float]]:
        """The last command of each joint that was a number."""
        return zip((command.name for command in self._commands), self._targets, strict=True)


def _checked(
    joint: ComponentInfo,
    interfaces: Sequence[InterfaceInfo],
    kind: str,
    supported: Sequence[str],
) -> Sequence[InterfaceInfo]:
    for interface in interfaces:
        if interface.name not in supported:
            raise HardwareError(
                f"joint '{joint.name}': {kind} interface '{interface.name}' is asked; there are: "
                f'{", ".join(supported)}'
            )
    return interfaces


def _holds_joints(info: HardwareInfo, world: World) -> bool:
    """Raises HardwareError for a text that is no truth value."""
    text = info.parameters.get('hold_joints')
    if text is None:
        return ros2_control_host_of(world.description).hold_joints
    if (hold := truth(text)) is None:
        raise HardwareError(f"parameter 'hold_joints' is '{text}'; true or false is needed")
    return hold
