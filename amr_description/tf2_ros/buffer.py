# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``Buffer``: :class:`~amr_description.tf2_ros.buffer_core.BufferCore` with the interface of tf2_ros.

Any number of threads may use it. Three things differ from the original: waiting ends as soon as
the transform is known (the original polls every 20 ms); when two nodes publish a frame, a warning
names them; errors say what is missing (see :mod:`~amr_description.tf2_ros.buffer_core`).
"""

from collections.abc import Callable, Mapping
import threading
import time as clocks
from typing import TypeAlias

from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import TransformStamped
import rclpy
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from tf2_msgs.srv import FrameGraph

from amr_description.clock import NANOSECONDS, TimeJumpFilter
from amr_description.errors import TransformException
from amr_description.ros.messages import fill_stamp, nanoseconds, transform_of_message
from amr_description.tf2_ros.buffer_core import BufferCore, CACHE_TIME, InputWarning
from amr_description.tf2_ros.buffer_interface import BufferInterface, nanoseconds_of
from amr_description.tf2_ros.frame_graph import FrameRecord, frames_as_string, frames_as_yaml
from amr_description.tf2_ros.time_cache import StampedTransform

_SLICE = 0.5  # s: how soon a wait notices that ROS was shut down
_QUIET = 5.0  # s between two warnings with one key

_Lookup: TypeAlias = Callable[[BufferCore], TransformStamped]


class Buffer(BufferInterface):
    """
    The transforms between frames over the last seconds.

    A transform that is looked up is the pose of the source frame in the target frame; ``Time()``
    asks for the latest. The lookups raise a subclass of
    :class:`~amr_description.errors.TransformException`.

    Args:
        cache_time: how long transforms are kept; None: 10 s.
        node: provides the service ``tf2_frames`` (the frames as YAML), the logger, and the clock
            whose jumps back clear the buffer.
        clock: only the clock, where no ``node`` is given.
    """

    def __init__(
        self,
        cache_time: Duration | None = None,
        node: Node | None = None,
        *,
        clock: Clock | None = None,
    ) -> None:
        super().__init__()
        self._core = BufferCore(CACHE_TIME if cache_time is None else cache_time.nanoseconds)
        self._changed = threading.Condition()  # its lock guards all that is below
        self._awaited: list[tuple[_Lookup, Future]] = []
        self._warned: dict[tuple[str, str], float] = {}
        self._logger = node.get_logger() if node else get_logger('tf2_buffer')
        self.publishers: Callable[[], Mapping[str, list[str]]] = dict
        """Topic -> the nodes that publish it; set by a listener."""
        if node is not None:
            self.srv = node.create_service(FrameGraph, 'tf2_frames', self._on_tf2_frames)
            clock = node.get_clock()
        self._clock = clock
        self._time_jumps = TimeJumpFilter()
        self._jumps = clock and clock.create_jump_callback(
            JumpThreshold(
                min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True
            ),
            post_callback=self._on_jump,
        )

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Add a moving transform; one that cannot be used is ignored with a warning."""
        self.insert(stamped_transform(transform), authority, static=False)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Add a transform that is valid at all times."""
        self.insert(stamped_transform(transform), authority, static=True)

    def insert(self, stamped: StampedTransform, authority: str, *, static: bool) -> None:
        """Add a transform as :meth:`set_transform` and :meth:`set_transform_static` do."""
        if not static and self._is_stale(stamped.time):
            return
        with self._changed:
            warning = self._core.set_transform(stamped, authority, static=static)
            self._changed.notify_all()
            due = warning if warning is not None and self._is_due(warning) else None
        if due is not None:
            self._warn(due)
        if self._awaited:
            self._complete_futures()

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = Duration(),  # noqa: B008 - never changed
    ) -> TransformStamped:
        """
        Return the pose of ``source_frame`` in ``target_frame``.

        Args:
            target_frame: the frame to which coordinates are transformed.
            source_frame: the frame in which they are given.
            time: of the transform; ``Time()``: the latest one.
            timeout: how long to wait for it.

        Raises:
            TransformException: it is not known by then; one of its subclasses says why.
        """
        return self._wait(_simple(target_frame, source_frame, time), timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> TransformStamped:
        """
        Return the pose of ``source_frame`` at one time in ``target_frame`` at another.

        Args:
            target_frame: the frame to which coordinates are transformed.
            target_time: the time of ``target_frame``.
            source_frame: the frame in which they are given.
            source_time: the time of ``source_frame``.
            fixed_frame: a frame that does not move in between, such as ``odom``.
            timeout: how long to wait.

        Raises:
            TransformException: it is not known by then; one of its subclasses says why.
        """
        times = (target_time, source_time)
        return self._wait(_full(target_frame, source_frame, fixed_frame, *times), timeout)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = Duration(),  # noqa: B008
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Return whether it can be looked up within ``timeout``; in a tuple also why not."""
        self._wait_until(_simple(target_frame, source_frame, time), timeout)
        can, reason = self.can_transform_core(target_frame, source_frame, time)
        return (can, reason) if return_debug_tuple else can

    # As tf2_py.BufferCore calls them, which never waits.
    lookup_transform_core = lookup_transform
    lookup_transform_full_core = lookup_transform_full

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008
        return_debug_tuple: bool = False,
    ) -> bool | tuple[bool, str]:
        """Return whether :meth:`lookup_transform_full` can succeed within ``timeout``."""
        times = (target_time, source_time)
        self._wait_until(_full(target_frame, source_frame, fixed_frame, *times), timeout)
        can, reason = self.can_transform_full_core(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )
        return (can, reason) if return_debug_tuple else can

    def wait_for_transform_async(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage
    ) -> Future:
        """Return a future that becomes the transform as soon as it can be looked up."""
        return self._future(_simple(target_frame, source_frame, time))

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
    ) -> Future:
        """Return a future that becomes the transform between two times once it is known."""
        times = (target_time, source_time)
        return self._future(_full(target_frame, source_frame, fixed_frame, *times))

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
    ) -> TransformStamped:
        """Await a transform between two times in an ``async def`` callback."""
        return await self.wait_for_transform_full_async(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage
    ) -> tuple[bool, str]:
        """Return whether it can be looked up now, and why not."""
        with self._changed:
            reason = self._core.explain_failure(target_frame, source_frame, nanoseconds_of(time))
        return not reason, reason

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
    ) -> tuple[bool, str]:
        """Return whether it can be looked up between two times now, and why not."""
        try:
            self.lookup_transform_full(
                target_frame, target_time, source_frame, source_time, fixed_frame
            )
        except TransformException as error:
            return False, str(error)
        return True, ''

    def _future(self, lookup: _Lookup) -> Future:
        future = Future()
        with self._changed:
            self._awaited.append((lookup, future))
        self._complete_futures()
        return future

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage
    ) -> TransformStamped:
        """Await a transform in an ``async def`` callback."""
        return await self.wait_for_transform_async(target_frame, source_frame, time)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the latest time at which all transforms between two frames are known."""
        with self._changed:
            return Time(nanoseconds=self._core.latest_common_time(target_frame, source_frame))

    def chain(self, target_frame: str, source_frame: str) -> list[str]:
        """Return the frames between the target and the source, both included."""
        with self._changed:
            return self._core.chain(target_frame, source_frame)

    def records(self) -> list[FrameRecord]:
        """Return how each frame that has a parent is published."""
        with self._changed:
            return self._core.records()

    def all_frames_as_yaml(self) -> str:
        """Return all frames as a YAML mapping."""
        return frames_as_yaml(self.records())

    def all_frames_as_string(self) -> str:
        """Return all frames, a line each."""
        return frames_as_string(self.records())

    def clear(self) -> None:
        """Drop all moving transforms; static ones stay."""
        with self._changed:
            self._core.clear()

    def _is_stale(self, stamp: int) -> bool:
        """
        Return whether a transform of that stamp, ns, was sent before time jumped back.

        It would become the latest of its frame, so that all that follow were too old.
        """
        if self._clock is None or not self._time_jumps.is_recent:
            return False
        self._time_jumps.observe(self._clock.now().nanoseconds)
        return self._time_jumps.is_stale(stamp)

    def _wait(self, lookup: _Lookup, timeout: Duration) -> TransformStamped:
        self._wait_until(lookup, timeout)
        with self._changed:
            return lookup(self._core)

    def _wait_until(self, lookup: _Lookup, timeout: Duration) -> None:
        """Wait until a lookup succeeds, but no longer than ``timeout``."""
        deadline = clocks.monotonic() + timeout.nanoseconds / NANOSECONDS
        with self._changed:
            while (rest := deadline - clocks.monotonic()) > 0.0 and rclpy.ok():
                try:
                    lookup(self._core)
                    return
                except TransformException:
                    self._changed.wait(min(rest, _SLICE))

    def _complete_futures(self) -> None:
        """Complete the futures that can be, outside of the lock: their callbacks may look up."""
        found: list[tuple[Future, TransformStamped]] = []
        with self._changed:
            waiting = []
            for lookup, future in self._awaited:
                if future.cancelled():
                    continue
                try:
                    found.append((future, lookup(self._core)))
                except TransformException:
                    waiting.append((lookup, future))
            self._awaited = waiting
        for future, transform in found:
            future.set_result(transform)

    def _is_due(self, warning: InputWarning) -> bool:
        now = clocks.monotonic()
        if now - self._warned.get(warning.key, -_QUIET) < _QUIET:
            return False
        self._warned[warning.key] = now
        return True

    def _warn(self, warning: InputWarning) -> None:
        nodes = '; '.join(
            f'{topic} is published by {", ".join(names)}'
            for topic, names in self.publishers().items()
            if names
        )
        self._logger.warning(f'{warning.text}. {nodes[:1].upper()}{nodes[1:]}'.rstrip(' .'))

    def _on_jump(self, jump: TimeJump) -> None:
        if self.records():
            what = 'jump back in time' if jump.delta.nanoseconds < 0 else 'time source change'
            self._logger.warning(f'Detected {what}. Clearing tf buffer.')
        self.clear()
        now, step = self._clock.now().nanoseconds, jump.delta.nanoseconds
        self._time_jumps.observe(now - step)
        self._time_jumps.observe(now)

    def _on_tf2_frames(
        self, _request: FrameGraph.Request, response: FrameGraph.Response
    ) -> FrameGraph.Response:
        response.frame_yaml = self.all_frames_as_yaml()
        return response


def stamped_transform(message: TransformStamped) -> StampedTransform:
    """Return what a message says; its ``frame_id`` is the parent."""
    return StampedTransform(
        message.header.frame_id,
        message.child_frame_id,
        nanoseconds(message.header.stamp),
        transform_of_message(message.transform),
    )


def transform_message(stamped: StampedTransform) -> TransformStamped:
    """Return the message of a transform."""
    message = TransformStamped()
    fill_stamp(stamped.time, message.header.stamp)
    message.header.frame_id = stamped.parent
    message.child_frame_id = stamped.child
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = stamped.transform.translation
    rotation.x, rotation.y, rotation.z, rotation.w = stamped.transform.rotation
    return message


def _simple(target: str, source: str, time: Time | TimeMessage) -> _Lookup:
    when = nanoseconds_of(time)
    return lambda core: transform_message(core.lookup_transform(target, source, when))


def _full(
    target: str,
    source: str,
    fixed: str,
    target_time: Time | TimeMessage,
    source_time: Time | TimeMessage,
) -> _Lookup:
    at_target, at_source = nanoseconds_of(target_time), nanoseconds_of(source_time)
    return lambda core: transform_message(
        core.lookup_transform_full(target, at_target, source, at_source, fixed)
    )
