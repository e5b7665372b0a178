# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
twist_mux_controller: of several velocity commands the one of the highest priority, for a drive.

It stands in the chain before a drive, whose references it commands. Each of ``cmd_vel_inputs`` is
a topic (TwistStamped) with a priority, and a timeout, after which the next one counts; with none
that counts the drive is commanded to stand. ``~/source`` (std_msgs/String) tells which one does.

Differences from husarion_controllers:

- of inputs with the same priority the first by name counts;
- an input whose latest command is not finite does not count (there: its last one stays in force);
- on deactivation the drive is commanded to stand.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    Input,
    Output,
    Port,
    Qos,
)
from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.command_reception import (
    CommandReception,
    HOLONOMIC,
    ignore_commands,
    PLANAR,
)
from amr_description.controllers.drives.wheeled_drive import STAMPED_TWIST
from amr_description.errors import ControllerError
from amr_description.log import Log, Severity
from amr_description.parameters import keyed_group, parameter

_NONE = 'not_published'
_SOURCE_QOS = Qos(depth=1, reliability='reliable', durability='transient_local')


@dataclass(frozen=True)
class CmdVelInputParameters:
    """One of the inputs."""

    topic: str = parameter('', 'Topic of the commands; empty: <name of the input>/cmd_vel')
    timeout: float = parameter(0.5, 'Age at which a command expires', unit='s', minimum=0.0)
    priority: int = parameter(0, 'The highest counts', minimum=0, maximum=255)


@dataclass(frozen=True)
class TwistMuxControllerParameters:
    """The table of twist_mux_controller/TwistMuxController."""

    holonomic: bool = parameter(False, 'Whether the drive moves sideways, too')
    cmd_vel_inputs: Mapping[str, CmdVelInputParameters] = keyed_group(
        'cmd_vel_inputs', '', CmdVelInputParameters
    )
    command_interface_linear_x: str = parameter('linear/x/velocity', 'Reference ahead, m/s')
    command_interface_linear_y: str = parameter('linear/y/velocity', 'Reference to the left, m/s')
    command_interface_angular_z: str = parameter('angular/z/velocity', 'Reference of turns, rad/s')


class _CmdVelInput:
    """One of the inputs."""

    def __init__(
        self, name: str, parameters: CmdVelInputParameters, axes: tuple[str, ...], log: Log
    ) -> None:
        self.name = name
        self._timeout = round(parameters.timeout * NANOSECONDS)
        self._reception = CommandReception(self._timeout, log, axes)
        topic = parameters.topic or f'{name}/cmd_vel'
        self.port: Input[TwistSample] = Input(Port(topic, STAMPED_TWIST, sample=TwistSample))

    def receive(self, now: int) -> None:
        """Take what has come; ``now``: the time that the sender's clock can show, ns."""
        self._reception.receive(self.port.drain(), now)

    def in_force(self, time: int) -> Sequence[float] | None:
        """Return the twist (m/s, rad/s) to drive at ``time``, ns; None: it does not count."""
        if self._reception.age(time) >= self._timeout:
            return None
        return self._reception.in_force(time)

    def forget(self, time: int) -> None:
        """Drop what there is, and what waits."""
        self._reception.discard((self.port,), time)


class TwistMuxController(Controller):
    """Chooses at every update; see the module."""

    parameters_type = TwistMuxControllerParameters
    is_chainable = True

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._handles: Sequence[CommandInterface] = ()

    def configure(self, parameters: TwistMuxControllerParameters) -> None:
        """Make the inputs. Raises ControllerError: there is none."""
        given = parameters.cmd_vel_inputs
        if not given:
            raise ControllerError(
                "'cmd_vel_inputs' is empty; it takes cmd_vel_inputs.<name>.topic and priority"
            )
        axes = HOLONOMIC if parameters.holonomic else PLANAR
        commanded = {
            'linear/x': parameters.command_interface_linear_x,
            'linear/y': parameters.command_interface_linear_y,
            'angular/z': parameters.command_interface_angular_z,
        }
        if not parameters.holonomic:
            del commanded['linear/y']
        self._request = InterfaceRequest.individual(commanded.values())
        self._references = tuple(
            CommandInterface(self.context.name, f'{name}/{VELOCITY}') for name in commanded
        )
        self._at_rest = (0.0,) * len(axes)
        self._inputs = [
            _CmdVelInput(name, given[name], axes, self.log)
            for name in sorted(given, key=lambda name: (-given[name].priority, name))
        ]
        self._source: Output[str] = Output(
            Port('~/source', 'std_msgs/msg/String', '', _SOURCE_QOS, str)
        )
        self.log(Severity.INFO, 'configure successful')

    def command_interfaces(self) -> InterfaceRequest:
        """Return the references of the drive: ahead, to the left if holonomic, turn."""
        return self._request

    def references(self) -> tuple[CommandInterface, ...]:
        """Return ``linear/x/velocity`` …, m/s and rad/s."""
        return self._references

    def inputs(self) -> tuple[Input[TwistSample], ...]:
        """Return the topics of the commands, the highest priority first."""
        return tuple(each.port for each in self._inputs)

    def outputs(self) -> tuple[Output[str], ...]:
        """Return ``~/source``."""
        return (self._source,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the references. Raises ControllerError: some are missing."""
        self._request.require_all(commands, 'command')
        self._handles = commands
        self._told = ''
        self.set_clock(time)

    def update(self, time: int, period: int) -> None:
        """Choose and pass on; in chained mode the preceding controller does."""
        if self.is_chained:
            ignore_commands(self.inputs(), self.log)
        else:
            self._choose(time, period)
        for reference, handle in zip(self._references, self._handles, strict=True):
            handle.value = reference.value

    def deactivate(self, time: int) -> None:
        """Have the drive stand."""
        self.set_clock(time)
        for handle in self._handles:
            handle.value = 0.0
        self._handles = ()

    def reset(self, time: int) -> None:
        """Wait for new commands: the simulation was reset."""
        self.set_clock(time)

    def set_clock(self, time: int) -> None:
        """Drop all commands: their stamps are of another time."""
        for each in self._inputs:
            each.forget(time)
        self._refer(self._at_rest)

    def _choose(self, time: int, period: int) -> None:
        source, twist = _NONE, self._at_rest
        for each in reversed(self._inputs):
            # What waits was sent after the previous update: the sender's clock showed its time.
            each.receive(time - period)
            found = each.in_force(time)
            if found is not None:
                source, twist = each.name, tuple(found)
        self._refer(twist)
        if source != self._told:
            self._told = source
            self._source.send(source)

    def _refer(self, values: Sequence[float]) -> None:
        for reference, value in zip(self._references, values, strict=True):
            reference.value = value
