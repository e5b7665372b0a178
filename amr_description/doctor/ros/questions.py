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

_AGAIN = 0.5
"""s until a question is asked again: a server may throw away its first response to a client that
it has not discovered yet."""
_PATIENCE = 2.0
"""s that a server has to answer."""
_FEWEST_LOOKS = 60
"""Looks for the answer meanwhile: a process that had no time to look may have missed it."""


class Question:
    """A call that is made until it is answered; by being looked at."""

    def __init__(self, node: Node, service_type: Any, service: str, **fields: Any) -> None:
        self._client: Client = node.create_client(service_type, service)
        self._is_ready = ServiceReadiness(node, self._client)
        self._request = service_type.Request(**fields)
        self._futures: list[Future] = []
        self._began = time.monotonic()
        self._asked = self._last = 0.0
        self._looks = 0
        self._response: Any | None = None

    @property
    def response(self) -> Any | None:
        """The response; None: none has come yet."""
        if self._response is not None:
            return self._response
        self._looks += 1
        for future in self._futures:
            if future.done() and not future.exception():
                self._response = future.result()
        now = time.monotonic()
        if now - self._last >= _AGAIN and self._is_ready():
            self._last, self._asked = now, self._asked or now
            self._futures.append(self._client.call_async(self._request))
        return self._response

    @property
    def is_silent(self) -> bool:
        """Whether there is no server, or one that has had time to answer and did not."""
        if self.response is not None or self._looks < _FEWEST_LOOKS:
            return False
        since = self._asked or self._began
        return time.monotonic() - since >= _PATIENCE


class ParameterQuestion:
    """All parameters of a node, or some of them by name."""

    def __init__(self, node: Node, of: str, names: tuple[str, ...] = ()) -> None:
        """``of``: the node's full name; ``names``: none are all."""
        self._node, self._of = node, of
        self._list = None if names else Question(node, ListParameters, f'{of}/list_parameters')
        self._names, self._values = names, self._ask(names) if names else None

    @property
    def values(self) -> dict[str, Any] | None:
        """The values by name; None: they have not come yet."""
        if self._list is not None and self._values is None:
            listed = self._list.response
            if listed is None:
                return None
            self._names = tuple(listed.result.names)
            self._values = self._ask(self._names)
        response = self._values.response if self._values is not None else None
        if response is None:
            return None
        found = map(parameter_value_to_python, response.values)
        return {name: each for name, each in zip(self._names, found, strict=False)}

    def _ask(self, names: tuple[str, ...]) -> Question:
        return Question(self._node, GetParameters, f'{self._of}/get_parameters', names=names)
