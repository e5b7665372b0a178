# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of action names."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_graph_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the action type'
    )
    parser.add_argument(
        '-c',
        '--count-actions',
        action='store_true',
        help='Only display the number of actions discovered',
    )


def main(args: Namespace) -> int:
    """Print the actions; 0."""
    from amr_description.cli.actions import actions
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time) as session:
        wait_for_discovery(session, args.spin_time)
        found = actions(session.node)
    if args.count_actions:
        print(len(found))
        return 0
    for name, types in found:
        print(f'{name} [{", ".join(types)}]' if args.show_types else name)
    return 0
