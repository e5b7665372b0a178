# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Various daemon related sub-commands.

There is no daemon: every command looks at the graph itself, so that no answer is stale. The verbs
are there for scripts.
"""

VERBS = {
    'start': 'amr_description.cli.daemon.start',
    'status': 'amr_description.cli.daemon.status',
    'stop': 'amr_description.cli.daemon.stop',
}
