# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A hidden node while a verb runs, and the ways in which a verb waits."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
import os
import threading
import time

from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description import streams
from amr_description.ros.runtime import argument_errors, ros
from amr_description.ros.signals import StopRequested, StopRequests

_POLL = 0.02  # s
_IDLE = 0.5  # s; callbacks, signals and time-outs end the wait at once


@dataclass(frozen=True)
class Session:
    """A verb's node and the executor of its callbacks, which run in the verb's own thread."""

    node: Node
    executor: Executor
    stop: StopRequests

    def spin(
        self, until: Callable[[], bool], timeout: float | None = None, *, poll: float = _POLL
    ) -> bool:
        """
        Serve callbacks until ``until()``, at most for ``timeout`` s; tell whether it came true.

        ``until`` is asked after every callback, and every ``poll`` seconds.
        """
        deadline = float('inf') if timeout is None else time.monotonic() + timeout
        while not until():
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            self.executor.spin_once(timeout_sec=min(left, poll))
        return True

    def serve(
        self, done: Callable[[], bool] = lambda: False, timeout: float | None = None
    ) -> None:
        """Serve callbacks, one of which makes ``done()`` true, at most for ``timeout`` s."""
        self.spin(done, timeout, poll=_IDLE)

    @contextmanager
    def finishing(self) -> Iterator[Callable[[], bool]]:
        """
        Leave it to the block how it ends when a signal asks for it; only a second interrupts it.

        Yields what tells whether it is asked to. Nothing is served after the block.

        :raises StopRequested: After the block, if it was asked to end.
        """
        asked = threading.Event()

        def ask() -> None:
            asked.set()
            self.executor.wake()

        with self.stop.on_stop(ask):
            yield asked.is_set
        if self.stop.signum is not None:
            raise StopRequested(self.stop.signum)


@contextmanager
def open_session(
    *,
    name: str = '',
    use_sim_time: bool = False,
    ros_args: Sequence[str] = (),
    executor: Callable[[], Executor] = SingleThreadedExecutor,
) -> Iterator[Session]:
    """
    Yield a session; end it in every way out.

    :param name: The node's name; empty: a hidden one, ``_ros2cli_<pid>``.
    :param ros_args: What stands behind ``--ros-args``.
    :param executor: Makes the executor. EventsExecutor takes half the time, but fails at a
        callback that wants the message's info (SystemError, rclpy 7.1.6).
    :raises StopRequested: (a KeyboardInterrupt) A signal asked the verb to stop.
    """
    streams.keep_libraries_off_stdout()
    with ros(['--ros-args', *ros_args] if ros_args else []) as stop:
        with argument_errors():
            node = _make_node(name or f'_ros2cli_{os.getpid()}', use_sim_time)
        serving = executor()
        serving.add_node(node)
        try:
            yield Session(node, serving, stop)
        finally:
            stop.leave()
            serving.shutdown()
            node.destroy_node()


def _make_node(name: str, use_sim_time: bool) -> Node:
    """Make a node with as few endpoints as possible: each costs time, here and elsewhere."""
    return Node(
        name,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[
            Parameter('use_sim_time', value=use_sim_time),
            Parameter('start_type_description_service', value=False),
        ],
    )
