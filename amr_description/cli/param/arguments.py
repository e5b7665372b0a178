# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs of ``ros2 param`` read in common."""

from argparse import ArgumentParser

from amr_description.cli.arguments import add_graph_arguments, nonnegative_float


def add_node_arguments(parser: ArgumentParser, *, optional: bool = False) -> None:
    """Add the node's name, and how long to wait for it."""
    add_graph_arguments(parser)
    parser.add_argument('node_name', nargs='?' if optional else None, help='Name of the ROS node')
    parser.add_argument(
        '--include-hidden-nodes', action='store_true', help='Consider hidden nodes as well'
    )
    parser.add_argument(
        '--timeout',
        metavar='N',
        type=nonnegative_float,
        default=1.0,
        help='Wait for N seconds until node becomes available (default: 1)',
    )
