# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``amr_description/MujocoSystem``: the joints, sensors and GPIOs of a simulated robot.

It depends on :class:`~amr_description.control.world.World` only. A joint follows the command
interface that is claimed, from the first command on. Before that, and while nobody commands it, it
is held where it is, as with ``hold_joints`` in Gazebo. With ``<hold_joints>false</hold_joints>``
in the plugin's ``<gazebo>`` block, or ``<param name="hold_joints">false</param>`` in
``<hardware>``, it moves freely. A controller that claims several command interfaces of a joint
moves it by the position, else by the velocity: Gazebo, which takes the velocity, drifts away.

A state of a GPIO follows the command of its name. A command that is not simulated can be claimed
and has no effect, a state that is not simulated keeps its initial value; one line names them.
Transmissions are not applied, as in Gazebo: commands and states are those of the joints.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
import math

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import HardwareComponent
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    EFFORT,
    POSITION,
    QUANTITIES,
    StateInterface,
    VELOCITY,
)
from amr_description.control.world import JointGroup, World
from amr_description.errors import HardwareError, SimulationError
from amr_description.hardware.mock_system import MockPart
from amr_description.hardware.simulated_sensors import sensors_of
from amr_description.log import Log, Severity
from amr_description.model.gazebo.tags import GAZEBO_POSITION_GAIN, ros2_control_host_of
from amr_description.model.hardware_info import (
    HardwareInfo,
    HardwareType,
    InterfaceInfo,
)
from amr_description.text import quote_all, truth

COMMANDS = (POSITION, VELOCITY, EFFORT)
"""What a joint can follow; of several that are claimed, the first one."""
STATES = (*COMMANDS, ACCELERATION)
"""What is measured of a joint."""
_PID = '_pid'
_GAINS = ('kp', 'ki', 'kd', 'pos_kp', 'vel_kp')
"""Parameters of joints with gains, as MuJoCo's and Gazebo's hardware have them."""


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
        self._commands = [
            CommandInterface(joint.name, interface.name)
            for joint in self.info.joints
            for interface in _exported(joint.command_interfaces)
        ]
        self._states = [
            StateInterface.of(joint, interface)
            for joint in self.info.joints
            for interface in _exported(joint.state_interfaces)
        ]
        self._sources: list[tuple[list[StateInterface], Callable[[], list[float]]]] = []
        for quantity in STATES:
            states = [state for state in self._states if _quantity(state) == quantity]
            if states:
                group = world.joints([state.prefix for state in states])
                self._sources.append((states, _reader(group, quantity)))
        following = {joint.name for joint in self.info.joints if joint.mimic is not None}
        self._modes = CommandModes(
            [
                command
                for command in self._commands
                if _quantity(command) in COMMANDS and command.prefix not in following
            ]
        )
        self._commanded: list[_CommandedGroup] = []
        self._idle: tuple[str, ...] = ()
        self._idle_group = world.joints(self._modes.joints)
        sensors = sensors_of(self.info, world, self.log)
        self._sensors = sensors.instruments
        self._gpios = [MockPart(gpio) for gpio in self.info.gpios]
        # One list, as most robots have neither: a second loop would cost each cycle 1 %.
        self._updates = [
            *(sensor.read for sensor in self._sensors),
            *(_follower(gpio) for gpio in self._gpios),
        ]
        self._states += sensors.states
        self._states += [state for gpio in self._gpios for state in gpio.states.values()]
        if self.info.type is not HardwareType.SENSOR:
            self._commands += [each for gpio in self._gpios for each in gpio.commands.values()]
        self._warn_unsupported(sensors.others)

    def _warn_unsupported(self, sensor_states: Sequence[str]) -> None:
        name = f"hardware component '{self.info.name}':"
        missing = [*self._unsupported_of_joints(), *sensor_states, *self._unset_states_of_gpios()]
        if missing:
            self.log(
                Severity.WARN,
                f'{name} not simulated: {quote_all(missing)}; such states keep their initial '
                'values, such commands have no effect',
            )
        if self.info.transmissions:
            transmissions = quote_all([each.name for each in self.info.transmissions])
            self.log(
                Severity.INFO,
                f'{name} transmissions are not applied, as in Gazebo: {transmissions}; commands '
                'and states are those of the joints',
            )
        host = ros2_control_host_of(self._world.description)
        has_gains = any(key in joint.parameters for joint in self.info.joints for key in _GAINS)
        if has_gains or host.position_proportional_gain != GAZEBO_POSITION_GAIN:
            gains = 'gains of joints are' if has_gains else '<position_proportional_gain> is'
            self.log(
                Severity.WARN,
                f'{name} {gains} left out: positions are approached as fast as the limits of '
                'their joints allow',
            )

    def _unsupported_of_joints(self) -> Iterator[str]:
        """Yield the names of the joints' interfaces that are not simulated."""
        for joint in self.info.joints:
            for interfaces, known in (
                (joint.command_interfaces, COMMANDS),
                (joint.state_interfaces, STATES),
            ):
                for each in _exported(interfaces):
                    if QUANTITIES.get(each.name) not in known:
                        yield f'{joint.name}/{each.name}'

    def _unset_states_of_gpios(self) -> Iterator[str]:
        """Yield the names of the GPIOs' states that nothing sets."""
        for gpio in self._gpios:
            for state in gpio.states.values():
                if state.interface not in gpio.commands and math.isnan(state.value):
                    yield state.name

    def state_interfaces(self) -> Sequence[StateInterface]:
        """Return those of the tag, in its order."""
        return self._states

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """Return those of the tag, in its order."""
        return self._commands

    def configure(self) -> None:
        """Read the states, which become available now."""
        for gpio in self._gpios:
            gpio.set_initial_states()
        self.read(0, 0)
        self._restart_sensors()

    def activate(self) -> None:
        """Start with idle joints, without earlier commands."""
        self._stop()
        for gpio in self._gpios:
            gpio.set_initial_commands()

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
        unheeded = self._modes.unheeded(start)
        if unheeded:
            self.log(
                Severity.INFO,
                f"hardware component '{self.info.name}': {quote_all(unheeded)} has no effect: of "
                'several commands to a joint the position counts, else the velocity',
            )

    def reset(self, time: int) -> None:
        """Drop all commands, and repeat the noise from its start."""
        self._stop()
        for gpio in self._gpios:
            gpio.set_initial_commands()
            gpio.set_initial_states()
        self._restart_sensors()

    def read(self, time: int, period: int) -> None:
        """Read joints and sensors; the states of GPIOs follow their commands."""
        for states, read in self._sources:
            for state, value in zip(states, read(), strict=True):
                state.value = value
        for update in self._updates:
            update(period / NANOSECONDS)

    def write(self, time: int, period: int) -> None:
        """Command the joints; NaN keeps the previous command."""
        if self._idle and any(self._has_command(joint) for joint in self._idle):
            self._group_joints([joint for joint in self._idle if not self._has_command(joint)])
        try:
            for group in self._commanded:
                group.write()
            if self._idle:
                self._keep_idle()
        except SimulationError as cause:
            self._stop()
            raise HardwareError(f"hardware component '{self.info.name}': {cause}") from cause

    def _has_command(self, joint: str) -> bool:
        command = self._modes.followed(joint)
        return command is not None and not math.isnan(command.value)

    def _restart_sensors(self) -> None:
        for sensor in self._sensors:
            sensor.restart()

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
        for quantity in COMMANDS:
            commands = [each for each in busy if each is not None and _quantity(each) == quantity]
            if commands:
                group = self._world.joints([command.prefix for command in commands])
                self._commanded.append(_CommandedGroup(group, quantity, commands, targets))
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

    A joint with a single command interface follows it, claimed or not. Of several that were
    claimed at once, which one controller does, it follows the first by :data:`COMMANDS`.
    """

    def __init__(self, commands: Sequence[CommandInterface]) -> None:
        """``commands``: all command interfaces of the component."""
        self._commands = {command.name: command for command in commands}
        self._claimed: set[str] = set()
        self._by_joint: dict[str, list[CommandInterface]] = {}
        for command in commands:
            self._by_joint.setdefault(command.prefix, []).append(command)
        for own in self._by_joint.values():
            own.sort(key=lambda command: COMMANDS.index(_quantity(command)))

    def check(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        Check a switch of command interfaces.

        Args:
            start: names of the interfaces to claim.
            stop: names of the interfaces to release.

        Raises:
            HardwareError: a joint that is claimed already would be claimed by another interface.
        """
        modes = {
            self._commands[name].prefix: self._commands[name].interface
            for name in sorted(self._claimed - set(stop) - set(start))
        }
        for name in sorted(self._commands.keys() & set(start)):
            command = self._commands[name]
            other = modes.get(command.prefix)
            if other is not None:
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

    def unheeded(self, start: Sequence[str]) -> list[str]:
        """Return those of the interfaces just claimed that their joints do not follow."""
        names = [name for name in start if name in self._commands]
        followed = [self.followed(self._commands[name].prefix) for name in names]
        return [
            name
            for name, command in zip(names, followed, strict=True)
            if command is not None and command.name != name
        ]

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
            value = command.value
            if value == value:  # no NaN
                self._targets[index] = value
        self._group.command(self._interface, self._targets)

    def targets(self) -> Iterable[tuple[str, float]]:
        """Return the command in force, by name."""
        return zip((command.name for command in self._commands), self._targets, strict=True)


