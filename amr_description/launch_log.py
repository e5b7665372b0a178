# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a bring-up has warned of, for what it starts: it has no node, and so no /rosout."""

from dataclasses import dataclass
from pathlib import Path
import re

LAUNCH_LOG = 'AMR_LAUNCH_LOG'
"""The environment variable with the ``launch.log`` of the bring-up that has started a program."""
_LINE = re.compile(r'^(\d+\.\d+) \[(WARNING|ERROR)\] \[([^]]+)\]: (.*)', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class LaunchWarning:
    """A line: when, s since 1970; of what process, or of ``launch``; and the text."""

    stamp: float
    is_error: bool
    source: str
    text: str


def launch_warnings(file: str) -> list[LaunchWarning]:
    """Return the warnings and errors of a ``launch.log``; none where it cannot be read."""
    try:
        text = Path(file).read_text('utf-8', 'replace') if file else ''
    except OSError:
        return []
    return [
        LaunchWarning(float(stamp), level == 'ERROR', source, said)
        for stamp, level, source, said in _LINE.findall(text)
    ]
