# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The backend's part on the ROS thread: what the server's thread has done there, and is told of.

Neither thread calls the other: :class:`RosCalls` gives tasks to the executor,
:class:`GraphReporter` calls to the server.
"""

from collections.abc import Callable, Sequence, Set as AbstractSet
from functools import partial
import time
from typing import Protocol

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import Executor
from visualization_msgs.msg import MarkerArray

from amr_description.viewer.backend import Watched
from amr_description.viewer.joint_groups import ControllerJoints
from amr_description.viewer.protocol import RobotInfo, SensorInfo, World
from amr_description.viewer.requests import Part
from amr_description.viewer.ros.goals import Goals
from amr_description.viewer.ros.graph_monitor import GraphMonitor, GraphObserver
from amr_description.viewer.ros.introspection import GraphMessage
from amr_description.viewer.ros.markers import LatestDiagnostics, shapes_of
from amr_description.viewer.ros.robot import RobotConnection, still_held
from amr_description.viewer.ros.spawned_robots import SpawnedRobots
from amr_description.viewer.server import Server


class RosCalls:
    """
    What the server's thread has done on the ROS thread.

    rclpy runs tasks in any order. So a task passes on what is wanted when it runs, not when it was
    asked for.
    """

    def __init__(self, executor: Executor, monitor: GraphMonitor, spawned: SpawnedRobots) -> None:
        self._executor = executor
        self._monitor = monitor
        self._spawned = spawned
        self._session_count = 0
        self._session = 0
        """From the first page's connection to the last one's end; 0: no pages."""
        self._watched = Watched()
        self.held: frozenset[str] = frozenset()
        """The robots that are held at rest; replaced as a whole."""

    def open(self) -> None:
        """Open a session with the graph."""
        self._session_count += 1
        self._set_session(self._session_count)

    def close(self) -> None:
        """Close it."""
        self._set_session(0)

    def _set_session(self, session: int) -> None:
        self._session = session
        self._executor.create_task(lambda: self._monitor.set_session(self._session))

    def watch(self, watched: Watched) -> None:
        """Collect what pages watch."""
        self._watched = watched
        self._executor.create_task(lambda: self._monitor.watch(self._watched))

    def hold(self, robots: AbstractSet[str]) -> None:
        """Answer commands of others for these robots, and no others."""
        self.held = frozenset(robots)
        self._executor.create_task(lambda: self._monitor.hold(self.held))

    def set_groups(self, robot: str, groups: Sequence[ControllerJoints]) -> None:
        """Advertise what moves joints of a robot, unless it has gone in the meantime."""
        self._executor.create_task(self._monitor.set_groups, robot, groups)

    def describe(self, robot: str, urdf: str) -> None:
        """Publish the description of a robot that a page has spawned."""
        self._executor.create_task(self._spawned.add, robot, urdf)

    def disconnect(self, warn: Callable[[str], object]) -> None:
        """
        Close the session, once the server has ended; on the ROS thread.

        ``warn`` logs which robots stay held: nobody may drive because this node has ended.
        """
        for name, robot in sorted(self._monitor.connections.items()):
            if name in self.held and (robot.is_locked or robot.deactivated):
                warn(still_held(robot))
        self._monitor.set_session(0)
        self._spawned.retain(())


class ServerSide(Protocol):
    """What is called on the server's thread when the graph has changed."""

    server: Server

    def set_graph(
        self,
        robots: Sequence[RobotInfo],
        simulators: Sequence[str],
        sensors: Sequence[SensorInfo],
    ) -> None:
        """Publish what there is."""

    def list_controllers(self, robot: str) -> None:
        """List the controllers of a robot anew."""

    def ask_for_world(self, simulator: str) -> None:
        """Ask a simulator which world it has: it may be another one."""


class GraphReporter(GraphObserver):
    """
    Tells the server's thread of changes of the graph.

    Args:
        monitor: watches the graph.
        side: is told, on its own thread.
        goals: follow what navigates.
        spawned: of the robots that nobody else describes.
    """

    def __init__(
        self,
        monitor: GraphMonitor,
        side: ServerSide,
        goals: Goals,
        spawned: SpawnedRobots,
    ) -> None:
        self._monitor = monitor
        self._side = side
        self._goals = goals
        self._spawned = spawned
        self._diagnostics = LatestDiagnostics()

    def graph_changed(self) -> None:
        """Publish the graph."""
        side, pages = self._side, self._side.server.pages
        connections, found = self._monitor.connections, self._monitor.found
        self._spawned.forget_deleted(found.robots)
        simulators = [each.id for each in found.simulators]
        infos = tuple(each.info for each in connections.values())
        self._call(lambda: pages.retain([*connections, *simulators]))
        self._goals.find(found.navigators, found.tf_namespaces)
        self._call(lambda: side.set_graph(infos, simulators, found.sensors))
        for name, each in connections.items():
            if each.found.manager:
                self.controllers_changed(name)

    def graph_polled(self) -> None:
        """Describe the robots of worlds that nobody describes."""
        spawned = [each for all in self._monitor.entities.spawned.values() for each in all]
        self._spawned.look(spawned, self._monitor.found.robots, time.monotonic())

    def description_changed(self, connection: RobotConnection) -> None:
        """Publish the description."""
        if (described := connection.described) is not None:
            robot, pages = connection.found.id, self._side.server.pages
            self._call(lambda: pages.publish(robot, described.message))

    def controllers_changed(self, robot: str) -> None:
        """List the controllers anew."""
        self._call(lambda: self._side.list_controllers(robot))

    def world_received(self, simulator: str, message: MarkerArray) -> None:
        """Publish the shapes of the world."""
        world, pages = World(simulator, shapes_of(message)), self._side.server.pages
        self._call(lambda: pages.publish(simulator, world))
        self._call(lambda: self._side.ask_for_world(simulator))

    def diagnostics_received(self, message: DiagnosticArray) -> None:
        """Publish the diagnostics of each robot."""
        present = [each.id for each in self._monitor.found.robots if each.is_present]
        pages = self._side.server.pages
        for each in self._diagnostics.update(message, present):
            self._call(partial(pages.publish, each.robot, each))

    def graph_shown(self, part: Part, message: GraphMessage) -> None:
        """Send news of the graph to the pages that show them."""
        pages = self._side.server.pages
        self._call(lambda: pages.send_to(part, message))

    def _call(self, callback: Callable[[], object]) -> None:
        self._side.server.call(callback)
