# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One browser for all files: to start one costs more than most tests of the page."""

from contextlib import suppress

import pytest
from support import chromium
from support.needs import need
from websockets.exceptions import ConnectionClosed


@pytest.fixture(scope='session')
def browser():
    """A browser; each test opens, and closes, tabs of its own."""
    need(chromium.executable(), 'no chromium; apt install chromium')
    with chromium.Chromium() as browser:
        yield browser


@pytest.fixture(autouse=True)
def no_tab_is_left():
    """Close the tabs that a failed test left: those of the others are hidden behind them."""
    before = {*chromium.OPEN_PAGES}
    yield
    for page in {*chromium.OPEN_PAGES} - before:
        with suppress(chromium.BrowserError, ConnectionClosed):  # its browser has ended
            page.close()
