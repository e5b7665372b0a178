# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available nodes."""

from argparse import ArgumentParser, Namespace
from itertools import pairwise
import sys

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        '-a', '--all', action='store_true', help='Display all nodes even hidden ones'
    )
    parser.add_argument(
        '-c',
        '--count-nodes',
        action='store_true',
        help='Only display the number of nodes discovered',
    )


def main(args: Namespace) -> int:
    """Print the full names of the nodes; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        wait_for_discovery(session, args.spin_time)
        nodes = graph.nodes(session.node, hidden=args.all)
    if args.count_nodes:
        print(len(nodes))
        return 0
    if any(one == next_one for one, next_one in pairwise(nodes)):
        print(
            'WARNING: Be aware that there are nodes in the graph that share an exact name, which '
            'can have unintended side effects.',
            file=sys.stderr,
        )
    for node in nodes:
        print(node.full_name)
    return 0
