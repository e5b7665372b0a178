# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Print information about an action."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        'action_name', help="Name of the ROS action to get info (e.g. '/fibonacci')"
    )
    parser.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the action type'
    )
    parser.add_argument(
        '-c',
        '--count',
        action='store_true',
        help='Only display the number of action clients and action servers',
    )


def main(args: Namespace) -> int:
    """Print clients and servers, perhaps none; 0."""
    from amr_description.cli.actions import clients_of, servers_of, types_of_action
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        node = session.node
        action = full_name(node, args.action_name, 'an action')
        wait_for_discovery(session, args.spin_time, lambda: bool(types_of_action(node, action)))
        ends = {'clients': clients_of(node, action), 'servers': servers_of(node, action)}
    print(f'Action: {args.action_name}')
    for title, nodes in ends.items():
        print(f'Action {title}: {len(nodes)}')
        for name, types in nodes if not args.count else ():
            print(f'    {name} [{", ".join(types)}]' if args.show_types else f'    {name}')
    return 0
