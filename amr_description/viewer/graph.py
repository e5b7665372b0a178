# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Finds the robots, simulators and sensors of a ROS graph, and what each of their topics means.

Pure: names and types in, names out. Every namespace with a ``robot_description`` is a robot. A
name belongs to the robot with the longest namespace that contains it.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Set as AbstractSet
from dataclasses import dataclass, field
from typing import TypeAlias

from amr_description.viewer.joint_groups import ACTIONS, is_joint_command, POSITIONS, TRAJECTORY
from amr_description.viewer.navigation import Navigator
from amr_description.viewer.protocol import Command, SensorInfo, SensorKind

STRING = 'std_msgs/msg/String'
TWISTS = ('geometry_msgs/msg/TwistStamped', 'geometry_msgs/msg/Twist')
"""Types of velocity commands; if a topic has subscribers of both, the first is used."""
JOINT_STATE = 'sensor_msgs/msg/JointState'
ODOMETRY = 'nav_msgs/msg/Odometry'
DYNAMIC_JOINT_STATE = 'control_msgs/msg/DynamicJointState'
TF = 'tf2_msgs/msg/TFMessage'
SPAWN_ENTITY = 'simulation_interfaces/msg/SpawnEntity'
MARKERS = 'visualization_msgs/msg/MarkerArray'
ENTITY_WRENCH = 'ros_gz_interfaces/msg/EntityWrench'
ACTIVITY = 'controller_manager_msgs/msg/ControllerManagerActivity'
STATISTICS_VALUES = 'pal_statistics_msgs/msg/StatisticsValues'
LIST_CONTROLLERS = 'controller_manager_msgs/srv/ListControllers'
GET_PARAMETERS = 'rcl_interfaces/srv/GetParameters'
SET_SIMULATION_STATE = 'simulation_interfaces/srv/SetSimulationState'
LASER_SCAN = 'sensor_msgs/msg/LaserScan'
CLOUD = 'sensor_msgs/msg/PointCloud2'
IMAGE = 'sensor_msgs/msg/Image'
COMPRESSED_IMAGE = 'sensor_msgs/msg/CompressedImage'
RANGE = 'sensor_msgs/msg/Range'
GZ_CONTACTS = 'ros_gz_interfaces/msg/Contacts'
CLASSIC_CONTACTS = 'gazebo_msgs/msg/ContactsState'
OCCUPANCY_GRID = 'nav_msgs/msg/OccupancyGrid'
PATH = 'nav_msgs/msg/Path'
MARKER = 'visualization_msgs/msg/Marker'
POSES = 'geometry_msgs/msg/PoseArray'
POLYGON = 'geometry_msgs/msg/PolygonStamped'
POINT = 'geometry_msgs/msg/PointStamped'
GOAL = 'geometry_msgs/msg/PoseStamped'
INITIAL_POSE = 'geometry_msgs/msg/PoseWithCovarianceStamped'
NAVIGATE = 'nav2_msgs/action/NavigateToPose'
NAVIGATE_FEEDBACK = f'{NAVIGATE}_FeedbackMessage'
"""What a server of the action publishes: its services have names for as long as it has clients."""
SENSORS: Mapping[str, SensorKind] = {
    LASER_SCAN: 'scan',
    CLOUD: 'cloud',
    IMAGE: 'picture',
    COMPRESSED_IMAGE: 'picture',
    RANGE: 'range',
    GZ_CONTACTS: 'contacts',
    CLASSIC_CONTACTS: 'contacts',
    OCCUPANCY_GRID: 'map',
    PATH: 'path',
    MARKER: 'markers',
    MARKERS: 'markers',
    POSES: 'poses',
    POLYGON: 'polygon',
    POINT: 'point',
}
"""Type of a topic -> how a page shows it."""
_OF_ALL = {OCCUPANCY_GRID, PATH, MARKER, MARKERS, POSES, POLYGON, POINT}
"""What need not be of a robot."""
_COMPRESSED = '/compressed'
"""What image_transport appends to the topic of the same pictures as JPEG or PNG."""
_GOALS = '/_action/send_goal'
_FEEDBACK = '/_action/feedback'

NamesAndTypes: TypeAlias = Mapping[str, Iterable[str]]
"""Name of a topic or service -> its types."""


@dataclass(frozen=True, slots=True)
class GraphNames:
    """The topics that are published, those that are subscribed to, and the services."""

    published: NamesAndTypes = field(default_factory=dict)
    subscribed: NamesAndTypes = field(default_factory=dict)
    services: NamesAndTypes = field(default_factory=dict)

    def if_published(self, topic: str, type_name: str) -> str | None:
        """Return the topic if it is published with this type, else None."""
        return topic if type_name in self.published.get(topic, ()) else None


