# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various service related sub-commands."""

import argparse

VERBS = {
    'call': 'amr_description.cli.service.call',
    'find': 'amr_description.cli.service.find',
    'info': 'amr_description.cli.service.info',
    'list': 'amr_description.cli.service.list',
    'type': 'amr_description.cli.service.type',
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what every verb of ``ros2 service`` reads."""
    parser.add_argument(
        '--include-hidden-services', action='store_true', help='Consider hidden services as well'
    )
