# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various control related sub-commands."""

VERBS = {
    'list_controllers': 'amr_description.cli.control.list_controllers',
}
