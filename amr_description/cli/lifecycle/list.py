# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output a list of available transitions."""

from argparse import ArgumentParser, Namespace

from amr_description.cli.lifecycle.managed import add_lifecycle_arguments, ask, find_lifecycle_node


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_lifecycle_arguments(parser)
    parser.add_argument('node_name', help='Name of the ROS node')
    parser.add_argument(
        '-a', '--all', action='store_true', help='Display all existing transitions'
    )


def main(args: Namespace) -> int:
    """Print the transitions that can be triggered now, or all that there are; 0."""
    from lifecycle_msgs.srv import GetAvailableTransitions

    from amr_description.cli.session import open_session

    service = 'get_transition_graph' if args.all else 'get_available_transitions'
    with open_session(use_sim_time=args.use_sim_time) as session:
        node = find_lifecycle_node(session, args)
        request = GetAvailableTransitions.Request()
        response = ask(session, node, service, GetAvailableTransitions, request, args.timeout)
    for description in response.available_transitions:
        print(
            f'- {description.transition.label} [{description.transition.id}]\n'
            f'\tStart: {description.start_state.label}\n'
            f'\tGoal: {description.goal_state.label}'
        )
    return 0
