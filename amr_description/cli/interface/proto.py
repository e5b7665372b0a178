# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Output an interface prototype.

Of a service the request is printed, of an action the goal: what 'ros2 service call' and 'ros2
action send_goal' want to be given.
"""

from argparse import ArgumentParser, Namespace
from typing import Any


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('type', help="Show an interface definition (e.g. 'std_msgs/msg/String')")
    parser.add_argument(
        '--no-quotes', action='store_true', help='if true output has no outer quotes.'
    )


def main(args: Namespace) -> int:
    """Print a message with its defaults, as YAML; 0."""
    from amr_description.cli.message_text import Style, to_yaml

    text = to_yaml(_message_class(args.type)(), Style(truncate_length=None))
    print(text if args.no_quotes else f'"{text}"')
    return 0


def _message_class(name: str) -> Any:
    from amr_description.cli.interface.index import split_name
    from amr_description.ros.message_types import action_type, message_type, service_type

    _, kind, _ = split_name(name)
    if kind == 'srv':
        return service_type(name).Request
    return action_type(name).Goal if kind == 'action' else message_type(name)
