# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Services that pages call by a form, and goals that they send; on the server's thread."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Time
from rclpy.action import ActionClient
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.task import Future

from amr_description.errors import ViewerError
from amr_description.ros.message_fields import set_fields
from amr_description.ros.message_text import to_yaml
from amr_description.ros.message_types import action_type, service_type
from amr_description.ros.messages import fill_stamp
from amr_description.ros.qos import SERVICE_CLIENT
from amr_description.ros.service_calls import ActionReadiness
from amr_description.text import shorten
from amr_description.viewer.backend import Answer
from amr_description.viewer.forms import CallService, CancelSent, GoalProgress, SendGoal
from amr_description.viewer.ros.action_goals import ActionGoal, ActionGoals
from amr_description.viewer.ros.service_clients import call_client, wait_until_ready
from amr_description.viewer.ros.threads import on_ros_thread

_CALL_TIMEOUT = 14.0
"""s until a service has answered: with the wait for it less than pages wait for a reply."""
_MOST = 16
"""Goals that a page may have at once."""
_FEEDBACK_PERIOD = 0.1
"""s between two feedbacks of a goal that a page is told."""
_LOOK_PERIOD = 1.0
"""s between two looks whether the server of a goal's action is there still."""
_LATE = 60.0
"""s for which an action may still accept a goal of which it has not said so in time."""
_STATES = {
    GoalStatus.STATUS_SUCCEEDED: 'succeeded',
    GoalStatus.STATUS_CANCELED: 'canceled',
    GoalStatus.STATUS_ABORTED: 'aborted',
}


@dataclass(slots=True, eq=False, kw_only=True)
class _SentGoal(ActionGoal):
    """A goal of a page, by the id of the request that sent it."""

    page: str
    id: int
    client: Any = None
    """Of the action; None: it is to be made."""
    is_there: Callable[[], bool] = lambda: False
    """Whether the action's server is."""
    ended: asyncio.Event = field(default_factory=asyncio.Event)
    feedback: Any = None
    """The latest that the page was not told."""
    timer: asyncio.TimerHandle | None = None
    """Until it is told of the next."""


