# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m amr_description.nodes.calibrate``."""

import sys

from amr_description.nodes.calibrate import main

sys.exit(main())
