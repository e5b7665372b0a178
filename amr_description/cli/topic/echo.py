# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Output messages from a topic.

examples:
  ros2 topic echo /odom --once
  ros2 topic echo /odom --field pose.pose.position
  ros2 topic echo /joint_states --csv
"""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import (
    add_graph_arguments,
    add_style_arguments,
    positive_float,
)
from amr_description.cli.qos_arguments import add_qos_arguments

if TYPE_CHECKING:
    from amr_description.cli.session import Session


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_graph_arguments(parser)
    parser.add_argument('topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        'message_type',
        nargs='?',
        help="Type of the ROS message (e.g. 'std_msgs/msg/String')",
    )
    add_qos_arguments(parser, 'subscribe', 'sensor_data', matched='reliability, durability')
    _add_selection(parser)
    _add_appearance(parser)


def _add_selection(parser: ArgumentParser) -> None:
    parser.add_argument(
        '--field',
        help="Echo a selected field of a message. Use '.' to select sub-fields. "
        'For example, to echo the position field of a nav_msgs/msg/Odometry message: '
        "'ros2 topic echo /odom --field pose.pose.position'",
    )
    parser.add_argument(
        '--filter',
        dest='filter_expr',
        metavar='FILTER_EXPR',
        help='Python expression to filter messages that are printed. Expression can use '
        "Python builtins as well as m (the message), as in 'm.twist.twist.linear.x > 0.1'",
    )
    parser.add_argument(
        '--once', action='store_true', help='Print the first message received and then exit.'
    )
    parser.add_argument(
        '--timeout',
        metavar='N',
        type=positive_float,
        help='Set a timeout in seconds for waiting',
    )
    parser.add_argument('--lost-messages', action='store_true', help='DEPRECATED: Does nothing')
    parser.add_argument(
        '--no-lost-messages', action='store_true', help="Don't report when a message is lost"
    )


def _add_appearance(parser: ArgumentParser) -> None:
    add_style_arguments(parser)
    parser.add_argument('--raw', action='store_true', help='Echo the raw binary representation')
    parser.add_argument(
        '--include-message-info',
        '-i',
        action='store_true',
        help='Shows the associated message info.',
    )


def main(args: Namespace) -> int:
    """Print messages until ``--once``, ``--timeout`` or Ctrl-C; 0 for the first two."""
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.experimental import EventsExecutor

    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery
    from amr_description.cli.mismatch import TypeMismatchReporter
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session
    from amr_description.ros.message_types import message_type

    if args.message_type:
        message_type(args.message_type)
    executor = SingleThreadedExecutor if args.include_message_info else EventsExecutor
    with open_session(use_sim_time=args.use_sim_time, executor=executor) as session:
        topic = full_name(session.node, args.topic_name)
        wait_for_discovery(
            session,
            args.spin_time,
            None if args.message_type else lambda: graph.is_published(session.node, topic),
        )
        type_name = args.message_type or graph.only_type_of(session.node, topic)
        message_class = message_type(type_name)
        TypeMismatchReporter(session.node, topic, message_class, publishing=False).report()
        printed = _subscribe(session, args, topic, message_class)
        session.serve(lambda: printed() and args.once, args.timeout)
    return 0


def _subscribe(
    session: 'Session', args: Namespace, topic: str, message_class: Any
) -> Callable[[], bool]:
    """Print the messages; return a function that tells whether one was printed."""
    from rclpy.event_handler import SubscriptionEventCallbacks

    from amr_description.cli import qos
    from amr_description.cli.echo_printer import EchoPrinter

    publishers = session.node.get_publishers_info_by_topic(topic)
    profile, notes = qos.for_subscription(args, [p.qos_profile for p in publishers])
    for note in notes:
        print(note)
    printer = EchoPrinter(args, message_class)
    events = SubscriptionEventCallbacks()
    if not args.no_lost_messages:
        events.message_lost = printer.report_lost
    receive = printer.receive_with_info if args.include_message_info else printer.receive
    session.node.create_subscription(
        message_class, topic, receive, profile, raw=args.raw, event_callbacks=events
    )
    return printer.has_printed
