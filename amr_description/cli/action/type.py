# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Print an action's type."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        'action_name', help="Name of the ROS action to get info (e.g. '/fibonacci')"
    )


def main(args: Namespace) -> int:
    """Print one type per line; 0, or 1 and nothing if the action is not known."""
    from amr_description.cli.actions import types_of_action
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        node = session.node
        action = full_name(node, args.action_name, 'an action')
        wait_for_discovery(session, args.spin_time, lambda: bool(types_of_action(node, action)))
        types = types_of_action(node, action)
    for name in types:
        print(name)
    return 0 if types else 1
