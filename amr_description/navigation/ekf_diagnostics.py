# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is wrong with the settings and the data of a filter, in the words of robot_localization.

The rate of updates is judged as by diagnostic_updater: over the last ten periods, within 2 Hz and
a tenth of what is asked.
"""

from collections import deque
from collections.abc import Iterator, Sequence
import enum
from typing import NamedTuple

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.navigation.ekf import Array, StateMember
from amr_description.navigation.ekf_measurement import Mask
from amr_description.navigation.ekf_parameters import EkfParameters

_LARGE_COVARIANCE = 1e3
_WINDOW = 10
_TOLERANCE = 0.1
_ALLOWED_DIFFERENCE = 2.0  # Hz
_SUMMARIES = (
    'The robot_localization state estimation node appears to be functioning properly.',
    'Potentially erroneous data or settings detected for a robot_localization state estimation '
    'node.',
    'Erroneous data or settings detected for a robot_localization state estimation node.',
)
NAMES = (
    'X', 'Y', 'Z', 'ROLL', 'PITCH', 'YAW',
    'X_VELOCITY', 'Y_VELOCITY', 'Z_VELOCITY', 'ROLL_VELOCITY', 'PITCH_VELOCITY', 'YAW_VELOCITY',
    'X_ACCELERATION', 'Y_ACCELERATION', 'Z_ACCELERATION',
)  # fmt: skip
"""Of the states."""


class Level(enum.IntEnum):
    """As in ``diagnostic_msgs/msg/DiagnosticStatus``."""

    OK = 0
    WARN = 1
    ERROR = 2


class EkfStatus(NamedTuple):
    """One status of ``/diagnostics``."""

    name: str
    level: Level
    message: str
    values: Sequence[tuple[str, str]]


class FilterDiagnostics:
    """What was found wrong: with settings, for good, and with data, until it is reported."""

    def __init__(self, parameters: EkfParameters) -> None:
        self._static = {key: (level, text) for level, key, text in _on_settings(parameters)}
        self._dynamic: dict[str, tuple[Level, str]] = {}

    def add(self, key: str, text: str) -> None:
        """Note something wrong with data."""
        self._dynamic[key] = (Level.WARN, text)

    def take(self) -> EkfStatus:
        """Return what is known, and forget what is wrong with data."""
        found = {**self._static, **self._dynamic}
        self._dynamic.clear()
        level = max((level for level, _ in found.values()), default=Level.OK)
        values = [(key, text) for key, (_, text) in found.items()]
        return EkfStatus('Filter diagnostic updater', level, _SUMMARIES[level], values)


class RateDiagnostics:
    """Whether ``odometry/filtered`` is published as often as asked."""

    def __init__(self, frequency: float) -> None:
        """``frequency``: Hz."""
        self._bounds = (
            (frequency - _ALLOWED_DIFFERENCE) * (1.0 - _TOLERANCE),
            (frequency + _ALLOWED_DIFFERENCE) * (1.0 + _TOLERANCE),
        )
        self._count = 0
        self._windows: deque[tuple[int, int]] = deque(maxlen=_WINDOW)

    def tick(self) -> None:
        """Count a message."""
        self._count += 1

    def take(self, now: int) -> EkfStatus:
        """Return the rate since the tenth call before this one; ``now``: ns."""
        self._windows = self._windows or deque([(now, 0)], _WINDOW)
        since, before = self._windows[0]
        events, seconds = self._count - before, (now - since) / NANOSECONDS
        self._windows.append((now, self._count))
        frequency = events / seconds if seconds > 0.0 else 0.0
        lowest, highest = self._bounds
        level, message = Level.OK, 'Desired frequency met'
        if not events:
            level, message = Level.ERROR, 'No events recorded.'
        elif frequency < lowest:
            level, message = Level.WARN, 'Frequency too low.'
        elif frequency > highest:
            level, message = Level.WARN, 'Frequency too high.'
        values = [
            ('Events in window', str(events)),
            ('Events since startup', str(self._count)),
            ('Duration of window (s)', f'{seconds:f}'),
            ('Actual frequency (Hz)', f'{frequency:f}'),
            ('Minimum acceptable frequency (Hz)', f'{lowest:f}'),
            ('Maximum acceptable frequency (Hz)', f'{highest:f}'),
        ]
        return EkfStatus('odometry/filtered topic status', level, message, values)


def complaint_on(covariance: Array, used: Mask, offset: int) -> str:
    """
    Return what is wrong with a covariance of a message; '' if nothing is.

    Args:
        covariance: of states that follow each other.
        used: of all 15 states.
        offset: the first state that it is of.
    """
    size = len(covariance)
    mask = used[offset : offset + size]
    for row, column in np.argwhere((mask[:, None] | mask) & (covariance > _LARGE_COVARIANCE)):
        first, second = NAMES[offset + row], NAMES[offset + column]
        of = f'{first} variance' if row == column else f'{first} and {second} covariance'
        which = first if row == column else f'{first} and/or {second}'
        return (
            f'The covariance at position ({size * row + column}), which corresponds to {of}, the '
            f'value is extremely large ({covariance[row, column]:g}), but the update vector for '
            f'{which} is set to true. This may produce undesirable results.'
        )
    variances = np.diagonal(covariance)
    for row in np.flatnonzero(mask & (variances <= 0.0)):
        sign, small = ('zero', 'small') if variances[row] == 0.0 else ('negative', 'positive')
        return (
            f'The covariance at position ({size * row + row}), which corresponds to '
            f'{NAMES[offset + row]} variance, was {sign}. This will be replaced with a {small} '
            'value to maintain filter stability, but should be corrected at the message origin '
            'node.'
        )
    return ''


def _on_settings(parameters: EkfParameters) -> Iterator[tuple[Level, str, str]]:
    """Yield (level, key, text) of what the inputs measure several times, or not at all."""
    poses, twists = np.zeros(6, dtype=int), np.zeros(6, dtype=int)
    for each in parameters.inputs:
        if not each.is_used:
            yield (
                Level.WARN,
                f'{each.topic}_configuration',
                f'{each.topic} is listed as an input topic, but all update variables are false',
            )
        (twists if each.pose.differential else poses)[:] += each.pose.used[:6]
        twists += each.twist.used[6:12]
    is_flat = parameters.is_on('two_d_mode')
    for member in range(StateMember.X, StateMember.YAW + 1):
        key = f'{NAMES[member]}_configuration'
        if poses[member] > 1:
            yield (
                Level.WARN,
                key,
                f'{poses[member]} absolute pose inputs detected for {NAMES[member]}. This may '
                'result in oscillations. Please ensure that your variances for each measured '
                'variable are set appropriately.',
            )
        in_plane = member in (StateMember.X, StateMember.Y, StateMember.YAW)
        if not poses[member] and not twists[member] and (in_plane or not is_flat):
            yield (
                Level.ERROR,
                key,
                f'Neither {NAMES[member]} nor its velocity is being measured. This will result in '
                'unbounded error growth and erratic filter behavior.',
            )
