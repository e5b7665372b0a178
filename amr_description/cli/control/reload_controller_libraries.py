# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Reload controller libraries: unload every controller, and find their classes anew.

Refused while a controller is active, unless forced.
"""

from argparse import ArgumentParser, Namespace

from amr_description.cli.control.manager import add_manager_arguments, failure, open_manager
from amr_description.colors import BLUE, colored


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    parser.add_argument(
        '--force-kill', action='store_true', help='Force stop of loaded controllers'
    )


def main(args: Namespace) -> int:
    """Do so; 0."""
    with open_manager(args) as manager:
        if not manager.reload_libraries(force_kill=args.force_kill):
            raise failure(
                'Error reloading libraries, check controller_manager logs', manager.logged()
            )
    print(colored('Reload successful', BLUE))
    return 0
