# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Clean up a controller in a controller manager: inactive to unconfigured."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.control.manager import (
    add_controller_argument,
    add_manager_arguments,
    failure,
    open_manager,
)
from amr_description.colors import BLUE, colored


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    add_controller_argument(parser, 'to be cleaned up')


def main(args: Namespace) -> int:
    """Do so; 0."""
    name = args.controller_name
    with open_manager(args) as manager:
        if not manager.cleanup(name):
            text = f'Error cleaning up controller {name}, check controller_manager logs'
            raise failure(text, manager.logged(name))
    print(colored(f'Successfully cleaned up controller {name}', BLUE))
    return 0