class FormCalls:
    """
    All that pages ask of services and actions by forms.

    Args:
        node: of the viewer.
        executor: that spins it.
        refusal: returns why no goal must be sent to an action now, None: it may.
        now: returns the time, ns, that a stamp of ``now`` becomes.
        tell: tells a page, which is named, how its goal goes.
        call: calls something on the server's thread; on any thread.
    """

    def __init__(
        self,
        node: Node,
        executor: Executor,
        refusal: Callable[[str], str | None],
        now: Callable[[], int],
        tell: Callable[[str, GoalProgress], object],
        call: Callable[[Callable[[], object]], object],
    ) -> None:
        self._node = node
        self._executor = executor
        self._refusal = refusal
        self._now = now
        self._tell = tell
        self._actions: ActionGoals[_SentGoal] = ActionGoals(node, executor, call)
        self._sending: set[_SentGoal] = set()
        """Those that are not accepted yet."""
        self._goals: dict[tuple[str, int], _SentGoal] = {}
        """(page, id) -> what was accepted and has not ended."""
        self._followers: set[asyncio.Task[None]] = set()

    async def call_service(self, request: CallService, page: str) -> Answer:
        """Call a service; answer with the response. Raises AmrError."""
        name, kind = request.service, service_type(request.kind)
        message = self._filled(kind.Request(), request.values)
        client = await on_ros_thread(
            self._executor,
            lambda: self._node.create_client(kind, name, qos_profile=SERVICE_CLIENT),
        )
        self._node.get_logger().info(f'{page} calls {request.kind} {name}')
        started = asyncio.get_running_loop().time()
        try:
            response = await call_client(self._node, client, name, message, _CALL_TIMEOUT)
        finally:
            self._executor.create_task(self._node.destroy_client, client)
        took = asyncio.get_running_loop().time() - started
        return Answer(f'{name} answered within {took:.2f} s', to_yaml(response))

    async def send_goal(self, request: SendGoal, page: str) -> str:
        """Send a goal, until it is accepted; return one line about it. Raises AmrError."""
        name, kind = request.action, action_type(request.kind)
        self._check(name)
        wanted = self._filled(kind.Goal(), request.values)
        if sum(each.page == page for each in self._all()) >= _MOST:
            raise ViewerError(f'this page has {_MOST} goals already; cancel one first')
        goal = _SentGoal(action=name, page=page, id=request.id)
        self._sending.add(goal)
        try:
            await self._connect(goal, kind)
            await self._actions.send(
                goal,
                goal.client,
                wanted,
                lambda feedback: self._on_feedback(goal, feedback),
                lambda done: self._on_result(goal, done),
            )
        except ViewerError:
            delay = _LATE if goal.handle is None else 0.0  # else it was refused
            asyncio.get_running_loop().call_later(delay, self._destroy, goal.client)
            raise
        finally:
            self._sending.discard(goal)
        self._goals[page, goal.id] = goal
        follower = asyncio.create_task(self._follow(goal))
        self._followers.add(follower)
        follower.add_done_callback(self._followers.discard)
        self._actions.follow(goal)
        return f'{name} has accepted the goal'

    async def _connect(self, goal: _SentGoal, kind: Any) -> None:
        """Wait for the server of a goal's action. Raises ViewerError."""
        name = goal.action
        goal.client = await on_ros_thread(
            self._executor, lambda: ActionClient(self._node, kind, name)
        )
        goal.is_there = ActionReadiness(self._node, goal.client, kind, name)
        await wait_until_ready(goal.is_there, f'action {name}')
        if goal.reason:
            raise ViewerError(f'{goal.reason}: no goal was sent')
        self._node.get_logger().info(f'{goal.page} sends a goal to {name}')

    async def cancel(self, request: CancelSent, page: str) -> str:
        """Cancel a goal; return one line about it. Raises ViewerError."""
        goal = self._goals.get((page, request.goal))
        if goal is None:
            raise ViewerError('the goal has ended already')
        return await self._actions.cancel(goal, lambda: not goal.ended.is_set())

    def forget(self, page: str) -> None:
        """A page has gone: what it is after ends."""
        self._cancel(f'{page} has gone', lambda goal: goal.page == page)

    def stop(self) -> None:
        """Cancel the goals that must not be sent any more."""
        self._cancel('STOP was pressed', lambda goal: self._refusal(goal.action) is not None)

    def _cancel(self, reason: str, concerns: Callable[[_SentGoal], bool]) -> None:
        for goal in self._all():
            if concerns(goal):
                self._actions.cancel_soon(goal, reason)

    def _all(self) -> list[_SentGoal]:
        return [*self._sending, *self._goals.values()]

    def _check(self, action: str) -> None:
        """Raise ViewerError: no goal must be sent to an action now."""
        if (refusal := self._refusal(action)) is not None:
            raise ViewerError(refusal)

    def _filled(self, message: Any, values: Any) -> Any:
        """Return a message with these values, and its stamps of now. Raises AmrError."""
        now = Time()
        fill_stamp(self._now(), now)
        for stamp in set_fields(message, values):
            stamp(now)
        return message

    async def _follow(self, goal: _SentGoal) -> None:
        """Wait for the end of a goal, or of its server."""
        while not goal.ended.is_set():
            try:
                await asyncio.wait_for(goal.ended.wait(), _LOOK_PERIOD)
            except TimeoutError:
                if not goal.is_there():
                    self._end(goal, 'lost', f'{goal.action} has gone')
        self._destroy(goal.client)

    def _on_feedback(self, goal: _SentGoal, feedback: Any) -> None:
        """Tell the feedback, the newest of those that come faster than a page shows them."""
        goal.feedback = feedback
        if goal.timer is None:
            self._tell_feedback(goal)

    def _tell_feedback(self, goal: _SentGoal) -> None:
        goal.timer = None
        if goal.feedback is None or goal.ended.is_set():
            return
        text, goal.feedback = to_yaml(goal.feedback), None
        self._tell(goal.page, GoalProgress(goal.id, 'active', text))
        loop = asyncio.get_running_loop()
        goal.timer = loop.call_later(_FEEDBACK_PERIOD, self._tell_feedback, goal)

    def _on_result(self, goal: _SentGoal, done: Future) -> None:
        if (error := done.exception()) is not None:
            self._end(goal, 'lost', shorten(str(error)))
            return
        response = done.result()
        state = _STATES.get(response.status, 'lost')
        self._end(goal, state, to_yaml(response.result))

    def _end(self, goal: _SentGoal, state: Any, text: str) -> None:
        if goal.ended.is_set():
            return
        goal.ended.set()
        self._goals.pop((goal.page, goal.id), None)
        if goal.reason:
            text = f'# {goal.reason}\n{text}'
        self._tell(goal.page, GoalProgress(goal.id, state, text))

    def _destroy(self, client: ActionClient | None) -> None:
        if client is not None:
            self._executor.create_task(client.destroy)
