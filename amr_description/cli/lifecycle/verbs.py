# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 lifecycle`` about one node: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
import sys
from typing import Any

from amr_description.cli.lifecycle.managed import (
    add_lifecycle_arguments,
    ask,
    find_lifecycle_node,
    lifecycle_nodes,
    no_response,
    TIMEOUT,
)
from amr_description.errors import AmrError


class GetVerb:
    """Get lifecycle state for one or more nodes."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_lifecycle_arguments(parser)
        parser.add_argument(
            'node_name',
            nargs='?',
            help='Name of the ROS node. If no name is provided, then get the state for all nodes.',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the state of one node, or of all, asked at once; 0, or 1: one did not answer."""
        from lifecycle_msgs.srv import GetState

        from amr_description.cli.discovery import wait_for_discovery
        from amr_description.cli.service_calls import responses
        from amr_description.cli.session import open_session

        with open_session(use_sim_time=args.use_sim_time) as session:
            if args.node_name:
                nodes = [find_lifecycle_node(session, args)]
            else:
                wait_for_discovery(session, args.spin_time)
                nodes = lifecycle_nodes(session.node, hidden=args.include_hidden_nodes)
            requests = {f'{node}/get_state': GetState.Request() for node in nodes}
            answers = responses(session, GetState, requests, args.timeout)
        for node, answer in ((node, answers.get(f'{node}/get_state')) for node in nodes):
            if answer is None:
                print(no_response(node, args.timeout), file=sys.stderr)
            else:
                prefix = '' if args.node_name else f'{node}: '
                print(f'{prefix}{answer.current_state.label} [{answer.current_state.id}]')
        return 0 if len(answers) == len(nodes) else 1


class ListVerb:
    """Output a list of available transitions."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_lifecycle_arguments(parser)
        parser.add_argument('node_name', help='Name of the ROS node')
        parser.add_argument(
            '-a', '--all', action='store_true', help='Display all existing transitions'
        )

    @staticmethod
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


class SetVerb:
    """
    Trigger lifecycle state transition.

    examples:
      ros2 lifecycle set /my_node configure
      ros2 lifecycle set /my_node 3
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_lifecycle_arguments(parser, timeout=None)  # a node may take its time to configure
        parser.add_argument('node_name', help='Name of the ROS node')
        parser.add_argument('transition', help='The lifecycle transition')

    @staticmethod
    def main(args: Namespace) -> int:
        """Trigger a transition, given by its label or number; 0. Raises AmrError if it fails."""
        from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions

        from amr_description.cli.session import open_session

        with open_session(use_sim_time=args.use_sim_time) as session:
            node = find_lifecycle_node(session, args)
            available = ask(
                session,
                node,
                'get_available_transitions',
                GetAvailableTransitions,
                GetAvailableTransitions.Request(),
                args.timeout or TIMEOUT,
            )
            known = [description.transition for description in available.available_transitions]
            request = ChangeState.Request(transition=chosen(args.transition, known))
            response = ask(
                session, node, 'change_state', ChangeState, request, args.timeout, changes=True
            )
        if not response.success:
            raise AmrError('Transitioning failed')
        print('Transitioning successful')
        return 0


def chosen(wanted: str, known: list[Any]) -> Any:
    """Return the transition whose label, or else number, is the wanted one. Raises AmrError."""
    for key in ('label', 'id'):
        for transition in known:
            if str(getattr(transition, key)) == wanted:
                return transition
    lines = [f'\n- {transition.label} [{transition.id}]' for transition in known]
    raise AmrError(f'Unknown transition requested, available ones are:{"".join(lines) or " none"}')
