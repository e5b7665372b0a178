# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which interfaces of which joints a joint trajectory controller has, and their values."""

from collections.abc import Callable, Sequence
from dataclasses import replace
import math
from typing import TypeAlias

from amr_description.control.contracts import (
    Action,
    ActionPort,
    Goal,
    Input,
    Output,
    Port,
    Qos,
    Service,
    ServicePort,
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
    SpeedScalingSample,
    TrajectoryPoint,
    TrajectorySample,
    TrajectoryStateSample,
)
from amr_description.controllers.joint_trajectory.parameters import (
    JointTrajectoryParameters,
)
from amr_description.errors import ControllerError
from amr_description.model.robot import JointType, Robot

_TOPIC = Port('~/joint_trajectory', 'trajectory_msgs/msg/JointTrajectory', sample=TrajectorySample)
_SCALING = Port(
    '~/speed_scaling_input',
    'control_msgs/msg/SpeedScalingFactor',
    qos=Qos(durability='transient_local'),
    sample=SpeedScalingSample,
)
_STATE = Port(
    '~/controller_state',
    'control_msgs/msg/JointTrajectoryControllerState',
    sample=TrajectoryStateSample,
)
_QUERY = ServicePort(
    '~/query_state',
    'control_msgs/srv/QueryTrajectoryState',
    QueryStateRequest,
    QueryStateResponse,
)
_ACTION = ActionPort(
    '~/follow_joint_trajectory',
    'control_msgs/action/FollowJointTrajectory',
    FollowTrajectoryGoal,
    FollowTrajectoryFeedback,
    FollowTrajectoryResult,
)
FollowGoal: TypeAlias = Goal[
    FollowTrajectoryGoal, FollowTrajectoryFeedback, FollowTrajectoryResult
]


class TrajectoryPorts:
    """Declares them, with the names and types of joint_trajectory_controller 4.x."""

    def __init__(
        self,
        rate: float,
        check_trajectory: Callable[[TrajectorySample, int], str],
        check_goal: Callable[[FollowTrajectoryGoal, int], str],
        answer: Callable[[QueryStateRequest], QueryStateResponse],
    ) -> None:
        """
        Make the ports.

        Args:
            rate: of the action, Hz.
            check_trajectory: of :class:`Input`.
            check_goal: of :class:`Action`.
            answer: of :class:`Service`.
        """
        self.topic: Input[TrajectorySample] = Input(_TOPIC, check=check_trajectory)
        self.scaling: Input[SpeedScalingSample] = Input(_SCALING)
        self.state: Output[TrajectoryStateSample] = Output(_STATE)
        self.query: Service[QueryStateRequest, QueryStateResponse] = Service(_QUERY, answer)
        self.action: Action[
            FollowTrajectoryGoal, FollowTrajectoryFeedback, FollowTrajectoryResult
        ] = Action(replace(_ACTION, rate=rate), check_goal)


def _check(is_wrong: bool, text: str) -> None:
    if is_wrong:
        raise ControllerError(text)


class JointLayout:
    """The joints, and the kinds of their interfaces, as the parameters have them."""

    def __init__(self, parameters: JointTrajectoryParameters, robot: Robot | None) -> None:
        """
        Check the parameters against each other.

        Args:
            parameters: with at least one joint and kind of interface.
            robot: its continuous joints wrap around; None: no joint does.

        Raises:
            ControllerError: they contradict each other.
        """
        self.joints = parameters.joints
        self.command_joints = parameters.command_joints or parameters.joints
        self.commands = parameters.command_interfaces
        self.states = parameters.state_interfaces
        self.scaling_state = parameters.speed_scaling.state_interface
        self.scaling_command = parameters.speed_scaling.command_interface
        self.commanded = self._commanded()
        self._check_commands()
        self._check_states()
        self._check_together()
        self.wraps = tuple(
            robot is not None
            and robot.has_joint(joint)
            and robot.joint(joint).type is JointType.CONTINUOUS
            for joint in self.joints
        )
        alone = len(self.commands) == 1
        self.has_pids = alone and (
            EFFORT in self.commands
            or (VELOCITY in self.commands and not parameters.open_loop_control)
        )

    @property
    def command_request(self) -> InterfaceRequest:
        """``<joint>/<interface>`` joint by joint, and the speed scaling's at the end."""
        names = [f'{joint}/{kind}' for joint in self.command_joints for kind in self.commands]
        return InterfaceRequest.individual([*names, *filter(None, [self.scaling_command])])

    @property
    def state_request(self) -> InterfaceRequest:
        """Likewise."""
        names = [f'{joint}/{kind}' for joint in self.joints for kind in self.states]
        return InterfaceRequest.individual([*names, *filter(None, [self.scaling_state])])

    def decelerations(
        self, parameters: JointTrajectoryParameters
    ) -> tuple[tuple[float, ...], str]:
        """
        Return the deceleration on cancel of each joint, and a complaint.

        None of them: joints are held at once, as it is wanted or as the complaint says.
        """
        if not parameters.constraints.decelerate_on_cancel:
            return (), ''
        instead = 'holding position on cancel instead'
        if VELOCITY not in self.states:
            return (), (
                "'constraints.decelerate_on_cancel' needs the 'velocity' state interface; "
                f'{instead}'
            )
        found = [
            parameters.joint_constraints[joint].max_deceleration_on_cancel for joint in self.joints
        ]
        for joint, deceleration in zip(self.joints, found, strict=True):
            if deceleration <= 0.0:
                return (), (
                    f"'constraints.{joint}.max_deceleration_on_cancel' is not set; {instead}"
                )
        return tuple(found), ''

    def _commanded(self) -> tuple[int, ...]:
        """Return the number of the joint that each command joint is."""
        _check(
            len(self.command_joints) > len(self.joints),
            "The 'command_joints' parameter must not exceed the size of the 'joints' parameter.",
        )
        if len(self.command_joints) == len(self.joints):
            return tuple(range(len(self.joints)))
        _check(
            not set(self.command_joints) <= set(self.joints),
            "'command_joints' parameter must be a subset of 'joints' parameter, if their size is "
            'not equal.',
        )
        return tuple(self.joints.index(joint) for joint in self.command_joints)

    def _check_commands(self) -> None:
        kinds = set(self.commands)
        _check(
            VELOCITY in kinds and len(kinds) > 1 and POSITION not in kinds,
            "'velocity' command interface can be used either alone or 'position' interface has to "
            'be present',
        )
        _check(
            ACCELERATION in kinds and not {VELOCITY, POSITION} <= kinds,
            "'acceleration' command interface can only be used if 'velocity' and 'position' "
            'interfaces are present',
        )
        _check(
            EFFORT in kinds and kinds not in ({EFFORT}, {EFFORT, POSITION}),
            "'effort' command interface has to be used alone or with a 'position' interface",
        )

    def _check_states(self) -> None:
        kinds = set(self.states)
        _check(
            VELOCITY in kinds and POSITION not in kinds,
            "'velocity' state interface cannot be used if 'position' interface is missing.",
        )
        _check(
            ACCELERATION in kinds and not {VELOCITY, POSITION} <= kinds,
            "'acceleration' state interface cannot be used if 'position' and 'velocity' "
            'interfaces are not present.',
        )

    def _check_together(self) -> None:
        has_both = {POSITION, VELOCITY} <= set(self.states)
        _check(
            set(self.commands) == {VELOCITY} and not has_both,
            "'velocity' command interface can only be used alone if 'velocity' and 'position' "
            'state interfaces are present',
        )
        _check(
            EFFORT in self.commands and not has_both,
            "'effort' command interface can only be used alone or with 'position' command "
            "interface if 'velocity' and 'position' state interfaces are present",
        )


