# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""For a program that asks other nodes and then ends: wait for something, and call services."""

from collections.abc import Callable
import re
import time
from typing import Any, TYPE_CHECKING, TypeVar

import rclpy
from rclpy.client import Client
from rclpy.node import Node
from rclpy.validate_node_name import validate_node_name

from amr_description.errors import NoAnswerError
from amr_description.ros.message_types import type_name
from amr_description.ros.qos import SERVICE_CLIENT
from amr_description.ros.runtime import argument_errors
from amr_description.ros.wait_clock import WaitClock

if TYPE_CHECKING:
    from rclpy.action import ActionClient

Result = TypeVar('Result')

_POLL = 0.05
"""s: how soon a change of the graph is seen; messages and responses are seen at once."""

_EARLY, _EARLY_POLL = 1.0, 0.01
"""s of a wait in which a change is nearly always on its way, and how soon it is seen then."""

_SHARE = 0.02
"""Of a core, that looking may take meanwhile: in a large graph a look takes a millisecond, and of
ten robots twenty programs look at once, on the processors that what they wait for has to start on.
"""

_MESSAGE_POLL = 0.1
"""s between two looks at the graph where a message is what is waited for, which ends the wait."""

_GRAPH_POLL = 0.01
"""s between two looks at the graph alone."""

_MATCHED_BY = 2.0
"""s after which a client and a service of the graph have found each other."""

_LAST_ANSWER = 0.2
"""s for which the answer of a server that is gone may still wait behind other messages."""


class _Readiness:
    """
    Tells whether the server of a client is there, so that a request would be answered.

    rmw_fastrtps 8.4 counts the servers that a client has found by changes of one. Where one server
    comes while another of the same name goes, as when a node is started anew, the two changes are
    reported together, as none: ``client.service_is_ready()`` is false from then on, though each
    request would be answered. So a service that has been in the graph for 2 s is taken as ready,
    counted from the first look that has found it: who asks seldom looks in between.
    """

    def __init__(self, is_matched: Callable[[], bool], is_offered: Callable[[], bool]) -> None:
        """``is_matched``: as rmw says; ``is_offered``: by the graph."""
        self._is_matched, self._is_offered = is_matched, is_offered
        self._present_since: float | None = None

    def __call__(self) -> bool:
        """Return whether it is there now."""
        if self._is_matched():
            return True
        if not self._is_offered():
            self._present_since = None
            return False
        now = time.monotonic()
        if self._present_since is None:
            self._present_since = now
        return now - self._present_since >= _MATCHED_BY


class ServiceReadiness(_Readiness):
    """Of a service."""

    def __init__(self, node: Node, client: Client) -> None:
        """``client``: of ``node``."""
        super().__init__(
            client.service_is_ready, lambda: _is_offered(node, client.srv_name, client.srv_type)
        )


class ActionReadiness(_Readiness):
    """Of an action: its client is ready when those of its three services are."""

    def __init__(self, node: Node, client: 'ActionClient', action_type: Any, action: str) -> None:
        """``client``: of ``node``, of the type and the name."""
        service = node.resolve_service_name(f'{action}/_action/send_goal')
        send_goal = action_type.Impl.SendGoalService
        super().__init__(client.server_is_ready, lambda: _is_offered(node, service, send_goal))


def _is_offered(node: Node, service: str, service_type: Any) -> bool:
    """Whether somebody has the service, and not of another type: that one will not answer."""
    if not node.count_services(service):
        return False
    # By the topic of the responses, as DDS names it: that of requests has the clients' type.
    package, kind, name = type_name(service_type).split('/')
    wanted = f'{package}::{kind}::dds_::{name}_Response_'
    servers = node.get_publishers_info_by_topic(f'rr{service}Reply', no_mangle=True)
    return not servers or any(each.topic_type == wanted for each in servers)


def client_node(name: str) -> Node:
    """Make the node of such a program. Raises ParameterError: ``name`` is none."""
    # Made before anything is logged: an executor that is interrupted half-made complains.
    rclpy.get_global_executor()
    with argument_errors():
        validate_node_name(name)  # Node() does so too, but leaves a warning behind
        return Node(name)


def name_of_type(interface_type: type) -> str:
    """Return the usual name of a service or action of a type: ``GetState`` → ``get_state``."""
    return re.sub('(?<!^)(?=[A-Z])', '_', interface_type.__name__).lower()


