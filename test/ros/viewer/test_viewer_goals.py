# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Goals that pages give by the action of Nav2: followed, cancelled, refused, and ended by STOP."""

import asyncio
from contextlib import ExitStack
from dataclasses import replace
import threading

from geometry_msgs.msg import PoseStamped
import pytest
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from support.navigated_robot import NavigationServer
from support.ros_processes import PATIENCE
from support.serving import serving
from support.waiting import until

from amr_description.errors import ViewerError
from amr_description.ros import service_calls
from amr_description.viewer.navigation import Navigator
from amr_description.viewer.requests import CancelGoal, SetGoal, SetInitialPose
from amr_description.viewer.ros import action_goals
from amr_description.viewer.ros.goals import Goals

NAVIGATOR = Navigator('/a', '/a/goal_pose', '/a/navigate_to_pose', None)
GOAL = SetGoal(1, '/a', 'a/map', 3.0, 4.0, 0.5)
SECOND = 1_000_000_000


class Graph:
    """The viewer's side, a server of the action, and the loop of the page's server."""

    def __init__(self):
        self._context = Context()
        self._context.init([])
        self.told = []
        self.loop = asyncio.new_event_loop()
        self.nodes = [Node(name, context=self._context) for name in ('viewer', 'navigator')]
        self._executors = [
            SingleThreadedExecutor(context=self._context),
            MultiThreadedExecutor(4, context=self._context),
        ]
        self._thread = threading.Thread(target=self.loop.run_forever)
        for node, executor in zip(self.nodes, self._executors, strict=True):
            executor.add_node(node)
        self.server = NavigationServer(self.nodes[1], NAVIGATOR.action)
        self.heard = []
        self.nodes[1].create_subscription(PoseStamped, NAVIGATOR.goal, self.heard.append, 10)
        self.goals = Goals(
            self.nodes[0], self._executors[0], self.told.append, self.loop.call_soon_threadsafe
        )
        self.goals.find([NAVIGATOR], ['/a'])
        self._thread.start()
        self._service = ExitStack()
        for executor in self._executors:
            self._service.enter_context(serving(executor))
        until(lambda: self.goals._ends['/a'].action.server_is_ready())

    def run(self, work):
        """Await something on the server's thread; return what it returned."""
        return asyncio.run_coroutine_threadsafe(work, self.loop).result(PATIENCE)

    def call(self, function, *arguments):
        """Call something on the server's thread."""

        async def work():
            return function(*arguments)

        return self.run(work())

    def find(self, *navigators):
        """Find these navigators, on the ROS thread."""
        found = threading.Event()

        def find():
            self.goals.find(navigators, [])
            found.set()

        self._executors[0].create_task(find)
        assert found.wait(PATIENCE)

    def give(self, goal=GOAL):
        """Give a goal; return the line about it."""
        return self.run(self.goals.set_goal(goal, 'page 1', 5 * SECOND))

    def is_told(self, **known):
        """Wait until the last word of a goal is this; return it."""
        return until(
            lambda: (
                self.told and replace(self.told[-1], **known) == self.told[-1] and self.told[-1]
            )
        )

    def close(self):
        self.server.ends.set()
        self._service.close()
        self.loop.call_soon_threadsafe(self.loop.stop)
        self._thread.join()
        self.loop.close()
        # destroy_node leaves it, and the next test would take it for its own.
        self.server.destroy()
        for node in self.nodes:
            node.destroy_node()
        self._context.try_shutdown()


@pytest.fixture
def graph():
    graph = Graph()
    yield graph
    graph.close()


def test_a_goal_is_followed_to_its_end(graph):
    assert graph.give() == '/a/navigate_to_pose has accepted the goal: x 3.00 m, y 4.00 m in map'
    status = graph.is_told(state='active', distance=3.2, time=8.0, recoveries=2)
    assert (status.client, status.frame, status.x, status.y, status.yaw) == (
        'page 1', 'a/map', 3.0, 4.0, 0.5
    )  # fmt: skip
    (handle,) = graph.server.goals
    pose = handle.request.pose
    assert (pose.header.frame_id, pose.header.stamp.sec) == ('map', 5), 'its TF has no prefix'
    assert (pose.pose.position.x, pose.pose.position.y) == (3.0, 4.0)
    graph.server.ends.set()
    graph.is_told(state='reached', distance=None, time=None)
    assert graph.heard == [], 'it came by the action alone'


