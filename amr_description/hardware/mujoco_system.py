# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``amr_description/MujocoSystem``: the joints and inertial measurement units of a simulated robot.

It depends on :class:`~amr_description.control.world.World` only. A joint follows the command
interface that is claimed, from the first command on. Before that, and while nobody commands it, it
is held where it is, as with ``hold_joints`` in Gazebo. With ``<hold_joints>false</hold_joints>``
in the plugin's ``<gazebo>`` block, or ``<param name="hold_joints">false</param>`` in
``<hardware>``, it moves freely.
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
from amr_description.model.gazebo import GAZEBO_POSITION_GAIN, ros2_control_host_of
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo, InterfaceInfo
from amr_description.text import truth

STATES = COMMANDS = (POSITION, VELOCITY, EFFORT)
"""The interfaces of a joint that are supported."""


class MujocoSystem(HardwareComponent):
    """Position, velocity and effort of joints, as states and commands; see the module."""

    def __init__(self, info: HardwareInfo, log: Log, world: World | None) -> None:
        """Raises HardwareError: there is no world, or an interface that is not supported."""
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
        """Connect the interfaces of the tag with the world."""
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
            states = [state for state in self._states if state.interface == interface]
            if states:
                group = world.joints([state.prefix for state in states])
                read = {
                    POSITION: group.positions,
                    VELOCITY: group.velocities,
                    EFFORT: group.efforts,
                }[interface]
                self._sources.append((states, read))
        self._imus = imus_of(self.info, world)
        self._warn_unsupported()
        self._states += [state for imu in self._imus for state in imu.states]
        self._modes = CommandModes(self._commands)
        self._commanded: list[_CommandedGroup] = []
        self._idle: tuple[str, ...] = ()
        self._idle_group = world.joints(self._modes.joints)

    def _warn_unsupported(self) -> None:
        simulated = [imu.info for imu in self._imus]
        others = [sensor for sensor in self.info.sensors if sensor not in simulated]
        host = ros2_control_host_of(self._world.description)
        if host.position_proportional_gain != GAZEBO_POSITION_GAIN:
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
        """Return those of the tag, in its order."""
        return self._states

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """Return those of the tag, in its order."""
        return self._commands

    def configure(self) -> None:
        """Read the states, which become available now."""
        self.read(0, 0)
        self._restart_noise()

    def activate(self) -> None:
        """Start with idle joints, without earlier commands."""
        self._stop()

    def deactivate(self) -> None:
        """Leave the joints idle."""
        self._stop()

    def cleanup(self) -> None:
        """Drop the claims."""
        self._modes.forget()

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Refuse two command interfaces on one joint. Raises HardwareError."""
        self._modes.check(start, stop)

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Joints that are claimed or released are idle until the first command."""
        self._make_idle(self._modes.switch(start, stop))

    def reset(self, time: int) -> None:
        """Drop all commands, and repeat the noise from its start."""
        self._stop()
        self._restart_noise()

    def read(self, time: int, period: int) -> None:
        """Read joints and sensors."""
        for states, read in self._sources:
            for state, value in zip(states, read(), strict=True):
                state.value = value
        for imu in self._imus:
            imu.read(period / NANOSECONDS)

    def write(self, time: int, period: int) -> None:
        """Command the joints; NaN keeps the previous command."""
        if any(self._has_command(joint) for joint in self._idle):
            self._group_joints([joint for joint in self._idle if not self._has_command(joint)])
        try:
            for group in self._commanded:
                group.write()
            self._keep_idle()
        except SimulationError as cause:
            self._stop()
            raise HardwareError(f"hardware component '{self.info.name}': {cause}") from cause

    def _has_command(self, joint: str) -> bool:
        command = self._modes.followed(joint)
        return command is not None and not math.isnan(command.value)

    def _restart_noise(self) -> None:
        for imu in self._imus:
            imu.restart()

    def _stop(self) -> None:
        self._make_idle(self._modes.joints)

    def _make_idle(self, joints: Iterable[str]) -> None:
        """Make joints idle, and drop their commands."""
        idle = set(joints)
        for command in self._commands:
            if command.prefix in idle:
                command.value = math.nan
        idle.update(self._idle)
        self._group_joints([joint for joint in self._modes.joints if joint in idle])
        self._keep_idle()

    def _group_joints(self, idle: Sequence[str]) -> None:
        """Divide the joints into idle ones and groups that follow one kind of command."""
        targets = {name: target for each in self._commanded for name, target in each.targets()}
        busy = [self._modes.followed(joint) for joint in self._modes.joints if joint not in idle]
        self._commanded = []
        for interface in COMMANDS:
            commands = [each for each in busy if each is not None and each.interface == interface]
            if commands:
                group = self._world.joints([command.prefix for command in commands])
                self._commanded.append(_CommandedGroup(group, interface, commands, targets))
        self._idle = tuple(idle)
        self._idle_group = self._world.joints(self._idle)

    def _keep_idle(self) -> None:
        if self._holds_joints:
            self._idle_group.hold()
        else:
            self._idle_group.release()


class CommandModes:
    """
    The command interface that each joint follows: the claimed one.

    A joint with a single command interface follows it, claimed or not.
    """

    def __init__(self, commands: Sequence[CommandInterface]) -> None:
        """``commands``: all command interfaces of the component."""
        self._commands = {command.name: command for command in commands}
        self._claimed: set[str] = set()
        self._by_joint: dict[str, list[CommandInterface]] = {}
        for command in commands:
            self._by_joint.setdefault(command.prefix, []).append(command)

    def check(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        Check a switch of command interfaces.

        Args:
            start: names of the interfaces to claim.
            stop: names of the interfaces to release.

        Raises:
            HardwareError: two interfaces of one joint would be claimed.
        """
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
        """Carry out a switch, arguments as above; return the joints concerned."""
        self._claimed = self._after(start, stop)
        names = self._commands.keys() & {*start, *stop}
        return {self._commands[name].prefix for name in names}

    def forget(self) -> None:
        """Drop all claims."""
        self._claimed.clear()

    def followed(self, joint: str) -> CommandInterface | None:
        """Return the command that a joint follows; None: it has several, none of them claimed."""
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


class _CommandedGroup:
    """Joints that follow one kind of command."""

    def __init__(
        self,
        group: JointGroup,
        interface: str,
        commands: Sequence[CommandInterface],
        targets: dict[str, float],
    ) -> None:
        """``targets``: earlier commands by name, in force where there is no new one."""
        self._group, self._interface, self._commands = group, interface, commands
        self._targets = [targets.get(command.name, command.value) for command in commands]

    def write(self) -> None:
        """Command the joints. Raises SimulationError."""
        for index, command in enumerate(self._commands):
            if not math.isnan(command.value):
                self._targets[index] = command.value
        self._group.command(self._interface, self._targets)

    def targets(self) -> Iterable[tuple[str, float]]:
        """Return the command in force, by name."""
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
    """Return the parameter ``hold_joints``. Raises HardwareError: it is not a truth value."""
    text = info.parameters.get('hold_joints')
    if text is None:
        return ros2_control_host_of(world.description).hold_joints
    if (hold := truth(text)) is None:
        raise HardwareError(f"parameter 'hold_joints' is '{text}'; true or false is needed")
    return hold
