# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Print information about a topic."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments
from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument('topic_name', help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help='Prints detailed information like the node name, node namespace, topic type, '
        'topic type hash, GUID, and QoS Profile of the publishers and subscribers to this topic',
    )


def main(args: Namespace) -> int:
    """Print type, publishers and subscriptions; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        node = session.node
        topic = full_name(node, args.topic_name)
        wait_for_discovery(session, args.spin_time, lambda: graph.is_published(node, topic))
        types = graph.types_of(node, topic)
        if not types:
            raise AmrError(f"Unknown topic '{args.topic_name}'")
        blank = '\n' if args.verbose else ''
        print(f'Type: {types[0] if len(types) == 1 else types}', end=f'\n{blank}')
        for title, count, endpoints in (
            ('Publisher', node.count_publishers, node.get_publishers_info_by_topic),
            ('Subscription', node.count_subscribers, node.get_subscriptions_info_by_topic),
        ):
            print(f'{title} count: {count(topic)}', end=f'\n{blank}')
            for endpoint in endpoints(topic) if args.verbose else ():
                print(endpoint, end='\n\n')
    return 0
