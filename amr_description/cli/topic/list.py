# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available topics."""

from argparse import ArgumentParser, Namespace, SUPPRESS
from collections.abc import Callable

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the topic type'
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
        default=SUPPRESS,  # or else it would undo the flag of the same name of `ros2 topic`
        help='Consider hidden topics as well',
    )
    parser.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help='List full details about each topic',
    )


def main(args: Namespace) -> int:
    """Print the topics; 0."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        wait_for_discovery(session, args.spin_time)
        topics = graph.topics(session.node, hidden=args.include_hidden_topics)
        if args.count_topics:
            print(len(topics))
        elif args.verbose:
            _print_ends('Published topics:', 'publisher', topics, session.node.count_publishers)
            _print_ends('Subscribed topics:', 'subscriber', topics, session.node.count_subscribers)
        else:
            for name, types in topics:
                print(f'{name} [{", ".join(types)}]' if args.show_types else name)
    return 0


def _print_ends(
    title: str, end: str, topics: list[tuple[str, list[str]]], count: Callable[[str], int]
) -> None:
    """Print how many publishers, or subscribers, the topics have that have any."""
    print(title)
    for name, types in topics:
        number = count(name)
        if number:
            plural = 's' if number > 1 else ''
            print(f' * {name} [{", ".join(types)}] {number} {end}{plural}')
    print()
