# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various package related sub-commands."""

VERBS = {
    'create': 'amr_description.cli.pkg.create',
    'executables': 'amr_description.cli.pkg.index_verbs:ExecutablesVerb',
    'list': 'amr_description.cli.pkg.index_verbs:ListVerb',
    'prefix': 'amr_description.cli.pkg.index_verbs:PrefixVerb',
    'xml': 'amr_description.cli.pkg.index_verbs:XmlVerb',
}
