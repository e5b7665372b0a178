# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Get parameter."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_remote_node_arguments, unicode_text
from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser)
    parser.add_argument('parameter_name', type=unicode_text, help='Name of the parameter')
    parser.add_argument('--hide-type', action='store_true', help='Hide the type information')


def main(args: Namespace) -> int:
    """Print type and value; 0."""
    from rclpy.parameter import parameter_value_to_python

    from amr_description.cli.param.remote import remote_parameters
    from amr_description.cli.param.values import TYPE_NAMES

    name = args.parameter_name
    with remote_parameters(args) as parameters:
        message = parameters.values([name]).get(name)
        if message is None:
            raise AmrError(f'Parameter not set: {parameters.absence(name)}')
    value = parameter_value_to_python(message)
    if args.hide_type:
        print(value)
    elif value is None:
        print('Parameter not set.')
    else:
        kind, is_array, _ = TYPE_NAMES[message.type].partition(' array')
        print(f'{kind.capitalize()} {"values are" if is_array else "value is"}: {value}')
    return 0
