# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The flags that several verbs have, and the types of values on a command line."""

from argparse import ArgumentParser, ArgumentTypeError
from typing import TypeVar

T = TypeVar('T', int, float)
_TRUNCATE_LENGTH = 128


def add_node_arguments(parser: ArgumentParser) -> None:
    """
    Add the flags of a verb that creates a node: ``spin_time`` and ``use_sim_time``.

    ``spin_time``: s; None: not given.
    """
    parser.add_argument(
        '--spin-time',
        type=nonnegative_float,
        help='Shortest time in seconds to wait for discovery; the wait goes on while news of '
        'other nodes comes in (default: 0, or 0.5 where nodes of other hosts are looked for)',
    )
    parser.add_argument(
        '-s', '--use-sim-time', action='store_true', help='Enable ROS simulation time'
    )


def add_graph_arguments(parser: ArgumentParser) -> None:
    """Add the flags of a verb that queries the graph."""
    add_node_arguments(parser)
    parser.add_argument(
        '--no-daemon',
        action='store_true',
        help='Accepted for scripts: there is no daemon, every answer is fresh',
    )


def add_hidden_nodes_argument(parser: ArgumentParser) -> None:
    """Add ``include_hidden_nodes``."""
    parser.add_argument(
        '--include-hidden-nodes', action='store_true', help='Consider hidden nodes as well'
    )


def add_remote_node_arguments(parser: ArgumentParser, *, optional: bool = False) -> None:
    """Add the name of the node that a verb is about, and how long to wait for it."""
    add_graph_arguments(parser)
    parser.add_argument('node_name', nargs='?' if optional else None, help='Name of the ROS node')
    add_hidden_nodes_argument(parser)
    parser.add_argument(
        '--timeout',
        metavar='N',
        type=nonnegative_float,
        default=1.0,
        help='Wait for N seconds until node becomes available (default: 1)',
    )


def add_style_arguments(parser: ArgumentParser) -> None:
    """Add how messages are printed; see :func:`amr_description.cli.echo_printer.style_of`."""
    parser.add_argument(
        '--csv',
        action='store_true',
        help='Output all recursive fields separated by commas (e.g. for plotting)',
    )
    parser.add_argument(
        '--full-length',
        '-f',
        action='store_true',
        help='Output all elements for arrays, bytes, and string with a length > '
        "'--truncate-length', by default they are truncated after '--truncate-length' "
        "elements with '...'",
    )
    parser.add_argument(
        '--truncate-length',
        '-l',
        type=nonnegative_int,
        default=_TRUNCATE_LENGTH,
        help=f'The length to truncate arrays, bytes, and string to (default: {_TRUNCATE_LENGTH})',
    )
    parser.add_argument(
        '--no-arr', action='store_true', help="Don't print array fields of messages"
    )
    parser.add_argument(
        '--no-str', action='store_true', help="Don't print string fields of messages"
    )
    parser.add_argument(
        '--flow-style',
        action='store_true',
        help='Print arrays in one line (not available with csv format)',
    )


def nonnegative_int(text: str) -> int:
    """Read an integer from 0 on."""
    value = _number(int, text)
    if value is None or value < 0:
        raise ArgumentTypeError('value must be non-negative integer')
    return value


def positive_int(text: str) -> int:
    """Read an integer from 1 on."""
    value = _number(int, text)
    if value is None or value <= 0:
        raise ArgumentTypeError('value must be a positive integer')
    return value


def positive_float(text: str) -> float:
    """Read a number above 0."""
    value = _number(float, text)
    if value is None:
        raise ArgumentTypeError(f"'{text}' is not a number")
    if not 0.0 < value < float('inf'):
        raise ArgumentTypeError('Value must be positive')
    return value


def nonnegative_float(text: str) -> float:
    """Read a number from 0 on."""
    return 0.0 if _number(float, text) == 0.0 else positive_float(text)


def unicode_text(text: str) -> str:
    """Read a name that ROS can send."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise ArgumentTypeError(f'not valid UTF-8: {text!a}') from error
    return text


def _number(kind: type[T], text: str) -> T | None:
    try:
        return kind(text)
    except ValueError:
        return None
