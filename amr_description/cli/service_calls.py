# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Service calls of verbs."""

from collections.abc import Mapping
import math
from typing import Any

from rclpy.client import Client
from rclpy.task import Future

from amr_description.cli.session import Session
from amr_description.ros.qos import SERVICE_CLIENT
from amr_description.ros.service_calls import ServiceReadiness

_REPEAT_PERIOD = 0.25  # s from the first request to the second, if there is no answer


def response_to(session: Session, client: Client, request: Any, timeout: float | None) -> Any:
    """Send a request once; return its response, or None if there is none within ``timeout`` s."""
    future = client.call_async(request)
    session.serve(future.done, timeout)
    if future.done():
        return future.result()
    client.remove_pending_request(future)
    return None


class _Call:
    """One service of those called together, and the requests that were sent to it."""

    def __init__(self, session: Session, client: Client, request: Any, changes: bool) -> None:
        self.client = client
        self._is_ready = ServiceReadiness(session.node, client)
        self._clock = session.clock
        self._request = request
        self._wait = math.inf if changes else _REPEAT_PERIOD  # s until the next one
        self._due = -math.inf  # of the clock, s
        self._futures: list[Future] = []

    @property
    def is_sent(self) -> bool:
        return bool(self._futures)

    @property
    def answered(self) -> Future | None:
        """What has been answered, if something has."""
        return next((each for each in self._futures if each.done()), None)

    def send(self) -> None:
        """Send the request, if the service is there and the last one is long enough ago."""
        now = self._clock.now()
        if now >= self._due and self._is_ready():
            self._futures.append(self.client.call_async(self._request))
            self._due = now + self._wait
            self._wait *= 2


def responses(
    session: Session,
    service_type: type,
    requests: Mapping[str, Any],
    timeout: float | None,
    *,
    service_timeout: float | None = None,
    changes: bool = False,
) -> dict[str, Any]:
    """
    Call several services of one type concurrently, each as soon as it is there.

    A server that has not discovered the client yet, as on a busy machine, throws its response
    away. So a request that changes nothing is sent again until it is answered, each time after
    twice as long.

    Args:
        session: of the verb.
        service_type: of all services.
        requests: by the names of the services.
        timeout: for all of them, s; None: no limit.
        service_timeout: for all services to be there, s, before ``timeout`` begins for those that
            are; None: they have ``timeout`` for that too.
        changes: whether the requests change something; they are then sent once.

    Returns:
        The responses that have arrived in time, by the same names.
    """

    def make_client(name: str) -> Client:
        return session.node.create_client(service_type, name, qos_profile=SERVICE_CLIENT)

    calls = {
        name: _Call(session, make_client(name), request, changes)
        for name, request in requests.items()
    }
    awaited = list(calls.values())

    def all_sent() -> bool:
        for call in awaited:
            if not call.is_sent:
                call.send()
        return all(call.is_sent for call in awaited)

    def all_answered() -> bool:
        missing = [call for call in awaited if call.answered is None]
        for call in missing:
            call.send()
        return not missing

    try:
        if service_timeout is not None:
            session.spin(all_sent, service_timeout)
            awaited = [call for call in awaited if call.is_sent]
        session.spin(all_answered, timeout)
        done = {name: call.answered for name, call in calls.items()}
        return {name: future.result() for name, future in done.items() if future is not None}
    finally:
        for call in calls.values():
            session.node.destroy_client(call.client)