@dataclass(frozen=True, slots=True)
class FoundRobot:
    """A robot: its namespace, ``/`` or ``/robot1``, and its topics and nodes; None: not there."""

    id: str
    description: str
    is_present: bool
    """False: only described, while a simulator runs that has no such robot; it was deleted, or is
    not spawned yet, or the description is but one of fixed frames."""
    command: Command | None
    odometry: str | None
    truth: str | None
    wheels: str | None
    joint_states: str | None
    joint_publisher: str | None
    manager: str | None
    activity: str | None
    introspection: str | None
    """``…/introspection_data`` of its controller manager, with ``/names`` and ``/values``."""
    joint_commands: tuple[Command, ...]
    """Topics and actions by which controllers may move joints."""
    drive_parameters: str | None = None
    """The service that gets parameters of the controller that takes the commands."""


@dataclass(frozen=True, slots=True)
class FoundSimulator:
    """A simulator: its node, the topic of its world's markers, and its services."""

    id: str
    world: str | None
    services: frozenset[str]
    hears_wrenches: bool
    """Whether it takes ``~/wrench/persistent``."""
    spawned: tuple[str, ...] = ()
    """Its topics that say with what it has spawned each entity."""


@dataclass(frozen=True, slots=True)
class DiscoveredGraph:
    """All robots and simulators, sorted by name."""

    robots: tuple[FoundRobot, ...] = ()
    simulators: tuple[FoundSimulator, ...] = ()
    tf_namespaces: tuple[str, ...] = ()
    """Namespaces with a TF of their own, such as ``/robot1`` of ``/robot1/tf``."""
    sensors: tuple[SensorInfo, ...] = ()
    navigators: tuple[Navigator, ...] = ()


def discover(names: GraphNames) -> DiscoveredGraph:
    """Find robots, simulators and sensors by the names of the graph."""
    ids = {
        topic.removesuffix('robot_description').rstrip('/') or '/'
        for topic, types in names.published.items()
        if topic.endswith('/robot_description') and STRING in types
    }
    simulators = tuple(_simulators(names))
    return DiscoveredGraph(
        tuple(
            _robot(names, each, lambda name: robot_of(name, ids), is_simulated=bool(simulators))
            for each in sorted(ids)
        ),
        simulators,
        _tf_namespaces(names),
        tuple(_sensors(names, ids, simulators)),
        tuple(_navigators(names, ids)),
    )


def robot_of(name: str, ids: Iterable[str]) -> str | None:
    """Return the id of the robot that a name belongs to: the longest namespace around it."""
    fitting = [each for each in ids if each == '/' or name.startswith(f'{each}/')]
    return max(fitting, key=len, default=None)


def _robot(
    names: GraphNames, robot: str, find_robot: Callable[[str], str | None], *, is_simulated: bool
) -> FoundRobot:
    namespace = robot.rstrip('/')

    def own(names: NamesAndTypes, type_name: str) -> list[str]:
        return [
            name
            for name, types in names.items()
            if type_name in types and find_robot(name) == robot
        ]

    odometries = [
        topic for topic in own(names.published, ODOMETRY) if '/ground_truth/' not in topic
    ]
    joint_states = [
        topic for topic in own(names.published, JOINT_STATE) if topic.endswith('/joint_states')
    ]
    joint_publishers = [
        topic.removesuffix('/set_joint_positions')
        for topic in own(names.subscribed, JOINT_STATE)
        if topic.endswith('/set_joint_positions')
    ]
    managers = [
        name.removesuffix('/list_controllers')
        for name in own(names.services, LIST_CONTROLLERS)
        if name.endswith('/list_controllers')
    ]
    manager = _shortest(managers)
    introspection = f'{manager}/introspection_data'
    truth, command = _truth(names, robot), _command(names, own)
    return FoundRobot(
        id=robot,
        description=f'{namespace}/robot_description',
        # Not its manager: a service has a name for as long as anybody has a client of it.
        is_present=not is_simulated or bool(truth or odometries or joint_states),
        command=command,
        odometry=_shortest(odometries, f'{namespace}/odom'),
        truth=truth,
        wheels=names.if_published(f'{namespace}/ground_truth/wheels', DYNAMIC_JOINT_STATE),
        joint_states=_shortest(joint_states, f'{namespace}/joint_states'),
        joint_publisher=_shortest(joint_publishers) or None,
        manager=manager,
        activity=names.if_published(f'{manager}/activity', ACTIVITY),
        introspection=introspection
        if names.if_published(f'{introspection}/values', STATISTICS_VALUES)
        else None,
        joint_commands=_joint_commands(names, own),
        drive_parameters=_drive_parameters(names, command),
    )


def _command(names: GraphNames, own: Callable[[NamesAndTypes, str], list[str]]) -> Command | None:
    """Choose among the topics with subscribers: first by the name cmd_vel, then stamped."""
    choices = [
        (not topic.endswith('/cmd_vel'), rank, len(topic), topic)
        for rank, type_name in enumerate(TWISTS)
        for topic in own(names.subscribed, type_name)
    ]
    if not choices:
        return None
    _, rank, _, topic = min(choices)
    return Command(topic, TWISTS[rank])


