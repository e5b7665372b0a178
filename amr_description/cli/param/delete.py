# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Delete parameter."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_remote_node_arguments, unicode_text
from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser)
    parser.add_argument('parameter_name', type=unicode_text, help='Name of the parameter')


def main(args: Namespace) -> int:
    """Undeclare a parameter; 0 if the node did so."""
    from amr_description.cli.param.remote import remote_parameters

    name = args.parameter_name
    with remote_parameters(args) as parameters:
        result = parameters.delete(name)
        reason = f': {result.reason}' if result.reason else ''
        if not result.successful:
            known = name in parameters.names()
            explanation = '' if known else f'; {parameters.absence(name)}'
            raise AmrError(f'Deleting parameter failed{reason}{explanation}')
    print(f'Deleted parameter successfully{reason}')
    return 0
