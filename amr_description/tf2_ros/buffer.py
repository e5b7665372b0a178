# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Transforms ↔ ROS messages.

``Buffer``: :class:`~amr_description.tf2_ros.buffer_core.BufferCore` behind the interface
of ``tf2_ros``, for any number of threads.

Better than the original where that hurts its users: waiting ends the moment the transform is
there (the original looks every 20 ms); a static transform sent by two, or a frame with two
parents, is told with the names of the nodes; errors say what is missing (see the model).
"""

from collections.abc import Callable, Mapping
import threading
import time as clocks

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
from amr_description.model.frames import Transform
from amr_description.tf2_ros.buffer_core import BufferCore, CACHE_TIME, Remark
from amr_description.tf2_ros.frame_graph import FrameRecord, frames_as_string, frames_as_yaml
from amr_description.tf2_ros.time_cache import StampedTransform


def stamped_transform(message: TransformStamped) -> StampedTransform:
    """Read a message; ``frame_id`` is the parent."""
    place, turn = message.transform.translation, message.transform.rotation
    return StampedTransform(
        message.header.frame_id,
        message.child_frame_id,
        nanoseconds(message.header.stamp),
        Transform((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w)),
    )


def transform_message(stamped: StampedTransform) -> TransformStamped:
    """Make a message."""
    message = TransformStamped()
    stamp = message.header.stamp
    stamp.sec, stamp.nanosec = divmod(stamped.time, NANOSECONDS)
    message.header.frame_id = stamped.parent
    message.child_frame_id = stamped.child
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = stamped.transform.translation
    turn.x, turn.y, turn.z, turn.w = stamped.transform.rotation
    return message


def nanoseconds(time: Time | TimeMessage) -> int:
    """Return a time of rclpy, or a stamp, in ns."""
    return time.nanoseconds if isinstance(time, Time) else time.sec * NANOSECONDS + time.nanosec


_SLICE = 0.5  # s: how soon a wait sees that ROS was shut down
_QUIET = 5.0  # s between two remarks about one matter

type _Lookup = Callable[[BufferCore], TransformStamped]


class Buffer:
    """
    What is known of transforms. A transform that is looked up is the pose of the source frame in
    the target frame; ``Time()`` asks for the latest.

    :param cache_time: How long the past is kept; None: 10 s.
    :param node: Offers the service ``tf2_frames`` (the frames as YAML), logs, and its clock's
        jumps back clear the buffer.
    :param clock: A clock to watch without all that.

    The lookups raise TransformException: Lookup-, Connectivity-, Extrapolation- or
    InvalidArgumentException of :mod:`amr_description.errors`.
    """

    def __init__(
        self,
        cache_time: Duration | None = None,
        node: Node | None = None,
        *,
        clock: Clock | None = None,
    ) -> None:
        self._core = BufferCore(CACHE_TIME if cache_time is None else cache_time.nanoseconds)
        self._changed = threading.Condition()  # its lock guards all that is below
        self._awaited: list[tuple[_Lookup, Future]] = []
        self._said: dict[tuple[str, str], float] = {}
        self._logger = node.get_logger() if node else get_logger('tf2_buffer')
        self.publishers: Callable[[], Mapping[str, list[str]]] = dict
        """Topic -> the nodes that publish there; a listener knows."""
        if node is not None:
            self.srv = node.create_service(FrameGraph, 'tf2_frames', self._answer)
            clock = node.get_clock()
        self._clock = clock
        self._going_back = TimeJumpFilter()
        self._jumps = clock and clock.create_jump_callback(
            JumpThreshold(
                min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True
            ),
            post_callback=self._on_jump,
        )

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        """Take a moving transform; one that cannot be used is ignored, and told."""
        self._insert(transform, authority, static=False)

    def set_transform_static(self, transform: TransformStamped, authority: str) -> None:
        """Take a transform that is good for all times."""
        self._insert(transform, authority, static=True)

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = Duration(),  # noqa: B008 - never changed
    ) -> TransformStamped:
        """Return the pose of ``source_frame`` in ``target_frame``, waiting for it if need be."""
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
        """Return where ``source_frame`` was then, in ``target_frame`` at another time."""
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
        """Tell whether it can be looked up, after ``timeout``; in a tuple also why not."""
        self._until(_simple(target_frame, source_frame, time), timeout)
        with self._changed:
            why_not = self._core.obstacle(target_frame, source_frame, nanoseconds(time))
        return (not why_not, why_not) if return_debug_tuple else not why_not

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
        """Tell whether :meth:`lookup_transform_full` would do, after ``timeout``."""
        times = (target_time, source_time)
        why_not = ''
        try:
            self._wait(_full(target_frame, source_frame, fixed_frame, *times), timeout)
        except TransformException as error:
            why_not = str(error)
        return (not why_not, why_not) if return_debug_tuple else not why_not

    def wait_for_transform_async(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage
    ) -> Future:
        """Return a future that becomes the transform as soon as it can be looked up."""
        future = Future()
        with self._changed:
            self._awaited.append((_simple(target_frame, source_frame, time), future))
        self._serve_awaited()
        return future

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage
    ) -> TransformStamped:
        """Await a transform in an ``async def`` callback."""
        return await self.wait_for_transform_async(target_frame, source_frame, time)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the latest time that is known of all transforms between two frames."""
        with self._changed:
            return Time(nanoseconds=self._core.latest_common_time(target_frame, source_frame))

    def chain(self, target_frame: str, source_frame: str) -> list[str]:
        """Return the frames on the way from the target to the source, both included."""
        with self._changed:
            return self._core.chain(target_frame, source_frame)

    def records(self) -> list[FrameRecord]:
        """Return what is known of each frame that has a parent."""
        with self._changed:
            return self._core.records()

    def all_frames_as_yaml(self) -> str:
        """Return all frames as a YAML mapping."""
        return frames_as_yaml(self.records())

    def all_frames_as_string(self) -> str:
        """Return all frames, a line each."""
        return frames_as_string(self.records())

    def clear(self) -> None:
        """Forget all moving transforms."""
        with self._changed:
            self._core.clear()

    def _insert(self, transform: TransformStamped, authority: str, *, static: bool) -> None:
        if not static and self._is_of_before(transform):
            return
        with self._changed:
            remark = self._core.set_transform(
                stamped_transform(transform), authority, static=static
            )
            self._changed.notify_all()
            due = remark is not None and self._is_due(remark)
        if due:
            self._say(remark)
        if self._awaited:
            self._serve_awaited()

    def _is_of_before(self, transform: TransformStamped) -> bool:
        """
        Whether it was on its way when time went back: taken as the newest that is known, it would
        keep out, as too old, all that comes since.
        """
        if not self._going_back.is_recent:
            return False
        self._going_back.observe(self._clock.now().nanoseconds)
        return self._going_back.is_stale(nanoseconds(transform.header.stamp))

    def _wait(self, lookup: _Lookup, timeout: Duration) -> TransformStamped:
        self._until(lookup, timeout)
        with self._changed:
            return lookup(self._core)

    def _until(self, lookup: _Lookup, timeout: Duration) -> None:
        """Wait until a lookup does not fail, but no longer than ``timeout``."""
        deadline = clocks.monotonic() + timeout.nanoseconds * 1e-9
        with self._changed:
            while (rest := deadline - clocks.monotonic()) > 0.0 and rclpy.ok():
                try:
                    lookup(self._core)
                    return
                except TransformException:
                    self._changed.wait(min(rest, _SLICE))

    def _serve_awaited(self) -> None:
        """Complete the futures whose time has come; not under the lock, as somebody listens."""
        found: list[tuple[Future, TransformStamped]] = []
        with self._changed:
            waiting = []
            for lookup, future in self._awaited:
                try:
                    found.append((future, lookup(self._core)))
                except TransformException:
                    if not future.cancelled():
                        waiting.append((lookup, future))
            self._awaited = waiting
        for future, transform in found:
            future.set_result(transform)

    def _is_due(self, remark: Remark) -> bool:
        now = clocks.monotonic()
        if now - self._said.get(remark.matter, -_QUIET) < _QUIET:
            return False
        self._said[remark.matter] = now
        return True

    def _say(self, remark: Remark) -> None:
        nodes = '; '.join(
            f'{topic} is published by {", ".join(names)}'
            for topic, names in self.publishers().items()
            if names
        )
        self._logger.warning(f'{remark.text}. {nodes[:1].upper()}{nodes[1:]}'.rstrip(' .'))

    def _on_jump(self, jump: TimeJump) -> None:
        if self.records():
            what = 'jump back in time' if jump.delta.nanoseconds < 0 else 'time source change'
            self._logger.warning(f'Detected {what}. Clearing tf buffer.')
        self.clear()
        now, step = self._clock.now().nanoseconds, jump.delta.nanoseconds
        self._going_back.observe(now - step)
        self._going_back.observe(now)

    def _answer(
        self, _request: FrameGraph.Request, response: FrameGraph.Response
    ) -> FrameGraph.Response:
        response.frame_yaml = self.all_frames_as_yaml()
        return response


def _simple(target: str, source: str, time: Time | TimeMessage) -> _Lookup:
    when = nanoseconds(time)
    return lambda core: transform_message(core.lookup(target, source, when))


def _full(
    target: str,
    source: str,
    fixed: str,
    target_time: Time | TimeMessage,
    source_time: Time | TimeMessage,
) -> _Lookup:
    at_target, at_source = nanoseconds(target_time), nanoseconds(source_time)
    return lambda core: transform_message(
        core.lookup_full(target, at_target, source, at_source, fixed)
    )
