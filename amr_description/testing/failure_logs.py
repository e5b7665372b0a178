# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The log of the simulator, kept for a test that fails.

Its last lines are a section of the report. Where pytest writes a JUnit report, all lines are in a
file beside it, which a CI service can keep as an artifact: ``results/report.xml`` has the log of
``test_ramp`` in ``results/report.test_my_robot.test_ramp.log``.
"""

import os
from pathlib import Path
import re

import pytest

from amr_description.testing.program import started

TAIL = 12
"""Lines of the log in the report."""


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


def _write(item: pytest.Item, report: pytest.TestReport, text: str) -> str:
    """Write a log beside the JUnit report; return its path, '' without such a report."""
    option = item.config.getoption('xmlpath', None)
    if not option:
        return ''
    xml = Path(os.path.expanduser(os.path.expandvars(option)))
    name = re.sub(r'[^\w-]+', '.', report.nodeid.replace('.py::', '.')).strip('.')
    path = xml.with_name(f'{xml.stem}.{name}.log')
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
    except OSError as error:  # a disk that is full shall not hide the failure of the test
        return f'no file: {error}'
    return str(path)
