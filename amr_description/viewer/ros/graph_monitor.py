# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Watches the ROS graph, and connects the viewer with its robots and simulators.

Everything here runs on the ROS thread, but for what a :class:`GraphView` has: that is all that the
server's thread uses, beside ``states.sources``. Both are replaced as a whole and never modified.
"""

from collections.abc import Mapping, Sequence, Set as AbstractSet
from dataclasses import replace
from functools import partial
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.srv import GetParameters
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.subscription import Subscription
from rclpy.timer import Timer
from visualization_msgs.msg import MarkerArray

from amr_description.viewer.backend import Watched
from amr_description.viewer.graph import (
    ACTIVITY,
    discover,
    DiscoveredGraph,
    DYNAMIC_JOINT_STATE,
    ENTITY_WRENCH,
    FoundRobot,
    GOAL,
    GraphNames,
    INITIAL_POSE,
    JOINT_STATE,
    MARKERS,
    NAVIGATE_FEEDBACK,
    ODOMETRY,
    SENSORS,
    SPAWN_ENTITY,
    STATISTICS_VALUES,
    STRING,
    TF,
    TWISTS,
)
from amr_description.viewer.joint_groups import ControllerJoints, POSITIONS, TRAJECTORY
from amr_description.viewer.protocol import Channel
from amr_description.viewer.requests import Part
from amr_description.viewer.ros.entity_topics import EntityTopics
from amr_description.viewer.ros.introspection import GraphMessage, Introspection
from amr_description.viewer.ros.pushing import Pushing
from amr_description.viewer.ros.robot import RobotConnection, WorldSubscription
from amr_description.viewer.ros.robot_topics import TransformTopics
from amr_description.viewer.ros.service_clients import (
    manager_service_types,
    ServiceClients,
    simulator_service_types,
)
from amr_description.viewer.ros.states import RosClock, StateAssembler, StateSources
from amr_description.viewer.ros.threads import GraphSnapshot
from amr_description.viewer.ros.topic_feeds import TopicFeeds
from amr_description.viewer.samples import Sample

_PUBLISHED_TYPES = {
    ACTIVITY,
    DYNAMIC_JOINT_STATE,
    JOINT_STATE,
    MARKERS,
    NAVIGATE_FEEDBACK,
    ODOMETRY,
    SPAWN_ENTITY,
    STATISTICS_VALUES,
    STRING,
    TF,
    *SENSORS,
}
_SUBSCRIBED_TYPES = {
    ENTITY_WRENCH,
    GOAL,
    INITIAL_POSE,
    JOINT_STATE,
    POSITIONS,
    TRAJECTORY,
    *TWISTS,
}
_PERIOD = 0.5
"""s between two polls of the graph."""


class GraphObserver:
    """Callbacks of :class:`GraphMonitor`, on the ROS thread; by default they do nothing."""

    def graph_changed(self) -> None:
        """``found``, ``connections`` or ``entities`` have changed."""

    def graph_polled(self) -> None:
        """The graph was looked at, and may be as before."""

    def description_changed(self, connection: RobotConnection) -> None:
        """The description of a robot was received, or has changed."""

    def controllers_changed(self, robot: str) -> None:
        """The state of a controller or hardware component has changed."""

    def world_received(self, simulator: str, message: MarkerArray) -> None:
        """The markers of a simulator's world were received."""

    def diagnostics_received(self, message: DiagnosticArray) -> None:
        """A message on /diagnostics was received."""

    def graph_shown(self, part: Part, message: GraphMessage) -> None:
        """There is news of a part that pages show of the graph itself."""


