# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Why a joint trajectory is not accepted, and how far a joint may be from it.

In the words of joint_trajectory_controller. Beyond the original, numbers that are not finite,
joints named twice and efforts of another number are refused: they would become commands that mean
nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
import math
from typing import TypeAlias

from amr_description.clock import NANOSECONDS
from amr_description.control.trajectory_samples import (
    FollowTrajectoryGoal,
    JointTolerance,
    TrajectoryPoint,
    TrajectorySample,
)
from amr_description.controllers.joint_trajectory.parameters import (
    JointTrajectoryParameters,
)
from amr_description.errors import ControllerError

_FLOAT32_EPSILON = 2.0**-23


@dataclass(frozen=True, slots=True)
class TrajectoryRules:
    """What a trajectory has to be like."""

    joints: tuple[str, ...]
    allow_partial_joints: bool = False
    allow_integration: bool = False
    """Of points without positions."""
    allow_nonzero_end_velocity: bool = False
    has_effort: bool = False
    """Efforts are commanded."""

    def complaint(self, trajectory: TrajectorySample, time: int) -> str:
        """Return what is wrong with a trajectory at a time, ns; '': nothing."""
        return (
            self._names(trajectory)
            or self._end_velocity(trajectory)
            or _end_time(trajectory, time)
            or self._points(trajectory)
        )

    def _names(self, trajectory: TrajectorySample) -> str:
        names = trajectory.joint_names
        if not self.allow_partial_joints and len(names) != len(self.joints):
            return "Joints on incoming trajectory don't match the controller joints."
        if not names:
            return 'Empty joint names on incoming trajectory.'
        if not trajectory.points:
            return 'Empty trajectory received.'
        for name in names:
            if name not in self.joints:
                return f"Incoming joint {name} doesn't match the controller's joints."
        if len(set(names)) < len(names):
            return f'Incoming joints {", ".join(names)} name one of them twice.'
        return ''

    def _end_velocity(self, trajectory: TrajectorySample) -> str:
        if self.allow_nonzero_end_velocity:
            return ''
        velocities = trajectory.points[-1].velocities
        for name, velocity in zip(trajectory.joint_names, velocities, strict=False):
            if abs(velocity) > _FLOAT32_EPSILON:
                return (
                    f'Velocity of last trajectory point of joint {name} is not zero: '
                    f'{velocity:.15f}'
                )
        return ''

    def _points(self, trajectory: TrajectorySample) -> str:
        count = len(trajectory.joint_names)
        before = 0
        for number, (point, time) in enumerate(
            zip(trajectory.points, trajectory.times, strict=True)
        ):
            if number and time <= before:
                return (
                    f'Time between points {number - 1} and {number} is not strictly increasing, '
                    f'it is {before / NANOSECONDS:f} and {time / NANOSECONDS:f} respectively'
                )
            before = time
            if complaint := self._point(point, count, number):
                return complaint
        return ''

    def _point(self, point: TrajectoryPoint, count: int, number: int) -> str:
        if self.allow_integration:
            if not (point.positions or point.velocities or point.accelerations):
                return 'The given trajectory has no position, velocity, or acceleration points.'
        elif len(point.positions) != count:
            return _mismatch(count, 'positions', point.positions, number)
        for word, values in (
            ('positions', point.positions),
            ('velocities', point.velocities),
            ('accelerations', point.accelerations),
        ):
            if values and len(values) != count:
                return _mismatch(count, word, values, number)
        if point.effort:
            if not self.has_effort:
                return (
                    'Trajectories with effort fields are only supported for controllers using '
                    "the 'effort' command interface."
                )
            if len(point.effort) != count:
                return _mismatch(count, 'effort', point.effort, number)
        if not math.isfinite(
            sum(point.positions)
            + sum(point.velocities)
            + sum(point.accelerations)
            + sum(point.effort)
        ):
            return f'Point #{number} has a number that is not finite.'
        return ''


def _end_time(trajectory: TrajectorySample, time: int) -> str:
    end = trajectory.stamp + trajectory.times[-1]
    if trajectory.stamp == 0 or end >= time:
        return ''
    return (
        f'Received trajectory with non-zero start time ({trajectory.stamp / NANOSECONDS:f}) that '
        f'ends in the past ({end / NANOSECONDS:f})'
    )


def _mismatch(count: int, word: str, values: Sequence[float], number: int) -> str:
    return (
        f'Mismatch between joint_names size ({count}) and {word} ({len(values)}) at point '
        f'#{number}.'
    )


