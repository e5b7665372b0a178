# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available packages."""

from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb: none."""


def main(_args: Namespace) -> int:
    """Print the names; 0."""
    from amr_description.ament_index import packages

    for name in packages():
        print(name)
    return 0
