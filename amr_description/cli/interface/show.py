# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Output the interface definition.

examples:
  ros2 interface show geometry_msgs/msg/TwistStamped
  ros2 topic type /chatter | ros2 interface show -
"""

from argparse import ArgumentParser, Namespace
import sys

from amr_description.errors import UsageError

_STDIN = '-'


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    comments = parser.add_mutually_exclusive_group()
    comments.add_argument(
        '--all-comments',
        action='store_true',
        help='Show all comments, including for nested interface definitions',
    )
    comments.add_argument(
        '--no-comments', action='store_true', help='Show no comments or whitespace'
    )
    parser.add_argument(
        'type',
        help="Show an interface definition (e.g. 'example_interfaces/msg/String'). Passing "
        "'-' reads the argument from stdin (e.g. 'ros2 topic type /chatter | ros2 interface "
        "show -').",
    )


def main(args: Namespace) -> int:
    """Print the definition, and below each field that of its type; 0."""
    from amr_description.cli.interface.definition import Comments, expand
    from amr_description.cli.interface.index import read_definition

    name = _from_stdin() if args.type == _STDIN else args.type
    comments = Comments(at_top=not args.no_comments, below=args.all_comments)
    for line in expand(name, read_definition, comments):
        print(line)
    return 0


def _from_stdin() -> str:
    """Return the first line of stdin. Raises UsageError."""
    if sys.stdin is None or sys.stdin.isatty():
        raise UsageError("expected stdin pipe: '-' stands for what another command writes")
    name = sys.stdin.buffer.readline().decode(errors='replace').strip()
    if not name:
        raise UsageError('the passed value is empty: nothing came from stdin')
    return name