class JointHandles:
    """The interfaces on loan, in the order of the joints."""

    def __init__(
        self,
        layout: JointLayout,
        commands: Sequence[CommandInterface],
        states: Sequence[StateInterface],
    ) -> None:
        """Take what was requested. Raises ControllerError: there is less."""
        for word, request, given in (
            ('command', layout.command_request, commands),
            ('state', layout.state_request, states),
        ):
            if len(given) != len(request.names):
                raise ControllerError(
                    f'Expected {len(request.names)} {word} interfaces, got {len(given)}.'
                )
        self._layout = layout
        step = len(layout.commands)
        of_joints = commands[: step * len(layout.command_joints)]
        self._commands = {kind: of_joints[k::step] for k, kind in enumerate(layout.commands)}
        step = len(layout.states)
        measured = states[: step * len(layout.joints)]
        self._states = {kind: measured[k::step] for k, kind in enumerate(layout.states)}
        self._positions = self._states[POSITION]
        self._velocities = self._states.get(VELOCITY, ())
        self._accelerations = self._states.get(ACCELERATION, ())
        self._is_partial = len(layout.command_joints) < len(layout.joints)
        self.scaling_state = states[-1] if layout.scaling_state else None
        self.scaling_command = commands[-1] if layout.scaling_command else None

    def measured(self, effort: tuple[float, ...] = ()) -> TrajectoryPoint:
        """Return where the joints are; ``effort`` is handed on."""
        return TrajectoryPoint(
            tuple([handle.value for handle in self._positions]),
            tuple([handle.value for handle in self._velocities]),
            tuple([handle.value for handle in self._accelerations]),
            effort,
        )

    def last_commands(self, measured: TrajectoryPoint) -> TrajectoryPoint | None:
        """
        Return the last commands as a state, and what is not commanded as it is measured.

        None: not every joint has them, or positions are not commanded.
        """
        if self._is_partial or POSITION not in self._commands:
            return None
        values = {
            kind: tuple(handle.value for handle in handles)
            for kind, handles in self._commands.items()
        }
        if any(map(math.isnan, (value for row in values.values() for value in row))):
            return None
        return TrajectoryPoint(
            values[POSITION],
            values.get(VELOCITY, measured.velocities) if self._velocities else (),
            values.get(ACCELERATION, measured.accelerations) if self._accelerations else (),
            values.get(EFFORT, ()),
        )

    def held_positions(self, measured: TrajectoryPoint) -> tuple[float, ...]:
        """Return the commanded position of each joint; the measured one, where there is none."""
        positions = list(measured.positions)
        for joint, handle in zip(
            self._layout.commanded, self._commands.get(POSITION, ()), strict=False
        ):
            if math.isfinite(handle.value):
                positions[joint] = handle.value
        return tuple(positions)

    def write(self, kind: str, values: tuple[float, ...]) -> tuple[float, ...]:
        """
        Command one kind of interface.

        Args:
            kind: of those that are commanded.
            values: of all joints.

        Returns:
            What was commanded, of all joints; NaN: not commanded.
        """
        handles = self._commands[kind]
        if not self._is_partial:
            for handle, value in zip(handles, values, strict=True):
                handle.value = value
            return values
        written = [math.nan] * len(values)
        for handle, joint in zip(handles, self._layout.commanded, strict=True):
            handle.value = written[joint] = values[joint]
        return tuple(written)

    def release(self) -> None:
        """Stop what would keep moving; position commands stay."""
        for kind, handles in self._commands.items():
            if kind != POSITION:
                for handle in handles:
                    handle.value = 0.0
