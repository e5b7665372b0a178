# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m amr_description.nodes.joy_node``."""

import sys

from amr_description.nodes.joy_node import main

sys.exit(main())
