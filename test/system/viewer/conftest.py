# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One browser for all files: to start one costs more than most tests of the page."""

import pytest
from support import chromium
from support.needs import need


@pytest.fixture(scope='session')
def browser():
    """A browser; each test opens, and closes, tabs of its own."""
    need(chromium.executable(), 'no chromium; apt install chromium')
    with chromium.Chromium() as browser:
        yield browser
