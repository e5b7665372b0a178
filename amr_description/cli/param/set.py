# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Set parameter.

The value is YAML: 5 is an integer and 5.0 a double, which are not the same to a node; on, off,
true and false are booleans; '"5"' is a string, '[1.0, 2.0]' an array. Before a value that begins
with a dash and is not a plain number stands '--': ros2 param set /node limit -- -.inf
"""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_remote_node_arguments, unicode_text
from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser)
    parser.add_argument('parameter_name', type=unicode_text, help='Name of the parameter')
    parser.add_argument('value', help='Value of the parameter')


def main(args: Namespace) -> int:
    """Set a parameter; 0 if the node took the value."""
    from amr_description.cli.param.remote import remote_parameters
    from amr_description.cli.param.values import typed

    name, value = args.parameter_name, typed(args.value)
    with remote_parameters(args) as parameters:
        result = parameters.set({name: value})[name]
        reason = f': {result.reason}' if result.reason else ''
        if not result.successful:
            explanation = parameters.explain(name, args.value)
            raise AmrError(f'Setting parameter failed{reason}{explanation}')
    print(f'Set parameter successful{reason}')
    return 0
