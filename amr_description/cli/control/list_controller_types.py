# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the available controller types and their base classes."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.control.manager import add_manager_arguments, ask


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)


def main(args: Namespace) -> int:
    """Print a line per type; 0."""
    from controller_manager_msgs.srv import ListControllerTypes

    response = ask(args, ListControllerTypes)
    for name, base_class in zip(response.types, response.base_classes, strict=True):
        print(f'{name:70} {base_class}')
    return 0
