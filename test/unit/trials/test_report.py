# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The statistic of trials, and what a report is written as."""

from dataclasses import replace
import json
from pathlib import Path
import xml.etree.ElementTree as ElementTree

from hypothesis import given, strategies as st
import pytest

from amr_description.errors import TrialsError
from amr_description.trials.one_run import Ending, TrialRun
from amr_description.trials.page import page_of, shares_of
from amr_description.trials.report import merged, TrialsReport, wilson


def report_of(*kinds, **options):
    runs = tuple(
        TrialRun(
            str(n), n, kind, '' if kind is Ending.PASSED else '<why> & how\x07', {'speed': n / 10}
        )
        for n, kind in enumerate(kinds)
    )
    runs = tuple(
        replace(run, values={'error': run.seed * 0.5}, seconds=0.25)
        if run.kind is Ending.PASSED
        else run
        for run in runs
    )
    return TrialsReport('drives.py:drive', runs, total=len(runs), **options)


@pytest.mark.parametrize(
    ('passed', 'total', 'lower', 'upper'),
    [
        # Newcombe, Two-sided confidence intervals for the single proportion (1998), table I.
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ],
)
def test_the_interval_is_that_of_the_literature(passed, total, lower, upper):
    assert wilson(passed, total) == pytest.approx((lower, upper), abs=5e-5)


@given(st.integers(0, 10_000), st.integers(0, 10_000))
def test_the_interval_holds_the_share_and_is_symmetric(first, second):
    passed, total = min(first, second), max(first, second)
    lower, upper = wilson(passed, total)
    other_lower, other_upper = wilson(total - passed, total)
    assert 0.0 <= lower <= upper <= 1.0
    assert (1.0 - other_upper, 1.0 - other_lower) == pytest.approx((lower, upper))
    if total:
        assert lower - 1e-12 <= passed / total <= upper + 1e-12
        assert lower == 0.0 if not passed else lower > 0.0


def test_the_text_says_how_often_and_names_each_failure_with_what_repeats_it():
    report = report_of(*[Ending.PASSED] * 3, Ending.HUNG, bags={'3': Path('out/bags/3')})
    lines = str(report).splitlines()
    assert lines[0] == (
        'drives.py:drive: 3 of 4 passed: 75.0 % (between 30.1 % and 95.4 %, Wilson, 95 %)'
    )
    assert lines[1].startswith('  hung 3 (speed=0.3): <why> & how')
    assert lines[2].strip() == 'python -m amr_description.trials drives.py:drive --only 3'
    assert lines[3].strip() == 'its bag: out/bags/3'
    assert lines[4] == '  error: 0.5 (5 % below 0.05, 5 % above 0.95, from 0 to 1)'
    assert not report.is_sound
    assert report_of(Ending.FAILED, Ending.RAISED).is_sound
    assert not report_of(Ending.FAILED, unlike=('0',)).is_sound
    assert '    and 15 more' not in str(report_of(*[Ending.FAILED] * 35))
    assert '  and 15 more' in str(report_of(*[Ending.FAILED] * 35))


def test_json_has_all_of_it_and_the_digest_leaves_times_out():
    report = report_of(Ending.PASSED, Ending.FAILED, seconds=3.0, workers=2, bags={'1': Path('b')})
    again = TrialsReport.from_json(report.to_json(), 'r.json')
    assert again == report
    slower = replace(report, seconds=9.0, workers=1, bags={})
    slower = replace(slower, runs=[replace(run, seconds=7.0) for run in report.runs])
    assert slower.digest == report.digest == json.loads(report.to_json())['digest']
    other = replace(report, runs=[replace(run, bits='00') for run in report.runs])
    assert other.digest != report.digest


@pytest.mark.parametrize('text', ['', '[]', '{"format": 99}', '{"format": 1, "trial": "a"}'])
def test_what_is_no_report_is_said(text):
    with pytest.raises(TrialsError, match='r.json: no report of trials'):
        TrialsReport.from_json(text, 'r.json')


def test_junit_has_a_case_for_each_run():
    kinds = [Ending.PASSED, Ending.FAILED, Ending.RAISED, Ending.DIED]
    suite = ElementTree.fromstring(report_of(*kinds, seconds=1.5).to_junit()).find('testsuite')
    assert (suite.get('tests'), suite.get('failures'), suite.get('errors')) == ('4', '1', '2')
    assert [each.tag for case in suite for each in case] == ['failure', 'error', 'error']
    assert suite[1][0].get('message') == r'<why> & how\x07'
    assert '--only 1' in suite[1][0].text
    assert suite[0].get('time') == '0.250'


def test_shards_make_a_whole():
    whole = report_of(*[Ending.PASSED, Ending.FAILED] * 3)
    shards = [replace(whole, runs=whole.runs[n::2], total=3) for n in range(2)]
    assert merged(shards[::-1]).digest == whole.digest
    with pytest.raises(TrialsError, match="the run '0' is in two reports"):
        merged([shards[0], shards[0]])
    with pytest.raises(TrialsError, match="'drives.py:drive' and of 'other'"):
        merged([shards[0], replace(shards[1], label='other')])


def test_the_page_shows_success_by_each_parameter():
    report = report_of(*[Ending.PASSED] * 30, *[Ending.FAILED] * 10)
    page = page_of(report)
    assert page.count('<svg') == 2
    assert '&lt;why&gt; &amp; how' in page
    assert '<why>' not in page
    shares = shares_of(report.runs, 'speed')
    assert [each.total for each in shares] == [4] * 10
    assert [each.passed for each in shares] == [4] * 7 + [2, 0, 0]
    few = [replace(run, parameters={'world': 'ab'[run.seed % 2]}) for run in report.runs]
    assert [tuple(each) for each in shares_of(few, 'world')] == [('a', 15, 20), ('b', 15, 20)]
