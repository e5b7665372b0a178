# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What becomes of an exception in a callback: it is logged, and the node serves on.

A message or a request comes from outside; whatever is in it, a robot must not stop for it. So in
every node that a robot stands on, wherever its callbacks run,

- the exception is logged as an error, with its place and its traceback; again from the same place
  in one line each :data:`REPEAT_PERIOD` s, with how often;
- a service is answered all the same, with the reason where its response has a field for one;
- more than :data:`MOST_A_SECOND` within a second end the process, with one line: it is broken.

=====================================  ======================================================
callbacks                              caught by
=====================================  ======================================================
of subscriptions, timers, services     :func:`guard`, which names the topic or the service
of actions, events, clients; tasks     ``runtime.spin()``
served by a thread of their own        ``subscription_thread.py``
between two cycles of a control loop   ``LoopThread.submit()``: its future raises
of controllers and hardware            ``control/``: the part is deactivated, and its chain
=====================================  ======================================================

Tools end with a traceback, as ever: nobody guards their nodes.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
import inspect
import threading
import time
import traceback
from typing import Any
from weakref import ref

from rclpy.logging import get_logger
from rclpy.node import Node

from amr_description.errors import CallbackError
from amr_description.plugin_errors import describe
from amr_description.ros.rclpy_internals import RcutilsLogger, takes_info
from amr_description.text import encodable

MOST_A_SECOND = 100
"""Exceptions: a robot's fastest sensors publish less often."""
REPEAT_PERIOD = 10.0
"""s between two lines of one place that raises again and again."""
_MOST_PLACES = 500


@dataclass
class _Place:
    """Where exceptions have come from."""

    said: float
    """s: the time of the last line."""
    count: int = 0
    """How many came since."""


class Firewall:
    """The exceptions of one process; on any thread."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """``clock``: s."""
        self._clock = clock
        self._lock = threading.Lock()
        self._latest: deque[float] = deque(maxlen=MOST_A_SECOND + 1)
        self._places: dict[tuple[str, str, int], _Place] = {}

    def caught(self, error: Exception, what: str, log: Callable[[str], object]) -> None:
        """
        Log an exception, unless its like was just logged.

        Args:
            error: It.
            what: Raised it: ``the callback of /scan``.
            log: Logs an error.

        Raises:
            CallbackError: There are too many.
        """
        if isinstance(error, CallbackError):  # of another thread, which has said so
            raise error
        with self._lock:
            now = self._clock()
            self._latest.append(now)
            text = self._text(error, what, now)
            is_storm = len(self._latest) > MOST_A_SECOND and now - self._latest[0] <= 1.0
        if text:
            log(encodable(text))
        if is_storm:
            raise CallbackError(
                f'callbacks have raised more than {MOST_A_SECOND} times within a second, '
                f'the last: {what}: {describe(error)}'
            ) from error

    def _text(self, error: Exception, what: str, now: float) -> str:
        frame = traceback.extract_tb(error.__traceback__)[-1:]
        key = (what, *((frame[0].filename, frame[0].lineno or 0) if frame else ('', 0)))
        place = self._places.get(key)
        if place is None:
            if len(self._places) >= _MOST_PLACES:
                self._places.clear()
            self._places[key] = _Place(now)
            lines = ''.join(traceback.format_exception(error))
            return f'{what} has raised {describe(error)}; the node serves on\n{lines}'
        place.count += 1
        if now - place.said < REPEAT_PERIOD:
            return ''
        count, place.said, place.count = place.count, now, 0
        return f'{what} has raised {count} times more, the last: {describe(error)}'


FIREWALL = Firewall()
"""Of this process."""


def caught(error: Exception, what: str, logger: RcutilsLogger | None = None) -> None:
    """
    Log what a callback has raised; ``logger``: of its node, None: of the process.

    Raises CallbackError: too much is raised.
    """
    FIREWALL.caught(error, what, (logger or get_logger('callbacks')).error)


def reason_of(error: Exception) -> str:
    """Return what a client is told of an exception: ``ValueError: text (file.py:6)``."""
    return describe(error)


def guard(node: Node) -> None:
    """
    Catch what callbacks of this node raise: of what it has, and of what it will get.

    Call it where the node was made, before it is in an executor.
    """
    logger = node.get_logger()
    for subscription in node.subscriptions:
        _guard_subscription(subscription, logger)
    for timer in node.timers:
        _guard_timer(timer, logger)
    for service in node.services:
        _guard_service(service, logger)
    _guard_made_by(node, 'create_subscription', _guard_subscription)
    _guard_made_by(node, 'create_timer', _guard_timer)
    _guard_made_by(node, 'create_service', _guard_service)


def refuse(response: Any, reason: str) -> Any:
    """
    Write into a response that the request has failed, and why, as far as its fields allow.

    Returns:
        The response.
    """
    result: Any = getattr(response, 'result', None)
    if hasattr(result, 'error_message'):  # of simulation_interfaces
        result.result, result.error_message = result.RESULT_OPERATION_FAILED, reason
    elif hasattr(result, 'successful'):  # of rcl_interfaces
        result.successful, result.reason = False, reason
    elif hasattr(response, 'RESULT_UNDEFINED_FAILURE'):  # of nav2_msgs
        response.result = response.RESULT_UNDEFINED_FAILURE
    for name in ('message', 'status_message', 'error_msg', 'reason'):
        if isinstance(getattr(response, name, None), str):
            setattr(response, name, reason)
    return response


def _guard_made_by(node: Node, name: str, guard_one: Callable[[Any, RcutilsLogger], None]) -> None:
    """Guard what a method of this node makes from now on; without a reference to the node."""
    of_node, logger = ref(node), node.get_logger()

    def make(*args: Any, **options: Any) -> Any:
        entity = getattr(type(of_node()), name)(of_node(), *args, **options)
        guard_one(entity, logger)
        return entity

    setattr(node, name, make)


def _guard_subscription(subscription: Any, logger: RcutilsLogger) -> None:
    callback, what = subscription.callback, f'the callback of {subscription.topic_name}'

    def called(message: Any) -> Any:
        try:
            return callback(message)
        except Exception as error:
            caught(error, what, logger)

    def called_with_info(message: Any, info: Any) -> Any:
        try:
            return callback(message, info)
        except Exception as error:
            caught(error, what, logger)

    if not inspect.iscoroutinefunction(callback):  # runtime.spin() catches what those raise
        subscription.callback = called_with_info if takes_info(subscription) else called


def _guard_timer(timer: Any, logger: RcutilsLogger) -> None:
    callback = timer.callback

    def called() -> Any:
        try:
            return callback()
        except Exception as error:
            caught(error, 'the callback of a timer', logger)

    if not inspect.iscoroutinefunction(callback):
        timer.callback = called


def _guard_service(service: Any, logger: RcutilsLogger) -> None:
    callback, what = service.callback, f'the service {service.service_name}'
    response_type = service.srv_type.Response

    def answer(error: Exception) -> Any:
        caught(error, what, logger)
        return refuse(response_type(), reason_of(error))

    async def awaited(request: Any, response: Any) -> Any:
        try:
            return await callback(request, response)
        except Exception as error:
            return answer(error)

    def called(request: Any, response: Any) -> Any:
        try:
            return callback(request, response)
        except Exception as error:
            return answer(error)

    service.callback = awaited if inspect.iscoroutinefunction(callback) else called
