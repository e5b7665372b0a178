# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What became of trials: an honest statistic, as text, JSON and JUnit.

The interval is Wilson's: with n runs, a share p of which passed, and z = 1.96 for 95 %, it is
``(p + z²/2n ± z √(p (1-p)/n + z²/4n²)) / (1 + z²/n)`` (E. B. Wilson, Probable inference, the law
of succession, and statistical inference, JASA 22, 1927). It stays between 0 and 1, and is not
empty where all have passed.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from hashlib import blake2b
import json
import math
from pathlib import Path
import shlex
from typing import Any, NamedTuple
import xml.etree.ElementTree as ElementTree

import numpy as np

from amr_description.errors import TrialsError
from amr_description.text import one_line
from amr_description.trials.one_run import Ending, TrialRun

Z = 1.959963984540054
"""Of 95 %: half of the rest is above it in a normal distribution."""
QUANTILES = (0.0, 0.05, 0.5, 0.95, 1.0)
COMMAND = 'python -m amr_description.trials'
MOST_LINES = 20
"""Runs that did not pass, in the text."""
FORMAT = 1


class Interval(NamedTuple):
    """Between which shares the true one is, in 95 of 100 cases."""

    lower: float
    upper: float


def wilson(passed: int, total: int) -> Interval:
    """Return Wilson's interval of 95 % for the share of runs that pass; see the module."""
    if not total:
        return Interval(0.0, 1.0)
    share, weight = passed / total, Z * Z / total
    middle = share + weight / 2
    half = Z * math.sqrt(share * (1.0 - share) / total + weight / total / 4)
    lower, upper = (middle - half) / (1.0 + weight), (middle + half) / (1.0 + weight)
    # 0 and 1 by the formula, but for rounding.
    return Interval(max(0.0, lower) if passed else 0.0, min(1.0, upper) if passed < total else 1.0)


