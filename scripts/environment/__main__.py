# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python3 -ES scripts/environment``: what ``scripts/setup`` runs once it has a Python."""

from pathlib import Path
import sys

sys.path[0] = str(Path(__file__).resolve().parents[1])  # this folder's parent: the package is ours

from environment.main import main  # noqa: E402

sys.exit(main(sys.argv[1:]))
