# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Serve nodes of this process in a thread of their own, as another process would."""

from contextlib import contextmanager, suppress
import threading

from rclpy.exceptions import InvalidHandle

from amr_description.ros.runtime import end_wait, spin


def serve(executor, is_over):
    """
    Serve an executor's callbacks until ``is_over()``; a thread's.

    A test ends nodes and timers meanwhile, on its own thread: rclpy raises where it has waited for
    one of them, and looks at it afterwards.
    """
    while executor.context.ok() and not is_over():
        with suppress(InvalidHandle):
            spin(executor, is_over)


@contextmanager
def serving(executor):
    """
    Serve an executor's callbacks while inside; it is shut down at the end.

    Not by ``Executor.spin()``, which a ``shutdown()`` may leave waiting for ever (rclpy 7.1.6):
    if that destroys the guard condition after the loop has asked whether to go on, and before it
    waits for it, nothing wakes it any more.
    """
    is_over = threading.Event()
    thread = threading.Thread(target=serve, args=(executor, is_over.is_set))
    thread.start()
    try:
        yield
    finally:
        is_over.set()
        end_wait(executor)
        thread.join()
        executor.shutdown()
