# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Load parameter file for a node.

Only what the file says to this node is set: below its own name, and below patterns such as '/**'.
"""

from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from pathlib import Path
import sys
from typing import TYPE_CHECKING

from amr_description.cli.arguments import add_remote_node_arguments
from amr_description.errors import ParameterError

if TYPE_CHECKING:
    from amr_description.cli.param.remote import RemoteParameters
    from amr_description.cli.param.values import Value


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser)
    parser.add_argument('parameter_file', type=Path, help='Parameter file')
    parser.add_argument(
        '--no-use-wildcard',
        action='store_true',
        help="Do not load parameters in the '/**' namespace into the node",
    )


def main(args: Namespace) -> int:
    """Set what the file says; 0 if the node has those values now."""
    from amr_description.cli.param.files import select
    from amr_description.cli.param.remote import remote_parameters
    from amr_description.cli.param.values import as_text
    from amr_description.parameter_files import read_parameter_file

    content = read_parameter_file(args.parameter_file)
    refused = {}
    with remote_parameters(args) as parameters:
        try:
            values = select(content, parameters.node, wildcards=not args.no_use_wildcard)
        except ParameterError as error:
            raise ParameterError(f'{args.parameter_file}: {error}') from error
        for name, result in parameters.set(values).items():
            reason = f': {result.reason}' if result.reason else ''
            if result.successful:
                print(f'Set parameter {name} successful{reason}')
            else:
                refused[name] = values[name]
                explanation = parameters.explain(name, as_text(values[name]))
                print(f'Set parameter {name} failed{reason}{explanation}', file=sys.stderr)
        return 0 if _has(parameters, refused) else 1


def _has(parameters: 'RemoteParameters', values: Mapping[str, 'Value']) -> bool:
    """Tell whether a node has the values that it refused: what ``dump`` wrote may be read-only."""
    from rclpy.parameter import parameter_value_to_python

    from amr_description.cli.param.values import as_text

    found = parameters.values(list(values))
    return all(
        name in found and as_text(parameter_value_to_python(found[name])) == as_text(value)
        for name, value in values.items()
    )
