# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Trigger lifecycle state transition.

examples:
  ros2 lifecycle set /my_node configure
  ros2 lifecycle set /my_node 3
"""

from argparse import ArgumentParser, Namespace
from typing import Any

from amr_description.cli.lifecycle.managed import (
    add_lifecycle_arguments,
    ask,
    find_lifecycle_node,
    TIMEOUT,
)
from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_lifecycle_arguments(parser, timeout=None)  # a node may take its time to configure
    parser.add_argument('node_name', help='Name of the ROS node')
    parser.add_argument('transition', help='The lifecycle transition')


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
