# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Coroutines that run in one executor, and are awaited in another one."""

from collections.abc import Coroutine
from typing import Any

from rclpy.executors import Executor
from rclpy.task import Future


def run_in(executor: Executor, work: Coroutine[Any, Any, None], waiting: Executor) -> Future:
    """
    Run a coroutine in one executor; return what a coroutine of another one can await.

    Args:
        executor: Of the node that the coroutine is about; its thread runs.
        work: The coroutine.
        waiting: The executor of the one that awaits.
    """
    done = Future(executor=waiting)

    async def run() -> None:
        try:
            await work
        except Exception as error:  # raised again where the future is awaited
            done.set_exception(error)
        finally:  # it may be closed, as its robot is removed
            if not done.done():
                done.set_result(None)
            waiting.wake()  # a task that awaits is looked at only when the executor wakes

    executor.create_task(run())
    return done


def abandon(done: Future, waiting: Executor) -> None:
    """
    End the wait for what :func:`run_in` was to run, where its executor runs no more.

    Args:
        done: What :func:`run_in` has returned; it may be done.
        waiting: The executor of the one that awaits it.
    """
    if not done.done():
        done.set_result(None)
        waiting.wake()
