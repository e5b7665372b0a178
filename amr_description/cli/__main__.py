# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m amr_description.cli ros2 topic list``: any of the commands, without its shim."""

import sys

from amr_description.cli.main import main, PROGRAMS

if len(sys.argv) < 2 or sys.argv[1] not in PROGRAMS:
    print(f'usage: python -m amr_description.cli {{{",".join(PROGRAMS)}}} ...', file=sys.stderr)
    sys.exit(2)
sys.exit(main(sys.argv[1], sys.argv[2:]))
