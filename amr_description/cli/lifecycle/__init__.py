# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various lifecycle related sub-commands."""

VERBS = {
    'get': 'amr_description.cli.lifecycle.verbs:GetVerb',
    'list': 'amr_description.cli.lifecycle.verbs:ListVerb',
    'nodes': 'amr_description.cli.graph_verbs:LIFECYCLE_NODES',
    'set': 'amr_description.cli.lifecycle.verbs:SetVerb',
}
