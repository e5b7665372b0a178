# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs of ``ros2 control`` share: which controller manager, and how to ask it."""

from argparse import ArgumentParser, Namespace, REMAINDER
from typing import Any

from amr_description.cli.arguments import add_node_arguments

_DEFAULT = 'controller_manager'


def add_manager_arguments(parser: ArgumentParser) -> None:
    """Add the flags that every verb reads."""
    add_node_arguments(parser)
    parser.add_argument(
        '-c',
        '--controller-manager',
        default=_DEFAULT,
        help=f'Name of the controller manager ROS node (default: {_DEFAULT})',
    )
    parser.add_argument(
        '--include-hidden-nodes', action='store_true', help='Consider hidden nodes as well'
    )
    parser.add_argument(
        '--ros-args',
        nargs=REMAINDER,
        default=[],
        help='Pass arbitrary arguments to the executable',
    )


def ask(args: Namespace, service: str, service_type: Any, request: Any) -> Any:
    """
    Return the response of a service of the controller manager.

    :param service: Its name below that of the manager: ``list_controllers``.
    :raises AmrError: No answer.
    """
    from amr_description.cli.service_calls import call
    from amr_description.cli.session import open_session

    manager = '/' + args.controller_manager.strip('/')
    with open_session(use_sim_time=args.use_sim_time, ros_args=args.ros_args) as session:
        return call(session, f'{manager}/{service}', service_type, request)
