# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Print the average publishing rate to screen.

It is the rate at which messages arrive here, which may be lower than that of the publisher.
"""

from argparse import ArgumentParser, Namespace
from typing import Any

from amr_description.cli.arguments import add_node_arguments, positive_int

_WINDOW = 10000


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        '--window',
        '-w',
        dest='window_size',
        type=positive_int,
        default=_WINDOW,
        metavar='WINDOW',
        help=f'window size, in # of messages, for calculating rate (default: {_WINDOW})',
    )
    parser.add_argument(
        '--filter',
        dest='filter_expr',
        metavar='EXPR',
        help='only measure messages matching the specified Python expression',
    )
    parser.add_argument(
        '--wall-time',
        action='store_true',
        help='calculates rate using wall time which can be helpful when clock is not published '
        'during simulation',
    )
    add_node_arguments(parser)


def main(args: Namespace) -> int:
    """Print a report a second until Ctrl-C."""
    from rclpy.clock import Clock, ClockType

    from amr_description.cli.message_filter import make_filter
    from amr_description.cli.meters import RateMeter
    from amr_description.cli.topic.measuring import measured_topic

    meter = RateMeter(args.window_size)
    wanted = make_filter(args.filter_expr)
    with measured_topic(args.topic_name, use_sim_time=args.use_sim_time) as topic:
        system_clock = Clock(clock_type=ClockType.SYSTEM_TIME)
        clock = system_clock if args.wall_time else topic.session.node.get_clock()

        def receive(message: Any) -> None:
            if not wanted(message):
                return
            if not meter.add(clock.now().nanoseconds):
                print('time has reset, resetting counters')
            rate = meter.report()
            if rate is not None:
                print(rate)

        topic.subscribe(receive, raw=args.filter_expr is None)
    return 0