_ERASE = -1.0
_EPSILON = 2.0**-52
_KINDS = ('position', 'velocity', 'acceleration')

Limits: TypeAlias = tuple[float, float, float]
"""Of position, velocity, acceleration; 0: none."""


@dataclass(frozen=True, slots=True)
class Violation:
    """What exceeds its tolerance at a joint."""

    joint: int
    """Its number."""
    kind: str
    """``position``, ``velocity`` or ``acceleration``."""
    error: float
    limit: float


@dataclass(frozen=True, slots=True)
class StateTolerances:
    """The tolerances of all joints at one state."""

    limits: tuple[Limits, ...]

    def violations(self, error: TrajectoryPoint) -> list[Violation]:
        """
        Return what exceeds its tolerance; errors that are not known, as NaN, do not.

        Args:
            error: desired − actual; velocities and accelerations may be empty.
        """
        found = []
        for kind, errors, row in zip(
            _KINDS, (error.positions, error.velocities, error.accelerations), range(3), strict=True
        ):
            for joint, value in enumerate(errors):
                limit = self.limits[joint][row]
                if limit > 0.0 and abs(value) > limit:
                    found.append(Violation(joint, kind, value, limit))
        return found


@dataclass(frozen=True, slots=True)
class Tolerances:
    """What holds during a trajectory, and at its end."""

    path: StateTolerances
    goal: StateTolerances
    goal_time: float = 0.0
    """s in which the goal has to be reached after its time; 0: it may take for ever."""


def tolerances_of_parameters(parameters: JointTrajectoryParameters) -> Tolerances:
    """Return those of the parameters."""
    constraints = parameters.constraints
    joints = [parameters.joint_constraints[joint] for joint in parameters.joints]
    return Tolerances(
        StateTolerances(tuple((each.trajectory, 0.0, 0.0) for each in joints)),
        StateTolerances(
            tuple((each.goal, constraints.stopped_velocity_tolerance, 0.0) for each in joints)
        ),
        constraints.goal_time,
    )


def resolved(default: float, wanted: float) -> float:
    """
    Return the tolerance in force; see :class:`JointTolerance`.

    Raises:
        ControllerError: ``wanted`` is another negative number than −1.
    """
    if wanted > 0.0:
        return wanted
    if abs(wanted - _ERASE) < _EPSILON:
        return 0.0
    if wanted < 0.0:
        raise ControllerError('Illegal tolerance value.')
    return default


def tolerances_of_goal(
    defaults: Tolerances, goal: FollowTrajectoryGoal, joints: Sequence[str]
) -> tuple[Tolerances, str]:
    """
    Return the tolerances of a goal, and a complaint.

    Args:
        defaults: those of the parameters; they hold where the goal has a mistake, of which the
            complaint speaks.
        goal: with tolerances of its own.
        joints: in their order.
    """
    try:
        goal_time = resolved(defaults.goal_time, goal.goal_time_tolerance)
    except ControllerError:
        return defaults, (
            f'Illegal goal time tolerance specified: {goal.goal_time_tolerance:f}. Using default '
            'tolerances.'
        )
    try:
        path = _merged('path', defaults.path, goal.path_tolerance, joints)
        end = _merged('goal', defaults.goal, goal.goal_tolerance, joints)
    except ControllerError as error:
        return defaults, str(error)
    return replace(defaults, path=path, goal=end, goal_time=goal_time), ''


def _merged(
    word: str,
    defaults: StateTolerances,
    wanted: Sequence[JointTolerance],
    joints: Sequence[str],
) -> StateTolerances:
    limits = list(defaults.limits)
    for each in wanted:
        if each.name not in joints:
            raise ControllerError(
                f"{word.capitalize()} tolerance specified for unknown joint '{each.name}'. Using "
                'default tolerances.'
            )
        joint = joints.index(each.name)
        position, velocity, acceleration = (
            _resolved_of(word, kind, each, default)
            for kind, default in zip(_KINDS, defaults.limits[joint], strict=True)
        )
        limits[joint] = (position, velocity, acceleration)
    return StateTolerances(tuple(limits))


def _resolved_of(word: str, kind: str, tolerance: JointTolerance, default: float) -> float:
    try:
        return resolved(default, getattr(tolerance, kind))
    except ControllerError:
        raise ControllerError(
            f"Illegal {kind} {word} tolerance value specified for joint '{tolerance.name}'. Using "
            'default tolerances.'
        ) from None
