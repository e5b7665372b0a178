# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Look twice at tests that fail: once more, alone, in a new process and on a quiet machine.

What passes then is *flaky*: it is named, what it said both times is kept in
``build/tests/flaky/``, and it counts as passed, while such tests stand in few files. Else, and
where none is allowed, the first look counts for all of them. Nothing is hidden: a flaky test is a
fault to be mended.
"""

from collections.abc import Iterable, Sequence
import contextlib
from pathlib import Path
import shutil

import pytest
from support import failures
from support.paths import ROOT

FLAKY = ROOT / 'build' / 'tests' / 'flaky'
MOST_FILES = 3
"""In which flaky tests may stand: a cascade has one cause, many causes are none of the network."""
MOST_LOOKS = 30
"""Tests that are looked at twice; where more fail it is no flake, and each takes its time."""
PROPERTY = 'flaky'
"""The property of such a test in pytest's JUnit file; its value is the file of the test."""


class SecondLook:
    """Keeps the reports of tests that failed until they were looked at once more."""

    def __init__(self, *, strict: bool) -> None:
        """``strict``: no flaky test is allowed."""
        self._most_files = 0 if strict else MOST_FILES
        self._first: dict[int, list[pytest.TestReport]] = {}
        self._second: dict[int, list[pytest.TestReport]] = {}
        self.flaky: list[str] = []
        """Names of the tests that passed when they were looked at again."""

    def withholds(self, index: int, reports: Sequence[pytest.TestReport]) -> bool:
        """Keep all reports of a test if it failed; return whether."""
        if not any(report.failed for report in reports):
            return False
        self._first[index] = [*reports]
        return True

    def to_look_at(self) -> list[int]:
        """Return which tests are to be run once more."""
        return [*self._first][:MOST_LOOKS]

    def note(self, index: int, reports: Sequence[pytest.TestReport]) -> None:
        """Take what a test has reported the second time."""
        self._second[index] = [*reports]

    def results(self) -> list[pytest.TestReport]:
        """
        Return what counts of the tests that were kept; they are kept no more.

        A test that failed twice is told as it failed the second time, with the first beside it.
        """
        passed = [index for index, reports in self._second.items() if _has_passed(reports)]
        files = {_file_of(self._first[index]) for index in passed}
        are_allowed = len(files) <= self._most_files
        counting: list[pytest.TestReport] = []
        for index, first in self._first.items():
            second = self._second.get(index)
            if second is None:
                counting += first
            elif index not in passed:
                _keep(first, 'first', within=failures.folder_of(first[0].nodeid))
                counting += [_beside(report, first) for report in second]
            else:
                self.flaky.append(first[0].nodeid)
                keep_flaky(first, second)
                counting += [_marked(each) for each in (second if are_allowed else first)]
        self._first.clear()
        self._second.clear()
        return counting

    def lines(self) -> list[str]:
        """What to say of flaky tests at the end of a run."""
        if not self.flaky:
            return []
        return [
            f'{len(self.flaky)} flaky: failed, then passed alone; both logs: {FLAKY}',
            *(f'FLAKY {nodeid}' for nodeid in self.flaky),
        ]


def begin() -> None:
    """Forget what earlier runs have kept."""
    shutil.rmtree(FLAKY, ignore_errors=True)


def keep_flaky(first: Sequence[pytest.TestReport], second: Sequence[pytest.TestReport]) -> None:
    """Keep what a flaky test said, and left, when it failed, and what it said when it passed."""
    failed = failures.folder_of(first[0].nodeid)
    folder = FLAKY / failed.name
    with contextlib.suppress(OSError):  # a full disk does not hide the test
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        if failed.is_dir():
            shutil.move(failed, folder / 'first')
    _keep(first, 'first', within=folder)
    _keep(second, 'second', within=folder)


def said(reports: Iterable[pytest.TestReport]) -> str:
    """Return how a test failed, and all that was captured of it."""
    texts = []
    for report in reports:
        if report.failed:
            texts.append(report.longreprtext)
        texts += [f'--- {title}\n{text}' for title, text in report.sections]
    return '\n'.join(dict.fromkeys(texts)) + '\n'


def _keep(reports: Sequence[pytest.TestReport], name: str, *, within: Path) -> None:
    with contextlib.suppress(OSError):
        within.mkdir(parents=True, exist_ok=True)
        text = f'{reports[0].nodeid}: {name} look\n{said(reports)}'
        (within / f'{name}.txt').write_text(text, encoding='utf-8', errors='replace')


def _has_passed(reports: Sequence[pytest.TestReport]) -> bool:
    """Return whether it did; one that was skipped has not."""
    return not any(each.failed or each.skipped for each in reports) and any(
        each.when == 'call' for each in reports
    )


def _file_of(reports: Sequence[pytest.TestReport]) -> str:
    return reports[0].nodeid.partition('::')[0]


def _marked(report: pytest.TestReport) -> pytest.TestReport:
    """Return a report that says in the JUnit file that its test is flaky."""
    report.user_properties.append((PROPERTY, _file_of([report])))
    return report


def _beside(report: pytest.TestReport, first: Sequence[pytest.TestReport]) -> pytest.TestReport:
    if report.failed:
        report.sections.insert(0, ('how it failed the first time', said(first)))
    return report
