# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m amr_description.trials``."""

import sys

from amr_description.trials.command import main

if __name__ == '__main__':
    sys.exit(main())
