# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Grippers with one joint, which a goal of an action opens or closes: ``~/gripper_cmd``.

- parallel_gripper_action_controller/GripperActionController: control_msgs/ParallelGripperCommand;
  commands a position and, where there are interfaces for it, the greatest effort and velocity;
- position_controllers/GripperActionController: control_msgs/GripperCommand; commands a position;
- effort_controllers/GripperActionController: the same; commands an effort, by a PID on the
  position, ``gains.<joint>``, of at most max_effort.

A goal succeeds within goal_tolerance of its position. It has stalled when the joint has been
slower than stall_velocity_threshold for stall_timeout: it then succeeds with allow_stalling, and
else is aborted. A newer goal cancels it; when it is cancelled, the gripper holds where it is.

Differences from ros2_controllers 4.x: feedback is published at action_monitor_rate; the effort in
result and feedback is the state ``effort`` where the controller has it; a goal that is not finite
is rejected; without a velocity state the velocity is that of the positions.
"""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
from typing import Any, TypeAlias

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import (
    Action,
    ActionPort,
    Controller,
    ControllerContext,
    Goal,
)
from amr_description.control.dof_samples import GripperGoal, GripperState
from amr_description.control.interfaces import (
    CommandInterface,
    EFFORT,
    InterfaceRequest,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.controllers.pid import Pid, PidGains
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.parameters import keyed_group, parameter


@dataclass(frozen=True)
class GripperParameters:
    """The table of position_controllers/GripperActionController."""

    action_monitor_rate: float = parameter(
        20.0, 'Rate of feedback and results', unit='Hz', minimum=0.1
    )
    joint: str = parameter('', 'Joint of the gripper', not_empty=True)
    goal_tolerance: float = parameter(
        0.01, 'Distance at which a goal is reached', unit='rad or m', minimum=0.0
    )
    max_effort: float = parameter(
        0.0, 'Greatest effort until a goal gives one', unit='N m or N', minimum=0.0
    )
    allow_stalling: bool = parameter(False, 'A goal succeeds when the gripper stalls')
    stall_velocity_threshold: float = parameter(
        0.001, 'Velocity below which the gripper stands still', unit='rad/s or m/s'
    )
    stall_timeout: float = parameter(
        1.0, 'Time at standstill after which it has stalled', unit='s'
    )


@dataclass(frozen=True)
class EffortGains:
    """The PID of effort_controllers/GripperActionController."""

    p: float = parameter(0.0, 'Proportional gain')
    i: float = parameter(0.0, 'Integral gain')
    d: float = parameter(0.0, 'Derivative gain')
    i_clamp: float = parameter(0.0, 'Greatest size of the integral term')


@dataclass(frozen=True)
class EffortGripperParameters(GripperParameters):
    """The table of effort_controllers/GripperActionController."""

    gains: Mapping[str, EffortGains] = keyed_group('gains', 'joint', EffortGains)


@dataclass(frozen=True)
class ParallelGripperParameters:
    """The table of parallel_gripper_action_controller/GripperActionController."""

    action_monitor_rate: float = parameter(
        20.0, 'Rate of feedback and results', unit='Hz', minimum=0.1, read_only=True
    )
    joint: str = parameter('', 'Joint of the gripper', not_empty=True, read_only=True)
    state_interfaces: tuple[str, ...] = parameter(
        (POSITION, VELOCITY), 'State interfaces of the joint to use', not_empty=True
    )
    goal_tolerance: float = parameter(
        0.01, 'Distance at which a goal is reached', unit='rad or m', minimum=0.0
    )
    allow_stalling: bool = parameter(False, 'A goal succeeds when the gripper stalls')
    stall_velocity_threshold: float = parameter(
        0.001, 'Velocity below which the gripper stands still', unit='rad/s or m/s'
    )
    stall_timeout: float = parameter(
        1.0, 'Time at standstill after which it has stalled', unit='s', minimum=0.0
    )
    max_effort_interface: str = parameter('', 'Command interface that gets the greatest effort')
    max_effort: float = parameter(
        10.0, 'Greatest effort, unless a goal has one', unit='N', minimum=0.0
    )
    max_velocity_interface: str = parameter(
        '', 'Command interface that gets the greatest velocity'
    )
    max_velocity: float = parameter(
        0.1, 'Greatest velocity, unless a goal has one', unit='m/s', minimum=0.0
    )


_Goal: TypeAlias = Goal[GripperGoal, GripperState, GripperState]


@dataclass(frozen=True, slots=True)
class _Command:
    """What is in force."""

    position: float
    velocity: float
    effort: float


class GripperBase(Controller):
    """All of a gripper's controller but what it commands."""

    action_type = 'control_msgs/action/GripperCommand'

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._handles: tuple[CommandInterface, ...] = ()
        self._states: dict[str, StateInterface] = {}
        self._goal: _Goal | None = None
        self._command: _Command | None = None
        """None: to hold the present position."""

    @abstractmethod
    def default_command(self, position: float) -> _Command:
        """Return the command that holds a position."""

    @abstractmethod
    def command_of(self, goal: GripperGoal) -> _Command:
        """Return the command of a goal."""

    @abstractmethod
    def write(self, command: _Command, error: float, velocity: float, period: float) -> float:
        """Command the joint, and return the effort of the result. period: s."""

    def configure(self, parameters: Any) -> None:
        """Take over names and limits."""
        self._parameters = parameters
        self.log(
            Severity.INFO,
            f'Action status changes will be monitored at {parameters.action_monitor_rate:f} Hz.',
        )
        self._action: Action[GripperGoal, GripperState, GripperState] = Action(
            ActionPort(
                '~/gripper_cmd',
                self.action_type,
                GripperGoal,
                GripperState,
                GripperState,
                rate=parameters.action_monitor_rate,
            ),
            self._check,
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Return position and velocity of the joint."""
        joint = self._parameters.joint
        return InterfaceRequest.individual((f'{joint}/{POSITION}', f'{joint}/{VELOCITY}'))

    def actions(self) -> tuple[Action[GripperGoal, GripperState, GripperState], ...]:
        """Return ``~/gripper_cmd``."""
        return (self._action,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces, and hold. Raises ControllerError: some are missing."""
        self.command_interfaces().require_all(commands, 'command')
        self.state_interfaces().require_all(states, 'state')
        self._handles = tuple(commands)
        self._states = {state.interface: state for state in states}
        self._goal = self._command = None
        self._position = math.nan

    def update(self, time: int, period: int) -> None:
        """Look at the goal, then command the joint."""
        seconds = period / NANOSECONDS
        position = self._states[POSITION].value
        velocity = self._velocity(position, seconds)
        for goal in self._action.drain():
            self._take(goal, time)
        if self._goal is not None and self._goal.is_cancel_requested:
            self.log(
                Severity.INFO,
                'Canceling active action goal because cancel callback received.',
            )
            self._goal.cancel(None)
            self._goal = self._command = None
        command = self._command or self.default_command(position)
        if self._command is None and math.isfinite(position):
            self._command = command
        error = command.position - position
        effort = self.write(command, error, velocity, seconds)
        if EFFORT in self._states:
            effort = self._states[EFFORT].value
        if self._goal is not None:
            self._follow(self._goal, (position, error, velocity, effort), time)

    def deactivate(self, time: int) -> None:
        """Drop the interfaces."""
        self._handles, self._states = (), {}
        self._goal = self._command = None

    def reset(self, time: int) -> None:
        """Hold where the gripper is: the simulation was reset."""
        if self._goal is not None:
            self._goal.abort(None)
        self._goal = self._command = None
        self._position = math.nan

    def set_clock(self, time: int) -> None:
        """Count the time of a stall from now on."""
        self._moved = time

    def _velocity(self, position: float, period: float) -> float:
        """Return the measured velocity, or that since the last update."""
        before, self._position = self._position, position
        if VELOCITY in self._states:
            return float(self._states[VELOCITY].value)
        return (position - before) / period if period > 0.0 else math.nan

    def _check(self, request: GripperGoal, time: int) -> str:
        if len(request.position) != 1:
            return (
                'Received action goal with wrong number of position values, expects 1, got '
                f'{len(request.position)}'
            )
        limits = (*request.velocity[:1], *request.effort[:1])
        if not all(map(math.isfinite, (*request.position, *limits))):
            return 'Received action goal with a value that is not finite'
        return ''

    def _take(self, goal: _Goal, time: int) -> None:
        self.log(Severity.INFO, 'Received & accepted new action goal')
        if self._goal is not None:
            self._goal.cancel(None)
        self._goal = goal
        self._command = self.command_of(goal.request)
        self._moved = time

    def _follow(self, goal: _Goal, measured: tuple[float, float, float, float], time: int) -> None:
        """End the goal if it is reached or has stalled, and else report on it."""
        position, error, velocity, effort = measured
        parameters = self._parameters
        has_reached = abs(error) < parameters.goal_tolerance
        if abs(velocity) > parameters.stall_velocity_threshold:
            self._moved = time
        waits = time - self._moved
        has_stalled = not has_reached and waits > parameters.stall_timeout * NANOSECONDS
        state = GripperState(parameters.joint, position, effort, has_stalled, has_reached)
        if has_reached or (has_stalled and parameters.allow_stalling):
            goal.succeed(state)
        elif has_stalled:
            self.log(Severity.WARN, 'Stall detected moving to goal. Aborting action!')
            goal.abort(state)
        else:
            goal.send_feedback(state)
            return
        self._goal = None


class PositionGripperActionController(GripperBase):
    """Commands the position."""

    parameters_type = GripperParameters

    def command_interfaces(self) -> InterfaceRequest:
        """Return the position of the joint."""
        return InterfaceRequest.individual((f'{self._parameters.joint}/{POSITION}',))

    def default_command(self, position: float) -> _Command:
        """Return the position, with the greatest effort of the parameters."""
        return _Command(position, math.nan, self._parameters.max_effort)

    def command_of(self, goal: GripperGoal) -> _Command:
        """Return what the goal says."""
        return _Command(goal.position[0], math.nan, goal.effort[0])

    def write(self, command: _Command, error: float, velocity: float, period: float) -> float:
        """Command the position; the effort is not commanded, and is reported as it was asked."""
        self._handles[0].value = command.position
        return command.effort


class EffortGripperActionController(PositionGripperActionController):
    """Commands an effort, by a PID on the position."""

    parameters_type = EffortGripperParameters

    def configure(self, parameters: EffortGripperParameters) -> None:
        """Make the PID. Raises ControllerError: its gains contradict each other."""
        super().configure(parameters)
        gains = parameters.gains[parameters.joint]
        clamp = abs(gains.i_clamp)
        self._pid = Pid(
            PidGains(gains.p, gains.i, gains.d, i_max=clamp, i_min=-clamp, strategy='legacy')
        )

    def command_interfaces(self) -> InterfaceRequest:
        """Return the effort of the joint."""
        return InterfaceRequest.individual((f'{self._parameters.joint}/{EFFORT}',))

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces, and hold. Raises ControllerError: some are missing."""
        super().activate(commands, states, time)
        self._pid.reset()

    def write(self, command: _Command, error: float, velocity: float, period: float) -> float:
        """Command the effort, and return it."""
        if not math.isfinite(error):
            return 0.0
        rate = -velocity if math.isfinite(velocity) else None
        effort = self._pid.compute(error, period, rate)
        effort = min(max(effort, -abs(command.effort)), abs(command.effort))
        self._handles[0].value = effort
        return effort

    def deactivate(self, time: int) -> None:
        """Let the joint go."""
        for handle in self._handles:
            handle.value = 0.0
        super().deactivate(time)


class ParallelGripperActionController(GripperBase):
    """Commands the position and, where there are interfaces, the greatest effort and velocity."""

    parameters_type = ParallelGripperParameters
    action_type = 'control_msgs/action/ParallelGripperCommand'

    def command_interfaces(self) -> InterfaceRequest:
        """Return the position of the joint, then effort and velocity, if they are named."""
        parameters = self._parameters
        named = (parameters.max_effort_interface, parameters.max_velocity_interface)
        return InterfaceRequest.individual(
            (f'{parameters.joint}/{POSITION}', *filter(None, named))
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Return those of the parameter."""
        parameters = self._parameters
        if POSITION not in parameters.state_interfaces:
            raise ControllerError('Expected 1 position state interface')
        return InterfaceRequest.individual(
            f'{parameters.joint}/{interface}' for interface in parameters.state_interfaces
        )

    def default_command(self, position: float) -> _Command:
        """Return the position, with the limits of the parameters."""
        return _Command(position, self._parameters.max_velocity, self._parameters.max_effort)

    def command_of(self, goal: GripperGoal) -> _Command:
        """Return what the goal says; what it leaves open is as in the parameters."""
        default = self.default_command(goal.position[0])
        return _Command(
            default.position,
            goal.velocity[0] if goal.velocity else default.velocity,
            goal.effort[0] if goal.effort else default.effort,
        )

    def write(self, command: _Command, error: float, velocity: float, period: float) -> float:
        """Command the position and the limits."""
        limits = []
        if self._parameters.max_effort_interface:
            limits.append(command.effort)
        if self._parameters.max_velocity_interface:
            limits.append(command.velocity)
        for handle, value in zip(self._handles, (command.position, *limits), strict=True):
            handle.value = value
        return 0.0
