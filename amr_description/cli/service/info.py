# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Print information about a service."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments
from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        'service_name', help="Name of the ROS service to get info (e.g. '/add_two_ints')"
    )


def main(args: Namespace) -> int:
    """Print type, clients and servers; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        node = session.node
        service = full_name(node, args.service_name, 'a service')
        wait_for_discovery(
            session, args.spin_time, lambda: bool(graph.types_of_service(node, service))
        )
        types = graph.types_of_service(node, service)
        if not types:
            raise AmrError(f"Unknown service '{args.service_name}'")
        print(f'Type: {types[0] if len(types) == 1 else types}')
        print(f'Clients count: {node.count_clients(service)}')
        print(f'Services count: {node.count_services(service)}')
    return 0
