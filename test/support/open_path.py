# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A folder of a test that all users may read; those of pytest are their owner's alone."""

import os
from pathlib import Path
import tempfile

import pytest


@pytest.fixture
def open_path():
    """An empty folder that every user may list."""
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        yield Path(folder)
