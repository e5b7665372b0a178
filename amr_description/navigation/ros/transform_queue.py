# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages that wait until a transform at their stamp is known, as in ``tf2_ros::MessageFilter``; and
the latest transform in place of one that is not known.

What a robot measures at an instant is often there before the odometry of that instant. It is not
taken with an older transform, which would be wrong while the robot drives, nor lost.
"""

from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import Generic, TypeVar

from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.task import Future
from rclpy.time import Time

from amr_description.errors import TransformException
from amr_description.model.frames import Transform
from amr_description.ros.messages import transform_of_message
from amr_description.tf2_ros.buffer import Buffer

Item = TypeVar('Item')


def transform_at(
    buffer: Buffer, target: str, source: str, time: int, timeout: int
) -> Transform | None:
    """Return a transform at a time (ns) that is one, else the latest; None: there is none."""
    wait = Duration(nanoseconds=timeout)
    for each in (time, 0) if time > 0 else (0,):
        with suppress(TransformException):
            found = buffer.lookup_transform(target, source, Time(nanoseconds=each), wait)
            return transform_of_message(found.transform)
    return None


class TransformQueue(Generic[Item]):
    """
    A queue in front of a callback, which gets each item with its transform, in their order.

    An item that still waits when a later one has its transform is dropped.
    """

    def __init__(
        self, buffer: Buffer, handle: Callable[[Item, TransformStamped], object], depth: int
    ) -> None:
        """
        Begin empty.

        Args:
            buffer: Of the transforms.
            handle: Called with each item and its transform; in the thread that has received the
                transform, or in that of :meth:`add` if it was there.
            depth: If more items wait, the oldest is dropped.
        """
        self._buffer = buffer
        self._handle = handle
        self._depth = depth
        self._waiting: deque[Future] = deque()

    def add(self, item: Item, target_frame: str, source_frame: str, stamp: int) -> None:
        """
        Have an item handled with the pose of ``source_frame`` in ``target_frame`` at its stamp.

        Args:
            item: What to handle.
            target_frame: To which coordinates are transformed.
            source_frame: In which they are given.
            stamp: ns.
        """
        future = self._buffer.wait_for_transform_async(
            target_frame, source_frame, Time(nanoseconds=stamp)
        )
        self._waiting.append(future)
        while len(self._waiting) > self._depth:
            self._waiting.popleft().cancel()
        future.add_done_callback(lambda done: self._on_done(done, item))

    def clear(self) -> None:
        """Drop what waits, as time has gone back."""
        while self._waiting:
            self._waiting.popleft().cancel()

    def _on_done(self, future: Future, item: Item) -> None:
        if not future.cancelled():
            # What came before it would be out of order; its transform is of before all that is
            # known, and each new transform would be tried in vain for it.
            while (earlier := self._waiting.popleft()) is not future:
                earlier.cancel()
            self._handle(item, future.result())
