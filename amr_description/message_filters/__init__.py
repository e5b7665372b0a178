# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``message_filters`` in Python, for nodes that run where the original is not installed.

In the environment of ``scripts/setup`` such a node imports it under its name::

    from message_filters import ApproximateTimeSynchronizer, Subscriber

    scan = Subscriber(self, LaserScan, 'scan')
    odometry = Subscriber(self, Odometry, 'odom')
    self.pairs = ApproximateTimeSynchronizer([scan, odometry], queue_size=10, slop=0.05)
    self.pairs.registerCallback(self.on_pair)

Names, arguments and results are those of message_filters of Jazzy. Other than there, a callback
that raises, or that feeds its own synchronizer, does not leave it locked for ever.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import reduce
from itertools import product
import threading
from typing import Any

from rclpy.clock import ROSClock
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.time import Time

from amr_description.errors import MessageFilterError

__all__ = [
    'ApproximateTimeSynchronizer',
    'Cache',
    'SimpleFilter',
    'Subscriber',
    'TimeSynchronizer',
]

Queue = dict[int, Any]
"""Messages by stamp, ns."""


class SimpleFilter:
    """What every filter is to those behind it: callbacks that get its output."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., object], tuple[object, ...]]] = {}

    def registerCallback(self, cb: Callable[..., object], *args: object) -> int:
        """
        Have ``cb`` called with each output, followed by ``args``.

        Returns:
            The number of the connection.
        """
        connection = len(self.callbacks)
        self.callbacks[connection] = (cb, args)
        return connection

    def signalMessage(self, *msg: object) -> None:
        """Hand an output, one message or several, to all callbacks."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """The begin of a chain: the messages of a topic. It has all that its subscription has."""

    sub: Subscription

    def __init__(self, node: Node, *args: Any, **kwargs: Any) -> None:
        """
        Subscribe.

        Args:
            node: whose subscription it is.
            args: message type and topic, as for ``Node.create_subscription`` without callback.
            kwargs: the rest of them; ``qos_profile`` is 10, if not given.
        """
        super().__init__()
        self.node = node
        self.topic: str = args[1]
        kwargs.setdefault('qos_profile', 10)
        self.sub = node.create_subscription(*args, self.callback, **kwargs)

    def callback(self, msg: object) -> None:
        """Hand a message on."""
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """Return the topic as it was asked for."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        if key == 'sub':  # subscribing has failed
            raise AttributeError(key)
        return getattr(self.sub, key)


