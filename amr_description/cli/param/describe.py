# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Show descriptive information about declared parameters."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
import sys
from typing import TYPE_CHECKING

from amr_description.cli.arguments import add_remote_node_arguments, unicode_text

if TYPE_CHECKING:
    from rcl_interfaces.msg import ParameterDescriptor


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser)
    parser.add_argument(
        'parameter_names', nargs='+', type=unicode_text, help='Names of the parameters'
    )


def main(args: Namespace) -> int:
    """Print type, description and constraints of each; 0, or 1 if one is not declared."""
    from amr_description.cli.param.remote import remote_parameters

    names = args.parameter_names
    with remote_parameters(args) as parameters:
        known = parameters.descriptors(names)
        absent = [parameters.absence(name) for name in names if name not in known]
    for name in names:
        for line in lines(known[name]) if name in known else ():
            print(line)
    for line in absent:
        print(line, file=sys.stderr)
    return 1 if absent else 0


def lines(descriptor: 'ParameterDescriptor') -> Iterator[str]:
    """Yield what a descriptor says."""
    from amr_description.cli.param.values import TYPE_NAMES

    yield f'Parameter name: {descriptor.name}'
    yield f'  Type: {TYPE_NAMES[descriptor.type]}'
    if descriptor.description:
        yield f'  Description: {descriptor.description}'
    yield '  Constraints:'
    if descriptor.read_only:
        yield '    Read only: true'
    for bounds in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        yield f'    Min value: {bounds.from_value}'
        yield f'    Max value: {bounds.to_value}'
        if bounds.step:
            yield f'    Step: {bounds.step}'
    if descriptor.additional_constraints:
        yield f'    Additional constraints: {descriptor.additional_constraints}'
