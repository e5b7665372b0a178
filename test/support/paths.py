# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where things are in a checkout."""

from pathlib import Path
import tomllib

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
PROJECT = tomllib.loads((ROOT / 'pyproject.toml').read_text(encoding='utf-8'))['project']
EXECUTABLES = PROJECT['entry-points']['amr_description.executables']
"""What ``ros2 run amr_description`` starts: name → entry point."""
