# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Calls of services of others that change nothing, answered or not."""

from typing import Any

from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.task import Future


class Question:
    """One call, which is made as soon as the service is reached."""

    def __init__(self, node: Node, service_type: Any, service: str, **fields: Any) -> None:
        self._client: Client = node.create_client(service_type, service)
        self._request = service_type.Request(**fields)
        self._future: Future | None = None

    @property
    def response(self) -> Any | None:
        """The response; None: none has come yet."""
        if self._future is None and self._client.service_is_ready():
            self._future = self._client.call_async(self._request)
        if self._future is None or not self._future.done() or self._future.exception():
            return None
        return self._future.result()


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
