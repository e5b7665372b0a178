# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The names of the ROS graph as discovery (viewer/graph.py) wants them.

The viewer's side towards ROS: looks at the graph, and connects with what is there.

Everything here runs on the ROS thread. What the server's thread reads, :attr:`GraphMonitor.links`,
:attr:`GraphMonitor.found` and ``states.scene``, is replaced as a whole and never changed.
"""

from collections.abc import Callable, Mapping

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.timer import Timer
from visualization_msgs.msg import MarkerArray

from amr_description.viewer.graph import (
    ACTIVITY,
    discover,
    DYNAMIC_JOINT_STATE,
    Found,
    FoundRobot,
    JOINT_STATE,
    MARKERS,
    Names,
    ODOMETRY,
    STATISTICS_VALUES,
    STRING,
    TF,
    TWISTS,
)
from amr_description.viewer.ros.robot import RobotLink, WorldLink
from amr_description.viewer.ros.robot_topics import Frames
from amr_description.viewer.ros.service_clients import clients_of, manager_clients, Services
from amr_description.viewer.ros.states import RosClock, Scene, States

_PUBLISHED = {
    ACTIVITY,
    DYNAMIC_JOINT_STATE,
    JOINT_STATE,
    MARKERS,
    ODOMETRY,
    STATISTICS_VALUES,
    STRING,
    TF,
}
_HEARD = {JOINT_STATE, *TWISTS}


def names_in(node: Node) -> Names:
    """Return what others publish, hear and serve, as far as it may matter to a page."""
    published, heard = {}, {}
    for topic, types in node.get_topic_names_and_types():
        if not _PUBLISHED.isdisjoint(types) and node.count_publishers(topic):
            published[topic] = types
        if not _HEARD.isdisjoint(types):
            wanted = {
                each.topic_type
                for each in node.get_subscriptions_info_by_topic(topic)
                if (each.node_name, each.node_namespace) != (node.get_name(), node.get_namespace())
            }
            if wanted:
                heard[topic] = sorted(wanted)
    return Names(published, heard, dict(node.get_service_names_and_types()))


_PERIOD = 0.5
"""s between two looks at the graph."""


class GraphObserver:
    """Whom the stage tells; all is called on the ROS thread, and does nothing by default."""

    def graph_changed(self) -> None:
        """Robots, simulators or what they have: see ``found`` and ``links``."""

    def model_came(self, link: RobotLink) -> None:
        """The description of a robot came, or changed."""

    def controllers_changed(self, robot: str) -> None:
        """A controller or hardware component has another state."""

    def world_came(self, simulator: str, message: MarkerArray) -> None:
        """The surroundings came, or changed."""

    def diagnostics_came(self, message: DiagnosticArray) -> None:
        """Somebody said how it is."""


class GraphMonitor:
    """Closed at first: nothing is subscribed."""

    def __init__(self, node: Node, states: States, services: Services) -> None:
        self.audience = GraphObserver()
        self.found = Found()
        self.links: Mapping[str, RobotLink] = {}
        self._node = node
        self._states = states
        self._services = services
        self._worlds: dict[str, WorldLink] = {}
        self._session = 0
        self._described: dict[str, str] = {}
        self._timer: Timer | None = None
        self._diagnostics: Subscription | None = None
        self._clock: RosClock | None = None
        self._frames: Frames | None = None

    def attend(self, session: int) -> None:
        """Be open for this session, which is told everything anew; 0: be closed."""
        if session == self._session:
            return
        self._session = session
        self._close()
        if session:
            self._open()

    def describe(self, robot: str, text: str) -> None:
        """Take this for the description of a robot that nobody else describes."""
        self._described[robot] = text
        if self._timer is not None:
            self._look()

    def _open(self) -> None:
        """Connect with what is there, and go on looking."""
        node = self._node
        self._clock, self._frames = RosClock(node), Frames(node)
        self._diagnostics = node.create_subscription(
            DiagnosticArray, '/diagnostics', lambda m: self.audience.diagnostics_came(m), 10
        )
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD, self._look, clock=steady)
        self._set_scene()
        self._look()
        self.audience.graph_changed()

    def _close(self) -> None:
        """Part with everything."""
        if self._timer is None or self._clock is None or self._frames is None:
            return
        self._states.scene = None
        self._node.destroy_timer(self._timer)
        self._timer = None
        self._node.destroy_subscription(self._diagnostics)
        self._clock.destroy()
        self._frames.destroy()
        self._follow(Found())

    def _look(self) -> None:
        """See whether the graph has changed."""
        self._forget_dead_clock()
        found = discover(names_in(self._node), self._described)
        if found != self.found:
            self._follow(found)
            self._set_scene()
            self.audience.graph_changed()

    def _forget_dead_clock(self) -> None:
        """Let no command carry the time of a simulation that is gone: robots take it for old."""
        if self._clock is not None and not self._node.count_publishers('/clock'):
            self._clock.time = None

    def _follow(self, found: Found) -> None:
        self._services.keep(_clients(found))
        links = {each.id: self._link(each) for each in found.robots}
        gone = [link for name, link in self.links.items() if name not in links]
        is_other_tree = bool(gone) or found.trees != self.found.trees
        self.links, self.found = links, found
        for link in gone:
            link.destroy()
            self._described.pop(link.found.id, None)
        for name, link in links.items():
            if link.described is None and name in self._described:
                link.describe(self._described[name])
        worlds = {each.id: each.world for each in found.simulators if each.world}
        for name in [*self._worlds]:
            if worlds.get(name) != self._worlds[name].topic:
                self._worlds.pop(name).destroy()
        for name, topic in worlds.items():
            if name not in self._worlds:
                self._worlds[name] = WorldLink(self._node, topic, self._teller(name))
        if is_other_tree and self._timer is not None:  # frames that are gone would stay for ever
            assert self._frames is not None, 'they are there while it is open'
            self._frames.destroy()
            self._frames = Frames(self._node, found.trees)

    def _link(self, found: FoundRobot) -> RobotLink:
        link = self.links.get(found.id)
        if link is None:
            return RobotLink(
                self._node,
                found,
                self._model_came,
                lambda link: self.audience.controllers_changed(link.found.id),
            )
        if link.found != found:
            link.follow(found)
        return link

    def _teller(self, simulator: str) -> Callable[[MarkerArray], None]:
        return lambda message: self.audience.world_came(simulator, message)

    def _model_came(self, link: RobotLink) -> None:
        self._set_scene()
        self.audience.model_came(link)
        self.audience.graph_changed()

    def _set_scene(self) -> None:
        assert self._clock and self._frames, 'they are there while it is open'
        robots = tuple(link.topics for link in self.links.values())
        self._states.scene = Scene(self._clock, self._frames, robots)


def _clients(found: Found) -> dict[str, type]:
    wanted: dict[str, type] = {}
    for simulator in found.simulators:
        wanted |= clients_of(simulator.id, simulator.services)
    for robot in found.robots:
        if robot.manager is not None:
            wanted |= manager_clients(robot.manager)
    return wanted