def _follower(gpio: MockPart) -> Callable[[float], None]:
    """Return what lets the states of a GPIO follow its commands."""
    return lambda period: gpio.follow()


def _reader(group: JointGroup, quantity: str) -> Callable[[], list[float]]:
    """Return what reads a quantity of STATES."""
    if quantity == POSITION:
        return group.positions
    if quantity == VELOCITY:
        return group.velocities
    return group.efforts if quantity == EFFORT else group.accelerations


def _quantity(handle: CommandInterface | StateInterface) -> str:
    """Return the quantity of an interface; '' if it is not simulated."""
    return QUANTITIES.get(handle.interface, '')


def _exported(interfaces: Sequence[InterfaceInfo]) -> Iterator[InterfaceInfo]:
    """Yield the interfaces as they are exported: ``position_pid`` as ``position``."""
    names = set()
    for interface in interfaces:
        name = QUANTITIES.get(interface.name, '') if interface.name.endswith(_PID) else ''
        exported = replace(interface, name=name) if name else interface
        if exported.name not in names:
            yield exported
        names.add(exported.name)


def _holds_joints(info: HardwareInfo, world: World) -> bool:
    """Return the parameter ``hold_joints``. Raises HardwareError: it is not a truth value."""
    text = info.parameters.get('hold_joints')
    if text is None:
        return ros2_control_host_of(world.description).hold_joints
    if (hold := truth(text)) is None:
        raise HardwareError(f"parameter 'hold_joints' is '{text}'; true or false is needed")
    return hold
