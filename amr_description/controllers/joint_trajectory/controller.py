# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
joint_trajectory_controller/JointTrajectoryController: joints follow trajectories, point by point.

At each update the joints are measured against the trajectory at this moment, and commanded where
it will be one period later. Position, velocity and acceleration are commanded as they are;
velocity alone, or effort alone, by one PID a joint::

    u = ff_velocity_scale·v_desired + PID(position error, velocity error)  (+ the desired effort)

After activation, success, an abort and a cancel it holds: the last command, the last point, or
where the joints are (after a deceleration, with ``constraints.decelerate_on_cancel``).

Differences from joint_trajectory_controller 4.x:

- a trajectory that begins at the desired state (``interpolate_from_desired_state``) goes on from
  the last command at the time that it was for, not one period earlier, and so without a step;
- its effort begins at the last desired one, without what the PID has added;
- ``error_string`` of a violated tolerance names the joint behind the text of the original;
- a trajectory from the topic has the tolerances of the parameters, not those of the last goal;
- a goal that ``cmd_timeout`` ends is aborted, not reached;
- the PIDs begin anew on activation;
- position commands of a joint that wraps around go on from where it is, without whole turns back;
- points with accelerations, but no velocities, are joined linearly, not at zero;
- where positions are not known on activation, it holds as soon as they are;
- when the simulation is reset, the goal is aborted, and the joints are held where they are.
"""

from collections.abc import Sequence
import math
from operator import add
from typing import Any, NamedTuple

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import (
    Action,
    Controller,
    ControllerContext,
    Input,
    Output,
    Service,
)
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    EFFORT,
    InterfaceRequest,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.trajectory_samples import (
    FollowTrajectoryFeedback,
    FollowTrajectoryGoal,
    FollowTrajectoryResult,
    QueryStateRequest,
    QueryStateResponse,
    TrajectoryPoint,
    TrajectorySample,
    TrajectoryStateSample,
)
from amr_description.controllers.joint_trajectory import checks
from amr_description.controllers.joint_trajectory.checks import TrajectoryRules, Violation
from amr_description.controllers.joint_trajectory.interfaces import (
    FollowGoal,
    JointHandles,
    JointLayout,
    TrajectoryPorts,
)
from amr_description.controllers.joint_trajectory.parameters import (
    JointTrajectoryParameters,
)
from amr_description.controllers.joint_trajectory.splines import (
    decelerating,
    JointOrder,
    shortest_angular_distance,
    Trajectory,
)
from amr_description.controllers.pid import Pid
from amr_description.log import Severity

_INVALID_GOAL = -1
_PATH_TOLERANCE_VIOLATED = -4
_GOAL_TOLERANCE_VIOLATED = -5
_PREEMPTED = FollowTrajectoryResult(
    _INVALID_GOAL, 'Current goal cancelled due to new incoming action.'
)
_DEACTIVATED = FollowTrajectoryResult(
    _INVALID_GOAL, 'Current goal cancelled during deactivate transition.'
)
_RESET = FollowTrajectoryResult(
    _INVALID_GOAL, 'Current goal cancelled because the simulation was reset.'
)
_SUCCESS = FollowTrajectoryResult(0, 'Goal successfully reached!')


class _Judgement(NamedTuple):
    """How well the joints follow, at one update."""

    is_over: bool
    """The trajectory has ended."""
    path: Sequence[Violation]
    goal: Sequence[Violation]
    lateness: float
    """s since the present segment began; of the last one, since the end."""
    is_too_late: bool

    @property
    def is_failure(self) -> bool:
        """The trajectory is given up."""
        return bool(self.path) or self.is_too_late


class JointTrajectoryController(Controller):
    """Follows one trajectory at a time; see the module."""

    parameters_type = JointTrajectoryParameters

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._handles: JointHandles | None = None
        self._goal: FollowGoal | None = None
        self._last_update: int | None = None

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: JointTrajectoryParameters) -> None:
        """Check the parameters against each other."""
        if parameters.open_loop_control:
            self.log(
                Severity.WARN,
                "[deprecated] 'open_loop_control' parameter is deprecated. Instead, set the "
                "feedback gains to zero and use 'interpolate_from_desired_state' parameter",
            )
        if not parameters.command_joints:
            self.log(
                Severity.INFO,
                "No specific joint names are used for command interfaces. Using 'joints' "
                'parameter.',
            )
        self._parameters = parameters
        self._layout = layout = JointLayout(parameters, self.context.robot)
        self._rules = TrajectoryRules(
            layout.joints,
            allow_partial_joints=parameters.allow_partial_joints_goal,
            allow_integration=parameters.allow_integration_in_goal_trajectories,
            allow_nonzero_end_velocity=parameters.allow_nonzero_velocity_at_trajectory_end,
            has_effort=EFFORT in layout.commands,
        )
        self._defaults = self._tolerances = checks.tolerances_of_parameters(parameters)
        self._decelerations, complaint = layout.decelerations(parameters)
        if complaint:
            self.log(Severity.WARN, complaint)
        gains = [parameters.gains[layout.joints[joint]] for joint in layout.commanded]
        self._pids = [Pid(each.pid()) for each in gains] if layout.has_pids else []
        self._feed_forward = [each.ff_velocity_scale for each in gains]
        self._period = int(NANOSECONDS / self.context.update_rate)
        self._scaling = parameters.speed_scaling.initial_scaling_factor
        self._has_wraps = any(layout.wraps)
        self._has_splines = parameters.interpolation_method == 'splines'
        self._has_velocity_error = VELOCITY in layout.states and not {VELOCITY, EFFORT}.isdisjoint(
            layout.commands
        )
        self._has_acceleration_error = (
            ACCELERATION in layout.states and ACCELERATION in layout.commands
        )
        self._ports = TrajectoryPorts(
            parameters.action_monitor_rate, self._rules.complaint, self._check_goal, self._answer
        )
        self._describe(parameters)

    def command_interfaces(self) -> InterfaceRequest:
        """Return the interfaces of the command joints, joint by joint."""
        return self._layout.command_request

    def state_interfaces(self) -> InterfaceRequest:
        """Return the interfaces of the joints, joint by joint."""
        return self._layout.state_request

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/joint_trajectory`` and, if positions alone are commanded, the scaling."""
        can_scale = self._layout.commands == (POSITION,)
        return (self._ports.topic, self._ports.scaling) if can_scale else (self._ports.topic,)

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/controller_state``."""
        return (self._ports.state,)

    def services(self) -> tuple[Service[Any, Any], ...]:
        """Return ``~/query_state``."""
        return (self._ports.query,)

    def actions(self) -> tuple[Action[Any, Any, Any], ...]:
        """Return ``~/follow_joint_trajectory``."""
        return (self._ports.action,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Hold the last commands, or where the joints are."""
        self._handles = handles = JointHandles(self._layout, commands, states)
        state = handles.measured()
        if self._parameters.set_last_command_interface_value_as_state_on_activation:
            state = handles.last_commands(state) or state
        self._goal = None
        self._last_update = None
        self._tolerances = self._defaults
        self._begin_at(state)
        self._cmd_timeout = self._checked_timeout()

    def deactivate(self, time: int) -> None:
        """Abort the goal, and stop what would keep moving."""
        for goal in filter(None, (self._goal, *self._ports.action.drain())):
            goal.abort(_DEACTIVATED)
        self._goal = None
        if self._handles is not None:
            self._handles.release()
        self._handles = None

    def reset(self, time: int) -> None:
        """Abort the goal, and hold where the joints are at the next update."""
        if self._goal is not None:
            self._goal.abort(_RESET)
        self._goal = None
        self._last_update = None
        self._trajectory: Trajectory | None = None

    def set_clock(self, time: int) -> None:
        """Have the trajectory go on, by the new clock."""
        if self._last_update is None:
            return
        delay = time - self._last_update
        for trajectory in filter(None, (self._trajectory, self._next)):
            trajectory.shift(delay)
        self._clock += delay
        self._commanded_for += delay
        self._last_update = time

    def _begin_at(self, state: TrajectoryPoint) -> None:
        """Forget every trajectory, and hold."""
        zeros = (0.0,) * len(state.positions)
        has = self._layout.states
        self._actual = self._last_command = state
        self._desired = TrajectoryPoint(state.positions, zeros, zeros, zeros)
        self._error = TrajectoryPoint(
            zeros, zeros if VELOCITY in has else (), zeros if ACCELERATION in has else ()
        )
        self._output = TrajectoryPoint()
        self._commanded_for = self._clock = 0
        self._turns = zeros
        self._upcoming: tuple[Trajectory, int, TrajectoryPoint] | None = None
        self._next: Trajectory | None = None
        self._trajectory = Trajectory.holding(TrajectoryPoint(state.positions))
        self._is_holding = True
        self._is_blind = not all(map(math.isfinite, state.positions))
        for pid in self._pids:
            pid.reset()

    # --- update ------------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Follow the trajectory."""
        handles = self._handles
        if handles is None:
            return
        self._last_update = time
        self._actual = handles.measured(self._desired.effort)
        if self._trajectory is None or (self._is_blind and self._is_holding):
            self._begin_at(self._actual)
        self._scale(handles)
        self._accept(handles)
        trajectory, is_first = self._advance(time, period)
        self._sample_desired(trajectory, is_first)
        found = trajectory.sample(self._clock + self._period)
        if found is not None:
            upcoming, segment = found
            self._upcoming = (trajectory, self._clock + self._period, upcoming)
            self._error = self._error_of(self._desired, self._actual)
            judgement = self._judge(trajectory, segment, is_first=is_first)
            if not judgement.is_failure:
                self._command(handles, upcoming, period)
                self._last_command = upcoming
                self._commanded_for = time + self._period
            self._report(time)
            self._conclude(trajectory, judgement)
        self._ports.state.send(
            TrajectoryStateSample(
                time,
                self._layout.joints,
                self._desired,
                self._actual,
                self._error,
                self._output,
                self._scaling,
            )
        )

    def _accept(self, handles: JointHandles) -> None:
        """Take over what has arrived, and what was decided at the last update."""
        for sample in self._ports.topic.drain():
            self._tolerances = self._defaults
            self._follow(sample, handles)
        goals = self._ports.action.drain()
        if goals:
            for goal in filter(None, (self._goal, *goals[:-1])):
                goal.cancel(_PREEMPTED)
            self._goal = goal = goals[-1]
            self._tolerances, complaint = checks.tolerances_of_goal(
                self._defaults, goal.request, self._layout.joints
            )
            if complaint:
                self.log(Severity.WARN, complaint)
            self._follow(goal.request.trajectory, handles)
        if self._goal is not None and self._goal.is_cancel_requested:
            self.log(Severity.INFO, 'Got request to cancel goal')
            self.log(
                Severity.INFO,
                'Canceling active action goal because cancel callback received.',
            )
            self._goal.cancel(FollowTrajectoryResult())
            self._goal = None
            self._hold()
        if self._next is not None:
            self._trajectory, self._next = self._next, None

    def _follow(self, sample: TrajectorySample, handles: JointHandles) -> None:
        self._next = Trajectory(
            sample.points,
            sample.times,
            sample.stamp,
            order=JointOrder(
                sample.joint_names, self._layout.joints, handles.held_positions(self._actual)
            ),
            has_splines=self._has_splines,
        )
        self._is_holding = False

    def _advance(self, time: int, period: int) -> tuple[Trajectory, bool]:
        """Go on in time; return the trajectory, and whether this is its first update."""
        trajectory = self._trajectory
        assert trajectory is not None
        if trajectory.is_begun:
            scaling = self._scaling
            self._clock += period if scaling == 1.0 else round(period * scaling)
            return trajectory, False
        wraps = self._layout.wraps
        if self._parameters.interpolate_from_desired_state or self._parameters.open_loop_control:
            since = min(self._commanded_for or time, time)
            turns = trajectory.begin(since, self._last_command, wraps, start=time)
            self._turns = tuple(map(add, self._turns, turns))
        else:
            self._turns = trajectory.begin(time, self._actual, wraps)
        self._clock = time
        return trajectory, True

    def _sample_desired(self, trajectory: Trajectory, is_first: bool) -> None:
        known = self._upcoming
        if not is_first and known and known[0] is trajectory and known[1] == self._clock:
            self._desired = known[2]
        elif found := trajectory.sample(self._clock):
            self._desired = found[0]

    def _error_of(self, desired: TrajectoryPoint, actual: TrajectoryPoint) -> TrajectoryPoint:
        wraps = self._layout.wraps
        pairs = zip(desired.positions, actual.positions, strict=True)
        if self._has_wraps:
            positions = tuple(
                [
                    shortest_angular_distance(a, d) if wrap else d - a
                    for (d, a), wrap in zip(pairs, wraps, strict=True)
                ]
            )
        else:
            positions = tuple([d - a for d, a in pairs])
        velocities, accelerations = self._error.velocities, self._error.accelerations
        if self._has_velocity_error:
            pairs = zip(desired.velocities, actual.velocities, strict=True)
            velocities = tuple([d - a for d, a in pairs])
        if self._has_acceleration_error:
            pairs = zip(desired.accelerations, actual.accelerations, strict=True)
            accelerations = tuple([d - a for d, a in pairs])
        return TrajectoryPoint(positions, velocities, accelerations)

    def _judge(self, trajectory: Trajectory, segment: int, *, is_first: bool) -> _Judgement:
        is_over = trajectory.is_over(segment)
        if self._is_holding:
            return _Judgement(is_over, (), (), 0.0, is_too_late=False)
        lateness = (self._clock - trajectory.time_of(segment)) / NANOSECONDS
        tolerances = self._tolerances
        path = tolerances.path.violations(self._error) if is_first or not is_over else ()
        goal = tolerances.goal.violations(self._error) if is_over else ()
        is_too_late = bool(goal) and 0.0 < tolerances.goal_time < lateness
        return _Judgement(is_over, path, goal, lateness, is_too_late)

    def _command(self, handles: JointHandles, upcoming: TrajectoryPoint, period: int) -> None:
        kinds = self._layout.commands
        controlled = self._controlled(upcoming, period / NANOSECONDS) if self._pids else ()
        none: tuple[float, ...] = ()
        positions = velocities = accelerations = effort = none
        if POSITION in kinds:
            positions = upcoming.positions
            if self._has_wraps:
                positions = tuple(map(add, positions, self._turns))
            positions = handles.write(POSITION, positions)
        if VELOCITY in kinds:
            velocities = handles.write(VELOCITY, controlled or upcoming.velocities)
        if ACCELERATION in kinds:
            accelerations = handles.write(ACCELERATION, upcoming.accelerations)
        if EFFORT in kinds:
            effort = handles.write(EFFORT, controlled or self._desired.effort)
        self._output = TrajectoryPoint(positions, velocities, accelerations, effort)

    def _controlled(self, upcoming: TrajectoryPoint, period: float) -> tuple[float, ...]:
        """Return what the PIDs command; ``period``: s."""
        error = self._error
        commands = [0.0] * len(upcoming.positions)
        has_effort = EFFORT in self._layout.commands
        for joint, scale, pid in zip(
            self._layout.commanded, self._feed_forward, self._pids, strict=True
        ):
            commands[joint] = (
                scale * upcoming.velocities[joint]
                + (upcoming.effort[joint] if has_effort else 0.0)
                + pid.compute(error.positions[joint], period, error.velocities[joint])
            )
        return tuple(commands)

    def _report(self, time: int) -> None:
        if self._goal is not None:
            self._goal.send_feedback(
                FollowTrajectoryFeedback(
                    time, self._layout.joints, self._desired, self._actual, self._error
                )
            )

    def _conclude(self, trajectory: Trajectory, judgement: _Judgement) -> None:
        """Decide what the next update follows, and end the goal."""
        if self._is_holding:
            return
        goal = self._goal
        if judgement.path:
            self._log_violations(judgement.path)
            self._give_up(
                'Aborted due to state tolerance violation',
                'Holding position due to state tolerance violation',
                _PATH_TOLERANCE_VIOLATED,
                'Aborted due to path tolerance violation',
                judgement.path,
            )
        elif judgement.is_over and goal is not None and not judgement.goal:
            goal.succeed(_SUCCESS)
            self._goal = None
            self.log(Severity.INFO, 'Goal reached, success!')
            self._next = Trajectory.holding(trajectory.end_point())
            self._is_holding = True
        elif judgement.is_too_late:
            self._log_violations(judgement.goal)
            text = (
                f'Aborted due to goal_time_tolerance exceeding by {judgement.lateness:f} seconds'
            )
            self._give_up(
                text,
                'Exceeded goal_time_tolerance: holding position...',
                _GOAL_TOLERANCE_VIOLATED,
                text,
                judgement.goal,
            )
        elif judgement.is_over and 0.0 < self._cmd_timeout < judgement.lateness:
            text = 'Aborted due to command timeout'
            self._give_up(text, text, _GOAL_TOLERANCE_VIOLATED, text, judgement.goal)

    def _give_up(
        self,
        warning: str,
        error: str,
        code: int,
        result: str,
        violations: Sequence[Violation],
    ) -> None:
        """
        Hold.

        Args:
            warning: what is logged if there is a goal, which is aborted.
            error: what is logged if there is none.
            code: of the goal's result.
            result: its text, to which the first of ``violations`` is added.
            violations: what is beyond its tolerance.
        """
        goal, self._goal = self._goal, None
        if goal is None:
            severity = Severity.WARN if error == warning else Severity.ERROR
            self.log(severity, error)
        else:
            detail = f'; {self._described(violations[0])}' if violations else ''
            goal.abort(FollowTrajectoryResult(code, result + detail))
            self.log(Severity.WARN, warning)
        self._hold()

    def _hold(self) -> None:
        """Stay where the joints are, or come to rest, from the next trajectory on."""
        actual = self._actual
        self._is_holding = True
        if self._decelerations and all(map(math.isfinite, actual.velocities)):
            self._next = decelerating(actual, self._decelerations)
        else:
            self._next = Trajectory.holding(TrajectoryPoint(actual.positions))

    def _log_violations(self, violations: Sequence[Violation]) -> None:
        for each in violations:
            name, kind = self._layout.joints[each.joint], each.kind.capitalize()
            self.log(
                Severity.ERROR,
                f'State tolerances failed for joint {each.joint} ({name}): '
                f'{kind} Error: {each.error:f}, {kind} Tolerance: {each.limit:f}',
            )

    def _described(self, violation: Violation) -> str:
        return (
            f'{self._layout.joints[violation.joint]}: {violation.kind} error '
            f'{violation.error:f}, tolerance {violation.limit:f}'
        )

    # --- ports -------------------------------------------------------------------------------

    def _check_goal(self, goal: FollowTrajectoryGoal, time: int) -> str:
        """Return why a goal is rejected; on the ROS thread."""
        self.log(Severity.INFO, 'Received new action goal')
        complaint = self._rules.complaint(goal.trajectory, time)
        if not complaint:
            self.log(Severity.INFO, 'Accepted new action goal')
        return complaint

    def _answer(self, request: QueryStateRequest) -> QueryStateResponse:
        """Return where the joints should be at a time; on the control thread."""
        names = self._layout.joints
        if self._handles is None:
            text = "Can't sample trajectory. Controller is not active."
            self.log(Severity.ERROR, text)
            return QueryStateResponse(success=False, message=text)
        point, text = self._actual, ''
        trajectory = self._trajectory
        if trajectory is None:
            text = 'Currently there is no valid trajectory instance.'
        elif (found := trajectory.sample(request.time)) is None:
            text = 'Requested sample time is earlier than the current trajectory start time.'
        else:
            point = found[0]
            if trajectory.is_over(found[1]):
                text = 'Requested sample time precedes the current trajectory end time.'
        if text:
            self.log(Severity.ERROR, text)
        return QueryStateResponse(not text, text, names, point)

    def _scale(self, handles: JointHandles) -> None:
        """Take over the speed, from the topic or from the hardware, and hand it on."""
        for sample in self._ports.scaling.drain():
            if not 0.0 <= sample.factor < math.inf:
                self.log(
                    Severity.WARN,
                    'Scaling factor has to be greater or equal to 0.0 - Ignoring input!',
                )
            elif sample.factor != self._scaling:
                self.log(Severity.INFO, f'New scaling factor will be {sample.factor:f}')
                self._scaling = sample.factor
        if handles.scaling_command is not None:
            handles.scaling_command.value = self._scaling
        state = handles.scaling_state
        if state is not None and 0.0 <= state.value < math.inf:
            self._scaling = state.value

    # --- parameters --------------------------------------------------------------------------

    def _describe(self, parameters: JointTrajectoryParameters) -> None:
        layout = self._layout
        if parameters.allow_partial_joints_goal:
            self.log(Severity.INFO, 'Goals with partial set of joints are allowed')
        self.log(
            Severity.INFO,
            f'Command interfaces are [{" ".join(layout.commands)}] and state interfaces are '
            f'[{" ".join(layout.states)}].',
        )
        self.log(Severity.INFO, f"Using '{parameters.interpolation_method}' interpolation method.")
        self.log(
            Severity.INFO,
            f'Action status changes will be monitored at {parameters.action_monitor_rate:.2f} Hz.',
        )

    def _checked_timeout(self) -> float:
        timeout, goal_time = self._parameters.cmd_timeout, self._defaults.goal_time
        if timeout <= 0.0 or timeout > goal_time:
            return timeout
        self.log(
            Severity.WARN,
            f'Command timeout must be higher than goal_time tolerance ({timeout:f} vs. '
            f'{goal_time:f})',
        )
        return 0.0
