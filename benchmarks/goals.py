# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The figures of ``scripts/bench``, each with its goal; the report, and which goals are missed. Pure.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
import enum
import math


class Direction(enum.Enum):
    """On which side of its limit a figure is good."""

    AT_LEAST = '≥'
    AT_MOST = '≤'


@dataclass(frozen=True)
class Goal:
    """A figure and what it shall be."""

    key: str
    name: str
    unit: str
    direction: Direction
    limit: float
    part: str
    """Of ``scripts/bench``, which measures it."""
    needs_quiet: bool = True
    """False: other programs hardly change it, as it is processor time, or memory."""

    def is_met(self, value: float) -> bool:
        """Return whether a value is as good as wanted."""
        if self.direction is Direction.AT_LEAST:
            return value >= self.limit
        return value <= self.limit


_AT_LEAST, _AT_MOST = Direction.AT_LEAST, Direction.AT_MOST

GOALS = (
    Goal('stack', 'full stack ÷ mj_step alone, heard', '', _AT_LEAST, 0.42, 'speed'),
    Goal('clock', 'full stack ÷ mj_step alone, /clock heard', '', _AT_LEAST, 0.52, 'speed'),
    Goal('engine', 'without ROS ÷ mj_step alone', '', _AT_LEAST, 0.72, 'engine', False),
    Goal('engine fleet', '…, ten robots', '', _AT_LEAST, 0.5, 'engine', False),
    Goal('engine start', '…, first step', 's', _AT_MOST, 0.5, 'engine', False),
    Goal('engine reset', '…, a reset', 'ms', _AT_MOST, 2.0, 'engine', False),
    Goal('engine memory', '…, memory', 'MB', _AT_MOST, 120.0, 'engine', False),
    Goal('beside', 'a cycle besides physics, heard', 'µs', _AT_MOST, 50.0, 'speed', False),
    Goal('warm', 'warm start to both controllers', 's', _AT_MOST, 1.8, 'stack'),
    Goal('cold', 'cold set-up to ready', 's', _AT_MOST, 90.0, 'cold'),
    Goal('load', 'whole stack at factor 1, driven', '% of a core', _AT_MOST, 12.0, 'stack', False),
    Goal(
        'transforms',
        'robot_state_publisher at 100 Hz',
        '% of a core',
        _AT_MOST,
        2.0,
        'robot_state_publisher',
        False,
    ),
    Goal('page', "page's node, one page, driven", '% of a core', _AT_MOST, 6.0, 'stack', False),
    Goal('pages', "page's node, 20 pages, driven", '% of a core', _AT_MOST, 12.0, 'page', False),
    Goal('plot', 'ten plotted fields of 100 Hz', '% of a core', _AT_MOST, 2.0, 'page', False),
    Goal('key', 'key to command, p95', 'ms', _AT_MOST, 5.0, 'page'),
    Goal('drawn', 'first drawn robot, cold', 's', _AT_MOST, 1.5, 'page'),
    Goal('frames', 'frames, software GL, driving', '/s', _AT_LEAST, 20.0, 'page'),
    Goal('held', 'held key, gaps p99', 'ms', _AT_MOST, 100.0, 'page'),
    Goal('heap', 'heap of a driving page, a minute', 'MB more', _AT_MOST, 0.5, 'page', False),
    Goal('fleet', '20 robots, real-time factor', '', _AT_LEAST, 5.0, 'fleet'),
    Goal('fleet bare', '20 robots, mj_step alone', '', _AT_LEAST, 18.0, 'fleet', False),
    Goal('fleet start', 'ten robots to driving', 's', _AT_MOST, 8.0, 'fleet_start'),
    Goal('100 Hz p50', 'cmd_vel to wheels at 100 Hz, p50', 'ms', _AT_MOST, 12.0, 'latency'),
    Goal('100 Hz p99', 'cmd_vel to wheels at 100 Hz, p99', 'ms', _AT_MOST, 12.0, 'latency'),
    Goal('1 kHz p50', 'cmd_vel to wheels at 1 kHz, p50', 'ms', _AT_MOST, 3.0, 'latency'),
    Goal('1 kHz p99', 'cmd_vel to wheels at 1 kHz, p99', 'ms', _AT_MOST, 3.0, 'latency'),
    Goal('missed', '1 kHz control, cycles missed', '', _AT_MOST, 0.0, 'latency'),
    Goal('late', '1 kHz control, lateness p99', 'ms', _AT_MOST, 2.0, 'latency'),
    Goal('list', 'ros2 topic list', 's', _AT_MOST, 0.6, 'stack'),
    Goal('doctor', 'ros2 doctor, nothing running', 's', _AT_MOST, 2.0, 'stack'),
    # All of what is published: both rates are means over some seconds, and not quite the same
    # ones: 99.5 rounds to all of it, and 10 ms at either end are two thousandths.
    Goal('hz', 'ros2 topic hz of 1 kHz', '%', _AT_LEAST, 99.5, 'stack'),
    Goal('scan', '360 rays in warehouse', 'ms', _AT_MOST, 0.5, 'sensors', False),
    Goal('scan load', '360 rays at 10 Hz, heard', '% of a core', _AT_MOST, 1.5, 'sensors', False),
    Goal('rings', '16 × 1024 rays at 10 Hz, factor 1 held', '', _AT_LEAST, 0.99, 'sensors'),
    Goal(
        'picture', 'pictures 320 × 240 of rays', '/s of a core', _AT_LEAST, 20.0, 'sensors', False
    ),
    Goal('depth', 'depths 320 × 240 of rays', '/s of a core', _AT_LEAST, 40.0, 'sensors', False),
    Goal('unheard', 'sensors that nobody hears, a cycle', 'µs', _AT_MOST, 5.0, 'sensors', False),
    Goal('sensors late', 'all sensors on, lateness p99 more by', 'ms', _AT_MOST, 1.0, 'sensors'),
    Goal('small', 'ros2 bag record of 20,000/s of 100 B', '%', _AT_LEAST, 100.0, 'recording'),
    Goal('large', 'ros2 bag record of 200 MB/s of 1 MB', '%', _AT_LEAST, 100.0, 'recording'),
    Goal('played', 'a bag at 1000 messages/s, lateness p95', 'ms', _AT_MOST, 1.0, 'playing'),
    Goal('memory', 'one simulated hour, memory', 'MB more', _AT_MOST, 1.0, 'memory', False),
)
"""All figures of the table, in its order."""

