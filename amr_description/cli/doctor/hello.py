# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Check network connectivity between multiple hosts.

This command can be invoked on multiple hosts to confirm that they can talk to each other by using
talker/listener, multicast send/receive to check topic discovering and UDP communication. This
command outputs a summary table of msgs statistics at a custom period(s).
"""

from argparse import ArgumentParser, ArgumentTypeError, Namespace

from amr_description.argument_types import positive


def positive_int(text: str) -> int:
    """Return a whole number above 0, for argparse."""
    if not text.isdecimal() or int(text) <= 0:
        raise ArgumentTypeError('value must be a positive integer')
    return int(text)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument(
        '--topic',
        '-t',
        nargs='?',
        default='/canyouhearme',
        help="Name of ROS topic to publish to (default: '/canyouhearme')",
    )
    parser.add_argument(
        '--emit-period',
        '-ep',
        metavar='N',
        type=positive,
        default=0.1,
        help='Time period to publish/send one message (default: 0.1s)',
    )
    parser.add_argument(
        '--print-period',
        '-pp',
        metavar='N',
        type=positive,
        default=1.0,
        help='Time period to print summary table (default: 1.0s)',
    )
    parser.add_argument('--ttl', type=positive_int, help='TTL for multicast send (default: None)')
    parser.add_argument(
        '--once',
        '-1',
        action='store_true',
        help='Publish and multicast send for one emit period then exit; used in test case.',
    )


def main(args: Namespace) -> int:
    """Publish, send and count what others publish and send, until Ctrl-C; 0."""
    from amr_description.cli.doctor.greeting import greet

    return greet(
        args.topic,
        emit_period=args.emit_period,
        print_period=args.print_period,
        ttl=args.ttl,
        is_once=args.once,
    )
