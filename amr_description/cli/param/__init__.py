# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various param related sub-commands."""

VERBS = {
    'delete': 'amr_description.cli.param.delete',
    'describe': 'amr_description.cli.param.describe',
    'dump': 'amr_description.cli.param.dump',
    'get': 'amr_description.cli.param.get',
    'list': 'amr_description.cli.param.list',
    'load': 'amr_description.cli.param.load',
    'set': 'amr_description.cli.param.set',
}
