# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available services of a given type."""

from argparse import ArgumentParser, Namespace, SUPPRESS

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        'service_type',
        help='Name of the ROS service type to filter for '
        "(e.g. 'rcl_interfaces/srv/ListParameters')",
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
        default=SUPPRESS,
        help='Consider hidden services as well',
    )


def main(args: Namespace) -> int:
    """Print the services of exactly that type, perhaps none; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        wait_for_discovery(session, args.spin_time)
        there = graph.services(session.node, hidden=args.include_hidden_services)
    found = [name for name, types in there if args.service_type in types]
    if args.count_services:
        print(len(found))
        return 0
    for name in found:
        print(name)
    return 0
