# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available services."""

from argparse import ArgumentParser, Namespace, SUPPRESS

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the service type'
    )
    parser.add_argument(
        '-c',
        '--count-services',
        action='store_true',
        help='Only display the number of services discovered',
    )
    parser.add_argument(
        '--include-hidden-services',
        action='store_true',
        default=SUPPRESS,  # or else it would undo the flag of the same name of `ros2 service`
        help='Consider hidden services as well',
    )


def main(args: Namespace) -> int:
    """Print the services; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        wait_for_discovery(session, args.spin_time)
        found = graph.services(session.node, hidden=args.include_hidden_services)
    if args.count_services:
        print(len(found))
        return 0
    for name, types in found:
        print(f'{name} [{", ".join(types)}]' if args.show_types else name)
    return 0
