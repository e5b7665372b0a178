# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a robot did, in one of three verdicts with the reason: as told, off, or not at all; the table.

A warning of the simulator is a reason for a motion that is off only if it explains that deviation:
a wheel of half the radius that is told does not make a robot turn the other way.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
import math
import re
from typing import TypeAlias

from amr_description.testing.trial.findings import MotionResult, RestResult, TrialFindings
from amr_description.text import one_line

HEADINGS = ('robot', 'check', 'spawn', 'rest', 'controllers', 'motion', 'WARN', 'wall', 'CPU')
_SHOWN_WARNINGS = 3
_WIDTH = 250
"""Characters of a line below a row."""
TOLERANCE = 0.05
"""Of the command."""
_GETS_AWAY = 0.1
"""Of what is asked; what makes less of it does not get away."""


_DRIVEN = ('forward', 'turn', 'sideways')
"""Motions of a whole robot; all others are of joints."""


class TrialVerdict(StrEnum):
    """What a robot did."""

    AS_TOLD = 'moved as told'
    OFF = 'moved, off'
    NOT = 'did not move'


@dataclass(frozen=True)
class Judgement:
    """A verdict, and why it is no better; of a robot that moved as told, what it did without."""

    verdict: TrialVerdict
    reason: str = ''

    def __str__(self) -> str:
        return f'{self.verdict} ({self.reason})' if self.reason else f'{self.verdict}'


def judge(found: TrialFindings) -> Judgement:
    """Return the verdict on a robot, by its motions and all that is not as it should be."""
    motions = [each for each in found.motions if not each.is_fine]
    reasons = [
        *found.posture,
        *(f'{figure(each)}: {_bare(each.said) or cause_of(each)}' for each in motions),
        *found.faults,
        *found.explained,
    ]
    if not any(map(gets_away, found.motions)):
        nothing = [*found.undriven, 'no active controller is one that moves']
        return Judgement(TrialVerdict.NOT, [*reasons, *nothing][0])
    if reasons:
        return Judgement(TrialVerdict.OFF, reasons[0])
    return Judgement(TrialVerdict.AS_TOLD, _without(found.spare))


def _without(spare: Sequence[str]) -> str:
    """Return which controllers a robot did without; '': it has all."""
    return f'without {"; ".join(spare)}' if spare else ''


def gets_away(motion: MotionResult) -> bool:
    """Return whether something moved by a command, be it too far, or the other way."""
    asked, truth = motion.asked, motion.truth
    return truth is not None and math.isfinite(truth) and abs(truth) > _GETS_AWAY * abs(asked)


# --- one motion ---------------------------------------------------------------------------------


def figure(motion: MotionResult) -> str:
    """Return how much of what was asked came of a motion."""
    if motion.truth is None or not motion.asked:
        return f'{motion.controller}: {motion.what}{f" ({motion.note})" if motion.note else ""}'
    return f'{motion.controller}: {motion.what} {100.0 * motion.truth / motion.asked:.0f} %'


def describe(motion: MotionResult) -> str:
    """Return a motion that is not as it should be, in one line."""

    def number(value: float | None) -> str:
        return '?' if value is None else f'{value:.3f}'

    odometry = '' if motion.odometry is None else f', odometry {number(motion.odometry)}'
    line = f'{motion.controller}: {motion.what} {motion.asked:.3f}: truth {number(motion.truth)}'
    return f'{line}{odometry}' + (f' ({motion.note})' if motion.note else '')


def cause_of(motion: MotionResult) -> str:
    """Return what truth and odometry of a motion that is not as it should be have in common."""
    asked, truth, odometry = motion.asked, motion.truth, motion.odometry
    if truth is None or not asked:
        return 'not measured'
    if abs(truth + asked) <= TOLERANCE * asked:
        return 'the other way: wheels are swapped, or an axis is upside down'
    if motion.what not in _DRIVEN:
        return 'its joints do not follow: by gains that do not fit them, or motors too weak'
    if odometry is None:
        return 'no odometry to compare with'
    if abs(odometry - asked) > TOLERANCE * asked:
        return 'by its odometry, too: a limit, or a wrong radius or separation'
    return 'not by its odometry: wheels slip, or roll otherwise than the parameters say'


def explanations(motion: MotionResult, logged_lines: Sequence[str]) -> list[str]:
    """Return what was said of the controller of a motion, or of slip, and explains how far off."""
    if motion.truth is None or not motion.asked:
        return []
    named = re.compile(rf'(?<![\w/]){re.escape(motion.controller)}: ')
    share = motion.truth / motion.asked
    return [
        line
        for line in logged_lines
        if line.startswith(('WARN', 'ERROR'))
        and (named.search(line) or _OF_ANY.search(line))
        and any(said.search(line) and does(motion.what, share, line) for said, does in _REASONS)
    ]


def _bare(said: str) -> str:
    """Return the first of what was said, without its severity, and folders of files."""
    return re.sub(r'^\w+: (?:\S*/)?', '', said.partition('; WARN: ')[0])


def _figures(line: str) -> tuple[float, float] | None:
    """Return what was found, and what it should be, of a line of the checker."""
    numbers = re.search(rf'({_NUMBER}) m(?:, | \([^)]*\), )expected ({_NUMBER}) m', line)
    if numbers is None:
        return None
    found, expected = map(float, numbers.groups())
    return (found, expected) if found and expected else None


def _by_size(line: str, share: float, *, is_inverse: bool) -> bool:
    """Return whether a size that is not told right makes a motion so much longer or shorter."""
    figures = _figures(line)
    if figures is None:
        return False
    found, true = figures
    predicted = found / true if is_inverse else true / found
    # Other deviations may come to it, and then it is a part of them: on the same side of 1.
    return abs(share - predicted) <= TOLERANCE * predicted or (
        share > 0.0 and (share - 1.0) * (predicted - 1.0) > 0.0
    )


