# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various rosbag related sub-commands."""

VERBS = {
    'burst': 'amr_description.cli.bag.play:BurstVerb',
    'convert': 'amr_description.cli.bag.rewriting:ConvertVerb',
    'filter': 'amr_description.cli.bag.rewriting:FilterVerb',
    'info': 'amr_description.cli.bag.listing:InfoVerb',
    'list': 'amr_description.cli.bag.listing:ListVerb',
    'merge': 'amr_description.cli.bag.rewriting:MergeVerb',
    'play': 'amr_description.cli.bag.play:PlayVerb',
    'record': 'amr_description.cli.bag.record',
    'reindex': 'amr_description.cli.bag.listing:ReindexVerb',
    'trim': 'amr_description.cli.bag.rewriting:TrimVerb',
}
