# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Calls of services of others that change nothing, answered or not."""

import time
from typing import Any

from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.task import Future

from amr_description.ros.service_calls import ServiceReadiness

GET_PARAMETERS = '/get_parameters'

_AGAIN = 0.5
"""s until a query is asked again: a server may throw away its first response to a client that
it has not discovered yet."""
_PATIENCE = 2.0
"""s that a server has to answer."""
_FEWEST_LOOKS = 60
"""Looks for the answer meanwhile: a process that had no time to look may have missed it."""


class Query:
    """A call that is made until it is answered; by being looked at."""

    def __init__(self, client: Client, is_reachable: ServiceReadiness, request: Any) -> None:
        """``client``: several queries may have one; ``is_reachable``: of it."""
        self._client = client
        self._request = request
        self._futures: list[Future] = []
        self._began = time.monotonic()
        self._last = self._began - _AGAIN
        self._response: Any | None = None
        self.is_reachable = is_reachable
        """Whether its server is there: what was of a node that has ended stays a moment."""
        self.asked: float | None = None
        """When it was asked first, s of the monotonic clock; None: its server is not reached."""
        self.looks = 0
        """How often it was looked for an answer, since it was asked if it was."""

    @property
    def response(self) -> Any | None:
        """The response; None: none has come yet."""
        if self._response is not None:
            return self._response
        self.looks += 1
        for future in self._futures:
            if future.done() and not future.exception():
                self._response = future.result()
        now = time.monotonic()
        if self._response is None and now - self._last >= _AGAIN and self.is_reachable():
            self._last = now
            if self.asked is None:
                self.asked, self.looks = now, 1
            self._futures.append(self._client.call_async(self._request))
        return self._response

    @property
    def is_silent(self) -> bool:
        """Whether there is no server, or one that has had time to answer and did not."""
        if self.response is not None or self.looks < _FEWEST_LOOKS:
            return False
        since = self._began if self.asked is None else self.asked
        return time.monotonic() - since >= _PATIENCE


def query(node: Node, service_type: Any, service: str, **fields: Any) -> Query:
    """Make a query with a client of its own; ``fields``: of the request."""
    client = node.create_client(service_type, service)
    return Query(client, ServiceReadiness(node, client), service_type.Request(**fields))


class ParameterQuery(Query):
    """Some parameters of a node, by name."""

    def __init__(
        self, client: Client, is_reachable: ServiceReadiness, names: tuple[str, ...]
    ) -> None:
        """``client``: of the service ``get_parameters``."""
        super().__init__(client, is_reachable, GetParameters.Request(names=names))
        self._names = names

    @property
    def values(self) -> dict[str, object] | None:
        """Those that the node has; None: they have not come yet."""
        if (response := self.response) is None:
            return None
        found = zip(self._names, response.values, strict=False)
        values = {name: parameter_value_to_python(value) for name, value in found}
        return {name: each for name, each in values.items() if each is not None}


def parameters_of(node: Node, of: str, names: tuple[str, ...]) -> ParameterQuery:
    """Make a query for parameters, with a client of its own; ``of``: a node's full name."""
    client = node.create_client(GetParameters, f'{of}{GET_PARAMETERS}')
    return ParameterQuery(client, ServiceReadiness(node, client), names)


class AllParametersQuery:
    """All parameters of a node."""

    def __init__(self, node: Node, of: str) -> None:
        """``of``: the node's full name."""
        self._node, self._of = node, of
        self._list = query(node, ListParameters, f'{of}/list_parameters')
        self._values: ParameterQuery | None = None

    @property
    def values(self) -> dict[str, object] | None:
        """The values by name; None: they have not come yet."""
        if self._values is None and (listed := self._list.response) is not None:
            self._values = parameters_of(self._node, self._of, tuple(listed.result.names))
        return self._values.values if self._values is not None else None
