# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 topic`` that measure: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
import sys
import time
from typing import Any

from amr_description.cli.arguments import add_node_arguments, positive_int
from amr_description.errors import AmrError

_BW_WINDOW = 100
_WINDOW = 10000
_OTHER_CLOCK_DELAY = 1e8  # s; three years: one of the two is simulation time


class HzVerb:
    """
    Print the average publishing rate to screen.

    It is the rate at which messages arrive here, which may be lower than that of the publisher.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument(
            'topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')"
        )
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
            help='calculates rate using wall time which can be helpful when clock is not '
            'published during simulation',
        )
        add_node_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a report a second until Ctrl-C."""
        from rclpy.clock import Clock, ClockType

        from amr_description.cli.message_filter import make_filter
        from amr_description.cli.meters import measured_topic, RateMeter

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


class BwVerb:
    """
    Display bandwidth used by topic.

    It is that of the messages which arrive here, in their serialized form. 1 KB is 1000 B.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('topic', help='Topic name to monitor for bandwidth utilization')
        parser.add_argument(
            '--window',
            '-w',
            type=positive_int,
            default=_BW_WINDOW,
            metavar='WINDOW',
            help='maximum window size, in # of messages, for calculating rate '
            f'(default: {_BW_WINDOW})',
        )
        add_node_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a report a second until Ctrl-C."""
        from amr_description.cli.meters import BandwidthMeter, measured_topic

        meter = BandwidthMeter(args.window)
        with measured_topic(args.topic, use_sim_time=args.use_sim_time) as topic:
            clock = topic.session.node.get_clock()

            def now() -> int:
                return clock.now().nanoseconds if args.use_sim_time else time.monotonic_ns()

            def report() -> None:
                bandwidth = meter.report(now())
                if bandwidth is not None:
                    print(bandwidth)

            topic.subscribe(lambda message: meter.add(now(), len(message)))
            print(f'Subscribed to [{topic.name}]')
            topic.every_second(report)
        return 0


class DelayVerb:
    """
    Display delay of topic from timestamp in header.

    It is the time between the stamp of a message and its arrival here, both by the same clock: use
    --use-sim-time for what is stamped with simulation time.
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('topic', help='Topic name to calculate the delay for')
        parser.add_argument(
            '--window',
            '-w',
            type=positive_int,
            default=_WINDOW,
            metavar='WINDOW',
            help=f'window size, in # of messages, for calculating rate (default: {_WINDOW})',
        )
        add_node_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print a report a second until Ctrl-C."""
        from amr_description.cli.meters import DelayMeter, measured_topic

        meter = DelayMeter(args.window)
        with measured_topic(args.topic, use_sim_time=args.use_sim_time) as topic:
            stamp_of = stamp_reader(topic.message_class)
            clock = topic.session.node.get_clock()

            def receive(message: bytes) -> None:
                if not meter.add(clock.now().nanoseconds, stamp_of(message)):
                    print('time has reset, resetting counters')

            has_warned = False

            def report() -> None:
                nonlocal has_warned
                delay = meter.report()
                if delay is not None:
                    print(delay)
                    if abs(delay.mean) > _OTHER_CLOCK_DELAY and not has_warned:
                        has_warned = True
                        print(_other_clock(topic.name, args.use_sim_time), file=sys.stderr)
                elif meter.started:
                    print('no new messages')

            topic.subscribe(receive)
            topic.every_second(report)
        return 0


def _other_clock(topic: str, use_sim_time: bool) -> str:
    ours, hint = (
        ('simulation time', 'leave --use-sim-time out')
        if use_sim_time
        else ("this computer's clock", 'for simulation time use --use-sim-time')
    )
    return f'WARNING: the stamps of {topic} are not by {ours}: {hint}'


def stamp_reader(message_class: Any) -> Callable[[bytes], int]:
    """
    Return a function that reads the stamp, ns, from a serialized message.

    If the header comes first, only it is decoded: to decode a large image takes longer than its
    transport.

    Raises AmrError if messages of this class have no header.
    """
    from rclpy.serialization import deserialize_message
    from std_msgs.msg import Header

    from amr_description.ros.message_types import type_name
    from amr_description.ros.messages import nanoseconds

    fields = list(message_class.get_fields_and_field_types().items())
    header = ('header', 'std_msgs/Header')
    if header not in fields:
        raise AmrError(
            f'msg does not have header: the delay of {type_name(message_class)} is not known'
        )
    if fields[0] == header:
        return lambda data: nanoseconds(deserialize_message(data, Header).stamp)
    return lambda data: nanoseconds(deserialize_message(data, message_class).header.stamp)
