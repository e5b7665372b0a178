# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs of ``ros2 control`` share: the controller manager, and calls of its services."""

from argparse import ArgumentParser, Namespace, REMAINDER
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import (
    add_hidden_nodes_argument,
    add_node_arguments,
    unicode_text,
)
from amr_description.errors import AmrError

if TYPE_CHECKING:
    from amr_description.cli.session import Session
    from amr_description.control.ros.client import ManagerClient

_DEFAULT = 'controller_manager'
_SILENT = 1.0  # s; a normal discovery is not logged


def add_manager_arguments(parser: ArgumentParser) -> None:
    """Add the flags that every verb has."""
    add_node_arguments(parser)
    parser.add_argument(
        '-c',
        '--controller-manager',
        type=unicode_text,
        default=_DEFAULT,
        help=f'Name of the controller manager ROS node (default: {_DEFAULT})',
    )
    add_hidden_nodes_argument(parser)
    parser.add_argument(
        '--ros-args',
        nargs=REMAINDER,
        default=[],
        help='Pass arbitrary arguments to the executable',
    )


def add_controller_argument(parser: ArgumentParser, purpose: str) -> None:
    """Add the name of a controller; ``purpose``: what is to happen to it."""
    parser.add_argument(
        'controller_name', type=unicode_text, help=f'Name of the controller {purpose}'
    )


def ask(args: Namespace, service_type: Any) -> Any:
    """
    Return the response of a service of the controller manager whose request has no fields.

    Raises AmrError if there is no response.
    """
    with open_manager(args, first=service_type) as manager:
        return manager.query(service_type)


@contextmanager
def open_manager(args: Namespace, first: Any = None) -> 'Iterator[ManagerClient]':
    """Yield the controller manager once it is there; ``first``: as of ManagerClient."""
    from amr_description.cli.session import open_session
    from amr_description.control.ros.client import ManagerClient

    with open_session(use_sim_time=args.use_sim_time, ros_args=args.ros_args) as session:
        name = _name(session, args)
        yield ManagerClient(session.node, name, silent=_SILENT, first=first)


def failure(text: str, reason: str) -> AmrError:
    """Return an error with the reason, which the responses of the services do not have."""
    return AmrError(f'{text}: {reason}' if reason else text)


def _name(session: 'Session', args: Namespace) -> str:
    from amr_description.cli.names import full_name

    name = args.controller_manager.rstrip('/')
    return full_name(session.node, name, 'the name of a controller manager')
