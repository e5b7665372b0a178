# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of joint_trajectory_controller 4.x: names, types, defaults and bounds."""

from collections.abc import Mapping
from dataclasses import dataclass
import math
from typing import Any, ClassVar

from amr_description.control.interfaces import ACCELERATION, EFFORT, POSITION, VELOCITY
from amr_description.controllers.pid import PidGains, STRATEGIES
from amr_description.former_parameters import FormerParameter, ignored
from amr_description.parameters import group, keyed_group, parameter

_ANY: dict[str, Any] = {'nan': True}
"""Numbers that may be infinite."""
_CONTINUOUS = 'joints that the URDF calls continuous wrap around'


@dataclass(frozen=True)
class JointGains:
    """The PID of one joint, where velocity or effort alone is commanded."""

    former: ClassVar[tuple[FormerParameter, ...]] = (
        ignored('angle_wraparound', 'Humble', _CONTINUOUS),
        ignored('normalize_error', 'Humble', _CONTINUOUS),
    )
    p: float = parameter(0.0, 'Proportional gain')
    i: float = parameter(0.0, 'Integral gain')
    d: float = parameter(0.0, 'Derivative gain')
    ff_velocity_scale: float = parameter(0.0, 'Factor of the desired velocity, added to the PID')
    i_clamp: float = parameter(
        math.inf, 'Deprecated: integral clamp in both directions', minimum=0.0, **_ANY
    )
    i_clamp_max: float = parameter(math.inf, 'Upper integral clamp; infinite: i_clamp', **_ANY)
    i_clamp_min: float = parameter(-math.inf, 'Lower integral clamp; infinite: -i_clamp', **_ANY)
    u_clamp_max: float = parameter(math.inf, 'Upper output clamp', **_ANY)
    u_clamp_min: float = parameter(-math.inf, 'Lower output clamp', **_ANY)
    antiwindup: bool = parameter(False, 'Clamp the integral itself; of the strategy legacy')
    antiwindup_strategy: str = parameter(
        'legacy', 'Anti-windup strategy of the integral', choices=STRATEGIES, read_only=True
    )
    tracking_time_constant: float = parameter(
        0.0, 'Time constant of back_calculation; 0: from the gains', unit='s'
    )
    error_deadband: float = parameter(0.0, 'Errors up to this size are not integrated')

    def pid(self) -> PidGains:
        """Return the gains for :class:`~amr_description.controllers.pid.Pid`."""
        return PidGains(
            p=self.p,
            i=self.i,
            d=self.d,
            u_max=self.u_clamp_max,
            u_min=self.u_clamp_min,
            i_max=self.i_clamp_max if math.isfinite(self.i_clamp_max) else self.i_clamp,
            i_min=self.i_clamp_min if math.isfinite(self.i_clamp_min) else -self.i_clamp,
            strategy=self.antiwindup_strategy,
            antiwindup=self.antiwindup,
            tracking_time_constant=self.tracking_time_constant,
            error_deadband=self.error_deadband,
        )


@dataclass(frozen=True)
class JointConstraints:
    """How far one joint may be from its trajectory, and how fast it may stop."""

    trajectory: float = parameter(0.0, 'Position tolerance on the way; 0: none')
    goal: float = parameter(0.0, 'Position tolerance at the goal; 0: none')
    max_deceleration_on_cancel: float = parameter(
        0.0, 'Deceleration to a stop, see decelerate_on_cancel', minimum=0.0, read_only=True
    )


@dataclass(frozen=True)
class Constraints:
    """Those of all joints."""

    stopped_velocity_tolerance: float = parameter(
        0.01, 'Velocity tolerance at the goal; 0: none', unit='rad/s or m/s'
    )
    goal_time: float = parameter(
        0.0,
        'Time after the end of a trajectory in which its goal is reached; 0: any',
        unit='s',
        minimum=0.0,
    )
    decelerate_on_cancel: bool = parameter(
        False,
        'Come to rest by max_deceleration_on_cancel of each joint, not at once, when a goal is '
        'canceled or a tolerance violated; needs velocity states',
        read_only=True,
    )


@dataclass(frozen=True)
class SpeedScaling:
    """How fast trajectories pass; of later releases than Jazzy's first."""

    initial_scaling_factor: float = parameter(
        1.0, 'Factor of the speed until another one is given', minimum=0.0, read_only=True
    )
    state_interface: str = parameter(
        '', 'State interface, <prefix>/<name>, that has the factor', read_only=True
    )
    command_interface: str = parameter(
        '', 'Command interface, <prefix>/<name>, that gets the factor', read_only=True
    )


@dataclass(frozen=True)
class JointTrajectoryParameters:
    """The table of joint_trajectory_controller/JointTrajectoryController."""

    former: ClassVar[tuple[FormerParameter, ...]] = (
        ignored('start_with_holding', 'Humble', 'it always holds the position at activation'),
        ignored('state_publish_rate', 'Humble', '~/controller_state has every update'),
        ignored('interface_name', 'forward_command_controller', 'command_interfaces says it'),
        ignored('stop_trajectory_duration', 'ROS 1', 'see constraints.decelerate_on_cancel'),
        ignored('hold_trajectory_duration', 'ROS 1', 'see constraints.decelerate_on_cancel'),
    )
    joints: tuple[str, ...] = parameter(
        (), 'Joints of the trajectories', read_only=True, not_empty=True, unique=True
    )
    command_joints: tuple[str, ...] = parameter(
        (),
        'Joints that are commanded, if they have other names, or are fewer, than joints',
        read_only=True,
        unique=True,
    )
    command_interfaces: tuple[str, ...] = parameter(
        (),
        'Interfaces that are commanded',
        read_only=True,
        not_empty=True,
        unique=True,
        elements=(POSITION, VELOCITY, ACCELERATION, EFFORT),
    )
    state_interfaces: tuple[str, ...] = parameter(
        (),
        'Interfaces that are measured',
        read_only=True,
        not_empty=True,
        unique=True,
        elements=(POSITION, VELOCITY, ACCELERATION),
    )
    speed_scaling: SpeedScaling = group('speed_scaling', SpeedScaling)
    allow_partial_joints_goal: bool = parameter(False, 'Accept goals for some of the joints')
    open_loop_control: bool = parameter(
        False, 'Deprecated: use interpolate_from_desired_state, and gains of 0', read_only=True
    )
    interpolate_from_desired_state: bool = parameter(
        False, 'Begin trajectories at the last command, not at the measured state', read_only=True
    )
    allow_integration_in_goal_trajectories: bool = parameter(
        False, 'Accept points without positions'
    )
    set_last_command_interface_value_as_state_on_activation: bool = parameter(
        True, 'Hold the last command on activation, if there is one, not the measured state'
    )
    action_monitor_rate: float = parameter(
        20.0,
        'Rate of feedback, and at which results are looked for',
        unit='Hz',
        minimum=0.1,
        read_only=True,
    )
    interpolation_method: str = parameter(
        'splines', 'Interpolation between points', choices=('splines', 'none'), read_only=True
    )
    allow_nonzero_velocity_at_trajectory_end: bool = parameter(
        False, 'Accept trajectories that do not end at rest'
    )
    cmd_timeout: float = parameter(
        0.0,
        'How long the end of a trajectory is held; more than goal_time; 0: for ever',
        unit='s',
        minimum=0.0,
    )
    gains: Mapping[str, JointGains] = keyed_group('gains', 'joints', JointGains)
    constraints: Constraints = group('constraints', Constraints)
    joint_constraints: Mapping[str, JointConstraints] = keyed_group(
        'constraints', 'joints', JointConstraints
    )
