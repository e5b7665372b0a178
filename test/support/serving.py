# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Serve nodes of this process in a thread of their own, as another process would."""

from contextlib import contextmanager
import threading

from amr_description.ros.runtime import end_wait, spin


@contextmanager
def serving(executor):
    """
    Serve an executor's callbacks while inside; it is shut down at the end.

    Not by ``Executor.spin()``, which a ``shutdown()`` may leave waiting for ever (rclpy 7.1.6):
    if that destroys the guard condition after the loop has asked whether to go on, and before it
    waits for it, nothing wakes it any more.
    """
    is_over = threading.Event()
    thread = threading.Thread(target=spin, args=(executor, is_over.is_set))
    thread.start()
    try:
        yield
    finally:
        is_over.set()
        end_wait(executor)
        thread.join()
        executor.shutdown()
