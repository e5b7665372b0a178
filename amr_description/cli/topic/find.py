# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available topics of a given type."""

from argparse import ArgumentParser, Namespace, SUPPRESS

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        'topic_type',
        help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')",
    )
    parser.add_argument(
        '-c',
        '--count-topics',
        action='store_true',
        help='Only display the number of topics discovered',
    )
    parser.add_argument(
        '--include-hidden-topics',
        action='store_true',
        default=SUPPRESS,
        help='Consider hidden topics as well',
    )


def main(args: Namespace) -> int:
    """Print the topics of exactly that type, perhaps none; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        wait_for_discovery(session, args.spin_time)
        topics = graph.topics(session.node, hidden=args.include_hidden_topics)
    found = [name for name, types in topics if args.topic_type in types]
    if args.count_topics:
        print(len(found))
    else:
        for name in found:
            print(name)
    return 0