class Cache(SimpleFilter):
    """
    The newest messages of a filter, to be asked for by time; they are handed on, too.

    Times that it takes and returns are ``rclpy.time.Time``.
    """

    def __init__(
        self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False
    ) -> None:
        """
        Begin to store.

        Args:
            f: whose messages.
            cache_size: how many at most.
            allow_headerless: whether to take a message without ``header.stamp``, with the time
                when it comes.
        """
        super().__init__()
        self.cache_size = cache_size
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Time] = []
        self.allow_headerless = allow_headerless
        self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:
        """Take the messages of ``f``."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Store a message, in the place of the one that came first if there are too many."""
        stamp = _stamp_of(msg, self.allow_headerless, 'message_filters_cache')
        if stamp is None:
            return
        self.cache_times.append(stamp)
        self.cache_msgs.append(msg)
        if len(self.cache_msgs) > self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:
        """Return the messages between two times, these included, in the order they came."""
        if from_stamp > to_stamp:
            raise MessageFilterError(f'from_stamp {from_stamp} is after to_stamp {to_stamp}')
        return [msg for time, msg in self._stored() if from_stamp <= time <= to_stamp]

    def getElemAfterTime(self, stamp: Time) -> Any:
        """Return the first message that came of those at or after a time; None: there is none."""
        return next((msg for time, msg in self._stored() if time >= stamp), None)

    def getElemBeforeTime(self, stamp: Time) -> Any:
        """Return the last message that came of those at or before a time; None: there is none."""
        before = [msg for time, msg in self._stored() if time <= stamp]
        return before[-1] if before else None

    def getLastestTime(self) -> Time | None:  # called so in the original
        """Return the time of the message that came last; None: there is none."""
        return self.cache_times[-1] if self.cache_times else None

    def getOldestTime(self) -> Time | None:
        """Return the time of the message that came first; None: there is none."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:
        """Return the first message at or after the latest time; None: there is none."""
        latest = self.getLastestTime()
        return None if latest is None else self.getElemAfterTime(latest)

    def _stored(self) -> Iterator[tuple[Time, Any]]:
        return zip(list(self.cache_times), list(self.cache_msgs), strict=False)


class TimeSynchronizer(SimpleFilter):
    """Sets of messages of several filters, one of each, that have the same stamp."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int) -> None:
        """
        Begin to synchronize.

        Args:
            fs: whose messages; the callback gets them in this order.
            queue_size: how many messages of each wait for the rest of their set.
        """
        super().__init__()
        self.queue_size = queue_size
        self.lock = threading.RLock()
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:
        """Take the messages of these filters, instead of what has come before."""
        self.queues: list[Queue] = [{} for _ in fs]
        self.input_connections = [
            f.registerCallback(self.add, queue, index)
            for index, (f, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: Queue, my_queue_index: int | None = None) -> None:
        """Take a message into its queue, and hand on the sets that are complete."""
        time = _time_of(msg, msg.header.stamp, 'message_filters')
        if time is None:
            return
        with self.lock:
            self._insert(time.nanoseconds, msg, my_queue)
            common: set[int] = reduce(set.intersection, [set(queue) for queue in self.queues])
            for stamp in sorted(common):
                self._signal([stamp] * len(self.queues))

    def _insert(self, stamp: int, msg: object, queue: Queue) -> None:
        queue[stamp] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]

    def _signal(self, stamps: Sequence[int]) -> bool:
        """Hand on the messages with these stamps, one of each queue; False: one is gone."""
        chosen = list(zip(self.queues, stamps, strict=True))
        if not all(stamp in queue for queue, stamp in chosen):
            return False
        self.signalMessage(*[queue.pop(stamp) for queue, stamp in chosen])
        return True


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Sets of messages of several filters, one of each, whose stamps are close to each other."""

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
    ) -> None:
        """
        Begin to synchronize.

        Args:
            fs: whose messages; the callback gets them in this order.
            queue_size: how many messages of each wait for the rest of their set.
            slop: s; the stamps of a set differ by less.
            allow_headerless: whether to take a message without ``header.stamp``, with the time
                when it comes.
        """
        super().__init__(fs, queue_size)
        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless

    def add(self, msg: Any, my_queue: Queue, my_queue_index: int | None = None) -> None:
        """Take a message into its queue, and hand on the set that it completes, if any."""
        time = _stamp_of(msg, self.allow_headerless, 'message_filters_approx')
        if time is None:
            return
        stamp, slop = time.nanoseconds, self.slop.nanoseconds
        with self.lock:
            self._insert(stamp, msg, my_queue)
            candidates = [
                [stamp] if index == my_queue_index else _closest_first(queue, stamp, slop)
                for index, queue in enumerate(self.queues)
            ]
            for stamps in product(*candidates):
                if max(stamps) - min(stamps) < slop and self._signal(stamps):
                    break


def _closest_first(stamps: Mapping[int, object], stamp: int, slop: int) -> list[int]:
    """Return those of ``stamps`` that are at most ``slop`` away from ``stamp``; all in ns."""
    near = [each for each in stamps if abs(each - stamp) <= slop]
    return sorted(near, key=lambda each: abs(each - stamp))


def _time_of(msg: Any, stamp: Any, logger: str) -> Time | None:
    """Return a stamp as a time; None, and a warning: it is negative, which rclpy raises at."""
    if stamp.sec >= 0:
        return Time.from_msg(stamp)
    get_logger(logger).warning(
        f'{type(msg).__name__} has the stamp {stamp.sec} s: the message is dropped'
    )
    return None


def _stamp_of(msg: Any, allow_headerless: bool, logger: str) -> Time | None:
    """Return the stamp of a message, or the time now; None, and a warning: it may have none."""
    stamp = getattr(getattr(msg, 'header', None), 'stamp', None)
    if stamp is not None:
        return stamp if hasattr(stamp, 'nanoseconds') else _time_of(msg, stamp, logger)
    if allow_headerless:
        return ROSClock().now()
    get_logger(logger).warning(
        f'{type(msg).__name__} has no header.stamp: the message is dropped; with '
        'allow_headerless=True such ones are taken with the time when they come'
    )
    return None
