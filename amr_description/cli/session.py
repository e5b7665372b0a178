# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The hidden node of a verb, and how a verb waits."""

from collections.abc import Callable, Iterator, Sequence, Set
from contextlib import contextmanager
from dataclasses import dataclass, field
import os
import threading
import time as wall

import rclpy
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description import streams
from amr_description.ros.local_participants import local_participants
from amr_description.ros.runtime import argument_errors, end_wait, ros
from amr_description.ros.signals import StopRequested, StopRequests
from amr_description.ros.wait_clock import WaitClock

_POLL_PERIOD = 0.02  # s
_IDLE_PERIOD = 0.5  # s; callbacks, signals and timeouts end the wait at once


@dataclass(frozen=True)
class Session:
    """The node of a verb, and the executor of its callbacks, which run in the verb's thread."""

    node: Node
    executor: Executor
    stop: StopRequests
    participants: Set[tuple[int, int]] = frozenset()
    """Those of this host that were there before the node's."""
    began: float = field(default_factory=wall.monotonic)
    """When these were seen, s, by ``time.monotonic``."""
    clock: WaitClock = field(default_factory=WaitClock)

    def spin(
        self,
        until: Callable[[], bool],
        timeout: float | None = None,
        *,
        poll: float = _POLL_PERIOD,
    ) -> bool:
        """
        Run callbacks until ``until()`` is true, at most for ``timeout`` s of ``clock``.

        ``until`` is called after every callback, and every ``poll`` s.

        Returns:
            False: it has not become true in time.

        Raises:
            StopRequested: after a callback, never inside of one.
        """
        deadline = float('inf') if timeout is None else self.clock.now() + timeout
        with self.stop.deferred(self.interrupt) as is_stopping:
            while not (is_stopping() or until()):
                left = deadline - self.clock.now()
                if left <= 0.0:
                    return False
                self.clock.wait(min(left, poll), self.executor.spin_once)
        return True

    def interrupt(self) -> None:
        """End the executor's wait for callbacks; on any thread."""
        end_wait(self.executor)

    def serve(
        self, done: Callable[[], bool] = lambda: False, timeout: float | None = None
    ) -> None:
        """Run callbacks until one of them has made ``done()`` true, at most for ``timeout`` s."""
        self.spin(done, timeout, poll=_IDLE_PERIOD)

    @contextmanager
    def finishing(self) -> Iterator[Callable[[], bool]]:
        """
        Let the block finish its work after a signal; only a second signal interrupts it.

        Yields:
            A function that returns whether a signal has come. No callbacks run after the block.

        Raises:
            StopRequested: after the block, if a signal has come.
        """
        is_stopping = threading.Event()

        def request_stop() -> None:
            is_stopping.set()
            self.interrupt()

        with self.stop.on_stop(request_stop):
            yield is_stopping.is_set
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
    Yield a session; it is closed however the block ends.

    Args:
        name: of the node; by default a hidden one, ``_ros2cli_<pid>``.
        use_sim_time: the parameter of that name.
        ros_args: the arguments after ``--ros-args``.
        executor: creates the executor. EventsExecutor takes half the time, but fails with
            callbacks that take a message's info (SystemError, rclpy 7.1.6).

    Raises:
        StopRequested: (a KeyboardInterrupt) a signal has asked the verb to stop.
    """
    streams.keep_libraries_off_stdout()
    with ros(['--ros-args', *ros_args] if ros_args else []) as stop:
        began = wall.monotonic()
        participants = local_participants(rclpy.get_default_context().get_domain_id())
        with argument_errors():
            node = _make_node(name or f'_ros2cli_{os.getpid()}', use_sim_time)
        spinner = executor()
        spinner.add_node(node)
        try:
            yield Session(node, spinner, stop, participants, began)
        finally:
            stop.leave()
            spinner.shutdown()
            node.destroy_node()


def _make_node(name: str, use_sim_time: bool) -> Node:
    """Create a node with as few endpoints as possible: each costs time, in every process."""
    return Node(
        name,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[
            Parameter('use_sim_time', value=use_sim_time),
            Parameter('start_type_description_service', value=False),
        ],
    )
