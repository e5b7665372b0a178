# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various node related sub-commands."""

VERBS = {
    'info': 'amr_description.cli.node.info',
    'list': 'amr_description.cli.node.list',
}