class GraphMonitor:
    """
    Connected with the graph while a session is open; nothing is subscribed at first.

    A session lasts from the first page's connection to the last one's end.
    """

    def __init__(self, node: Node, states: StateAssembler, services: ServiceClients) -> None:
        self.observer = GraphObserver()
        self.found = DiscoveredGraph()
        self.connections: Mapping[str, RobotConnection] = {}
        """By the id of the robot."""
        self.topics = TopicFeeds(node, states.time_at)
        self.introspection = Introspection(node, lambda *told: self.observer.graph_shown(*told))
        self.entities = EntityTopics(node, self._on_entities)
        self.snapshot = GraphSnapshot()
        self._node = node
        self._states = states
        self._services = services
        self._pushing: Mapping[str, Pushing] = {}
        """By the simulator."""
        self._held: AbstractSet[str] = frozenset()
        self._worlds: dict[str, WorldSubscription] = {}
        self._session = 0
        self._watched: AbstractSet[Part] = frozenset()
        self._timer: Timer | None = None
        self._diagnostics: Subscription | None = None
        self._clock: RosClock | None = None
        self._transforms: TransformTopics | None = None

    def set_session(self, session: int) -> None:
        """Open a session, which the observer is notified of everything anew; 0: close it."""
        if session == self._session:
            return
        self._session = session
        self._close()
        if session:
            self._open()

    def watch(self, watched: Watched) -> None:
        """Subscribe, of what is collected on demand, to these parts of all robots, and topics."""
        self._watched = watched.parts
        self.topics.watch(watched)
        self._watch_parts()

    def hold(self, robots: AbstractSet[str]) -> None:
        """Answer commands of others for these robots, which are held at rest, and no others."""
        self._held = robots
        for connection in self.connections.values():
            connection.look()
        self._answer_held()

    def set_groups(self, robot: str, groups: Sequence[ControllerJoints]) -> None:
        """Advertise what moves joints of a robot, unless it has gone."""
        if (connection := self.connections.get(robot)) is not None:
            connection.commands.set_groups(groups)

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """Return new samples of these channels, and of plotted values; on the server's thread."""
        return self.topics.take(wanted)

    def latest(self, part: Part) -> GraphMessage | None:
        """Return what a page that begins to show a part is sent at once; on any thread."""
        return self.introspection.latest(part)

    def _answer_held(self) -> None:
        for name, connection in self.connections.items():
            connection.answer(name in self._held)

    def _take_snapshot(self) -> None:
        self.snapshot = GraphSnapshot(
            self.found, self.connections, self._pushing, self.entities.spawned
        )

    def _watch_parts(self) -> None:
        parts = self._watched
        if self._timer is not None:
            self.introspection.watch(parts, self.found.tf_namespaces)
        for connection in self.connections.values():
            connection.watch(parts)

    def _open(self) -> None:
        node = self._node
        self._clock, self._transforms = RosClock(node), TransformTopics(node)
        self._diagnostics = node.create_subscription(
            DiagnosticArray, '/diagnostics', lambda m: self.observer.diagnostics_received(m), 10
        )
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD, self._poll, clock=steady)
        self._update_sources()
        self.introspection.open()
        self._poll()
        self.observer.graph_changed()

    def _close(self) -> None:
        if self._timer is None or self._clock is None or self._transforms is None:
            return
        self._states.sources = None
        self._node.destroy_timer(self._timer)
        self._timer = None
        self.introspection.close()
        self._node.destroy_subscription(self._diagnostics)
        self._transforms.destroy()
        self._connect(DiscoveredGraph())
        # Last: who reads /tf by stamps and not /clock would be told to use simulated time.
        self._clock.destroy()

    def _poll(self) -> None:
        """Compare the graph with what is connected."""
        self._forget_dead_clock()
        found = self._with_drawn(discover(names_in_graph(self._node)))
        if found != self.found:
            self._connect(found)
            self._update_sources()
            self.observer.graph_changed()
        for connection in self.connections.values():
            connection.look()
        self._watch_parts()  # of new robots, and of those whose layout is known by now
        self.topics.refresh()
        self.introspection.poll()
        self.observer.graph_polled()

    def _with_drawn(self, found: DiscoveredGraph) -> DiscoveredGraph:
        """Keep the topics of markers whose publishers have gone: what they drew stays."""
        topics = {each.topic for each in found.sensors}
        robots = {'', *(each.id for each in found.robots)}
        kept = [
            each
            for each in self.topics.drawn()
            if each.topic not in topics and each.robot in robots
        ]
        return replace(found, sensors=(*found.sensors, *kept)) if kept else found

    def file(self, name: str) -> Path | bytes | None:
        """Return a mesh that a marker names; on the server's thread."""
        return self.topics.file(name)

    def _forget_dead_clock(self) -> None:
        """Stamp no command with the time of a simulation that has ended: it would be too old."""
        if self._clock is not None and not self._node.count_publishers('/clock'):
            self._clock.time = None

    def _connect(self, found: DiscoveredGraph) -> None:
        """Connect with what is found, and disconnect from what is not found any more."""
        self._services.set_services(_service_types(found))
        connections = {each.id: self._connection(each) for each in found.robots}
        gone = [each for name, each in self.connections.items() if name not in connections]
        left = _present(self.found) - _present(found)
        has_other_frames = bool(left) or found.tf_namespaces != self.found.tf_namespaces
        self.connections, self.found = connections, found
        self._take_snapshot()  # before those that have gone are destroyed
        for connection in gone:
            connection.destroy()
        self.topics.find(found.sensors)
        self._connect_worlds({each.id: each.world for each in found.simulators if each.world})
        self.entities.find({each.id: each.spawned for each in found.simulators})
        self._connect_pushing({each.id for each in found.simulators if each.hears_wrenches})
        self._take_snapshot()
        self._answer_held()
        if has_other_frames and self._timer is not None:  # the frames of a robot never expire
            assert self._transforms is not None, 'a session is open'
            self._transforms.destroy()
            self._transforms = TransformTopics(self._node, found.tf_namespaces)

    def _connection(self, found: FoundRobot) -> RobotConnection:
        connection = self.connections.get(found.id)
        if connection is None:
            return RobotConnection(
                self._node,
                found,
                self._on_description,
                lambda each: self.observer.controllers_changed(each.found.id),
            )
        if connection.found != found:
            connection.update(found)
        return connection

    def _connect_worlds(self, topics: Mapping[str, str]) -> None:
        """Subscribe to the worlds of these simulators, and to no others."""
        for name in [*self._worlds]:
            if topics.get(name) != self._worlds[name].topic:
                self._worlds.pop(name).destroy()
        for name, topic in topics.items():
            if name not in self._worlds:
                callback = partial(self._on_world, name)
                self._worlds[name] = WorldSubscription(self._node, topic, callback)

    def _connect_pushing(self, simulators: AbstractSet[str]) -> None:
        """Have publishers of wrenches for these simulators, and for no others."""
        before = self._pushing
        if before.keys() != simulators:
            self._pushing = {
                name: before.get(name) or Pushing(self._node, name) for name in simulators
            }
            for name in before.keys() - simulators:
                before[name].destroy()

    def _on_entities(self) -> None:
        self._take_snapshot()
        self.observer.graph_changed()

    def _on_world(self, simulator: str, message: MarkerArray) -> None:
        self.observer.world_received(simulator, message)

    def _on_description(self, connection: RobotConnection) -> None:
        self._update_sources()
        self.observer.graph_changed()  # first: it has the robot's name
        self.observer.description_changed(connection)

    def _update_sources(self) -> None:
        assert self._clock and self._transforms, 'a session is open'
        robots = tuple(each.topics for each in self.connections.values())
        self._states.sources = StateSources(self._clock, self._transforms, robots)


def _present(graph: DiscoveredGraph) -> set[str]:
    return {each.id for each in graph.robots if each.is_present}


def names_in_graph(node: Node) -> GraphNames:
    """Return the names of the graph with the types that pages use, without ``node``'s own."""
    published, subscribed = {}, {}
    for topic, types in node.get_topic_names_and_types():
        if not _PUBLISHED_TYPES.isdisjoint(types) and node.count_publishers(topic):
            published[topic] = types
        if not _SUBSCRIBED_TYPES.isdisjoint(types):
            expected = {
                each.topic_type
                for each in node.get_subscriptions_info_by_topic(topic)
                if (each.node_name, each.node_namespace) != (node.get_name(), node.get_namespace())
            }
            if expected:
                subscribed[topic] = sorted(expected)
    return GraphNames(published, subscribed, dict(node.get_service_names_and_types()))


def _service_types(found: DiscoveredGraph) -> dict[str, type]:
    types: dict[str, type] = {}
    for simulator in found.simulators:
        types |= simulator_service_types(simulator.id, simulator.services)
    for robot in found.robots:
        if robot.manager is not None:
            types |= manager_service_types(robot.manager)
        if robot.drive_parameters is not None:
            types[robot.drive_parameters] = GetParameters
    return types
