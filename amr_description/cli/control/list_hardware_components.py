# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the list of available hardware components."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from typing import Any

from amr_description.cli.control.manager import add_manager_arguments, ask
from amr_description.colors import BLUE, colored, GREEN, MAGENTA, RED, YELLOW

_STATE_COLORS = {
    'active': GREEN,
    'inactive': MAGENTA,
    'unconfigured': YELLOW,
    'finalized': RED,
}


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    parser.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help='List the state interfaces, too, and the data type of each interface',
    )


def main(args: Namespace) -> int:
    """Print a block per component; 0."""
    from controller_manager_msgs.srv import ListHardwareComponents

    response = ask(args, ListHardwareComponents)
    for number, component in enumerate(response.component, start=1):
        for line in lines(number, component, args.verbose):
            print(line)
    return 0


def lines(number: int, component: Any, verbose: bool) -> Iterator[str]:
    """Yield the block of one component."""
    color = _STATE_COLORS.get(component.state.label, '')
    plugin = component.plugin_name or component.class_type
    yield f'Hardware Component {number}'
    yield f'\tname: {colored(component.name, color)}'
    yield f'\ttype: {component.type}'
    yield f'\tplugin name: {plugin or colored("plugin name missing!", YELLOW)}'
    yield f'\tstate: id={component.state.id} label={colored(component.state.label, color)}'
    yield f'\tread/write rate: {component.rw_rate} Hz'
    yield f'\tis_async: {component.is_async}'
    yield '\tcommand interfaces'
    for interface in component.command_interfaces:
        claimed = colored('[claimed]', BLUE) if interface.is_claimed else '[unclaimed]'
        yield f'\t\t{_available(interface, verbose)} {claimed}'
    if verbose:
        yield '\tstate interfaces'
        for interface in component.state_interfaces:
            yield f'\t\t{_available(interface, verbose)}'


def _available(interface: Any, verbose: bool) -> str:
    data_type = f' [{interface.data_type}]' if verbose else ''
    if interface.is_available:
        return f'{interface.name}{data_type} {colored("[available]", BLUE)}'
    return f'{interface.name}{data_type} {colored("[unavailable]", YELLOW)}'
