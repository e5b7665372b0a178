# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where things are in a checkout."""

from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
