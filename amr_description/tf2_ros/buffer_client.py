# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``BufferClient``: the buffer of another node, by the action LookupTransform."""

import threading
from typing import Any

from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import TransformStamped
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error

from amr_description.clock import NANOSECONDS
from amr_description.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from amr_description.ros.messages import fill_stamp
from amr_description.ros.wait_clock import WaitClock
from amr_description.tf2_ros.buffer_interface import BufferInterface, nanoseconds_of

EXCEPTIONS: dict[int, type[TransformException]] = {
    TF2Error.LOOKUP_ERROR: LookupException,
    TF2Error.CONNECTIVITY_ERROR: ConnectivityException,
    TF2Error.EXTRAPOLATION_ERROR: ExtrapolationException,
    TF2Error.INVALID_ARGUMENT_ERROR: InvalidArgumentException,
    TF2Error.TIMEOUT_ERROR: TimeoutException,
    TF2Error.TRANSFORM_ERROR: TransformException,
}
"""By the error of a result."""


class BufferClient(BufferInterface):
    """
    Looks up transforms that another node knows.

    Its lookups wait, so that the node has to be served by another thread.

    Args:
        node: it asks.
        ns: the name of the action, ``tf2_buffer_server`` of the original's executable.
        check_frequency: Hz, how often a wait looks whether there is an answer.
        timeout_padding: how much longer than the server may take the answer may take.
    """

    def __init__(
        self,
        node: Node,
        ns: str,
        check_frequency: float = 10.0,
        timeout_padding: Duration = Duration(seconds=2.0),  # noqa: B008 - never changed
    ) -> None:
        super().__init__()
        self.node = node
        self.action_client = ActionClient(node, LookupTransform, action_name=ns)
        self.check_frequency = check_frequency
        self.timeout_padding = timeout_padding

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> TransformStamped:
        """Return a transform. Raises TransformException."""
        goal = LookupTransform.Goal(target_frame=target_frame, source_frame=source_frame)
        fill_stamp(nanoseconds_of(time), goal.source_time)
        return self._result_of(goal, timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> TransformStamped:
        """Return a transform between two times. Raises TransformException."""
        goal = LookupTransform.Goal(
            target_frame=target_frame,
            source_frame=source_frame,
            fixed_frame=fixed_frame,
            advanced=True,
        )
        fill_stamp(nanoseconds_of(source_time), goal.source_time)
        fill_stamp(nanoseconds_of(target_time), goal.target_time)
        return self._result_of(goal, timeout)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | TimeMessage,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> bool:
        """Return whether it can be looked up within ``timeout``."""
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = Duration(),  # noqa: B008
    ) -> bool:
        """Return whether :meth:`lookup_transform_full` can succeed within ``timeout``."""
        try:
            self.lookup_transform_full(
                target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            )
        except TransformException:
            return False
        return True

    def destroy(self) -> None:
        """Ask no more."""
        self.action_client.destroy()

    def _result_of(self, goal: LookupTransform.Goal, timeout: Duration) -> TransformStamped:
        """Have the server look it up. Raises TransformException."""
        goal.timeout = timeout.to_msg()
        patience = (timeout.nanoseconds + self.timeout_padding.nanoseconds) / NANOSECONDS
        clock = WaitClock()
        end = clock.now() + patience
        if not self.action_client.wait_for_server(timeout_sec=patience):
            raise TimeoutException(
                f"there is no action server '{self.action_client._action_name}' after "
                f'{patience:g} s'
            )
        handle = self._await(self.action_client.send_goal_async(goal), clock, end)
        if not handle.accepted:
            raise TimeoutException('the buffer server has refused the goal')
        result = self._await(handle.get_result_async(), clock, end).result
        if result.error.error != TF2Error.NO_ERROR:
            kind = EXCEPTIONS.get(result.error.error, TransformException)
            raise kind(result.error.error_string)
        return result.transform

    def _await(self, future: Any, clock: WaitClock, end: float) -> Any:
        """Return the result of a future, which another thread completes. Raises."""
        is_done = threading.Event()
        future.add_done_callback(lambda _: is_done.set())
        while not is_done.wait(1.0 / self.check_frequency):
            if clock.now() > end:
                future.cancel()
                raise TimeoutException('the buffer server has not answered in time')
        return future.result()
