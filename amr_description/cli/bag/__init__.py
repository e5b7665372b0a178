# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various rosbag related sub-commands."""

VERBS = {
    'burst': 'amr_description.cli.bag.burst',
    'convert': 'amr_description.cli.bag.convert',
    'filter': 'amr_description.cli.bag.filter',
    'info': 'amr_description.cli.bag.info',
    'list': 'amr_description.cli.bag.list',
    'merge': 'amr_description.cli.bag.merge',
    'play': 'amr_description.cli.bag.play',
    'record': 'amr_description.cli.bag.record',
    'reindex': 'amr_description.cli.bag.reindex',
    'trim': 'amr_description.cli.bag.trim',
}
