# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the status of the daemon."""

from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb: none."""


def main(_args: Namespace) -> int:
    """Print that there is none; 0."""
    print('The daemon is not running')
    return 0
