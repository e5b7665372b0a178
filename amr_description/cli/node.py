# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various node related sub-commands."""

from argparse import ArgumentParser, Namespace
import sys
from typing import TYPE_CHECKING

from amr_description.cli.arguments import add_graph_arguments
from amr_description.errors import AmrError
from amr_description.text import did_you_mean

if TYPE_CHECKING:
    from amr_description.cli.graph import NodeName
    from amr_description.cli.session import Session


class InfoVerb:
    """Output information about a node."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_graph_arguments(parser)
        parser.add_argument('node_name', help='Node name to request information')
        parser.add_argument(
            '--include-hidden',
            action='store_true',
            help='Display hidden topics, services, and actions as well',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print what a node publishes, subscribes to, serves and calls; 0."""
        from amr_description.cli import graph
        from amr_description.cli.discovery import wait_for_discovery
        from amr_description.cli.session import open_session

        name = graph.node_name(args.node_name)
        with open_session(use_sim_time=args.use_sim_time) as session:

            def named() -> 'list[NodeName]':
                return [n for n in graph.nodes(session.node, hidden=True) if n.full_name == name]

            wait_for_discovery(session, args.spin_time, lambda: bool(named()))
            found = named()
            if not found:
                others = [node.full_name for node in graph.nodes(session.node)]
                raise AmrError(
                    f"Unable to find node '{args.node_name}'{did_you_mean(name, others)}"
                )
            if len(found) > 1:
                print(
                    f'There are {len(found)} nodes in the graph with the exact name "{name}". You '
                    'are seeing information about only one of them.',
                    file=sys.stderr,
                )
            print(name)
            for title, entries in _sections(session, found[0], args.include_hidden).items():
                print(f'  {title}:')
                for topic, types in entries:
                    print(f'    {topic}: {", ".join(types)}')
                if not entries:
                    print()
        return 0


def _sections(
    session: 'Session', node: 'NodeName', include_hidden: bool
) -> dict[str, list[tuple[str, list[str]]]]:
    from rclpy.action import (
        get_action_client_names_and_types_by_node,
        get_action_server_names_and_types_by_node,
    )
    from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

    of_node = session.node
    getters = {
        'Subscribers': of_node.get_subscriber_names_and_types_by_node,
        'Publishers': of_node.get_publisher_names_and_types_by_node,
        'Service Servers': of_node.get_service_names_and_types_by_node,
        'Service Clients': of_node.get_client_names_and_types_by_node,
        'Action Servers': lambda *name: get_action_server_names_and_types_by_node(of_node, *name),
        'Action Clients': lambda *name: get_action_client_names_and_types_by_node(of_node, *name),
    }
    return {
        title: [
            (name, types)
            for name, types in sorted(get(node.name, node.namespace))
            if include_hidden or not topic_or_service_is_hidden(name)
        ]
        for title, get in getters.items()
    }


VERBS = {
    'info': f'{__name__}:InfoVerb',
    'list': 'amr_description.cli.graph_verbs:NODE_LIST',
}
