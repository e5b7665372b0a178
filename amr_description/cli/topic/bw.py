# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Display bandwidth used by topic.

It is that of the messages which arrive here, in their serialized form. 1 KB is 1000 B.
"""

from argparse import ArgumentParser, Namespace
import time

from amr_description.cli.arguments import add_node_arguments, positive_int

_WINDOW = 100


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('topic', help='Topic name to monitor for bandwidth utilization')
    parser.add_argument(
        '--window',
        '-w',
        type=positive_int,
        default=_WINDOW,
        metavar='WINDOW',
        help=f'maximum window size, in # of messages, for calculating rate (default: {_WINDOW})',
    )
    add_node_arguments(parser)


def main(args: Namespace) -> int:
    """Print a report a second until Ctrl-C."""
    from amr_description.cli.meters import BandwidthMeter
    from amr_description.cli.topic.measuring import measured_topic

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
