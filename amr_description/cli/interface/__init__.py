# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Show information about ROS interfaces."""

VERBS = {
    'list': 'amr_description.cli.interface.verbs:ListVerb',
    'package': 'amr_description.cli.interface.verbs:PackageVerb',
    'packages': 'amr_description.cli.interface.verbs:PackagesVerb',
    'proto': 'amr_description.cli.interface.verbs:ProtoVerb',
    'show': 'amr_description.cli.interface.verbs:ShowVerb',
}
