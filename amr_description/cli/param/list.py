# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available parameters."""

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Sequence
import re
import sys
from typing import TYPE_CHECKING

from amr_description.cli.arguments import add_remote_node_arguments, unicode_text

if TYPE_CHECKING:
    from amr_description.cli.session import Session


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser, optional=True)
    parser.add_argument(
        '--param-prefixes',
        nargs='+',
        type=unicode_text,
        default=[],
        help='Only list parameters with the provided prefixes',
    )
    parser.add_argument(
        '--param-type', action='store_true', help='Print parameter types with parameter names'
    )
    parser.add_argument(
        '--filter',
        type=_pattern,
        default=re.compile(''),
        help='Only list parameters whose names begin with a match of the regular expression',
    )


def main(args: Namespace) -> int:
    """
    Print the parameters of a node, or of all nodes that have any; 0.

    A node that does not answer is told on stderr; 1 if it is the one that was asked for.
    """
    from amr_description.cli.param.remote import no_answer
    from amr_description.cli.param.requests import describe_all, list_all
    from amr_description.cli.param.values import TYPE_NAMES
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        nodes = _nodes(session, args)
        found = {
            node: [name for name in names if args.filter.match(name)]
            for node, names in list_all(session, nodes, args.param_prefixes).items()
        }
        descriptors = describe_all(session, found) if args.param_type else {}
    for node in nodes:
        if node not in found:
            print(no_answer(node), file=sys.stderr)
            continue
        if not args.node_name:
            print(f'{node}:')
        for name in found[node]:
            descriptor = descriptors.get(node, {}).get(name)
            print(f'  {name} (type: {TYPE_NAMES[descriptor.type]})' if descriptor else f'  {name}')
    return 1 if args.node_name and not found else 0


def _nodes(session: 'Session', args: Namespace) -> Sequence[str]:
    """Return the full names of the nodes whose parameters are wanted. Raises AmrError."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery

    if args.node_name:
        timeout = max(args.timeout, args.spin_time or 0.0)
        return [graph.find_node(session, args.node_name, timeout)]
    wait_for_discovery(session, args.spin_time)
    services = dict(session.node.get_service_names_and_types())
    nodes = graph.nodes(session.node, hidden=args.include_hidden_nodes)
    names = sorted({node.full_name for node in nodes})
    return [name for name in names if f'{name}/list_parameters' in services]


def _pattern(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise ArgumentTypeError(f"'{text}' is not a regular expression: {error}") from error
