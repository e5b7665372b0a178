# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Goals and initial poses that pages give to who navigates robots.

A goal goes to the action ``navigate_to_pose`` where its server and its type are there: it says how
far it is, and can be cancelled. Else it is published on ``goal_pose``, as RViz does.

:meth:`Goals.find` is called on the ROS thread, all else on the server's.
"""

from collections.abc import Callable, Mapping, Sequence, Set as AbstractSet
from dataclasses import dataclass, replace
import math
from typing import Any

from action_msgs.msg import GoalStatus as ActionStatus
from geometry_msgs.msg import Pose, PoseStamped, PoseWithCovarianceStamped
from rclpy.action import ActionClient
from rclpy.exceptions import InvalidHandle
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.task import Future

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, ViewerError
from amr_description.model.frames import Transform
from amr_description.ros.message_types import action_type
from amr_description.ros.messages import fill_pose, fill_stamp
from amr_description.ros.service_calls import ActionReadiness
from amr_description.text import shorten
from amr_description.viewer.graph import NAVIGATE
from amr_description.viewer.navigation import GoalStatus, Navigator
from amr_description.viewer.requests import CancelGoal, SetGoal, SetInitialPose
from amr_description.viewer.ros.action_goals import ActionGoal, ActionGoals

_VARIANCES = {0: 0.25, 7: 0.25, 35: (math.pi / 12.0) ** 2}
"""Of x and y (m²) and yaw (rad²), by their places: those of RViz' 2D Pose Estimate."""
_STOPPED = 'STOP was pressed'
_SHORTEST = 0.05
"""m of which a distance to go is told."""


class _Ends:
    """The publishers to one navigator, and the client of its action; made on the ROS thread."""

    def __init__(self, node: Node, navigator: Navigator) -> None:
        self.navigator = navigator
        self.goal: Publisher | None = None
        self.initial_pose: Publisher | None = None
        self.action: ActionClient | None = None
        self.is_ready: ActionReadiness | None = None
        """Whether the server of the action is there."""
        self._node = node
        if navigator.goal is not None:
            self.goal = node.create_publisher(PoseStamped, navigator.goal, 10)
        if navigator.initial_pose is not None:
            self.initial_pose = node.create_publisher(
                PoseWithCovarianceStamped, navigator.initial_pose, 10
            )
        if navigator.action is not None:
            kind = action_type(NAVIGATE)
            self.action = ActionClient(node, kind, navigator.action)
            self.is_ready = ActionReadiness(node, self.action, kind, navigator.action)

    def destroy(self) -> None:
        for publisher in (self.goal, self.initial_pose):
            if publisher is not None:
                self._node.destroy_publisher(publisher)
        if self.action is not None:
            self.action.destroy()


@dataclass(slots=True, eq=False, kw_only=True)
class _Goal(ActionGoal):
    """A goal by the action."""

    status: GoalStatus


