# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is found of a robot, as data that JSON can hold; the verdict, and the row of the table."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
import json
import math
from typing import Any

from amr_description.text import one_line

HEADINGS = ('robot', 'check', 'spawn', 'rest', 'controllers', 'motion', 'WARN', 'wall', 'CPU')
_SHOWN_WARNINGS = 3
_WIDTH = 250
"""Characters of a line below a row."""


@dataclass
class Check:
    """What ``check_urdf`` says."""

    exit_code: int | None = None
    """None: it did not end by itself."""
    errors: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    failure: str = ''
    """A traceback, or why nothing could be checked."""


@dataclass
class RestResult:
    """Three seconds after the spawn without a command."""

    seconds: float
    """Until the root link stands; infinite: it does not."""
    fastest: float
    """Of the root link, m/s."""
    drop: float
    """How far the root link has sunk, m."""
    shift: float
    """How far it has gone aside, m."""
    tilt: float
    """Between its z axis before and after, rad."""


@dataclass
class ControllerFinding:
    """One controller of the parameters."""

    name: str
    type: str
    state: str
    """``active``, ``inactive``, ``unconfigured``, or ``not loaded``."""
    reason: str = ''
    """Why it is not active, or what gave way to it."""


@dataclass
class MotionResult:
    """One motion: what was asked, and what came of it, in m, rad, m/s and rad/s."""

    controller: str
    what: str
    asked: float
    truth: float | None
    odometry: float | None = None
    is_fine: bool = True
    note: str = ''
    said: str = ''
    """What the simulator has said that explains why it is not fine: then it is no fault."""


@dataclass
class TrialFindings:
    """Everything about one robot."""

    robot: str
    file: str
    parameters: list[str] = field(default_factory=list)
    parameters_by: str = ''
    """How the parameter file was found."""
    stage: str = 'start'
    """What was under way when this was written; ``done``: it came to the end."""
    check: Check = field(default_factory=Check)
    spawn_seconds: float | None = None
    """s of the wall clock, with the start of the simulator; None: not spawned."""
    rest: RestResult | None = None
    controllers: list[ControllerFinding] = field(default_factory=list)
    motions: list[MotionResult] = field(default_factory=list)
    explained: list[str] = field(default_factory=list)
    """Motions that are off for a reason that the simulator has named."""
    undriven: list[str] = field(default_factory=list)
    """Active controllers that were not tried, and why."""
    warnings: list[str] = field(default_factory=list)
    """WARN and ERROR lines of the simulator."""
    faults: list[str] = field(default_factory=list)
    """What is not as it should be; empty: the robot is fine."""
    seconds: float = 0.0
    """s of the wall clock."""
    cpu_seconds: float = 0.0
    """s of all processes of this robot."""

    @property
    def is_fine(self) -> bool:
        """Whether nothing is wrong."""
        return not self.faults


def to_json(findings: Sequence[TrialFindings]) -> str:
    """Return everything as JSON, numbers that it does not have as null."""
    return json.dumps([_finite(asdict(each)) for each in findings], indent=1, ensure_ascii=False)


def from_json(text: str) -> TrialFindings:
    """Return what :func:`to_json` has written of one robot."""
    values = json.loads(text)[0]
    rest = values['rest']
    values['check'] = Check(**values['check'])
    if rest is not None:
        values['rest'] = RestResult(**{k: math.inf if v is None else v for k, v in rest.items()})
    values['controllers'] = [ControllerFinding(**each) for each in values['controllers']]
    values['motions'] = [MotionResult(**each) for each in values['motions']]
    return TrialFindings(**values)


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


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
    """Return the table; with ``details``, faults and the first warnings below each robot."""
    rows = [HEADINGS, *map(row, findings)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ['  '.join(map(str.ljust, HEADINGS, widths)).rstrip()]
    for found, cells in zip(findings, rows[1:], strict=True):
        mark = 'ok  ' if found.is_fine else 'FAIL'
        lines.append('  '.join(map(str.ljust, cells, widths)).rstrip() + f'  {mark}'.rstrip())
        if details:
            lines += [_shortened(f'    fault: {fault}') for fault in found.faults]
            lines += [_shortened(f'    explained: {each}') for each in found.explained]
            lines += [_shortened(f'    {warning}') for warning in _short_list(found.warnings)]
    fine = sum(each.is_fine for each in findings)
    return '\n'.join([*lines, f'{fine} of {len(findings)} fine'])


def _short_list(lines: Sequence[str]) -> list[str]:
    left = len(lines) - _SHOWN_WARNINGS
    return [*lines[:_SHOWN_WARNINGS], *([f'… and {left} lines more'] if left > 0 else [])]


def _shortened(text: str) -> str:
    line = one_line(text)
    return line if len(line) <= _WIDTH else f'{line[: _WIDTH - 1]}…'
