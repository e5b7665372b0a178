# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test that failed leaves in ``build/tests/failures/``, for whoever was not there."""

import contextlib
from pathlib import Path
import re
import shutil
import sys

from support.paths import ROOT

FAILURES = ROOT / 'build' / 'tests' / 'failures'
MOST = 2_000_000
"""Bytes of a log file that is kept."""


def folder_of(nodeid: str) -> Path:
    """Return where the things of a test are kept."""
    return FAILURES / re.sub(r'[^\w.=-]+', '_', nodeid.removeprefix('test/'))[:150]


def keep(nodeid: str, text: str, temporary: Path | None) -> None:
    """
    Keep what a failed test said, a picture of each page that is open, and its log files.

    :param text: The failure and what was captured.
    :param temporary: The test's own folder, if it has one.
    """
    with contextlib.suppress(OSError):  # a full disk does not hide the failure
        folder = folder_of(nodeid)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        (folder / 'failure.txt').write_text(text, encoding='utf-8', errors='replace')
        for log in sorted(temporary.rglob('*.log')) if temporary else ():
            if log.is_file() and log.stat().st_size <= MOST:
                target = folder / log.relative_to(temporary)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(log, target)
    _take_pictures(folder_of(nodeid))


def _take_pictures(folder: Path) -> None:
    chromium = sys.modules.get('support.chromium')  # where no test uses it there is no page
    for number, page in enumerate(list(chromium.OPEN_PAGES) if chromium else ()):
        with contextlib.suppress(Exception):  # the browser may be what has failed
            page.screenshot(folder / f'page{number}.png')
