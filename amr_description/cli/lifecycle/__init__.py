# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various lifecycle related sub-commands."""

VERBS = {
    'get': 'amr_description.cli.lifecycle.get',
    'list': 'amr_description.cli.lifecycle.list',
    'nodes': 'amr_description.cli.lifecycle.nodes',
    'set': 'amr_description.cli.lifecycle.set',
}
