# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The fixture ``stderr``, for tests that look at stderr while other threads write to it."""

from pathlib import Path

import pytest


@pytest.fixture
def stderr(capfd):
    """
    Return a function that returns all that this process has written to stderr, in whole lines.

    ``capfd.readouterr()`` empties the file that it has read: a line that another thread writes in
    between is lost. Here that file is only read.
    """
    return lambda: ''.join(Path('/proc/self/fd/2').read_text().rpartition('\n')[:2])
