# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Services of ``simulation_interfaces`` from handlers that raise.

When a handler returns, the ``result`` of its response is ``RESULT_OK``. When it raises, the result
has the message and the code of a RequestError, or ``RESULT_OPERATION_FAILED``.
"""

from collections.abc import Awaitable, Callable, Iterable
from typing import Any, TypeAlias

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from simulation_interfaces.msg import Result

from amr_description.errors import AmrError, RequestError
from amr_description.log import Log
from amr_description.plugin_errors import describe, log_error
from amr_description.text import unwrap

Handler: TypeAlias = Callable[[Any, Any], Awaitable[None]]
"""``async (request, response)``, for services whose response has a ``result``."""


def create_services(node: Node, log: Log, handlers: Iterable[tuple[type, Handler]]) -> None:
    """
    Create a service ``~/do_this`` for every handler ``_do_this``.

    Args:
        node: Gets the services, in one reentrant callback group.
        log: Gets unexpected errors, in addition to the client.
        handlers: Service type and handler of each.
    """
    group = ReentrantCallbackGroup()
    for service_type, handler in handlers:
        name = handler.__name__.removeprefix('_')
        node.create_service(
            service_type, f'~/{name}', _reporting_errors(handler, log), callback_group=group
        )


def fill_error(result: Result, error: Exception) -> None:
    """Write the code and the message of an error, in one line, into a result."""
    result.result = Result.RESULT_OPERATION_FAILED
    if isinstance(error, RequestError):
        result.result = error.code
    result.error_message = unwrap(describe(error))


def _reporting_errors(handler: Handler, log: Log) -> Callable[[Any, Any], Awaitable[Any]]:
    async def answer(request: Any, response: Any) -> Any:
        try:
            await handler(request, response)
            response.result.result = Result.RESULT_OK
        except Exception as error:  # a plugin may raise anything
            fill_error(response.result, error)
            if not isinstance(error, AmrError):
                log_error(log, error)
        return response

    return answer