@dataclass(frozen=True)
class TrialsReport:
    """What became of the runs of a trial."""

    label: str
    """As a command line names it."""
    runs: Sequence[TrialRun]
    """In the order of their seeds."""
    total: int
    """Those that were to be run."""
    was_interrupted: bool = False
    seconds: float = 0.0
    """Of the wall clock."""
    workers: int = 0
    """Processes of this machine; 0: an executor that was given."""
    bags: Mapping[str, Path] = field(default_factory=dict)
    """Of the first failures, by the names of their runs."""
    unlike: Sequence[str] = ()
    """Runs that came to something else when they were repeated for their bags."""

    @property
    def passed(self) -> int:
        """How many have passed."""
        return sum(run.kind is Ending.PASSED for run in self.runs)

    @property
    def share(self) -> float:
        """Of those that were run: which have passed. 0 if none was."""
        return self.passed / len(self.runs) if self.runs else 0.0

    @property
    def interval(self) -> Interval:
        """Wilson's, of 95 %."""
        return wilson(self.passed, len(self.runs))

    @property
    def bad(self) -> Sequence[TrialRun]:
        """Those that have not passed."""
        return [run for run in self.runs if run.kind is not Ending.PASSED]

    @property
    def is_sound(self) -> bool:
        """Whether each run says something of the robot, and says it again when it is repeated."""
        return not (self.unlike or any(run.kind.is_broken for run in self.runs))

    @property
    def digest(self) -> str:
        """Of all that has to be the same wherever the runs were: all but times and folders."""
        return blake2b(self.to_json(times=False).encode(), digest_size=8).hexdigest()

    def quantiles(self) -> dict[str, list[float]]:
        """Return, for each value that runs returned, its :data:`QUANTILES`."""
        return {
            name: np.quantile(values, QUANTILES).tolist() for name, values in self._values.items()
        }

    @property
    def _values(self) -> dict[str, list[float]]:
        found: dict[str, list[float]] = {}
        for run in self.runs:
            for name, value in run.values.items():
                found.setdefault(name, []).append(value)
        return found

    def replay_line(self, run: TrialRun) -> str:
        """Return the command that repeats a run."""
        return f'{COMMAND} {shlex.quote(self.label)} --only {run.name}'

    # --- text ---------------------------------------------------------------------------------

    def __str__(self) -> str:
        """For a terminal."""
        return '\n'.join(self._lines())

    def _lines(self) -> Iterator[str]:
        yield f'{self.label}: {self.summary}'
        if self.was_interrupted:
            yield f'  interrupted: {len(self.runs)} of {self.total} runs are done'
        for run in self.bad[:MOST_LINES]:
            given = ', '.join(f'{name}={_short(each)}' for name, each in run.parameters.items())
            where = f' after {run.step} steps' if run.step else ''
            yield f'  {run.kind} {run.name}{f" ({given})" if given else ""}{where}: {run.message}'
            yield f'      {self.replay_line(run)}'
            if run.name in self.bags:
                yield f'      its bag: {self.bags[run.name]}'
            if run.name in self.unlike:
                yield '      repeated, it came to something else: it depends on more than its seed'
        if len(self.bad) > MOST_LINES:
            yield f'  and {len(self.bad) - MOST_LINES} more'
        for name, (least, low, middle, high, most) in self.quantiles().items():
            yield (
                f'  {name}: {middle:.4g} (5 % below {low:.4g}, 5 % above {high:.4g}, '
                f'from {least:.4g} to {most:.4g})'
            )
        yield f'  {self._effort()}; digest {self.digest}'

    @property
    def summary(self) -> str:
        """How many have passed, and the interval, in one line."""
        lower, upper = (f'{100 * each:.1f} %' for each in self.interval)
        return (
            f'{self.passed} of {len(self.runs)} passed: {100 * self.share:.1f} % '
            f'(between {lower} and {upper}, Wilson, 95 %)'
        )

    def _effort(self) -> str:
        cpu = sum(run.seconds for run in self.runs) / max(1, len(self.runs))
        where = f'in {self.workers} processes' if self.workers else 'by an executor'
        return f'{self.seconds:.1f} s {where}, {cpu:.3f} s of a processor for each'

    # --- files --------------------------------------------------------------------------------

    def to_json(self, *, times: bool = True) -> str:
        """
        Return all of it as JSON.

        Args:
            times: With what need not be the same: times, processes, bags.
        """
        runs = []
        for run in self.runs:
            entry = asdict(run)
            if not times:
                del entry['seconds']
            runs.append(entry)
        data: dict[str, Any] = {
            'format': FORMAT,
            'trial': self.label,
            'total': self.total,
            'passed': self.passed,
            'interval': self.interval,
            'quantiles': self.quantiles(),
            'unlike': list(self.unlike),
            'runs': runs,
        }
        if times:
            data |= {
                'digest': self.digest,
                'was_interrupted': self.was_interrupted,
                'seconds': self.seconds,
                'workers': self.workers,
                'bags': {name: str(path) for name, path in self.bags.items()},
            }
        return json.dumps(data, indent=1)

    @classmethod
    def from_json(cls, text: str, source: str) -> 'TrialsReport':
        """Read a report, of which ``source`` is the file. Raises TrialsError: it is none."""
        try:
            data = json.loads(text)
            if data['format'] != FORMAT:
                raise ValueError(f'its format is {data["format"]}')
            return cls(
                data['trial'],
                tuple(TrialRun(**{**run, 'kind': Ending(run['kind'])}) for run in data['runs']),
                data['total'],
                data['was_interrupted'],
                data['seconds'],
                data['workers'],
                {name: Path(path) for name, path in data['bags'].items()},
                tuple(data['unlike']),
            )
        except (ValueError, KeyError, TypeError) as error:
            raise TrialsError(f'{source}: no report of trials: {error}') from error

    def to_junit(self) -> str:
        """Return it as a JUnit report: a test case for each run."""
        broken = sum(run.kind.is_broken or run.kind is Ending.RAISED for run in self.bad)
        counts: dict[str, str] = {
            'tests': str(len(self.runs)),
            'failures': str(len(self.bad) - broken),
            'errors': str(broken),
            'time': f'{self.seconds:.3f}',
        }
        root = ElementTree.Element('testsuites')
        suite = ElementTree.SubElement(root, 'testsuite', {'name': one_line(self.label), **counts})
        for run in self.runs:
            time = f'{run.seconds:.3f}'
            case = ElementTree.SubElement(
                suite, 'testcase', classname=one_line(self.label), name=run.name, time=time
            )
            if run.kind is not Ending.PASSED:
                is_failure = run.kind is Ending.FAILED
                tag, message = 'failure' if is_failure else 'error', one_line(run.message)
                about = ElementTree.SubElement(case, tag, type=run.kind, message=message)
                about.text = one_line(self.replay_line(run))
        ElementTree.indent(root)
        return ElementTree.tostring(root, encoding='unicode') + '\n'


def merged(reports: Sequence[TrialsReport]) -> TrialsReport:
    """
    Return the report of several shards of the same trial.

    Raises:
        TrialsError: They are of different trials, or a run is in two of them.
    """
    first = reports[0]
    runs: dict[str, TrialRun] = {}
    for each in reports:
        if each.label != first.label:
            raise TrialsError(f"reports of '{first.label}' and of '{each.label}' are no whole")
        twice = [run.name for run in each.runs if run.name in runs]
        if twice:
            raise TrialsError(f"the run '{twice[0]}' is in two reports")
        runs |= {run.name: run for run in each.runs}
    return replace(
        first,
        runs=sorted(runs.values(), key=_place),
        total=sum(each.total for each in reports),
        was_interrupted=any(each.was_interrupted for each in reports),
        seconds=sum(each.seconds for each in reports),
        workers=max(each.workers for each in reports),
        bags={name: path for each in reports for name, path in each.bags.items()},
        unlike=tuple(name for each in reports for name in each.unlike),
    )


def _place(run: TrialRun) -> tuple[int, int]:
    return run.seed, int(run.name.partition('.')[2] or 0)


def _short(value: float | str) -> str:
    return one_line(value) if isinstance(value, str) else f'{value:.4g}'
