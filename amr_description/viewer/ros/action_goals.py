# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Goals of actions: sent, followed to their end, cancelled; on the server's thread."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from rclpy.action import ActionClient
from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.task import Future

from amr_description.errors import ViewerError
from amr_description.ros.rclpy_internals import RCLError
from amr_description.viewer.ros.threads import on_ros_thread

_ANSWER_TIMEOUT = 5.0
"""s until an action server has answered."""


@dataclass(slots=True, eq=False, kw_only=True)
class ActionGoal:
    """A goal, from its sending to its end; ``handle`` is None until it was accepted."""

    action: str
    handle: Any = None
    reason: str = ''
    """Why it is to be cancelled."""
    on_result: Callable[[Future], object] = lambda _: None


G = TypeVar('G', bound=ActionGoal)


class ActionGoals(Generic[G]):
    """
    Sends goals.

    Args:
        node: of the viewer.
        executor: that spins it.
        call: calls something on the server's thread; on any thread.
    """

    def __init__(
        self,
        node: Node,
        executor: Executor,
        call: Callable[[Callable[[], object]], object],
    ) -> None:
        self._node = node
        self._executor = executor
        self._call = call
        self.asked: set[G] = set()
        """Those that their actions have not accepted yet."""

    async def send(
        self,
        goal: G,
        client: ActionClient,
        wanted: Any,
        on_feedback: Callable[[Any], object],
        on_result: Callable[[Future], object],
    ) -> None:
        """
        Send a goal, until it is accepted; then :meth:`follow` has its result asked for.

        ``on_feedback`` and ``on_result`` are called on the server's thread. Raises ViewerError.
        """

        def take(message: Any) -> None:
            self._call(lambda: on_feedback(message.feedback))

        def send() -> Future:
            sent = client.send_goal_async(wanted, take)
            sent.add_done_callback(lambda done: self._call(lambda: self._on_answer(goal, done)))
            return sent

        goal.on_result = on_result
        self.asked.add(goal)
        try:
            goal.handle = await self._answer(goal.action, send)
        finally:
            self.asked.discard(goal)
        if not goal.handle.accepted:
            raise ViewerError(f'{goal.action} refuses the goal; its log says why')

    def follow(self, goal: G) -> None:
        """Ask for the result of a goal that is accepted."""
        self._executor.create_task(self._await_result, goal)
        if goal.reason:  # STOP was pressed in the meantime
            self._executor.create_task(_cancel, goal)

    async def cancel(self, goal: G, is_active: Callable[[], bool]) -> str:
        """Cancel a goal; return one line about it. Raises ViewerError."""
        answer = await self._answer(goal.action, goal.handle.cancel_goal_async)
        if not answer.goals_canceling and is_active():
            raise ViewerError(f'{goal.action} does not cancel the goal; its log says why')
        return f'{goal.action} cancels the goal'

    def cancel_soon(self, goal: G, reason: str) -> None:
        """Cancel a goal, as soon as it is accepted."""
        goal.reason = reason
        if goal.handle is not None:
            self._executor.create_task(_cancel, goal)

    def _on_answer(self, goal: G, done: Future) -> None:
        """Cancel a goal that is accepted after its page was told that it is not."""
        is_late = goal not in self.asked and goal.handle is None
        if not is_late or done.exception() is not None:
            return
        goal.handle = done.result()
        if goal.handle.accepted:
            self._node.get_logger().warning(f'{goal.action} has accepted a goal too late')
            self._executor.create_task(_cancel, goal)

    def _await_result(self, goal: G) -> None:
        """Ask for the result of a goal; on the ROS thread."""
        with suppress(InvalidHandle, RCLError):  # the action has gone, which is told otherwise
            result = goal.handle.get_result_async()
            result.add_done_callback(lambda done: self._call(lambda: goal.on_result(done)))

    async def _answer(self, action: str, ask: Callable[[], Future]) -> Any:
        """
        Ask an action server on the ROS thread, and wait for its answer. Raises ViewerError.

        An ActionClient takes note of its request after it has sent it, without a lock: asked on
        another thread, the answer can come first, and is then unexpected.
        """
        loop = asyncio.get_running_loop()
        done = asyncio.Event()

        def run() -> Future:
            future = ask()
            future.add_done_callback(lambda _: loop.call_soon_threadsafe(done.set))
            return future

        future = await on_ros_thread(self._executor, run)
        try:
            await asyncio.wait_for(done.wait(), _ANSWER_TIMEOUT)
        except TimeoutError:
            raise ViewerError(f'{action} has not answered within {_ANSWER_TIMEOUT:g} s') from None
        return future.result()


def _cancel(goal: ActionGoal) -> None:
    """Cancel a goal; on the ROS thread."""
    with suppress(InvalidHandle, RCLError):  # the action has gone, and the goal with it
        goal.handle.cancel_goal_async()
