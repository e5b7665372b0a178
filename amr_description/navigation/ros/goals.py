# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Action servers that take one goal at a time: a new one ends the one before, as in Nav2."""

from collections.abc import Callable
from typing import Any

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import GoalEvent, ServerGoalHandle
from rclpy.node import Node

from amr_description.errors import NavigationError
from amr_description.ros.firewall import reason_of
from amr_description.ros.rclpy_internals import begin_goal, end_goal
from amr_description.ros.standing_clock import StandingClockNode

UNKNOWN_ERROR = 200


class NavigationGoal:
    """A goal of a client; one without a client, of a topic, has ``handle`` None."""

    def __init__(
        self, server: 'NavigationGoalServer | None', handle: ServerGoalHandle | None, request: Any
    ) -> None:
        self.server, self.handle, self.request = server, handle, request

    @property
    def is_cancel_requested(self) -> bool:
        """Whether the client wants it to end."""
        return self.handle is not None and bool(self.handle.is_cancel_requested)

    def feed(self, **fields: Any) -> None:
        """Publish feedback."""
        if self.handle is not None and self.server is not None:
            self.handle.publish_feedback(self.server.type.Feedback(**fields))

    def succeed(self, **fields: Any) -> None:
        """End well, with these fields of the result."""
        self._end(GoalEvent.SUCCEED, **fields)

    def cancel(self, **fields: Any) -> None:
        """End as the client has wished, with these fields of the result."""
        self._end(GoalEvent.CANCELED, **fields)

    def abort(self, error: NavigationError | None = None, **fields: Any) -> None:
        """End with an error; None: another goal has come."""
        if error is not None:
            fields |= {'error_code': error.error_code, 'error_msg': str(error)}
        self._end(GoalEvent.ABORT, **fields)

    def _end(self, event: GoalEvent, **fields: Any) -> None:
        if self.handle is not None and self.server is not None:
            self.server.end(self.handle, event, self.server.type.Result(**fields))


class NavigationGoalServer:
    """The server of one action."""

    def __init__(
        self,
        node: Node,
        action_type: Any,
        name: str,
        begin: Callable[[NavigationGoal], object],
        *,
        absent: str = '',
    ) -> None:
        """
        Serve.

        Args:
            node: has the action.
            action_type: of ``nav2_msgs.action``.
            name: of the action.
            begin: called with each goal, in the executor; it ends the goal then or later. What it
                raises as NavigationError is the goal's result.
            absent: why all goals are refused; empty: they are not.
        """
        self._absent = absent
        self.type = action_type
        self._begin = begin
        self._logger = node.get_logger()
        self._standing = StandingClockNode(node)
        self._server = ActionServer(
            self._standing,
            action_type,
            name,
            _never,
            goal_callback=self._decide,
            handle_accepted_callback=self._accepted,
            cancel_callback=lambda _handle: CancelResponse.ACCEPT,
        )

    def end(self, handle: ServerGoalHandle, event: GoalEvent, result: Any) -> None:
        """End a goal."""
        end_goal(self._server, handle, event, result)

    def close(self) -> None:
        """Serve no more."""
        self._server.destroy()

    def _decide(self, request: Any) -> GoalResponse:
        self._standing.set_time()
        if self._absent:
            self._logger.error(f'goal refused: {self._absent}')
            return GoalResponse.REJECT
        if getattr(request, 'behavior_tree', ''):
            self._logger.error(
                f'goal refused: behavior_tree is {request.behavior_tree!r}, and there are no '
                'behavior trees here; leave it empty'
            )
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _accepted(self, handle: ServerGoalHandle) -> None:
        begin_goal(handle)
        goal = NavigationGoal(self, handle, handle.request)
        try:
            self._begin(goal)
        except NavigationError as error:
            self._logger.error(f'{error} (error code {error.error_code})')
            goal.abort(error)
        except Exception as error:  # whatever is in the goal: its client hears of it
            if handle.is_active:
                goal.abort(NavigationError(UNKNOWN_ERROR, reason_of(error)))
            raise


def _never(handle: ServerGoalHandle) -> None:
    """Stand for the callback that executes goals, which a timer does."""
