# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m amr_description``: the command ``amr``, also where it is not on the PATH."""

import sys

from amr_description.entry import simulation

sys.exit(simulation.command.main())
