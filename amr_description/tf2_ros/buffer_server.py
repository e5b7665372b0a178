# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``BufferServer``: lets nodes without a listener of their own look up transforms."""

from collections.abc import Mapping

from rclpy.action import ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error

from amr_description.clock import NANOSECONDS
from amr_description.errors import TimeoutException, TransformException
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.buffer_client import EXCEPTIONS

_ERRORS: Mapping[type[TransformException], int] = {kind: n for n, kind in EXCEPTIONS.items()}


class BufferServer:
    """
    An action server LookupTransform for a buffer.

    Args:
        buffer: what is asked.
        node: serves; a goal that waits keeps none of its other callbacks from running.
        ns: the name of the action.
    """

    def __init__(self, buffer: Buffer, node: Node, ns: str) -> None:
        self._buffer = buffer
        self._node = node
        self._server = ActionServer(
            node, LookupTransform, ns, self._look_up, callback_group=ReentrantCallbackGroup()
        )

    def destroy(self) -> None:
        """Serve no more."""
        self._server.destroy()

    async def _look_up(self, handle: ServerGoalHandle) -> LookupTransform.Result:
        goal = handle.request
        result = LookupTransform.Result()
        try:
            result.transform = await self._transform(goal)
        except TransformException as error:
            result.error.error = _ERRORS.get(type(error), TF2Error.TRANSFORM_ERROR)
            result.error.error_string = str(error)
        handle.succeed()
        return result

    async def _transform(self, goal: LookupTransform.Goal) -> object:
        """Return what is asked for, as soon as it is known. Raises TransformException."""
        full = (goal.target_frame, goal.target_time, goal.source_frame, goal.source_time)
        simple = (goal.target_frame, goal.source_frame, goal.source_time)
        if goal.advanced:
            future = self._buffer.wait_for_transform_full_async(*full, goal.fixed_frame)
        else:
            future = self._buffer.wait_for_transform_async(*simple)
        patience = goal.timeout.sec + goal.timeout.nanosec / NANOSECONDS
        if patience > 0.0 and not future.done():
            await self._first_of(future, patience)
        if future.done():
            return future.result()
        future.cancel()
        if goal.advanced:
            self._buffer.lookup_transform_full(*full, goal.fixed_frame)  # says why not
        else:
            self._buffer.lookup_transform(*simple)
        raise TimeoutException(f'the transform was not known within {patience:g} s')

    async def _first_of(self, future: Future, seconds: float) -> None:
        """Await a future, no longer than a time."""
        either = Future()

        def done(_: object = None) -> None:
            if not either.done():
                either.set_result(None)

        future.add_done_callback(done)
        timer = self._node.create_timer(seconds, done)
        try:
            await either
        finally:
            self._node.destroy_timer(timer)
