# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Work for a coroutine of the ROS thread that may take long: a thread of its own does it."""

from collections.abc import Callable
import threading

from rclpy.executors import Executor
from rclpy.task import Future


def run_in_thread(call: Callable[[], None], executor: Executor, name: str) -> Future:
    """
    Make a call in a new thread called ``name``; await its end, however it ends, in an async
    callback.

    The thread is a daemon: a call that never returns does not keep the process from ending.
    """
    future = Future(executor=executor)

    def run() -> None:
        try:
            call()
        finally:
            future.set_result(None)
            executor.wake()  # a task that awaits is looked at only when the executor wakes

    threading.Thread(target=run, name=name, daemon=True).start()
    return future
