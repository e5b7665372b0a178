# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Subscriptions whose callbacks a thread of their own calls, instead of the executor of their node.

An executor of rclpy looks at all that it serves whenever something comes: with the 47 services and
40 event handlers of one robot that takes 1.4 ms for each message, during most of which no other
thread of the process has the interpreter's lock. Here a message takes 0.1 ms.

Who needs one message of five lets DDS keep them meanwhile, and takes all of them, in their order,
when the one that matters has come: a callback returns for how long no other is wanted.
"""

from collections.abc import Callable, Mapping
import threading
from typing import Any, TypeAlias

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription

from amr_description.errors import CallbackError
from amr_description.ros.firewall import caught
from amr_description.ros.polled_topic import NeverCalled
from amr_description.ros.rclpy_internals import SubscriptionWaiter, take_with_info
from amr_description.streams import print_traceback

Callback: TypeAlias = Callable[[Any, Mapping[str, int]], float | None]
"""
Called with a message, or its bytes, and what rclpy tells of it: its number, its stamps.

Returns for how long no other message is wanted, s; None: it is not known, the next one is.
"""


class SubscriptionThread:
    """
    Subscriptions of a node, and the thread that serves them; to be ended before the node.

    A shutdown of the context ends the thread, too: who is asked to stop while making the node has
    none that could be destroyed, and the process waits for its threads.

    What a callback raises is logged; too much of it, a CallbackError, ends the thread.
    """

    def __init__(self, node: Node, on_failure: Callable[[], object] | None = None) -> None:
        """
        Begin without subscriptions.

        Args:
            node: Has them. It may be in an executor, which leaves them alone; EventsExecutor
                does so with those of a ``PollingNode`` only.
            on_failure: Called in the thread when callbacks raise again and again, after that was
                logged; None: then the error is raised in the thread of the node's executor.
        """
        self._node = node
        self._context = node.context
        self._on_failure = on_failure
        self._served: list[tuple[Subscription, Callback]] = []
        self._is_ending = False
        self._awake = threading.Event()
        self._waiter: SubscriptionWaiter | None = None
        self._error: BaseException | None = None
        if on_failure is None:
            steady = Clock(clock_type=ClockType.STEADY_TIME)
            self._failure = node.create_timer(0.0, self._raise, clock=steady, autostart=False)
        self._thread = threading.Thread(target=self._run, name=f'{node.get_name()} subscriptions')

    def subscribe(
        self,
        message_type: Any,
        topic: str,
        callback: Callback,
        qos: QoSProfile | int,
        *,
        raw: bool = False,
        qos_overriding_options: QoSOverridingOptions | None = None,
    ) -> Subscription:
        """
        Add a subscription, before :meth:`start`; as ``Node.create_subscription()``.

        If its callback asks for rests, ``qos`` has to be deep enough for what comes meanwhile.
        """
        subscription = self._node.create_subscription(
            message_type,
            topic,
            _ignore,
            qos,
            callback_group=NeverCalled(),
            raw=raw,
            qos_overriding_options=qos_overriding_options,
        )
        self._served.append((subscription, callback))
        return subscription

    def start(self) -> None:
        """Begin to serve."""
        subscriptions = [subscription for subscription, _ in self._served]
        self._waiter = SubscriptionWaiter(subscriptions, self._context)
        self._context.on_shutdown(self._leave)
        self._thread.start()

    def wake(self) -> None:
        """End a rest, as what it was decided by has changed; from any thread."""
        self._awake.set()

    def end(self) -> None:
        """Serve no more, wait for the callback that runs, and remove the subscriptions."""
        self._leave()
        if self._waiter is not None:
            self._thread.join()
            self._waiter.destroy()
            self._waiter = None
        for subscription, _ in self._served:
            self._node.destroy_subscription(subscription)
        self._served.clear()

    def _leave(self) -> None:
        if not self._is_ending:  # else the waiter may be gone
            self._is_ending = True
            self._awake.set()
            if self._waiter is not None:
                self._waiter.wake()

    def _run(self) -> None:
        assert self._waiter is not None, 'start() has made it'
        try:
            while not self._is_ending:
                if not self._serve_one_each():
                    self._waiter.wait()
        except BaseException as error:  # sys.exit() in a plugin, too: nobody else would see it
            if self._context.ok():  # otherwise: it was shut down in the midst of that
                self._fail(error)

    def _serve_one_each(self) -> bool:
        """Serve a message of each subscription; return whether there was one."""
        has_come = False
        for subscription, callback in self._served:
            taken = take_with_info(subscription)
            if taken is not None:
                has_come = True
                rest = self._call(subscription, callback, *taken)
                if rest and not self._is_ending:
                    self._awake.wait(rest)
                    self._awake.clear()
        return has_come

    def _call(
        self, subscription: Subscription, callback: Callback, message: Any, info: Mapping[str, int]
    ) -> float | None:
        try:
            return callback(message, info)
        except Exception as error:
            if not self._context.ok():
                raise
            what = f'the callback of {subscription.topic_name}'
            caught(error, what, self._node.get_logger())
            return None

    def _fail(self, error: BaseException) -> None:
        if self._on_failure is None:
            self._error = error
            self._failure.reset()
            return
        if isinstance(error, CallbackError):
            self._node.get_logger().fatal(str(error))
        else:
            print_traceback()
        self._on_failure()

    def _raise(self) -> None:
        self._failure.cancel()
        assert self._error is not None, 'the timer was started for it'
        raise self._error


def _ignore(_: Any) -> None:
    """Stand for the callback, which rclpy is not to call."""
