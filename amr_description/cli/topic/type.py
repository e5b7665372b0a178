# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Print a topic's type."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument('topic_name', help="Name of the ROS topic to get type (e.g. '/chatter')")


def main(args: Namespace) -> int:
    """Print one type per line; 0, or 1 and nothing if the topic is not known."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        topic = full_name(session.node, args.topic_name)
        wait_for_discovery(
            session, args.spin_time, lambda: graph.is_published(session.node, topic)
        )
        types = graph.types_of(session.node, topic)
    for name in types:
        print(name)
    return 0 if types else 1