def test_a_goal_that_fails_says_why(graph):
    graph.server.outcome = 'abort'
    graph.give()
    graph.server.ends.set()
    assert graph.is_told(state='failed').text


def test_a_server_that_is_there_is_asked_though_its_client_is_never_ready(graph, monkeypatch):
    """As after a new start of the navigation; see service_calls."""
    monkeypatch.setattr(service_calls, '_MATCHED_BY', 0.0)
    monkeypatch.setattr(graph.goals._ends['/a'].is_ready, '_is_matched', lambda: False)
    assert graph.give().startswith('/a/navigate_to_pose has accepted')


def test_a_goal_is_cancelled(graph):
    graph.give()
    until(lambda: graph.server.goals)
    assert (
        graph.run(graph.goals.cancel(CancelGoal(1, '/a'), 'page 1'))
        == '/a/navigate_to_pose cancels the goal'
    )
    graph.server.ends.set()
    assert graph.is_told(state='cancelled').text == ''
    with pytest.raises(ViewerError, match='no page has given /a a goal that it is after'):
        graph.run(graph.goals.cancel(CancelGoal(1, '/a'), 'page 1'))


def test_stop_cancels_the_goals_of_the_robots_that_it_holds(graph):
    graph.give()
    until(lambda: graph.server.goals)
    graph.call(graph.goals.stop, {'/b'})
    graph.call(graph.goals.stop, {'/a'})
    until(lambda: graph.server.goals[0].is_cancel_requested)
    graph.server.ends.set()
    assert graph.is_told(state='cancelled').text == 'STOP was pressed'


def test_what_the_server_refuses_is_refused(graph):
    graph.server.accepts = False
    with pytest.raises(ViewerError, match='/a/navigate_to_pose refuses the goal'):
        graph.give()
    graph.server.accepts, graph.server.cancels = True, False
    graph.give()
    until(lambda: graph.server.goals)
    with pytest.raises(ViewerError, match='does not cancel the goal'):
        graph.run(graph.goals.cancel(CancelGoal(1, '/a'), 'page 1'))


class Slow:
    """Is true once it is released."""

    def __init__(self):
        self.released = threading.Event()

    def __bool__(self):
        return self.released.wait(PATIENCE)


def test_a_goal_that_is_accepted_too_late_is_cancelled(graph, monkeypatch):
    monkeypatch.setattr(action_goals, '_ANSWER_TIMEOUT', 0.1)
    graph.server.accepts = Slow()
    with pytest.raises(ViewerError, match='has not answered within 0.1 s'):
        graph.give()
    graph.server.accepts.released.set()
    until(lambda: graph.server.goals and graph.server.goals[0].is_cancel_requested)


def test_a_goal_ends_with_its_server(graph):
    graph.give()
    until(lambda: graph.server.goals)
    graph.find(replace(NAVIGATOR, action=None))
    assert graph.is_told(state='failed').text == '/a/navigate_to_pose has gone'


def test_without_a_server_the_goal_is_published(graph):
    graph.find(replace(NAVIGATOR, action=None))
    until(lambda: graph.goals._ends['/a'].goal.get_subscription_count())
    line = graph.give()
    assert line == 'the goal was published on /a/goal_pose: x 3.00 m, y 4.00 m in a/map'
    (pose,) = until(lambda: graph.heard)
    assert (pose.header.frame_id, pose.pose.position.x) == ('a/map', 3.0)
    graph.is_told(state='published')


def test_where_nobody_hears_it_is_said_so(graph):
    graph.find(replace(NAVIGATOR, action=None, goal=None))
    with pytest.raises(ViewerError, match='nothing hears goals of /a; is its navigation running'):
        graph.give()
    with pytest.raises(ViewerError, match='nothing hears poses of /a; is its localisation'):
        graph.call(graph.goals.set_initial_pose, SetInitialPose(1, '/a', 'map', 0, 0, 0), 0)
    with pytest.raises(ViewerError, match="nothing navigates '/b'"):
        graph.give(replace(GOAL, robot='/b'))
