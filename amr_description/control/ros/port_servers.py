# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The services and actions that controllers declare, over rclpy; all of it on the ROS thread.

The control thread makes no call into rclpy for them. A service's answer is submitted to it,
between two cycles. Of a goal it writes attributes, which a timer looks at while there are goals,
as the original's real-time goal handles are looked at.
"""

from typing import Any

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import GoalEvent, ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.timer import Timer

from amr_description.control.contracts import Action, Goal, GoalStatus, Service
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.messages.readers import part_of, reader_of
from amr_description.messages.writers import writer_of
from amr_description.plugin_errors import describe
from amr_description.ros.message_types import action_type, service_type
from amr_description.ros.rclpy_internals import begin_goal, end_goal
from amr_description.ros.standing_clock import StandingClockNode

_RESULT_TIMEOUT = 10
"""s for which the result of an ended goal is kept, as by rclcpp_action; rclpy: 900."""

_EVENTS = {
    GoalStatus.SUCCEEDED: GoalEvent.SUCCEED,
    GoalStatus.ABORTED: GoalEvent.ABORT,
    GoalStatus.CANCELED: GoalEvent.CANCELED,
}


class ServiceServer:
    """One service of a controller."""

    def __init__(self, node: Node, service: Service[Any, Any], context: LoopContext) -> None:
        """
        Serve.

        Args:
            node: Of the controller.
            service: As the configured controller declares it.
            context: Of the process.

        Raises:
            AmrError: There is no such type, or no converter.
        """
        port = service.port
        self._node = node
        self._answer = service.answer
        self._submit = context.loop_thread.submit
        self._read = reader_of(part_of(port, 'request'))
        self._fill = writer_of(part_of(port, 'response'))
        self._service = node.create_service(
            service_type(port.service),
            port.name,
            self._serve,
            callback_group=ReentrantCallbackGroup(),  # others do not wait for the control thread
        )

    def close(self) -> None:
        """Serve no more."""
        self._node.destroy_service(self._service)

    async def _serve(self, request: Any, response: Any) -> Any:
        try:
            sample = self._read(request)
            answer = await self._submit(lambda: self._answer(sample), self._node.executor)
            self._fill(answer, response)
        except Exception as error:  # a third party's; the client has to hear something
            self._node.get_logger().error(
                f"Could not answer '{self._service.service_name}': {describe(error)}"
            )
            return type(response)()
        return response


class GoalServer:
    """One action of a controller."""

    def __init__(self, node: Node, action: Action[Any, Any, Any]) -> None:
        """
        Serve.

        Args:
            node: Of the controller.
            action: As the configured controller declares it.

        Raises:
            AmrError: There is no such type, or no converter.
        """
        port = action.port
        self._node = node
        self._action = action
        self._type = action_type(port.action)
        self._read = reader_of(part_of(port, 'goal'))
        self._fill_feedback = writer_of(part_of(port, 'feedback'))
        self._fill_result = writer_of(part_of(port, 'result'))
        self._accepted: Goal[Any, Any, Any] | None = None
        """Between its two callbacks, which follow on one another."""
        self._live: dict[bytes, tuple[Goal[Any, Any, Any], ServerGoalHandle]] = {}
        self._timer: Timer | None = None
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._standing = StandingClockNode(node)
        self._server = ActionServer(
            self._standing,
            self._type,
            port.name,
            _never,
            goal_callback=self._decide,
            handle_accepted_callback=self._begin,
            cancel_callback=self._cancel,
            result_timeout=_RESULT_TIMEOUT,
        )

    def close(self) -> None:
        """End every goal, and serve no more."""
        for goal, _ in self._live.values():
            goal.abort(None)
        self._look()
        self._server.destroy()

    def _decide(self, request: Any) -> GoalResponse:
        self._accepted = None
        self._standing.set_time()
        logger = self._node.get_logger()
        try:
            sample = self._read(request)
            reason = self._action.refusal(sample, self._node.get_clock().now().nanoseconds)
        except Exception as error:  # a third party's
            reason = f"Cannot accept a goal of '{self._action.port.name}': {describe(error)}"
        if reason:
            logger.error(reason)
            return GoalResponse.REJECT
        self._accepted = Goal(sample)
        return GoalResponse.ACCEPT

    def _begin(self, handle: ServerGoalHandle) -> None:
        goal = self._accepted
        if goal is None:  # pragma: no cover - rclpy accepts what it was told to
            return
        begin_goal(handle)
        self._live[_key(handle)] = (goal, handle)
        if self._timer is None:
            self._timer = self._node.create_timer(
                1.0 / self._action.port.rate, self._look, clock=self._clock
            )
        if not self._action.put(goal):
            goal.abort(None)

    def _cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        found = self._live.get(_key(handle))
        if found is None or not found[0].is_live:
            return CancelResponse.REJECT
        found[0].is_cancel_requested = True
        return CancelResponse.ACCEPT

    def _look(self) -> None:
        """Publish what the control thread has left: results, and the newest feedback."""
        for key, (goal, handle) in list(self._live.items()):
            try:
                if goal.outcome is not None:
                    del self._live[key]
                    self._end(handle, *goal.outcome)
                elif (feedback := goal.feedback) is not None:
                    goal.feedback = None
                    message = self._type.Feedback()
                    self._fill_feedback(feedback, message)
                    handle.publish_feedback(message)
            except Exception as error:  # a third party's converter
                self._node.get_logger().error(
                    f"Could not report on a goal of '{self._action.port.name}': {describe(error)}",
                    throttle_duration_sec=1.0,
                )
        if not self._live and self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None

    def _end(self, handle: ServerGoalHandle, status: GoalStatus, result: Any) -> None:
        message = self._type.Result()
        try:
            if result is not None:
                self._fill_result(result, message)
        finally:
            end_goal(self._server, handle, _EVENTS[status], message)


def _key(handle: ServerGoalHandle) -> bytes:
    return bytes(handle.goal_id.uuid)


def _never(handle: ServerGoalHandle) -> None:
    """Stand for the callback that executes goals, which the control thread does."""
