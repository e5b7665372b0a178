# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Show information about ROS interfaces."""

VERBS = {
    'list': 'amr_description.cli.interface.list',
    'package': 'amr_description.cli.interface.package',
    'packages': 'amr_description.cli.interface.packages',
    'proto': 'amr_description.cli.interface.proto',
    'show': 'amr_description.cli.interface.show',
}
