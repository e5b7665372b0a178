# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What of a ROS graph is a robot, and which of its topics mean what.

Pure: names and types in, names out. A robot is whatever has a ``robot_description``, in whatever
namespace; what lies below a namespace belongs to the robot of the longest one that fits.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

from amr_description.viewer.protocol import Command

STRING = 'std_msgs/msg/String'
TWISTS = ('geometry_msgs/msg/TwistStamped', 'geometry_msgs/msg/Twist')
"""Of a topic of both, the first is taken."""
JOINT_STATE = 'sensor_msgs/msg/JointState'
ODOMETRY = 'nav_msgs/msg/Odometry'
DYNAMIC_JOINT_STATE = 'control_msgs/msg/DynamicJointState'
TF = 'tf2_msgs/msg/TFMessage'
MARKERS = 'visualization_msgs/msg/MarkerArray'
ACTIVITY = 'controller_manager_msgs/msg/ControllerManagerActivity'
STATISTICS_VALUES = 'pal_statistics_msgs/msg/StatisticsValues'
LIST_CONTROLLERS = 'controller_manager_msgs/srv/ListControllers'
SET_SIMULATION_STATE = 'simulation_interfaces/srv/SetSimulationState'

type Types = Mapping[str, Iterable[str]]
"""Name of a topic or service → its types."""


@dataclass(frozen=True, slots=True)
class Names:
    """What the graph has: ``published`` and ``heard`` are topics by direction, with types."""

    published: Types = field(default_factory=dict)
    heard: Types = field(default_factory=dict)
    services: Types = field(default_factory=dict)

    def publishes(self, topic: str, kind: str) -> str | None:
        """Return the topic, if somebody publishes this type on it."""
        return topic if kind in self.published.get(topic, ()) else None


@dataclass(frozen=True, slots=True)
class FoundRobot:
    """A robot by its namespace, ``/`` or ``/robot1``, and its topics and nodes."""

    id: str
    description: str
    command: Command | None
    odometry: str | None
    truth: str | None
    wheels: str | None
    joint_states: str | None
    joint_publisher: str | None
    manager: str | None
    activity: str | None
    introspection: str | None
    """``…/introspection_data`` of its controller manager: below it are ``names``, ``values``."""


@dataclass(frozen=True, slots=True)
class FoundSimulator:
    """A simulator by its node; ``world``: where it publishes its surroundings."""

    id: str
    world: str | None
    services: frozenset[str]


@dataclass(frozen=True, slots=True)
class Found:
    """
    All robots and simulators, by name.

    ``trees``: namespaces with a TF of their own, such as ``/robot1`` of ``/robot1/tf``.
    """

    robots: tuple[FoundRobot, ...] = ()
    simulators: tuple[FoundSimulator, ...] = ()
    trees: tuple[str, ...] = ()


def discover(names: Names, described: Iterable[str] = ()) -> Found:
    """
    Return what there is to see.

    ``described``: the ids of robots whose description is known otherwise; they are there as long
    as their truth is.
    """
    ids = {
        topic.removesuffix('robot_description').rstrip('/') or '/'
        for topic, types in names.published.items()
        if topic.endswith('/robot_description') and STRING in types
    }
    ids |= {each for each in described if _truth(names, each)}
    robots = tuple(_robot(names, each, lambda name: owner(name, ids)) for each in sorted(ids))
    simulators = tuple(
        FoundSimulator(
            service.rpartition('/')[0],
            names.publishes(f'{service.rpartition("/")[0]}/world', MARKERS),
            frozenset(_below(service.rpartition('/')[0], names.services)),
        )
        for service, types in sorted(names.services.items())
        if SET_SIMULATION_STATE in types
    )
    return Found(robots, simulators, _trees(names))


def owner(name: str, ids: Iterable[str]) -> str | None:
    """Return the robot whose namespace a name is in; of several, the deepest."""
    fitting = [each for each in ids if each == '/' or name.startswith(f'{each}/')]
    return max(fitting, key=len, default=None)


def _trees(names: Names) -> tuple[str, ...]:
    places = {
        topic.rpartition('/')[0]
        for topic, types in names.published.items()
        if TF in types and topic.rpartition('/')[2] in ('tf', 'tf_static')
    }
    return tuple(sorted(places - {''}))


def _robot(names: Names, robot: str, owner_of: Callable[[str], str | None]) -> FoundRobot:
    place = robot.rstrip('/')

    def own(names: Types, kind: str) -> list[str]:
        return [name for name, types in names.items() if kind in types and owner_of(name) == robot]

    odometries = [
        topic for topic in own(names.published, ODOMETRY) if '/ground_truth/' not in topic
    ]
    publishers = [
        topic for topic in own(names.heard, JOINT_STATE) if topic.endswith('/set_joint_positions')
    ]
    managers = [
        name.rpartition('/')[0]
        for name in own(names.services, LIST_CONTROLLERS)
        if name.endswith('/list_controllers')
    ]
    manager = _first(managers)
    return FoundRobot(
        id=robot,
        description=f'{place}/robot_description',
        command=_command(own, names),
        odometry=_first(odometries, f'{place}/odom'),
        truth=_truth(names, robot),
        wheels=names.publishes(f'{place}/ground_truth/wheels', DYNAMIC_JOINT_STATE),
        joint_states=names.publishes(f'{place}/joint_states', JOINT_STATE),
        joint_publisher=(_first(publishers) or '').removesuffix('/set_joint_positions') or None,
        manager=manager,
        activity=names.publishes(f'{manager}/activity', ACTIVITY),
        introspection=_introspection(names, f'{manager}/introspection_data'),
    )


def _truth(names: Names, robot: str) -> str | None:
    return names.publishes(f'{robot.rstrip("/")}/ground_truth/odom', ODOMETRY)


def _introspection(names: Names, place: str) -> str | None:
    return place if names.publishes(f'{place}/values', STATISTICS_VALUES) else None


def _command(own: Callable[[Types, str], list[str]], names: Names) -> Command | None:
    """A topic of velocities that somebody hears; best one called cmd_vel, and stamped."""
    choices = [
        (not topic.endswith('/cmd_vel'), rank, len(topic), topic)
        for rank, kind in enumerate(TWISTS)
        for topic in own(names.heard, kind)
    ]
    if not choices:
        return None
    _, rank, _, topic = min(choices)
    return Command(topic, TWISTS[rank])


def _first(names: list[str], preferred: str = '') -> str | None:
    """The preferred one, or the shortest."""
    return min(names, key=lambda name: (name != preferred, len(name), name), default=None)


def _below(node: str, services: Types) -> list[str]:
    return [name for name in services if name.startswith(f'{node}/')]
