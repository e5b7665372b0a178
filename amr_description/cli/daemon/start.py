# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Start the daemon if it isn't running: does nothing, as none is needed."""

from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument(
        '-d', '--debug', action='store_true', help='Accepted for scripts: there is no daemon'
    )


def main(_args: Namespace) -> int:
    """Say so; 0."""
    print('The daemon is not needed: every answer is fresh')
    return 0
