# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``ros2node.api``, ``ros2param.api`` and their like: what programs ask of a graph by a node.

For rosapi, and for tools that begin as verbs of ``ros2`` do. The command itself (``cli/``) needs
none of it. A node of ``ros2cli`` asks the graph directly: there is no daemon here.
"""

import os
from pathlib import Path
import sys
import time
from typing import Any, NamedTuple, Self

from ament_index_python import get_package_prefix, get_packages_with_prefixes
from ament_index_python.packages import PackageNotFoundError
from rcl_interfaces.msg import ParameterType
import rclpy
import rclpy.action
from rclpy.exceptions import InvalidTopicNameException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.node import HIDDEN_NODE_PREFIX, Node
from rclpy.parameter import parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from rclpy.validate_full_topic_name import validate_full_topic_name

from amr_description.ros_packages.rosidl_runtime_py import get_message, get_service

NODE_NAME_PREFIX = f'{HIDDEN_NODE_PREFIX}ros2cli'
DEFAULT_TIMEOUT = 0.5
"""s in which a new node gets to know the others."""
_SERVICES = 5.0
"""s to wait for the parameter services of a node."""

NamesAndTypes = list[tuple[str, list[str]]]


class DirectNode:
    """A node for a few questions: within its context it is a node of rclpy."""

    def __init__(self, args: Any = None, *, node_name: str | None = None) -> None:
        """
        Start rclpy and the node, and let it get to know the others.

        Args:
            args: Of argparse; ``spin_time``, s, ``argv`` and ``use_sim_time`` count.
            node_name: None: ``_ros2cli_<pid>``.
        """
        rclpy.init(args=getattr(args, 'argv', []))
        simulated = rclpy.Parameter('use_sim_time', value=getattr(args, 'use_sim_time', False))
        self.node = Node(
            node_name or f'{NODE_NAME_PREFIX}_{os.getpid()}',
            start_parameter_services=getattr(args, 'start_parameter_services', False),
            parameter_overrides=[simulated],
        )
        end = time.monotonic() + getattr(args, 'spin_time', DEFAULT_TIMEOUT)
        while (left := end - time.monotonic()) > 0.0:
            rclpy.spin_once(self.node, timeout_sec=left)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_args: object) -> None:
        self.node.destroy_node()
        rclpy.try_shutdown()

    def get_action_names_and_types(self) -> NamesAndTypes:
        """Return all actions."""
        found: NamesAndTypes = rclpy.action.get_action_names_and_types(self.node)
        return found

    def get_action_client_names_and_types_by_node(self, name: str, space: str) -> NamesAndTypes:
        """Return the actions that a node asks for."""
        find = rclpy.action.get_action_client_names_and_types_by_node
        found: NamesAndTypes = find(self.node, name, space)
        return found

    def get_action_server_names_and_types_by_node(self, name: str, space: str) -> NamesAndTypes:
        """Return the actions that a node serves."""
        find = rclpy.action.get_action_server_names_and_types_by_node
        found: NamesAndTypes = find(self.node, name, space)
        return found

    def __getattr__(self, name: str) -> Any:
        if name == 'node':  # it could not be made
            raise AttributeError(name)
        return getattr(self.node, name)


NodeStrategy = DirectNode


def add_arguments(parser: Any) -> None:
    """Give a parser the options of such a node."""
    parser.add_argument(
        '--spin-time', type=float, default=DEFAULT_TIMEOUT, help='Time for discovery, s.'
    )
    parser.add_argument('-s', '--use-sim-time', action='store_true', help='Take /clock for time.')
    parser.add_argument('--no-daemon', action='store_true', help='Of no effect: there is none.')


class NodeName(NamedTuple):
    """The name of a node."""

    name: str
    namespace: str
    full_name: str


class TopicInfo(NamedTuple):
    """A topic, service or action of a node."""

    name: str
    types: list[str]


def get_absolute_node_name(node_name: str) -> str | None:
    """Return a name with a slash before it; None: there is none."""
    return f'/{node_name.removeprefix("/")}' if node_name else None


def parse_node_name(node_name: str) -> NodeName:
    """Return the parts of a full name."""
    full_name = f'/{node_name.removeprefix("/")}'
    namespace, _, name = full_name.rpartition('/')
    return NodeName(name, namespace or '/', full_name)


def has_duplicates(values: list[Any]) -> bool:
    """Return whether a value stands in a list twice."""
    return len({*values}) < len(values)


def get_node_names(*, node: Any, include_hidden_nodes: bool = False) -> list[NodeName]:
    """Return all nodes that a node sees."""
    return [
        NodeName(name, namespace, f'{namespace.rstrip("/")}/{name}')
        for name, namespace in node.get_node_names_and_namespaces()
        if include_hidden_nodes or (name and not name.startswith(HIDDEN_NODE_PREFIX))
    ]


def wait_for_node(
    node: Any, node_name: str, include_hidden_nodes: bool = False, timeout: float = 1.0
) -> bool:
    """Return whether a node is seen within a time, s."""
    wanted, end = get_absolute_node_name(node_name), time.monotonic() + timeout
    while True:
        seen = get_node_names(node=node, include_hidden_nodes=include_hidden_nodes)
        if any(each.full_name == wanted for each in seen):
            return True
        if time.monotonic() >= end:
            return False
        time.sleep(0.05)  # the graph tells no change to a node that is not spun


def _of_node(of: str, question: Any, *, hidden: bool) -> list[TopicInfo]:
    name = parse_node_name(of)
    return [
        TopicInfo(each, types)
        for each, types in question(name.name, name.namespace)
        if hidden or not topic_or_service_is_hidden(each)
    ]


def get_subscriber_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return what a node subscribes to."""
    question = node.get_subscriber_names_and_types_by_node
    return _of_node(remote_node_name, question, hidden=include_hidden)


