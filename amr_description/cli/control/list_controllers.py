# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the list of loaded controllers, their type and status."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from typing import Any

from amr_description.cli.control.manager import add_manager_arguments, ask
from amr_description.colors import colored, CYAN, GREEN, YELLOW

_STATE_COLORS = {'active': GREEN, 'inactive': CYAN, 'unconfigured': YELLOW}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    for flag, what in (
        ('--claimed-interfaces', "List controller's claimed interfaces"),
        ('--required-state-interfaces', "List controller's required state interfaces"),
        ('--required-command-interfaces', "List controller's required command interfaces"),
        ('--chained-interfaces', 'List interfaces that the controllers are chained to'),
        ('--reference-interfaces', "DEPRECATED: List controller's exported references"),
        ('--exported-interfaces', "List controller's exported state and reference interfaces"),
    ):
        parser.add_argument(flag, action='store_true', help=what)
    parser.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help="List controller's claimed interfaces, required state interfaces and required "
        'command interfaces',
    )


def main(args: Namespace) -> int:
    """Print a line per controller; 0."""
    from controller_manager_msgs.srv import ListControllers

    response = ask(args, ListControllers)
    if not response.controller:
        print('No controllers are currently loaded!')
    for line in lines(response.controller, args):
        print(line)
    return 0


def lines(controllers: Sequence[Any], args: Namespace) -> Iterator[str]:
    """Yield the table: name, type and state, each column as wide as its longest entry."""
    name_width, type_width, state_width = (
        max((len(getattr(c, column)) for c in controllers), default=0)
        for column in ('name', 'type', 'state')
    )
    for controller in controllers:
        color = _STATE_COLORS.get(controller.state, '')
        name = colored(f'{controller.name:{name_width}}', color)
        state = colored(f'{controller.state:{state_width}}', color)
        yield f'{name} {controller.type:{type_width}}  {state}'
        yield from _details(controller, args)


def _details(controller: Any, args: Namespace) -> Iterator[str]:
    """Yield what the flags ask for, indented by tabs."""
    if args.verbose:
        yield f'\tupdate_rate: {controller.update_rate} Hz'
        yield f'\tis_async: {controller.is_async}'
    chained = [name for link in controller.chain_connections for name in link.reference_interfaces]
    references = args.reference_interfaces or args.exported_interfaces
    for wanted, title, names in (
        (args.claimed_interfaces, 'claimed', controller.claimed_interfaces),
        (
            args.required_command_interfaces,
            'required command',
            controller.required_command_interfaces,
        ),
        (args.required_state_interfaces, 'required state', controller.required_state_interfaces),
    ):
        if wanted or args.verbose:
            yield from _block(f'{title} interfaces:', names)
    if args.chained_interfaces or args.verbose:
        yield from _block('chained to interfaces:', chained)
    if references or args.verbose:
        yield from _block('exported reference interfaces:', controller.reference_interfaces)
    if args.exported_interfaces or args.verbose:
        yield from _block('exported state interfaces:', controller.exported_state_interfaces)


def _block(title: str, names: Sequence[str]) -> Iterator[str]:
    yield f'\t{title}'
    for name in names:
        yield f'\t\t{name}'
