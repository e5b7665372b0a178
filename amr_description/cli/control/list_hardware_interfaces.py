# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the list of available command and state interfaces."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from operator import attrgetter
from typing import Any

from amr_description.cli.control.manager import add_manager_arguments, ask
from amr_description.colors import BLUE, colored, CYAN, YELLOW


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    parser.add_argument(
        '-v', '--verbose', action='store_true', help='Show the data type of each interface'
    )


def main(args: Namespace) -> int:
    """Print a line per interface, by name; 0."""
    from controller_manager_msgs.srv import ListHardwareInterfaces

    response = ask(args, ListHardwareInterfaces)
    for line in lines(response, args.verbose):
        print(line)
    return 0


def lines(response: Any, verbose: bool) -> Iterator[str]:
    """Yield the text of a response: command interfaces, then state interfaces."""
    yield 'command interfaces'
    for interface in sorted(response.command_interfaces, key=attrgetter('name')):
        available = '[available]' if interface.is_available else '[unavailable]'
        claimed = '[claimed]' if interface.is_claimed else '[unclaimed]'
        color = BLUE if interface.is_claimed else CYAN
        text = f'{_name(interface, verbose)} {available} {claimed}'
        yield f'\t{colored(text, color if interface.is_available else YELLOW)}'
    yield 'state interfaces'
    for interface in sorted(response.state_interfaces, key=attrgetter('name')):
        yield f'\t{_name(interface, verbose)}'


def _name(interface: Any, verbose: bool) -> str:
    return f'{interface.name} [{interface.data_type}]' if verbose else interface.name
