# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various action related sub-commands."""

VERBS = {
    'info': 'amr_description.cli.action.info',
    'list': 'amr_description.cli.action.list',
    'send_goal': 'amr_description.cli.action.send_goal',
    'type': 'amr_description.cli.action.type',
}
