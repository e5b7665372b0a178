# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various param related sub-commands."""

VERBS = {
    'delete': 'amr_description.cli.param.verbs:DeleteVerb',
    'describe': 'amr_description.cli.param.verbs:DescribeVerb',
    'dump': 'amr_description.cli.param.verbs:DumpVerb',
    'get': 'amr_description.cli.param.verbs:GetVerb',
    'list': 'amr_description.cli.param.verbs:ListVerb',
    'load': 'amr_description.cli.param.verbs:LoadVerb',
    'set': 'amr_description.cli.param.verbs:SetVerb',
}
