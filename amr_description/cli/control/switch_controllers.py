# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Switch controllers in a controller manager.

All in one go: what is deactivated hands its interfaces over to what is activated.

examples:
  ros2 control switch_controllers --deactivate diff_drive_controller
  ros2 control switch_controllers --strict --deactivate one --activate other another
"""

from argparse import ArgumentParser, Namespace
import sys

from amr_description.cli.arguments import positive_float, unicode_text
from amr_description.cli.control.manager import add_manager_arguments, open_manager
from amr_description.colors import BLUE, colored, RED
from amr_description.errors import AmrError

_BEST_EFFORT, _STRICT = 1, 2  # the constants of controller_manager_msgs/srv/SwitchController
_DEFAULT = 0  # the manager's own


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    for verb in ('deactivate', 'activate'):
        parser.add_argument(
            f'--{verb}',
            nargs='*',
            type=unicode_text,
            default=[],
            metavar='CONTROLLER',
            help=f'Names of the controllers to be {verb}d',
        )
    strictness = parser.add_mutually_exclusive_group()
    strictness.set_defaults(strictness=_DEFAULT)
    for flag, value, what in (
        ('--strict', _STRICT, 'Strict switch: all or nothing'),
        ('--best-effort', _BEST_EFFORT, 'Best effort switch: leave out what cannot be switched'),
    ):
        strictness.add_argument(
            flag, dest='strictness', action='store_const', const=value, help=what
        )
    parser.add_argument(
        '--activate-asap',
        action='store_true',
        help='Activate asap controllers as soon as their hardware allows it',
    )
    parser.add_argument(
        '--switch-timeout',
        type=positive_float,
        default=5.0,
        help='Timeout for switching controllers in seconds (default: 5.0)',
    )


def main(args: Namespace) -> int:
    """Switch, and print the manager's message; 0."""
    with open_manager(args) as manager:
        response = manager.request_switch(
            args.activate,
            args.deactivate,
            args.strictness,
            timeout=args.switch_timeout,
            activate_asap=args.activate_asap,
        )
    if not response.ok:
        raise AmrError(colored(response.message, RED, sys.stderr))
    print(colored(response.message, BLUE))
    return 0
