# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Get lifecycle state for one or more nodes."""

from argparse import ArgumentParser, Namespace
import sys

from amr_description.cli.lifecycle.managed import (
    add_lifecycle_arguments,
    find_lifecycle_node,
    lifecycle_nodes,
    no_response,
)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_lifecycle_arguments(parser)
    parser.add_argument(
        'node_name',
        nargs='?',
        help='Name of the ROS node. If no name is provided, then get the state for all nodes.',
    )


def main(args: Namespace) -> int:
    """Print the state of one node, or of all, all asked at once; 0, or 1 if one did not answer."""
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
