# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various package related sub-commands."""

VERBS = {
    'create': 'amr_description.cli.pkg.create',
    'executables': 'amr_description.cli.pkg.executables',
    'list': 'amr_description.cli.pkg.list',
    'prefix': 'amr_description.cli.pkg.prefix',
    'xml': 'amr_description.cli.pkg.xml',
}
