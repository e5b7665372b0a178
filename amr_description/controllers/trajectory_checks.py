# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Why a joint trajectory is not accepted, in the words of joint_trajectory_controller.

Beyond the original, numbers that are not finite, joints named twice and efforts of another number
are refused: they would become commands that mean nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math

from amr_description.clock import NANOSECONDS
from amr_description.control.trajectory_samples import TrajectoryPoint, TrajectorySample

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