_Explains: TypeAlias = Callable[[str, float, str], bool]
_NUMBER = r'[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?'
_OF_ANY = re.compile(r'they slip|scrub|is not on all its wheels|is clamped|out of limits')
"""What is said of a robot, or of its joints, and not of a controller."""
_REASONS: tuple[tuple[re.Pattern[str], _Explains], ...] = (
    (
        re.compile(r'swapped|does not steer to the left'),
        lambda what, share, _: what == 'turn' and share < 0.0,
    ),
    # The wheel outside turns slower than that inside, and is steered more: they turn it less.
    (re.compile(r'in the order'), lambda what, share, _: what == 'turn' and share < 1.0),
    (re.compile(r'turns? backwards|the other way'), lambda what, share, _: share < 1.0),
    (re.compile(r'scrub'), lambda what, share, _: what == 'turn' and 0.0 <= share < 1.0),
    (re.compile(r'they slip|slides'), lambda what, share, _: 0.0 <= share < 1.0),
    (re.compile(r'have rollers|not at the corner'), lambda what, share, _: what != 'forward'),
    (re.compile(r'does not roll ahead|not where wheel|outwards'), lambda *_: True),
    (
        re.compile(r'radius|diameter'),
        lambda what, share, line: _by_size(line, share, is_inverse=False),
    ),
    (
        re.compile(r'separation|track|kingpin|projection'),
        lambda what, share, line: what == 'turn' and _by_size(line, share, is_inverse=True),
    ),
    (
        re.compile(r'wheel_?base|axle to axle'),
        lambda what, share, line: what == 'turn' and _by_size(line, share, is_inverse=True),
    ),
    (
        re.compile(r'is clamped|out of limits|is beyond|limited to'),
        lambda what, share, _: 0.0 <= share < 1.0,
    ),
    (re.compile(r'is not on all its wheels'), lambda *_: True),
)
"""What is said → whether that makes a motion (what, share of the command, line) as it was."""


# --- the table ----------------------------------------------------------------------------------


def row(found: TrialFindings) -> tuple[str, ...]:
    """Return the cells of a robot, in the order of :data:`HEADINGS`."""
    check = found.check
    active = sum(each.state == 'active' for each in found.controllers)
    return (
        found.robot,
        'failed' if check.failure else f'{len(check.errors)}E {len(check.warnings)}W',
        'refused' if found.spawn_seconds is None else f'{found.spawn_seconds:.1f} s',
        _rest(found.rest),
        f'{active}/{len(found.controllers)}',
        '; '.join(dict.fromkeys(map(_motion, found.motions))) or '-',
        str(len(found.warnings)),
        f'{found.seconds:.0f}',
        f'{found.cpu_seconds:.1f}',
    )


def _rest(rest: RestResult | None) -> str:
    if rest is None:
        return '-'
    return f'{rest.seconds:.1f} s' if math.isfinite(rest.seconds) else 'no'


def _motion(motion: MotionResult) -> str:
    sign = '' if motion.is_fine else '~' if motion.said else '!'
    if motion.truth is None or not motion.asked:
        return f'{sign}{motion.what}'
    return f'{sign}{motion.what} {100.0 * motion.truth / motion.asked:.0f}%'


def table(findings: Sequence[TrialFindings], *, details: bool = True) -> str:
    """Return the table; with ``details``, reasons and the first warnings below each robot."""
    rows = [HEADINGS, *map(row, findings)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ['  '.join(map(str.ljust, HEADINGS, widths)).rstrip()]
    for found, cells in zip(findings, rows[1:], strict=True):
        judged = judge(found)
        lines.append(f'{"  ".join(map(str.ljust, cells, widths)).rstrip()}  {judged.verdict}')
        if details:
            if judged.reason:
                lines.append(_shortened(f'    {judged}'))
            lines += [_shortened(f'    posture: {each}') for each in found.posture]
            lines += [_shortened(f'    without: {each}') for each in found.spare]
            lines += [_shortened(f'    fault: {fault}') for fault in found.faults]
            lines += [_shortened(f'    explained: {each}') for each in found.explained]
            lines += [_shortened(f'    {warning}') for warning in _short_list(found.warnings)]
    return '\n'.join([*lines, tells(findings)])


def _short_list(lines: Sequence[str]) -> list[str]:
    left = len(lines) - _SHOWN_WARNINGS
    return [*lines[:_SHOWN_WARNINGS], *([f'… and {left} lines more'] if left > 0 else [])]


def _shortened(text: str) -> str:
    line = one_line(text)
    return line if len(line) <= _WIDTH else f'{line[: _WIDTH - 1]}…'


def tells(findings: Sequence[TrialFindings]) -> str:
    """Return how many robots did what, in one line."""
    verdicts = [judge(each).verdict for each in findings]
    parts = [f'{verdicts.count(each)} {each}' for each in TrialVerdict]
    inert = sum(
        not each.has_drive and verdict is TrialVerdict.NOT
        for each, verdict in zip(findings, verdicts, strict=True)
    )
    more = f', {inert} of them without anything in their description that drives' if inert else ''
    spared = sum(
        verdict is TrialVerdict.AS_TOLD and bool(each.spare)
        for each, verdict in zip(findings, verdicts, strict=True)
    )
    if spared:
        parts[0] += f', {spared} of them without controllers that cannot be here'
    return f'{len(findings)} tried: {"; ".join(parts)}{more}'
