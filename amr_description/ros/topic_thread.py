# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A topic that is taken in a thread of its own, which may leave the messages waiting for a while.

A callback costs an executor a wake-up for each message. Who needs one message of five lets DDS
keep them meanwhile, and takes all of them, in their order, when the one that matters has come.
"""

from collections.abc import Callable
import threading
from typing import Any

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions

from amr_description.ros.firewall import caught
from amr_description.ros.polled_topic import NeverCalled, PollingNode
from amr_description.ros.rclpy_internals import SubscriptionWaiter, take_received


class TopicThread:
    """
    A subscription, and its thread; to be ended before its node is destroyed.

    A shutdown of the context ends the thread, too: who is asked to stop while making the node has
    none that could be destroyed, and the process waits for its threads.

    What ``handle`` raises is logged; too much of it, a CallbackError, ends the thread, and is
    raised in that of the node's executor.
    """

    def __init__(
        self,
        node: PollingNode,
        message_type: Any,
        topic: str,
        handle: Callable[[bytes, int], float],
        *,
        qos: QoSProfile,
        qos_overriding_options: QoSOverridingOptions | None = None,
    ) -> None:
        """
        Subscribe.

        Args:
            node: Has the subscription, and leaves it to the thread.
            message_type: The class of the messages.
            topic: Its name.
            handle: Called in the thread for each message, with its bytes and the system time when
                DDS received it, ns; returns for how long no other is wanted, s.
            qos: Deep enough for what comes while none is wanted.
            qos_overriding_options: As of ``Node.create_subscription()``.
        """
        self._context, self._logger = node.context, node.get_logger()
        self._handle = handle
        self._subscription = node.create_subscription(
            message_type,
            topic,
            _ignore,
            qos,
            callback_group=NeverCalled(),
            raw=True,
            qos_overriding_options=qos_overriding_options,
        )
        self._waiter = SubscriptionWaiter([self._subscription], node.context)
        self._error: BaseException | None = None
        self._failure = node.create_timer(
            0.0, self._raise, clock=Clock(clock_type=ClockType.STEADY_TIME), autostart=False
        )
        self._is_ending = False
        self._awake = threading.Event()
        self._thread = threading.Thread(target=self._run, name=topic)

    @property
    def publisher_count(self) -> int:
        """The publishers that are connected now."""
        return self._subscription.get_publisher_count()

    def start(self) -> None:
        """Begin to take messages."""
        self._context.on_shutdown(self._leave)
        self._thread.start()

    def wake(self) -> None:
        """End a rest, as what it was decided by has changed; from any thread."""
        self._awake.set()

    def end(self) -> None:
        """Take no more messages, and wait for the one that is handled."""
        self._leave()
        self._thread.join()
        self._waiter.destroy()

    def _leave(self) -> None:
        if not self._is_ending:
            self._is_ending = True
            self._awake.set()
            self._waiter.wake()

    def _run(self) -> None:
        try:
            while not self._is_ending:
                received = take_received(self._subscription)
                if received is None:
                    self._waiter.wait()
                    continue
                self._awake.clear()
                rest = self._handled(*received)
                if rest > 0.0 and not self._is_ending:
                    self._awake.wait(rest)
        except BaseException as error:
            if self._context.ok():  # otherwise: it was shut down in the midst of that
                self._error = error
                self._failure.reset()

    def _handled(self, data: bytes, arrival: int) -> float:
        try:
            return self._handle(data, arrival)
        except Exception as error:
            if not self._context.ok():
                raise
            what = f'the callback of {self._subscription.topic_name}'
            caught(error, what, self._logger)
            return 0.0

    def _raise(self) -> None:
        self._failure.cancel()
        assert self._error is not None, 'the timer was started for it'
        raise self._error


def _ignore(_: Any) -> None:
    pass