_NAME, _VALUE, _UNIT = 42, 9, 12


def report(
    values: Mapping[str, float],
    left_out: Mapping[str, str],
    goals: Iterable[Goal] = GOALS,
    *,
    is_quiet: bool = True,
) -> str:
    """
    Return the table.

    Args:
        values: By key of their goal, in its unit.
        left_out: Why a figure is not measured, by key.
        goals: The rows.
        is_quiet: False: rows that need a quiet machine say that it was none.
    """
    lines = [f'{"figure":<{_NAME}}{"value":>{_VALUE}} {"":<{_UNIT}} {"goal":>9}']
    for goal in goals:
        limit = f'{goal.direction.value} {goal.limit:g}'
        value = values.get(goal.key)
        if value is None:
            shown, note = '-', f'not measured: {left_out.get(goal.key, "it was not asked for")}'
        else:
            shown, note = rounded(value), '' if goal.is_met(value) else 'missed'
            if goal.needs_quiet and not is_quiet:
                note = f'{note or "met"}, on a busy machine'
        line = f'{goal.name:<{_NAME}}{shown:>{_VALUE}} {goal.unit:<{_UNIT}} {limit:>9}  {note}'
        lines.append(line.rstrip())
    return '\n'.join(lines)


def missed(
    values: Mapping[str, float],
    left_out: Mapping[str, str],
    goals: Iterable[Goal] = GOALS,
    parts: Collection[str] | None = None,
) -> list[str]:
    """
    Return a line for each goal that is missed, and for each figure that could not be measured.

    Args:
        values: As of :func:`report`.
        left_out: As of :func:`report`.
        goals: The rows.
        parts: Those that were asked for, others do not count; None: all.
    """
    lines = []
    for goal in goals:
        if parts is not None and goal.part not in parts:
            continue
        value = values.get(goal.key)
        limit = f'the goal is {goal.direction.value} {goal.limit:g} {goal.unit}'.rstrip()
        if value is None:
            reason = left_out.get(goal.key, 'it was not asked for')
            lines.append(f'{goal.name}: not measured: {reason}; {limit}')
        elif not goal.is_met(value):
            lines.append(f'{goal.name}: {f"{rounded(value)} {goal.unit}".rstrip()}; {limit}')
    return lines


def rounded(value: float) -> str:
    """Return a figure with three digits, or more before the point."""
    if not math.isfinite(value) or not value:
        return f'{value:g}'
    return f'{value:.{max(0, 2 - math.floor(math.log10(abs(value))))}f}'