def wait_until(
    node: Node,
    condition: Callable[[], Result | None],
    on_wait: Callable[[], object] = lambda: None,
    *,
    every: float = 1.0,
    timeout: float = 0.0,
    of_message: bool = False,
    clock: WaitClock | None = None,
) -> Result | None:
    """
    Spin a node, by its executor if it has one, until ``condition()`` is not ``None``.

    Args:
        node: It is spun here.
        condition: Asked after every callback, and besides as ``of_message`` says.
        on_wait: Called every ``every`` s.
        every: s.
        timeout: s, of the clock; 0: without end.
        of_message: A callback changes the condition, it is asked ten times a second besides; else
            20 times, at first up to 100 times, as nothing tells of a change of the graph.
        clock: That of the wait, for a condition that asks it; None: a new one.

    Returns:
        What ``condition()`` returned; ``None``: the time is over.
    """
    executor = node.executor or rclpy.get_global_executor()
    # For the whole wait: rclpy.spin_once() does so for each callback, which wakes the executor and
    # has it collect what it waits for twice more.
    was_added = executor.add_node(node)
    try:
        clock = clock or WaitClock()
        start = last = clock.now()
        worked = time.thread_time()
        while (result := condition()) is None:
            now = clock.now()
            if timeout and now - start >= timeout:
                return None
            if now - last >= every:
                last = now
                on_wait()
            before, worked = worked, time.thread_time()
            poll = _MESSAGE_POLL if of_message else _POLL
            if now - start < _EARLY and not of_message:
                poll = min(poll, max(_EARLY_POLL, (worked - before) / _SHARE))
            clock.wait(poll, executor.spin_once)
        return result
    finally:
        if was_added:
            executor.remove_node(node)


def ask_until_answered(
    node: Node, client: Client, request: Any, *, timeout: float = 10.0, attempts: int = 1
) -> Any:
    """
    Send a request that changes nothing, again every second until it is answered.

    Fast DDS finds the endpoints of two participants in either direction by itself, one perhaps a
    second after the other. A server that does not know the client's yet does what it is asked for
    and throws its response away. Once it has answered, other requests need to be sent only once.
    ``timeout``, ``attempts``: as of :func:`call`. Raises NoAnswerError.
    """
    pending = [client.call_async(request)]
    return _answer(
        node,
        client,
        lambda: next((future.result() for future in pending if future.done()), None),
        lambda: pending.append(client.call_async(request)),
        timeout=timeout,
        attempts=attempts,
    )


def call(
    node: Node,
    service_type: Any,
    name: str,
    request: Any,
    *,
    timeout: float = 10.0,
    attempts: int = 1,
) -> Any:
    """
    Call a service that is there, once; return the response. Raises NoAnswerError.

    ``attempts``: how often to wait ``timeout`` s for the response. Each wait that is in vain is
    logged, in the words of ros2_control. The request is not sent again: what it asks for would be
    done again, by a server that is only slow. A server that goes away ends the wait.
    """
    client = node.create_client(service_type, name, qos_profile=SERVICE_CLIENT)
    try:
        return call_with(node, client, request, timeout=timeout, attempts=attempts)
    finally:
        node.destroy_client(client)


def call_with(
    node: Node, client: Client, request: Any, *, timeout: float = 10.0, attempts: int = 1
) -> Any:
    """As :func:`call`, with a client that is there already."""
    is_ready = ServiceReadiness(node, client)
    if not wait_until(node, lambda: is_ready() or None, timeout=timeout):
        raise NoAnswerError(
            f'service {client.srv_name} is not there after {timeout:g} s; is its node running?'
        )
    future = client.call_async(request)
    return _answer(
        node,
        client,
        lambda: future.result() if future.done() else None,
        timeout=timeout,
        attempts=attempts,
        was_there=True,
    )


def wait_for_clients(node: Node, service: str, timeout: float = 0.5) -> None:
    """
    Before the end of a node whose last deed was an answer: wait until it has been taken.

    rclpy cannot tell when a response is acknowledged. A client that was made for one call is gone
    when it has it; of one that stays nothing is known, and ``timeout`` s are enough to send a
    response again that was lost. ``service`` may be a name such as ``~/set_state``.
    """
    deadline = time.monotonic() + timeout
    while node.count_clients(service) and time.monotonic() < deadline:
        time.sleep(_GRAPH_POLL)


def _answer(
    node: Node,
    client: Client,
    answered: Callable[[], Any | None],
    each_second: Callable[[], object] = lambda: None,
    *,
    timeout: float,
    attempts: int,
    was_there: bool = False,
) -> Any:
    """
    Wait for the response of a service. Raises NoAnswerError.

    ``was_there``: the server has been seen; it may be gone at the first look here.
    """
    service, gone_since, clock = client.srv_name, 0.0, WaitClock()

    def answered_or_gone() -> Any | None:
        nonlocal was_there, gone_since
        if (response := answered()) is not None:
            return response
        if client.service_is_ready() or node.count_services(service):
            was_there, gone_since = True, 0.0
        elif was_there:
            gone_since = gone_since or clock.now()
            if clock.now() - gone_since > _LAST_ANSWER:
                raise NoAnswerError(f'service {service} went away before it answered')
        return None

    for attempt in range(1, attempts + 1):
        response = wait_until(
            node, answered_or_gone, each_second, timeout=timeout, of_message=True, clock=clock
        )
        if response is not None:
            return response
        if attempts > 1:
            node.get_logger().warning(
                f'Failed getting a result from calling {service} in {timeout}. '
                f'(Attempt {attempt} of {attempts}.)'
            )
    if attempts > 1:
        raise NoAnswerError(
            f'Could not successfully call service {service} after {attempts} attempts.'
        )
    raise NoAnswerError(f'service {service} has not answered within {timeout:g} s')