class Goals:
    """
    The goals of all robots.

    Args:
        node: of the viewer.
        executor: that spins it.
        tell: takes how a goal goes, whenever that may have changed.
        call: calls something on the server's thread; on any thread.
    """

    def __init__(
        self,
        node: Node,
        executor: Executor,
        tell: Callable[[GoalStatus], object],
        call: Callable[[Callable[[], object]], object],
    ) -> None:
        self.navigators: tuple[Navigator, ...] = ()
        """Who takes goals and poses; the ROS thread replaces it."""
        self._node = node
        self._executor = executor
        self._tell = tell
        self._call = call
        self._ends: Mapping[str, _Ends] = {}
        self._prefixed: AbstractSet[str] = frozenset()
        self._goals: dict[str, _Goal] = {}
        """By the robot, those by the action; ended ones too."""
        self._actions: ActionGoals[_Goal] = ActionGoals(node, executor, call)

    # --- on the ROS thread -----------------------------------------------------------------------

    def find(self, navigators: Sequence[Navigator], tf_namespaces: Sequence[str]) -> None:
        """
        Follow a change of the graph.

        Args:
            navigators: Those that there are.
            tf_namespaces: The robots with a TF of their own: its frames have no prefix there.
        """
        usable = tuple(map(_usable, navigators))
        before, self._prefixed = self._ends, frozenset(tf_namespaces)
        kept = {each.robot: before.get(each.robot) for each in usable}
        self._ends = {
            each.robot: known
            if (known := kept[each.robot]) is not None and known.navigator == each
            else _Ends(self._node, each)
            for each in usable
        }
        for ends in self._ends.values():
            if ends.is_ready is not None:
                ends.is_ready()  # it has to be looked for before it is needed
        self.navigators = usable
        for robot, ends in before.items():
            if self._ends.get(robot) is not ends:
                ends.destroy()
        self._call(self._end_orphans)

    # --- on the server's thread ------------------------------------------------------------------

    async def set_goal(self, request: SetGoal, page: str, time: int) -> str:
        """Give a goal, at a ROS time (ns); return one line about it. Raises ViewerError."""
        ends = self._ends_of(request.robot)
        pose = PoseStamped(pose=_pose(request))
        fill_stamp(time, pose.header.stamp)
        pose.header.frame_id = self._frame(request)
        place = (request.frame, request.x, request.y, request.yaw)
        where = f'x {request.x:.2f} m, y {request.y:.2f} m in {pose.header.frame_id}'
        if ends.action is not None and ends.is_ready is not None and ends.is_ready():
            status = GoalStatus(request.robot, page, 'active', *place)
            self._node.get_logger().info(f'{page} sends {request.robot} to {where}')
            goal = _Goal(action=ends.navigator.action or '', status=status)
            await self._pursue(goal, ends.action, pose)
            return f'{ends.navigator.action} has accepted the goal: {where}'
        if ends.goal is None:
            raise ViewerError(
                f'nothing hears goals of {request.robot}; is its navigation running?'
            )
        self._node.get_logger().info(f'{page} sends {request.robot} to {where}')
        _publish(ends.goal, pose)
        self._goals.pop(request.robot, None)
        self._tell(GoalStatus(request.robot, page, 'published', *place))
        return f'the goal was published on {ends.navigator.goal}: {where}'

    async def cancel(self, request: CancelGoal, _: str) -> str:
        """Cancel the goal of a robot; return one line about it. Raises ViewerError."""
        robot = request.robot
        goal = self._goals.get(robot)
        if goal is None or goal.status.state != 'active':
            raise ViewerError(f'no page has given {robot} a goal that it is after')
        return await self._actions.cancel(goal, lambda: goal.status.state == 'active')

    def stop(self, robots: AbstractSet[str]) -> None:
        """Cancel the goals of robots that STOP holds from now on."""
        for goal in [*self._actions.asked, *self._goals.values()]:
            if goal.status.robot in robots and goal.status.state == 'active':
                self._actions.cancel_soon(goal, _STOPPED)

    def set_initial_pose(self, request: SetInitialPose, time: int) -> str:
        """Publish where a robot is, at a ROS time (ns); return one line. Raises ViewerError."""
        ends = self._ends_of(request.robot)
        if ends.initial_pose is None:
            raise ViewerError(
                f'nothing hears poses of {request.robot}; is its localisation running?'
            )
        message = PoseWithCovarianceStamped()
        fill_stamp(time, message.header.stamp)
        message.header.frame_id = self._frame(request)
        message.pose.pose = _pose(request)
        for place, variance in _VARIANCES.items():
            message.pose.covariance[place] = variance
        _publish(ends.initial_pose, message)
        return f'the pose was published on {ends.navigator.initial_pose}'

    async def _pursue(self, goal: _Goal, client: ActionClient, pose: PoseStamped) -> None:
        """Send a goal, and follow it to its end once it is accepted."""
        await self._actions.send(
            goal,
            client,
            action_type(NAVIGATE).Goal(pose=pose),
            lambda feedback: self._on_feedback(goal, feedback),
            lambda done: self._on_result(goal, done),
        )
        self._goals[goal.status.robot] = goal
        self._tell(goal.status)
        self._actions.follow(goal)

    def _on_feedback(self, goal: _Goal, feedback: Any) -> None:
        left = feedback.estimated_time_remaining
        seconds = left.sec + left.nanosec / NANOSECONDS
        distance = float(feedback.distance_remaining)
        is_told = math.isfinite(distance) and distance >= _SHORTEST
        self._change(
            goal,
            # What pages show; feedback comes a hundred times a second.
            distance=round(distance, 1) if is_told else None,
            time=float(round(seconds)) if seconds > 0.0 else None,
            recoveries=int(feedback.number_of_recoveries),
        )

    def _on_result(self, goal: _Goal, done: Future) -> None:
        if (error := done.exception()) is not None:
            self._change(goal, state='failed', text=shorten(str(error)))
            return
        response = done.result()
        if response.status == ActionStatus.STATUS_SUCCEEDED:
            self._change(goal, state='reached', distance=None, time=None)
        elif response.status == ActionStatus.STATUS_CANCELED:
            self._change(goal, state='cancelled', text=goal.reason)
        else:
            self._change(goal, state='failed', text=_fault(response.result))

    def _change(self, goal: _Goal, **changes: Any) -> None:
        """Tell what has changed, unless another goal has taken the place of this one."""
        robot = goal.status.robot
        before, goal.status = goal.status, replace(goal.status, **changes)
        if self._goals.get(robot) is goal and goal.status != before:
            self._tell(goal.status)

    def _end_orphans(self) -> None:
        """End the goals of actions that have gone, and tell new pages of the others."""
        for robot, goal in self._goals.items():
            ends = self._ends.get(robot)
            is_served = ends is not None and ends.navigator.action == goal.action
            if goal.status.state == 'active' and not is_served:
                self._change(goal, state='failed', text=f'{goal.action} has gone')
            else:
                self._tell(goal.status)

    def _ends_of(self, robot: str) -> _Ends:
        ends = self._ends.get(robot)
        if ends is None:
            raise ViewerError(f'nothing navigates {robot!a}; is its navigation running?')
        return ends

    def _frame(self, request: SetGoal | SetInitialPose) -> str:
        """Return the name that a frame of a page has in messages."""
        is_own = request.robot in self._prefixed
        return request.frame.removeprefix(f'{request.robot[1:]}/') if is_own else request.frame


def _usable(navigator: Navigator) -> Navigator:
    """Return a navigator without an action whose type is not installed here."""
    try:
        action_type(NAVIGATE)
    except AmrError:
        return replace(navigator, action=None)
    return navigator


def _pose(request: SetGoal | SetInitialPose) -> Pose:
    pose = Pose()
    turn = (0.0, 0.0, request.yaw)
    fill_pose(Transform.from_xyz_rpy((request.x, request.y, 0.0), turn), pose)
    return pose


def _publish(publisher: Publisher, message: Any) -> None:
    try:
        publisher.publish(message)
    except InvalidHandle:  # the ROS thread has destroyed it in the meantime
        raise ViewerError('it has just gone') from None


def _fault(result: Any) -> str:
    """Return why an action has failed, by its error code and message, as far as it has them."""
    code = getattr(result, 'error_code', 0)
    names = [
        name
        for name in dir(type(result))
        if name.isupper() and not name.startswith('_') and getattr(type(result), name) == code
    ]
    said = [*names, shorten(getattr(result, 'error_msg', ''))]
    why = ': '.join(each for each in said if each and each != 'NONE')
    return why or (f'error {code}' if code else '')
