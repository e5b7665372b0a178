# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Have the ROS thread do something, and wait for it on the server's thread."""

import asyncio
from collections.abc import Callable
from typing import TypeVar

from rclpy.executors import Executor

from amr_description.errors import ViewerError
from amr_description.text import shorten

T = TypeVar('T')

_TIMEOUT = 5.0
"""s"""


async def on_ros_thread(executor: Executor, call: Callable[[], T]) -> T:
    """Return what ``call`` returned on the ROS thread. Raises ViewerError: it failed."""
    loop = asyncio.get_running_loop()
    done: asyncio.Future[T] = loop.create_future()

    def settle(result: T | None, error: Exception | None) -> None:
        if done.done():
            return
        if error is None:
            done.set_result(result)  # type: ignore[arg-type]
        else:
            done.set_exception(error)

    def run() -> None:
        result, failed = None, None
        try:
            result = call()
        except Exception as error:  # rclpy's, such as of a type that the topic does not have
            failed = ViewerError(shorten(f'{type(error).__name__}: {error}'))
        loop.call_soon_threadsafe(settle, result, failed)

    executor.create_task(run)
    try:
        return await asyncio.wait_for(done, _TIMEOUT)
    except TimeoutError:
        raise ViewerError(f'ROS has not answered within {_TIMEOUT:g} s') from None
