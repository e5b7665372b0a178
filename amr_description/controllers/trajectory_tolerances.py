# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How far a joint may be from its trajectory, on the way and at the goal.

A tolerance of 0 is none. Semantics and texts: ``tolerances.cpp`` of joint_trajectory_controller.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from amr_description.control.trajectory_samples import (
    FollowTrajectoryGoal,
    JointTolerance,
    TrajectoryPoint,
)
from amr_description.controllers.joint_trajectory_parameters import JointTrajectoryParameters
from amr_description.errors import ControllerError

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


def of_parameters(parameters: JointTrajectoryParameters) -> Tolerances:
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


def of_goal(
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
