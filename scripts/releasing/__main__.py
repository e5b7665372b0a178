# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m releasing``, with ``scripts/`` on the path: what ``scripts/release`` runs."""

import sys

from releasing.main import main

sys.exit(main(sys.argv[1:]))