def _drive_parameters(names: GraphNames, command: Command | None) -> str | None:
    """Return the service by the topic ``~/cmd_vel`` or ``~/reference`` of a controller."""
    if command is None:
        return None
    service = f'{command.topic.rpartition("/")[0]}/get_parameters'
    return service if GET_PARAMETERS in names.services.get(service, ()) else None


def _joint_commands(
    names: GraphNames, own: Callable[[NamesAndTypes, str], list[str]]
) -> tuple[Command, ...]:
    found = [
        Command(topic, message)
        for message in (TRAJECTORY, POSITIONS)
        for topic in sorted(own(names.subscribed, message))
    ]
    # An action is, among others, a service for its goals.
    found += [
        Command(service.removesuffix(_GOALS), action)
        for action in ACTIONS
        for service in sorted(own(names.services, f'{action}_SendGoal'))
        if service.endswith(_GOALS)
    ]
    return tuple(each for each in found if is_joint_command(each.topic, each.message))


def _truth(names: GraphNames, robot: str) -> str | None:
    return names.if_published(f'{robot.rstrip("/")}/ground_truth/odom', ODOMETRY)


def _simulators(names: GraphNames) -> Iterator[FoundSimulator]:
    for service, types in sorted(names.services.items()):
        if SET_SIMULATION_STATE in types:
            node = service.rpartition('/')[0]
            services = frozenset(name for name in names.services if name.startswith(f'{node}/'))
            yield FoundSimulator(
                node,
                names.if_published(f'{node}/world', MARKERS),
                services,
                ENTITY_WRENCH in names.subscribed.get(f'{node}/wrench/persistent', ()),
                tuple(
                    sorted(
                        topic
                        for topic, published in names.published.items()
                        if SPAWN_ENTITY in published and topic.startswith(f'{node}/spawned/')
                    )
                ),
            )


def _sensors(
    names: GraphNames, ids: Iterable[str], simulators: Iterable[FoundSimulator]
) -> Iterator[SensorInfo]:
    """Yield the topics of sensors of robots that are published, each picture once."""
    worlds = {each.world for each in simulators}
    for topic, types in sorted(names.published.items()):
        message = next((each for each in types if each in SENSORS), None)
        robot = robot_of(topic, ids)
        if robot is None and message in _OF_ALL:
            robot = ''  # such as a map that all robots of a fleet have
        if topic in worlds:
            continue  # it is drawn as the world
        if message is None or robot is None or _is_shown_otherwise(names, topic, message):
            continue
        yield SensorInfo(topic, robot, SENSORS[message], message)


def _navigators(names: GraphNames, ids: AbstractSet[str]) -> Iterator[Navigator]:
    """Yield who hears of goals and poses; of one robot that is alone also by names outside it."""
    alone = next(iter(ids)) if len(ids) == 1 else None

    def ends_of(names: NamesAndTypes, type_name: str, end: str, robot: str) -> str | None:
        found = [
            name
            for name, types in names.items()
            if type_name in types
            and name.endswith(end)
            and (robot_of(name, ids) or alone) == robot
        ]
        return _shortest(found, f'{robot.rstrip("/")}{end}')

    for robot in sorted(ids):
        feedback = ends_of(
            names.published, NAVIGATE_FEEDBACK, f'/navigate_to_pose{_FEEDBACK}', robot
        )
        found = Navigator(
            robot,
            ends_of(names.subscribed, GOAL, '/goal_pose', robot),
            feedback and feedback.removesuffix(_FEEDBACK),
            ends_of(names.subscribed, INITIAL_POSE, '/initialpose', robot),
        )
        if found.goal or found.action or found.initial_pose:
            yield found


def _is_shown_otherwise(names: GraphNames, topic: str, message: str) -> bool:
    """
    Whether the same pictures come by a better topic.

    A compressed one is better, but for depths: image_transport offers ``…/compressed`` of those,
    too, and publishes nothing there. ``…/compressedDepth`` is no picture that a browser knows.
    """
    if message == COMPRESSED_IMAGE:
        raw = topic.removesuffix(_COMPRESSED)
        return (
            not topic.endswith(_COMPRESSED)
            and topic.endswith('compressedDepth')
            or ('depth' in raw and names.if_published(raw, IMAGE) is not None)
        )
    is_compressed = names.if_published(f'{topic}{_COMPRESSED}', COMPRESSED_IMAGE) is not None
    return message == IMAGE and 'depth' not in topic and is_compressed


def _tf_namespaces(names: GraphNames) -> tuple[str, ...]:
    namespaces = {
        topic.rpartition('/')[0]
        for topic, types in names.published.items()
        if TF in types and topic.rpartition('/')[2] in ('tf', 'tf_static')
    }
    return tuple(sorted(namespaces - {''}))


def _shortest(names: list[str], preferred: str = '') -> str | None:
    return min(names, key=lambda name: (name != preferred, len(name), name), default=None)
