# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a service's type."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        'service_name',
        help="Name of the ROS service to get type (e.g. '/talker/list_parameters')",
    )


def main(args: Namespace) -> int:
    """Print one type per line; 0, or 1 and nothing if the service is not known."""
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
    for name in types:
        print(name)
    return 0 if types else 1