def get_publisher_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return what a node publishes."""
    question = node.get_publisher_names_and_types_by_node
    return _of_node(remote_node_name, question, hidden=include_hidden)


def get_service_client_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the services that a node asks."""
    question = node.get_client_names_and_types_by_node
    return _of_node(remote_node_name, question, hidden=include_hidden)


def get_service_server_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the services that a node offers."""
    question = node.get_service_names_and_types_by_node
    return _of_node(remote_node_name, question, hidden=include_hidden)


def get_action_server_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the actions that a node serves."""
    question = _action_question(node, 'get_action_server_names_and_types_by_node')
    return _of_node(remote_node_name, question, hidden=include_hidden)


def get_action_client_info(
    *, node: Any, remote_node_name: str, include_hidden: bool = False
) -> list[TopicInfo]:
    """Return the actions that a node asks for."""
    question = _action_question(node, 'get_action_client_names_and_types_by_node')
    return _of_node(remote_node_name, question, hidden=include_hidden)


def _action_question(node: Any, name: str) -> Any:
    if isinstance(node, DirectNode):
        return getattr(node, name)
    return lambda *of: getattr(rclpy.action, name)(node, *of)


def get_action_names_and_types(*, node: Any) -> NamesAndTypes:
    """Return all actions that a node sees."""
    asked = node.node if isinstance(node, DirectNode) else node
    found: NamesAndTypes = rclpy.action.get_action_names_and_types(asked)
    return found


def get_action_names(*, node: Any) -> list[str]:
    """Return their names."""
    return [name for name, _ in get_action_names_and_types(node=node)]


def get_topic_names_and_types(*, node: Any, include_hidden_topics: bool = False) -> NamesAndTypes:
    """Return all topics that a node sees."""
    return _shown(node.get_topic_names_and_types(), hidden=include_hidden_topics)


def get_topic_names(*, node: Any, include_hidden_topics: bool = False) -> list[str]:
    """Return their names."""
    found = get_topic_names_and_types(node=node, include_hidden_topics=include_hidden_topics)
    return [name for name, _ in found]


def get_msg_class(
    node: Any, topic: str, blocking: bool = False, include_hidden_topics: bool = False
) -> Any:
    """
    Return the class of the messages of a topic.

    Args:
        node: Who asks.
        topic: Its name, relative to that of the node.
        blocking: Whether to wait until somebody has the topic.
        include_hidden_topics: Whether it may be one.

    Raises:
        RuntimeError: the name is none, there are several types, or the type has no package here.
    """
    try:
        name = expand_topic_name(topic, node.get_name(), node.get_namespace())
        validate_full_topic_name(name)
    except (ValueError, InvalidTopicNameException) as error:
        raise RuntimeError(str(error)) from error
    is_said = False
    while True:
        found = get_topic_names_and_types(node=node, include_hidden_topics=include_hidden_topics)
        types = dict(found).get(name)
        if types is not None:
            return _class_of(f"topic '{topic}'", types, get_message)
        if not is_said:
            is_said = True
            print(f'WARNING: topic [{topic}] does not appear to be published yet')
        if not blocking or not rclpy.ok():
            return None
        time.sleep(0.1)  # as for wait_for_node


def get_service_names_and_types(
    *, node: Any, include_hidden_services: bool = False
) -> NamesAndTypes:
    """Return all services that a node sees."""
    return _shown(node.get_service_names_and_types(), hidden=include_hidden_services)


def get_service_names(*, node: Any, include_hidden_services: bool = False) -> list[str]:
    """Return their names."""
    found = get_service_names_and_types(node=node, include_hidden_services=include_hidden_services)
    return [name for name, _ in found]


