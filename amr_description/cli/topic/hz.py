# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Print the average publishing rate to screen.

It is the rate at which messages arrive here, which may be lower than that of the publisher.
"""

from argparse import ArgumentParser, Namespace
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import add_node_arguments, positive_int

if TYPE_CHECKING:
    from amr_description.cli.session import Session

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
    from rclpy.experimental import EventsExecutor
    from rclpy.qos import qos_profile_sensor_data

    from amr_description.cli import graph
    from amr_description.cli.message_types import message_type
    from amr_description.cli.session import open_session

    with open_session(use_sim_time=args.use_sim_time, executor=EventsExecutor) as session:
        topic = graph.full_topic_name(session.node, args.topic_name)
        message_class = message_type(graph.wait_for_type(session, topic))
        session.node.create_subscription(
            message_class,
            topic,
            _receiver(session, args),
            qos_profile_sensor_data,
            raw=args.filter_expr is None,
        )
        session.serve()
    return 0


def _receiver(session: 'Session', args: Namespace) -> Any:
    """Return the callback that measures and prints."""
    from rclpy.clock import Clock, ClockType

    from amr_description.cli.message_filter import make_filter
    from amr_description.cli.rate_meter import RateMeter

    meter = RateMeter(args.window_size)
    wanted = make_filter(args.filter_expr)
    system_clock = Clock(clock_type=ClockType.SYSTEM_TIME)
    clock = system_clock if args.wall_time else session.node.get_clock()

    def receive(message: Any) -> None:
        if not wanted(message):
            return
        if not meter.add(clock.now().nanoseconds):
            print('time has reset, resetting counters')
        rate = meter.report()
        if rate is not None:
            print(rate)

    return receive
