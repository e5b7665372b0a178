# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What controllers of wheeled robots share: a life from twist to odometry, and topics."""

from collections import deque
from collections.abc import Sequence
import math
from typing import Any, ClassVar, Protocol

from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    Input,
    Output,
    Port,
    Qos,
)
from amr_description.control.interfaces import CommandInterface, StateInterface, VELOCITY
from amr_description.control.samples import FlagSample, Frames, OdometrySample, TwistSample
from amr_description.controllers.drives.command_reception import CommandReception, ignore_commands
from amr_description.log import Log, Severity

STAMPED_TWIST = 'geometry_msgs/msg/TwistStamped'
REFERENCE_QOS = Qos(depth=1, reliability='best_effort')
"""Of ``~/reference``."""


EMERGENCY_STOP = 'emergency_stop'
"""Topic of the lock, in the namespace of the robot."""


class EmergencyStop(Input[FlagSample]):
    """
    The lock of a drive: while the latest message on ``emergency_stop`` is true, it stands.

    Such locks are those of ``twist_mux``. The genuine controllers have none. A message counts also
    while the controller is inactive: activating it again does not release the robot.
    """

    def __init__(self, log: Log) -> None:
        super().__init__(
            Port(
                EMERGENCY_STOP,
                'std_msgs/msg/Bool',
                '',
                Qos(depth=1, reliability='reliable'),
                FlagSample,
            ),
            capacity=1,
        )
        self._log = log
        self._is_engaged = False
        self._latest = False
        """Of the ROS thread, which is ahead of the control thread."""
        self._arrived: deque[tuple[bool, bytes]] = deque(maxlen=16)

    @property
    def is_engaged(self) -> bool:
        """Whether the robot is held; on the control thread, which acts on it now."""
        while self._arrived:
            self._is_engaged, message = self._arrived.popleft()
            if self.on_drain is not None and message:
                self.on_drain([message])
        return self._is_engaged

    def put(self, sample: FlagSample, message: bytes = b'') -> bool:
        """Take the state of the lock, whatever the controller's is."""
        was_engaged, self._latest = self._latest, sample.value
        self._arrived.append((sample.value, message))
        if was_engaged != sample.value:
            name = self.port.name
            text = (
                f"'{name}' is true: the robot is held at rest, and commands are not taken, until "
                'it is false'
                if sample.value
                else f"'{name}' is false: commands are taken again"
            )
            self._log(Severity.WARN, text)
        return True


def stamped_twist_input() -> Input[TwistSample]:
    """Return ``~/cmd_vel``."""
    return Input(Port('~/cmd_vel', STAMPED_TWIST, sample=TwistSample))


def reference_input() -> Input[TwistSample]:
    """Return ``~/reference``, of which only the latest message counts."""
    return Input(Port('~/reference', STAMPED_TWIST, '', REFERENCE_QOS, TwistSample), capacity=1)


def odometry_outputs(
    topic: str, tf_topic: str
) -> tuple[Output[OdometrySample], Output[OdometrySample]]:
    """Return the topics of odometry and of its transform."""
    return (
        Output(Port(topic, 'nav_msgs/msg/Odometry', sample=OdometrySample)),
        Output(Port(tf_topic, 'tf2_msgs/msg/TFMessage', sample=OdometrySample)),
    )


def warn_of_one_shot_reference(controller: Controller, timeout: int) -> None:
    """Say what a ``reference_timeout`` (ns) of 0 means; few publishers are as fast as that."""
    if timeout == 0:
        rate = controller.context.update_rate
        controller.log(
            Severity.WARN,
            'reference_timeout is 0: each command counts for one update only '
            f'({1000 / rate:.3g} ms); for publishers slower than {rate} Hz set it, to 0.5 s say',
        )


class DriveOdometry(Protocol):
    """Where a drive takes itself to be."""

    def reset(self) -> None:
        """Return to the origin."""

    def sample(self, time: int, frames: Frames) -> OdometrySample:
        """Return pose and twist at ``time``, ns."""


