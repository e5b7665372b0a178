# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Publish a message to a topic.

Fields that are not mentioned keep their defaults. The word 'auto' for a header, or 'now' for a
time, stands for the time of each publication.

examples:
  ros2 topic pub --once /chatter std_msgs/msg/String "{data: hello}"
  ros2 topic pub -r 10 /cmd_vel geometry_msgs/msg/TwistStamped "{header: auto}"
"""

from argparse import ArgumentParser, Namespace
import sys
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import (
    add_node_arguments,
    nonnegative_float,
    nonnegative_int,
    positive_float,
)
from amr_description.cli.qos_arguments import add_qos_arguments
from amr_description.errors import AmrError

if TYPE_CHECKING:
    from rclpy.publisher import Publisher

    from amr_description.cli.mismatch import TypeMismatchReporter
    from amr_description.cli.session import Session

_HINT_AFTER = 3  # s of waiting for subscriptions until a hint is looked for, every second then
_MOMENT = 0.1  # s for a node that cannot be asked
_MATCHING_TIME = 1.0  # s, at most, from the discovery of a subscription until it is matched


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('topic_name', help="Name of the ROS topic to publish to (e.g. '/chatter')")
    parser.add_argument(
        'message_type', help="Type of the ROS message (e.g. 'std_msgs/msg/String')"
    )
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        'values',
        nargs='?',
        default='{}',
        help='Values to fill the message with in YAML format (e.g. "data: Hello World"), '
        'otherwise the message will be published with default values',
    )
    source.add_argument('--stdin', action='store_true', help='Read values from standard input')
    _add_repetition(parser)
    _add_waiting(parser)
    parser.add_argument('-n', '--node-name', help='Name of the created publishing node')
    add_qos_arguments(parser, 'publish', 'default')
    add_node_arguments(parser)


def _add_repetition(parser: ArgumentParser) -> None:
    parser.add_argument(
        '-r',
        '--rate',
        metavar='N',
        type=positive_float,
        default=1.0,
        help='Publishing rate in Hz (default: 1)',
    )
    parser.add_argument(
        '-p',
        '--print',
        metavar='N',
        type=nonnegative_int,
        default=1,
        help='Only print every N-th published message (default: 1), 0: none',
    )
    times = parser.add_mutually_exclusive_group()
    times.add_argument('-1', '--once', action='store_true', help='Publish one message and exit')
    times.add_argument(
        '-t',
        '--times',
        type=nonnegative_int,
        default=0,
        help='Publish this number of times and then exit',
    )


def _add_waiting(parser: ArgumentParser) -> None:
    parser.add_argument(
        '-w',
        '--wait-matching-subscriptions',
        type=nonnegative_int,
        help='Wait until finding the specified number of matching subscriptions. Defaults to 1 '
        'when using "-1"/"--once"/"--times", otherwise defaults to 0.',
    )
    parser.add_argument(
        '--max-wait-time-secs',
        type=positive_float,
        help='The maximum time in seconds to wait for matching subscriptions; without it the '
        'wait is endless',
    )
    parser.add_argument(
        '--keep-alive',
        metavar='N',
        type=nonnegative_float,
        default=0.1,
        help='Keep publishing node alive for N seconds after the last msg (default: 0.1)',
    )


def main(args: Namespace) -> int:
    """Publish until done or Ctrl-C; 0 if done."""
    from rclpy.duration import Duration

    from amr_description.cli import qos
    from amr_description.cli.mismatch import TypeMismatchReporter
    from amr_description.cli.names import full_name
    from amr_description.cli.session import open_session
    from amr_description.cli.yaml_input import read_mapping
    from amr_description.ros.discovery import DELIVERY_TIME
    from amr_description.ros.message_fields import set_fields
    from amr_description.ros.message_types import message_type

    times = 1 if args.once else args.times
    awaited = args.wait_matching_subscriptions
    awaits_all = times > 0 and awaited is None and args.max_wait_time_secs is None
    awaited = (1 if times else 0) if awaited is None else awaited
    if args.max_wait_time_secs is not None and awaited == 0:
        raise AmrError(
            '--max-wait-time-secs option is only effective with '
            '--wait-matching-subscriptions, --once or --times'
        )
    message = message_type(args.message_type)()
    stamps = set_fields(message, read_mapping(sys.stdin.read() if args.stdin else args.values))
    with open_session(name=args.node_name, use_sim_time=args.use_sim_time) as session:
        topic = full_name(session.node, args.topic_name)
        publisher = session.node.create_publisher(type(message), topic, qos.from_flags(args))
        others = TypeMismatchReporter(session.node, topic, type(message), publishing=True)
        _wait_for_subscriptions(session, publisher, awaited, args.max_wait_time_secs, others)
        if awaits_all:
            _wait_for_all_there(session, publisher)
        if times:
            _wait_for_best_effort(session, publisher)
        print('publisher: beginning loop')
        _Loop(session, publisher, message, stamps, args.print).run(times, args.rate, others)
        session.spin(lambda: publisher.wait_for_all_acked(Duration()), DELIVERY_TIME)
        session.serve(timeout=args.keep_alive)
    return 0


def _wait_for_subscriptions(
    session: 'Session',
    publisher: 'Publisher',
    awaited: int,
    timeout: float | None,
    others: 'TypeMismatchReporter',
) -> None:
    """Wait for this many matching subscriptions; print that every second. Raises AmrError."""

    def matched() -> bool:
        return publisher.get_subscription_count() >= awaited

    left = float('inf') if timeout is None else timeout
    waited = 0
    hinted = False
    while not matched():
        print(f'Waiting for at least {awaited} matching subscription(s)...')
        if left <= 0.0:
            raise AmrError(
                f'Timed out waiting for subscribers: Expected {awaited} subcribers but only got '
                f'{publisher.get_subscription_count()} subscribers'
            )
        session.spin(matched, min(left, 1.0))
        left -= 1.0
        waited += 1
        others.report()
        if waited >= _HINT_AFTER and not hinted and not publisher.get_subscription_count():
            hinted = _print_hint(session, publisher)


def _wait_for_all_there(session: 'Session', publisher: 'Publisher') -> None:
    """
    Wait until all who subscribe now are matched, as far as the graph shows them.

    The first that is found may be a page that shows commands, and not the robot. One whose QoS
    does not fit is never matched, so the wait ends.
    """
    from amr_description.cli.discovery import wait_for_discovery

    def all_matched() -> bool:
        there = session.node.count_subscribers(publisher.topic_name)
        return publisher.get_subscription_count() >= there

    wait_for_discovery(session, 0.0)
    session.spin(all_matched, _MATCHING_TIME)


def _wait_for_best_effort(session: 'Session', publisher: 'Publisher') -> None:
    """
    Wait until those who subscribe by best effort know the publisher, too.

    That they are matched here says nothing of them, and what comes to them before is lost: on a
    busy machine one of five commands was. A participant learns of the endpoints of another one in
    the order in which they were made, so a node that has answered a client that was made after the
    publisher knows both. A node without services of parameters is given a moment.
    """
    from rcl_interfaces.srv import GetParameterTypes
    from rclpy.qos import ReliabilityPolicy

    from amr_description.ros.endpoints import endpoint_node

    node = session.node
    names = {
        endpoint_node(each)
        for each in node.get_subscriptions_info_by_topic(publisher.topic_name)
        if each.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
    }
    clients = [
        node.create_client(GetParameterTypes, f'{name}/get_parameter_types')
        for name in names
        if name is not None
    ]
    answers: dict[Any, Any] = {}
    begin = session.clock.now()

    def is_known(client: Any) -> bool:
        if client in answers:
            return bool(answers[client].done())
        if client.service_is_ready():
            answers[client] = client.call_async(GetParameterTypes.Request())
        is_offered = node.count_services(client.srv_name) > 0
        return not is_offered and session.clock.now() - begin > _MOMENT

    session.spin(lambda: all([is_known(each) for each in clients]), _MATCHING_TIME)
    for client in clients:
        node.destroy_client(client)


def _print_hint(session: 'Session', publisher: 'Publisher') -> bool:
    """
    Name the topics that could be meant, where nobody subscribes to the one that is given.

    Returns:
        False: none is known.
    """
    from amr_description.cli import graph

    node = session.node
    found = graph.namesakes(node, publisher.topic_name, node.count_subscribers)
    if found:
        print(
            f'WARNING: nobody subscribes to {publisher.topic_name}; somebody does to '
            f'{", ".join(found)}',
            file=sys.stderr,
        )
    return bool(found)


class _Loop:
    """Publishes one message repeatedly."""

    def __init__(
        self,
        session: 'Session',
        publisher: 'Publisher',
        message: Any,
        stamps: list[Any],
        print_every: int,
    ) -> None:
        self._session = session
        self._publisher = publisher
        self._message = message
        self._stamps = stamps
        self._print_every = print_every
        self._count = 0

    def run(self, times: int, rate: float, others: 'TypeMismatchReporter') -> None:
        """Publish at once, then at ``rate`` (Hz): ``times`` times; 0: without limit."""
        self._publish()
        if times == 1:
            return
        node = self._session.node
        timer = node.create_timer(1.0 / rate, self._publish)
        watch = node.create_timer(1.0, others.report)
        self._session.serve(lambda: 0 < times <= self._count)
        node.destroy_timer(watch)
        node.destroy_timer(timer)

    def _publish(self) -> None:
        self._count += 1
        now = self._session.node.get_clock().now().to_msg()
        for stamp in self._stamps:
            stamp(now)
        if self._print_every and self._count % self._print_every == 0:
            print(f'publishing #{self._count}: {self._message!r}\n')
        self._publisher.publish(self._message)