def get_service_class(node: Any, service_name: str, include_hidden_services: bool = False) -> Any:
    """Return the class of a service. Raises RuntimeError, as :func:`get_msg_class`."""
    found = get_service_names_and_types(node=node, include_hidden_services=include_hidden_services)
    types = dict(found).get(service_name)
    if types is None:
        raise RuntimeError(f"Cannot find type for '{service_name}'")
    return _class_of(f"service '{service_name}'", types, get_service)


def _shown(found: NamesAndTypes, *, hidden: bool) -> NamesAndTypes:
    return [each for each in found if hidden or not topic_or_service_is_hidden(each[0])]


def _class_of(what: str, types: list[str], find: Any) -> Any:
    if len(types) > 1:
        raise RuntimeError(f'{what} has more than one type: {", ".join(types)}')
    try:
        return find(types[0])
    except (AttributeError, ModuleNotFoundError, ValueError) as error:
        raise RuntimeError(f"the type '{types[0]}' of {what} is not known here") from error


def get_value(*, parameter_value: Any) -> Any:
    """Return the value of a message as one of Python."""
    return parameter_value_to_python(parameter_value)


def call_get_parameters(*, node: Any, node_name: str, parameter_names: list[str]) -> Any:
    """Return the answer of a node that is asked for values. Raises RuntimeError: there is none."""
    return _answer(node, node_name, 'get_parameters', parameter_names)


def call_set_parameters(*, node: Any, node_name: str, parameters: list[Any]) -> Any:
    """Return the answer of a node that is given values. Raises RuntimeError: there is none."""
    return _answer(node, node_name, 'set_parameters', parameters)


def call_describe_parameters(
    *, node: Any, node_name: str, parameter_names: list[str] | None = None
) -> Any:
    """Return what a node says of parameters. Raises RuntimeError: it does not answer."""
    return _answer(node, node_name, 'describe_parameters', parameter_names)


def call_list_parameters(*, node: Any, node_name: str, prefixes: list[str] | None = None) -> Any:
    """Return the future, which is done, of a list of parameters; None: there is no such node."""
    client = AsyncParameterClient(_plain(node), node_name)
    if not client.wait_for_services(timeout_sec=_SERVICES):
        return None
    future = client.list_parameters(prefixes=prefixes)
    rclpy.spin_until_future_complete(_plain(node), future)
    return future


def load_parameter_file(
    *, node: Any, node_name: str, parameter_file: str, use_wildcard: bool
) -> None:
    """Give a node the values of a file, and print what it says to each."""
    answer = _answer(node, node_name, 'load_parameter_file', parameter_file, use_wildcard)
    for result in answer.results:
        text = 'Set parameter successful' if result.successful else 'Set parameter failed'
        stream = sys.stdout if result.successful else sys.stderr
        print(f'{text}: {result.reason}' if result.reason else text, file=stream)


def get_parameter_type_string(parameter_type: int) -> str:
    """Return the name of a type, ``double array``."""
    names = {getattr(ParameterType, f'PARAMETER_{each}'): each for each in _TYPES}
    return names[parameter_type].lower().replace('_', ' ').replace('bool', 'boolean')


_TYPES = (
    'NOT_SET', 'BOOL', 'INTEGER', 'DOUBLE', 'STRING', 'BYTE_ARRAY', 'BOOL_ARRAY', 'INTEGER_ARRAY',
    'DOUBLE_ARRAY', 'STRING_ARRAY',
)  # fmt: skip


def _plain(node: Any) -> Any:
    return node.node if isinstance(node, DirectNode) else node


def _answer(node: Any, node_name: str, method: str, *arguments: Any) -> Any:
    client = AsyncParameterClient(_plain(node), node_name)
    if not client.wait_for_services(timeout_sec=_SERVICES):
        raise RuntimeError(f'the parameter services of node {node_name} did not come in time')
    future = getattr(client, method)(*arguments)
    rclpy.spin_until_future_complete(_plain(node), future)
    answer = future.result()
    if answer is None:
        raise RuntimeError(f'node {node_name} did not answer: {future.exception()}')
    return answer


class PackageNotFound(Exception):  # noqa: N818 - as in ros2pkg
    """A package is not installed."""


def get_package_names() -> list[str]:
    """Return all packages that are installed."""
    return list(get_packages_with_prefixes())


def get_prefix_path(package_name: str) -> str | None:
    """Return where a package is installed; None: nowhere."""
    try:
        found: str = get_package_prefix(package_name)
    except PackageNotFoundError:
        return None
    return found


def get_executable_paths(*, package_name: str) -> list[str]:
    """Return the executables of a package. Raises PackageNotFound."""
    prefix = get_prefix_path(package_name)
    if prefix is None:
        raise PackageNotFound(package_name)
    files = Path(prefix, 'lib', package_name).rglob('*')
    return sorted(str(each) for each in files if each.is_file() and os.access(each, os.X_OK))
