# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A report as a page: success against each parameter, and what runs have returned; one file."""

from collections.abc import Iterator, Sequence
from html import escape
from typing import NamedTuple

import numpy as np

from amr_description.trials.one_run import Ending, TrialRun
from amr_description.trials.report import TrialsReport, wilson

BINS = 10
"""Of a parameter that is drawn, each with as many runs as any other; and of a histogram."""
WIDTH, HEIGHT, LEFT, BELOW, ABOVE = 480, 240, 44, 34, 12
"""Of a plot, and its margins, in pixels."""

_STYLE = """
:root { color-scheme: light dark; --ink: light-dark(#1c2733, #dbe4ee); --faint: #8894a1;
  --good: #2f80c9; --bad: light-dark(#b3261e, #f2857e); --paper: light-dark(#fff, #12181f) }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  margin: 2rem auto; max-width: 62rem; padding: 0 1rem }
h1 { font-size: 1.3rem } h2 { font-size: 1rem; margin: 0 0 .3rem }
.plots { display: flex; flex-wrap: wrap; gap: 1.5rem }
svg { max-width: 100%; height: auto } text { fill: var(--ink); font-size: 11px }
.axis { stroke: var(--faint) } .bar { fill: var(--good) } .range { stroke: var(--good) }
table { border-collapse: collapse } td, th { text-align: left; padding: .2rem .8rem .2rem 0;
  vertical-align: top } .bad { color: var(--bad) } code { font-size: .85em }
"""


class Share(NamedTuple):
    """Runs of about the same parameter, and how many of them have passed."""

    label: str
    passed: int
    total: int


def page_of(report: TrialsReport) -> str:
    """Return the page, as HTML that needs no other file."""
    return '\n'.join(_lines(report))


def shares_of(runs: Sequence[TrialRun], parameter: str) -> list[Share]:
    """Divide runs by a parameter: by its values if they are few, else into :data:`BINS`."""
    known = [run for run in runs if parameter in run.parameters]
    given = [run.parameters[parameter] for run in known]
    if len({*given}) <= BINS:
        values = sorted({*given}, key=lambda each: (isinstance(each, str), each))
        groups = [
            (each if isinstance(each, str) else f'{each:.3g}', [i == each for i in given])
            for each in values
        ]
    else:
        numbers = np.array(given, dtype=float)
        edges = np.quantile(numbers, np.linspace(0.0, 1.0, BINS + 1))
        places = np.clip(np.searchsorted(edges, numbers, side='right') - 1, 0, BINS - 1)
        groups = [(f'{edges[number]:.3g}', (places == number).tolist()) for number in range(BINS)]
    return [
        Share(label, sum(r.kind is Ending.PASSED for r in chosen), len(chosen))
        for label, is_here in groups
        if (chosen := [run for run, here in zip(known, is_here, strict=True) if here])
    ]


def _lines(report: TrialsReport) -> Iterator[str]:
    title = escape(report.label)
    yield '<!doctype html><html lang="en"><head><meta charset="utf-8">'
    yield '<meta name="viewport" content="width=device-width">'
    yield f'<title>{title}</title><style>{_STYLE}</style></head><body>'
    yield f'<h1>{title}</h1><p>{escape(report.summary)}</p><div class="plots">'
    names = dict.fromkeys(name for run in report.runs for name in run.parameters)
    for name in names:
        yield f'<section><h2>success by {escape(name)}</h2>'
        yield f'{_plot_of_shares(shares_of(report.runs, name))}</section>'
    values = dict.fromkeys(name for run in report.runs for name in run.values)
    for name in values:
        found = [run.values[name] for run in report.runs if name in run.values]
        yield f'<section><h2>{escape(name)}, of runs that passed</h2>'
        yield f'{_histogram(found)}</section>'
    yield '</div>'
    if report.bad:
        yield '<h2>Runs that did not pass</h2><table><tr><th>run</th><th></th><th></th></tr>'
        for run in report.bad:
            yield f'<tr><td>{escape(run.name)}</td><td class="bad">{run.kind}</td>'
            yield f'<td>{escape(run.message)}<br><code>{escape(report.replay_line(run))}</code>'
            yield '</td></tr>'
        yield '</table>'
    yield f'<p>digest {report.digest}</p></body></html>'


def _plot_of_shares(shares: Sequence[Share]) -> str:
    """Draw a point for each share, with Wilson's interval of 95 %, between 0 and 100 %."""
    parts = [_axes('100 %', '0')]
    step = (WIDTH - LEFT) / len(shares)
    for number, share in enumerate(shares):
        x = LEFT + (number + 0.5) * step
        middle, (lower, upper) = share.passed / share.total, wilson(share.passed, share.total)
        parts += [
            f'<line class="range" x1="{x:.1f}" x2="{x:.1f}" y1="{_y(lower):.1f}" '
            f'y2="{_y(upper):.1f}" stroke-width="3" opacity="0.45"/>',
            f'<circle class="bar" cx="{x:.1f}" cy="{_y(middle):.1f}" r="4">'
            f'<title>{share.passed} of {share.total}</title></circle>',
            f'<text x="{x:.1f}" y="{HEIGHT - 14}" text-anchor="middle">'
            f'{escape(share.label)}</text>',
        ]
    return _svg(parts)


def _histogram(values: Sequence[float]) -> str:
    counts, edges = np.histogram(values, BINS)
    most = int(counts.max())
    parts = [_axes(str(most), '0')]
    step = (WIDTH - LEFT) / BINS
    for number, count in enumerate(counts.tolist()):
        x, top = LEFT + number * step, _y(count / most)
        parts += [
            f'<rect class="bar" x="{x + 1:.1f}" y="{top:.1f}" width="{step - 2:.1f}" '
            f'height="{_y(0.0) - top:.1f}"><title>{count}</title></rect>',
            f'<text x="{x + step / 2:.1f}" y="{HEIGHT - 14}" text-anchor="middle">'
            f'{edges[number]:.2g}</text>',
        ]
    return _svg(parts)


def _y(share: float) -> float:
    """Return where a share of the height is, in pixels from above."""
    return ABOVE + (1.0 - share) * (HEIGHT - BELOW - ABOVE)


def _axes(above: str, below: str) -> str:
    return (
        f'<line class="axis" x1="{LEFT}" x2="{LEFT}" y1="{ABOVE}" y2="{_y(0.0):.1f}"/>'
        f'<line class="axis" x1="{LEFT}" x2="{WIDTH}" y1="{_y(0.0):.1f}" y2="{_y(0.0):.1f}"/>'
        f'<text x="{LEFT - 6}" y="{ABOVE + 4}" text-anchor="end">{above}</text>'
        f'<text x="{LEFT - 6}" y="{_y(0.0):.1f}" text-anchor="end">{below}</text>'
    )


def _svg(parts: Sequence[str]) -> str:
    size = f'width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}"'
    return f'<svg {size} role="img">{"".join(parts)}</svg>'
