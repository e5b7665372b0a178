# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various rosbag related sub-commands."""

VERBS = {
    'burst': 'amr_description.cli.bag.burst',
    'info': 'amr_description.cli.bag.info',
    'play': 'amr_description.cli.bag.play',
    'record': 'amr_description.cli.bag.record',
    'reindex': 'amr_description.cli.bag.reindex',
}
