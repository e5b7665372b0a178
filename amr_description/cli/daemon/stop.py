# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Stop the daemon if it is running: does nothing, as there is none."""

from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb: none."""


def main(_args: Namespace) -> int:
    """Print what scripts expect, and what is true from here on; 0."""
    print('The daemon has been stopped')
    return 0
