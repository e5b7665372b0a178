# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The log of the simulator, kept for a test that fails.

Its last lines are a section of the report. Where pytest writes a JUnit report, all lines are in a
file beside it, which a CI service can keep as an artifact: ``results/report.xml`` has the log of
``test_ramp`` in ``results/report.test_my_robot.test_ramp.log``.
"""

import hashlib
import os
from pathlib import Path
import re

import pytest

from amr_description.testing.program import started

TAIL = 12
"""Lines of the log in the report."""
_LONGEST = 150
"""Bytes of the name of a test in that of a file, which may have 255."""


def forget_ended() -> None:
    """Forget the simulators that have ended: they are of earlier tests."""
    running = [each for each in started if not each.has_ended]
    started.clear()
    started.extend(running)


def add_logs(item: pytest.Item, report: pytest.TestReport) -> None:
    """Add the logs of all simulators of a test to its report, if there are any."""
    logs = [each.log for each in started]
    if not logs:
        return
    heading = 'Simulator log'
    if path := _write(item, report, '\n'.join(logs)):
        heading += f', all of it in {path}'
    for log in logs:
        lines = log.splitlines()
        left_out = [f'[{len(lines) - TAIL} lines before]'] if len(lines) > TAIL else []
        report.sections.append((heading, '\n'.join([*left_out, *lines[-TAIL:]])))


def beside_junit_report(config: pytest.Config) -> Path | None:
    """Return the path of the JUnit report without its ending; None: there is no such report."""
    option = config.getoption('xmlpath', None)
    return Path(os.path.expanduser(os.path.expandvars(option))).with_suffix('') if option else None


def file_name(nodeid: str) -> str:
    """Return the name of a test as that of a file, without an ending."""
    name = re.sub(r'[^\w-]+', '.', nodeid.replace('.py::', '.')).strip('.')
    if len(name.encode()) <= _LONGEST:
        return name
    digest = hashlib.sha256(nodeid.encode()).hexdigest()[:8]
    return f'{name.encode()[:_LONGEST].decode(errors="ignore")}-{digest}'


def _write(item: pytest.Item, report: pytest.TestReport, text: str) -> str:
    """Write a log beside the JUnit report; return its path, '' without such a report."""
    beside = beside_junit_report(item.config)
    if beside is None:
        return ''
    path = beside.with_name(f'{beside.name}.{file_name(report.nodeid)}.log')
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
    except OSError as error:  # a disk that is full shall not hide the failure of the test
        return f'no file: {error}'
    return str(path)
