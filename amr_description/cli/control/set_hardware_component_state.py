# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Adjust the state of a hardware component."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import unicode_text
from amr_description.cli.control.manager import add_manager_arguments, failure, open_manager
from amr_description.colors import BLUE, colored

# state -> what failed, if it was not reached
_DOING = {'unconfigured': 'cleaning up', 'inactive': 'stopping', 'active': 'activating'}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    parser.add_argument(
        'hardware_component_name',
        type=unicode_text,
        help='Name of the hardware component to be changed',
    )
    parser.add_argument(
        'state',
        choices=list(_DOING),
        help='State in which the hardware component should be changed to',
    )


def main(args: Namespace) -> int:
    """Bring it there; 0."""
    from lifecycle_msgs.msg import State

    number = getattr(State, f'PRIMARY_STATE_{args.state.upper()}')
    with open_manager(args) as manager:
        response = manager.set_component_state(
            args.hardware_component_name, State(id=number, label=args.state)
        )
        if not response.ok:
            text = f'Error {_DOING[args.state]} hardware component, check controller_manager logs'
            raise failure(text, manager.logged())
    said = f'Successfully set {args.hardware_component_name} to state {response.state.label}'
    print(colored(said, BLUE))
    return 0
