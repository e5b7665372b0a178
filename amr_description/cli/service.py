# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various service related sub-commands."""

from argparse import ArgumentParser, Namespace
import sys
import time
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import (
    add_node_arguments,
    add_style_arguments,
    positive_float,
)
from amr_description.errors import AmrError
from amr_description.text import did_you_mean

if TYPE_CHECKING:
    from rclpy.client import Client

    from amr_description.cli.session import Session


class CallVerb:
    """
    Call a service.

    Fields that are not mentioned keep their defaults. The word 'auto' for a header, or 'now' for a
    time, stands for the time of each request.

    examples:
      ros2 service call /set_it std_srvs/srv/SetBool "{data: true}"
      ros2 service call --timeout 5 /trigger std_srvs/srv/Trigger
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument(
            'service_name', help="Name of the ROS service to call to (e.g. '/add_two_ints')"
        )
        parser.add_argument(
            'service_type', help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')"
        )
        source = parser.add_mutually_exclusive_group()
        source.add_argument(
            'values',
            nargs='?',
            default='{}',
            help="Values to fill the service request with in YAML format (e.g. '{a: 1, b: 2}'), "
            'otherwise the service request will be published with default values',
        )
        source.add_argument('--stdin', action='store_true', help='Read values from standard input')
        parser.add_argument(
            '-r',
            '--rate',
            metavar='N',
            type=float,
            help='Repeat the call at a specific rate in Hz',
        )
        parser.add_argument(
            '--timeout',
            metavar='N',
            type=positive_float,
            help='Longest time in seconds to wait for the service, and again for each response; '
            'without it the wait is endless',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print request and response, once or until Ctrl-C; 0 if done."""
        from amr_description.cli.names import full_name
        from amr_description.cli.session import open_session
        from amr_description.cli.yaml_input import read_value
        from amr_description.ros.message_fields import set_fields
        from amr_description.ros.message_types import service_type
        from amr_description.ros.qos import SERVICE_CLIENT

        if args.rate is not None and not 0.0 < args.rate < float('inf'):
            raise AmrError('rate must be greater than zero')
        service_class = service_type(args.service_type)
        request = service_class.Request()
        stamps = set_fields(request, read_value(sys.stdin.read() if args.stdin else args.values))
        with open_session() as session:
            name = full_name(session.node, args.service_name, 'a service')
            client = session.node.create_client(service_class, name, qos_profile=SERVICE_CLIENT)
            _wait_for_service(session, client, args.timeout)
            while True:
                start = time.monotonic()
                now = session.node.get_clock().now().to_msg()
                for stamp in stamps:
                    stamp(now)
                _call(session, client, request, args.timeout)
                if args.rate is None:
                    return 0
                session.serve(timeout=start + 1.0 / args.rate - time.monotonic())


class EchoVerb:
    """
    Echo a service.

    Requests and responses are published by clients and servers that are configured to: in Python
    by `configure_introspection()`.

    examples:
      ros2 service echo /set_it
      ros2 service echo /set_it std_srvs/srv/SetBool --flow-style
    """

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_node_arguments(parser)
        parser.add_argument(
            'service_name', help="Name of the ROS service to echo (e.g. '/add_two_ints')"
        )
        parser.add_argument(
            'service_type',
            nargs='?',
            help="Type of the ROS service (e.g. 'example_interfaces/srv/AddTwoInts')",
        )
        add_style_arguments(parser)

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the events of a service until Ctrl-C."""
        from rclpy.qos import QoSPresetProfiles

        from amr_description.bag.topic_filter import EVENT_TOPIC
        from amr_description.cli import graph
        from amr_description.cli.discovery import wait_for_discovery
        from amr_description.cli.echo_printer import style_of
        from amr_description.cli.names import full_name
        from amr_description.cli.session import open_session
        from amr_description.ros.message_text import to_csv, to_yaml
        from amr_description.ros.message_types import service_type

        style = style_of(args)

        def show(event: Any) -> None:
            text = to_csv(event, style) if args.csv else f'{to_yaml(event, style)}---'
            print(text, flush=True)

        with open_session(use_sim_time=args.use_sim_time) as session:
            node = session.node
            name = full_name(node, args.service_name, 'a service')
            wait_for_discovery(
                session, args.spin_time, lambda: bool(graph.types_of_service(node, name))
            )
            types = (
                [args.service_type] if args.service_type else graph.types_of_service(node, name)
            )
            if not types:
                known = [each for each, _ in graph.services(node)]
                raise AmrError(
                    f"Could not load the type for the passed service '{name}'"
                    f'{did_you_mean(name, known)}'
                )
            topic = f'{name}{EVENT_TOPIC}'
            if not node.count_publishers(topic):
                print(
                    f"WARNING: nobody publishes on '{topic}' yet: clients and servers do so once "
                    'they are configured to, in Python by configure_introspection()',
                    file=sys.stderr,
                )
            profile = QoSPresetProfiles.SERVICES_DEFAULT.value
            node.create_subscription(service_type(types[0]).Event, topic, show, profile)
            session.serve()
        return 0


def _call(session: 'Session', client: 'Client', request: Any, timeout: float | None) -> None:
    """Print a request and its response. Raises AmrError."""
    from amr_description.cli.service_calls import response_to

    print(f'requester: making request: {request!r}\n')
    response = response_to(session, client, request, timeout)
    if response is None:
        raise AmrError(f'No response from {client.service_name} within {timeout:g} s')
    print(f'response:\n{response!r}\n')


def _wait_for_service(session: 'Session', client: 'Client', timeout: float | None) -> None:
    """Wait for the service, and print that. Raises AmrError."""
    from amr_description.cli.discovery import explained_absence
    from amr_description.ros.service_calls import ServiceReadiness

    is_ready = ServiceReadiness(session.node, client)
    if is_ready():
        return
    print('waiting for service to become available...')
    reason = explained_absence(
        session, is_ready, timeout, lambda: _explain_absence(session, client)
    )
    if reason is not None:
        raise AmrError(
            f"Service '{client.service_name}' did not become available within {timeout:g} s"
            + (f': {reason}' if reason else '')
        )


def _explain_absence(session: 'Session', client: 'Client') -> str:
    """Return why the service is not there, '' if unknown."""
    from amr_description.cli import graph
    from amr_description.ros.message_types import type_name

    return graph.explain_absent_service(
        client.service_name,
        type_name(client.srv_type),
        graph.services(session.node, hidden=True),
    )


VERBS = {
    'call': f'{__name__}:CallVerb',
    'echo': f'{__name__}:EchoVerb',
    'find': 'amr_description.cli.graph_verbs:SERVICE_FIND',
    'info': 'amr_description.cli.graph_verbs:ServiceInfo',
    'list': 'amr_description.cli.graph_verbs:SERVICE_LIST',
    'type': 'amr_description.cli.graph_verbs:SERVICE_TYPE',
}


def add_arguments(parser: ArgumentParser) -> None:
    """Add what every verb of ``ros2 service`` reads."""
    parser.add_argument(
        '--include-hidden-services', action='store_true', help='Consider hidden services as well'
    )