class WheeledDrive(Controller):
    """
    A commanded twist to joints, and odometry: what all drives have in common.

    A drive is its parameters, its kinematics in ``update``, and where it departs from this life.
    ``configure`` makes what is declared here.
    """

    is_chainable = True
    axes: ClassVar[tuple[str, ...]] = ('linear', 'angular')
    """Of the references, each with ``/velocity``: m/s or rad/s."""
    keeps_references: ClassVar[bool] = False
    """Whether a command is in force until the next one or its timeout, not for one update."""

    _command: Input[TwistSample]
    _emergency_stop: EmergencyStop
    _reception: CommandReception
    _odometry: DriveOdometry
    _frames: Frames
    _odom: Output[OdometrySample]
    _transform: Output[OdometrySample]
    _publishes_transform: bool

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._references = tuple(
            CommandInterface(context.name, f'{axis}/{VELOCITY}') for axis in self.axes
        )
        self._none = (math.nan,) * len(self.axes)
        self._held = (0.0,) * len(self.axes) if self.keeps_references else self._none
        self._commands: Sequence[CommandInterface] = ()
        self._states: Sequence[StateInterface] = ()

    def references(self) -> tuple[CommandInterface, ...]:
        """Return the velocities of the axes, m/s or rad/s."""
        return self._references

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return the topic of commands and the lock."""
        return self._command, self._emergency_stop

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return odometry and its transform."""
        return self._odom, self._transform

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the joints; there is no command."""
        self._commands, self._states = commands, states
        self._reception.forget(time)
        self._set_references(self._none)

    def deactivate(self, time: int) -> None:
        """Stop; the pose stays."""
        self._stop()
        self._reception.forget(time)
        self._set_references(self._none)
        self._commands = self._states = ()

    def reset(self, time: int) -> None:
        """Start over at the origin."""
        self._odometry.reset()
        self.set_clock(time)

    def set_clock(self, time: int) -> None:
        """Keep the pose; what waits is dropped, the timeout starts now."""
        for port in self.inputs():
            port.drain()
        self._reception.forget(time)
        if not self.keeps_references:
            self._set_references(self._none)

    def _stop(self) -> None:
        """Command all joints 0."""
        for command in self._commands:
            command.value = 0.0

    def _update_references(self, time: int, period: int) -> None:
        """Take the command of the topics; in chained mode the preceding controller sets it."""
        if self._emergency_stop.is_engaged:
            self._reception.discard(self.inputs(), time)
            self._set_references(self._held)
        elif self.is_chained:
            ignore_commands(self.inputs(), self.log)
        else:
            # What waits was sent after the previous update: the sender's clock showed its time.
            self._receive(time - period)
            twist = self._reception.in_force(time)
            if twist is not None:
                self._set_references(twist)
            elif not self.keeps_references:
                self._set_references(self._none)

    def _receive(self, now: int) -> None:
        if samples := self._command.drain():
            self._reception.receive(samples, now)

    def _set_references(self, values: Sequence[float]) -> None:
        for reference, value in zip(self._references, values, strict=True):
            reference.value = value

    def _command_joints(self, values: Sequence[float]) -> None:
        for command, value in zip(self._commands, values, strict=True):
            command.value = value

    def _publish_odometry(self, time: int) -> None:
        sample = self._odometry.sample(time, self._frames)
        self._odom.send(sample)
        if self._publishes_transform:
            self._transform.send(sample)

    def _make_ports(
        self, command: Input[TwistSample], topics: tuple[str, str], *, enable_tf: bool
    ) -> None:
        """Make the ports. ``topics``: of odometry and of its transform."""
        self._emergency_stop = EmergencyStop(self.log)
        self._command = command
        self._odom, self._transform = odometry_outputs(*topics)
        self._publishes_transform = enable_tf
