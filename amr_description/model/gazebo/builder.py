# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the plugins of one robot become: joints, sensors, the body; controllers; lines to say."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
import math
import re
from typing import Any

from lxml import etree

from amr_description.model.base_interfaces import BASE, COMMAND_AXES, TRUTH, truth_prefix
from amr_description.model.gazebo.plugins import PluginElement, PluginTag
from amr_description.model.hardware_info import (
    ComponentInfo,
    ComponentType,
    HardwareInfo,
    HardwareType,
    InterfaceInfo,
)
from amr_description.model.robot import (
    held_without_commands,
    Joint,
    JointType,
    Limit,
    Robot,
    WORLD_LINK,
)
from amr_description.model.sensors import topic_in, WorldSensor
from amr_description.text import quote, quote_all

JOINTS = 'gazebo_plugins'
"""The name of the hardware component of joints and sensors."""
CLAIMED_JOINTS = 'simulated_joints'
"""Its name where it has joints that no tag commands, but controllers of parameter files."""
COMMAND = '~/cmd_vel'
"""What the controllers that drive call the topic of their commands."""
ODOMETRY = ('~/odom', '~/odometry')
"""What controllers call the topic of their odometry."""
BROADCASTER = 'joint_state_broadcaster/JointStateBroadcaster'
LEAST_RATE, HIGHEST_RATE = 100, 200
"""Hz, of the controller manager; it is raised for sensors that are faster."""

_NO_TAGS: Mapping[str, PluginTag] = {}
_STATES = ('position', 'velocity', 'effort')
_MODEL = re.compile(r'/?model/[^/]+/')
_NO_NAME = re.compile(r'\W', re.ASCII)


@dataclass(frozen=True, slots=True)
class PluginController:
    """
    A controller that stands for a plugin.

    Attributes:
        name: of the controller and its node: that of the plugin, if it can be one.
        type: of the controller.
        parameters: of its node; numbers, truth values, texts, lists of these.
        topics: what it calls its topics → what the plugin calls them.
        namespace: of these, if the robot is spawned without one.
        origin: the plugin or sensor, for messages.
        frames: the parameters that are frames and get the prefix of the robot's; the frames of
            odometry get theirs from the controller.
        line: of the plugin or sensor.
        tags: the elements that give some of the parameters, by the names of these.
    """

    name: str
    type: str
    parameters: Mapping[str, Any]
    topics: Mapping[str, str]
    namespace: str
    origin: str
    frames: frozenset[str] = frozenset()
    line: int = 0
    tags: Mapping[str, PluginTag] = field(default_factory=dict)

    def topics_in_use(self, namespace: str) -> list[str]:
        """Return the full names of the topics that it has, by its parameters."""
        unused = set()
        if not self.parameters.get('enable_odom_tf', True):
            unused.add('/tf')
        if not self.parameters.get('publish_odom', True):
            unused.update(ODOMETRY)
        names = self.names_of_topics(namespace)
        return list(dict.fromkeys(names[each] for each in names if each not in unused))

    def names_of_topics(self, namespace: str) -> dict[str, str]:
        """
        Return what it calls its topics → their full names.

        Args:
            namespace: of its node; see :func:`~amr_description.model.sensors.topic_in`.
        """
        own = f'{namespace.rstrip("/")}/{self.name}'

        def full_name(topic: str) -> str:
            if topic.startswith('~'):
                return f'{own}{topic[1:]}'
            return topic_in(namespace, topic, self.namespace)

        return {before: full_name(after) for before, after in self.topics.items()}


@dataclass(frozen=True, slots=True)
class GazeboTranslation:
    """
    What stands for the plugins of a robot.

    Attributes:
        robot: the robot with that hardware, and with the wheels' torques limited as a plugin says.
        controllers: to be active as soon as the robot is spawned, as plugins are.
        update_rate: that the controllers need, Hz.
        notes: what is to be warned of, one line each.
        remarks: what is worth to be known, one line each.
        not_simulated: one line that names what is declared and not simulated; '' if nothing is.
        sensors: lidars, cameras and contact sensors, which publish by themselves.
        faults: lines of the description, and the notes of what cannot work there.
    """

    robot: Robot
    controllers: tuple[PluginController, ...] = ()
    update_rate: int = LEAST_RATE
    notes: tuple[str, ...] = ()
    not_simulated: str = ''
    remarks: tuple[str, ...] = ()
    sensors: tuple[WorldSensor, ...] = ()
    faults: tuple[tuple[int, str], ...] = ()

    def twist_topic(self, namespace: str) -> str:
        """Return the topic of ``geometry_msgs/msg/Twist`` that drives the robot; '': none does."""
        for each in self.controllers:
            if COMMAND in each.topics:
                return each.names_of_topics(namespace)[COMMAND]
        return ''

    def odometry_topic(self, namespace: str) -> str:
        """Return the topic of its first odometry; '': there is none."""
        for each in self.controllers:
            topics = each.names_of_topics(namespace)
            if each.parameters.get('publish_odom', True) and (found := {*topics} & {*ODOMETRY}):
                return topics[found.pop()]
        return ''

    def joint_states_topic(self, namespace: str) -> str:
        """Return the topic of its joint states; '': there is none."""
        found = (each for each in self.controllers if each.type == BROADCASTER)
        first = next(found, None)
        return '' if first is None else first.names_of_topics(namespace)['joint_states']


class Builder:
    """Collects what the plugins of one robot become."""

    def __init__(
        self,
        robot: Robot,
        hardware: Sequence[HardwareInfo],
        claimed: Callable[[], Collection[str]] = tuple,
    ) -> None:
        """``claimed``: returns the joints that controllers of parameter files may claim."""
        self.robot = robot
        self._claimed = claimed
        self._offered = {
            joint.name: {each.name for each in joint.command_interfaces}
            for info in hardware
            for joint in info.joints
        }
        self.is_controlled = bool(hardware)
        self.controlled = {joint.name for info in hardware for joint in info.joints}
        self.sensors = {sensor.name for info in hardware for sensor in info.sensors}
        self.notes: list[str] = []
        self.faults: list[tuple[int, str]] = []
        self.remarks: list[str] = []
        self.lacking: list[tuple[str, str, str]] = []
        """What is not simulated: sensor or plugin, its name, its type or library."""
        self.controllers: list[PluginController] = []
        self.instruments: dict[str, tuple[tuple[str, ...], Mapping[str, str]]] = {}
        """The state interfaces and parameters of sensors, by name."""
        self._commands: dict[str, tuple[str, ...]] = {}
        self._truths: list[str] = []
        self._moves_base = False
        self._are_claimed = False
        self._initial: dict[str, float] = {}
        self._torques: dict[str, float] = {}
        self._rates = [float(LEAST_RATE)]

    def can_drive(
        self, plugin: PluginElement, joints: Sequence[str], interface: str = 'velocity'
    ) -> bool:
        """
        Return whether a plugin may command joints; note why it may not.

        Those of ``<ros2_control>`` it may if that offers the interface, and no controller of the
        parameter files claims them: in Gazebo both live side by side.
        """
        movable = [each.name for each in self.robot.joints if each.has_position]
        lacking = [name for name in joints if name not in movable]
        theirs = [
            name for name in joints if name in self._commands or self._is_theirs(name, interface)
        ]
        if lacking or not joints:
            plugin.fail(
                f'there is no joint {quote_all(lacking)} that moves; there are: '
                f'{quote_all(movable) or "none"}'
                if lacking
                else 'it names no joints'
            )
        elif theirs:
            owner = '<ros2_control>' if theirs[0] in self.controlled else 'another plugin'
            plugin.note(f'it is left out: {owner} has the joints {quote_all(theirs)}')
        return not lacking and not theirs and bool(joints)

    def is_of_drive(self, joint: str) -> bool:
        """Return whether a plugin has a joint, or one that turns as that does: a wheel beside."""
        return joint in self._commands or bool(
            self._commands
            and self.robot.has_joint(joint)
            and self.robot.joint(joint).type is JointType.CONTINUOUS
        )

    def is_claimed(self, joint: str) -> bool:
        """Return whether controllers of parameter files may claim a joint."""
        return joint in self._claimed()

    def _is_theirs(self, joint: str, interface: str) -> bool:
        """Return whether a joint is left to ``<ros2_control>``."""
        if joint not in self.controlled:
            return False
        return interface not in self._offered[joint] or self.is_claimed(joint)

    def command(
        self,
        joints: Sequence[str],
        *interfaces: str,
        torque: float = math.inf,
        initial: float | None = None,
    ) -> None:
        """Give joints command interfaces, a largest torque, N·m, and an initial position."""
        for joint in joints:
            self._commands[joint] = (*self._commands.get(joint, ()), *interfaces)
            if initial is not None:
                self._initial[joint] = initial
            if 0.0 < torque < math.inf:
                self._torques[joint] = torque

    def move_base(self, plugin: PluginElement) -> bool:
        """Have the body as a whole commanded; return False, and note it, if it cannot be."""
        if self.robot.root.name == WORLD_LINK:
            plugin.fail(f'the robot is fixed by its link "{WORLD_LINK}"')
        elif self._moves_base:
            plugin.note('it is left out: another plugin moves the body')
        else:
            self._moves_base = True
            return True
        return False

    def truth(self, link: str) -> None:
        """Have the true motion of a link as state interfaces."""
        if link not in self._truths:
            self._truths.append(link)

    def add(
        self,
        kind: str,
        parameters: Mapping[str, Any],
        topics: Mapping[str, str],
        *,
        name: str,
        origin: str,
        namespace: str = '',
        frames: Collection[str] = (),
        line: int = 0,
        tags: Mapping[str, PluginTag] = _NO_TAGS,
    ) -> None:
        """Add a controller; ``kind`` is its type, the rest as in :class:`PluginController`."""
        rate = parameters.get('update_rate')
        if rate is not None:
            self._rates.append(rate)
        taken = {each.name for each in self.controllers} | {JOINTS, BASE, 'controller_manager'}
        free, number = name, 1
        while free in taken:
            number += 1
            free = f'{name}_{number}'
        self.controllers.append(
            PluginController(
                free, kind, parameters, topics, namespace, origin, frozenset(frames), line, tags
            )
        )

    def broadcast(
        self,
        plugin: PluginElement | None = None,
        joints: Sequence[str] = (),
        topic: str = 'joint_states',
        rate: float = 0.0,
    ) -> None:
        """Add the broadcaster; without a plugin, for the transforms of the wheels."""
        if self.is_controlled:
            return
        parameters: dict[str, Any] = {
            'publish_dynamic_joint_states': False,
            'frame_id': self.robot.root.name,
        }
        if joints:
            parameters |= {'joints': list(joints), 'interfaces': list(_STATES)}
        if rate > 0.0:
            parameters['update_rate'] = max(1, round(rate))
        self.add(
            BROADCASTER,
            parameters,
            {'joint_states': topic},
            name='joint_state_broadcaster'
            if plugin is None
            else node_name(plugin.name, 'joint_state_publisher'),
            origin='the transforms of its joints' if plugin is None else origin_of(plugin),
            namespace=self._namespace() if plugin is None else plugin.namespace,
        )

    def _namespace(self) -> str:
        """Return the namespace of the first plugin."""
        return next((each.namespace for each in self.controllers), '')

    def build(self, sensors: tuple[WorldSensor, ...] = ()) -> GazeboTranslation:
        """Return the whole, with sensors that publish by themselves."""
        moves = bool(self._commands or self._moves_base)
        moves &= any(joint.has_position for joint in self.robot.joints)
        if moves and not any(each.type == BROADCASTER for each in self.controllers):
            self.broadcast()
        self._leave_to_controllers()
        hardware = self._joint_hardware() + self._base_hardware()
        joints = [self._limited(joint.name) for joint in self.robot.joints]
        robot = self.robot
        if hardware or self._torques:
            robot = replace(robot, joints=tuple(joints), plugin_hardware=hardware)
        rate = min(HIGHEST_RATE, math.ceil(max(self._rates)))
        return GazeboTranslation(
            robot,
            tuple(self.controllers),
            rate,
            tuple(self.notes),
            _names_of(self.lacking),
            (*self.remarks, *self._lone_joints()),
            sensors,
            tuple(self.faults),
        )

    def _leave_to_controllers(self) -> None:
        """
        Let controllers command joints that neither ``<ros2_control>`` nor a plugin has.

        They are those that controllers of the parameter files claim, and with them those that are
        held while nobody commands the robot, so that it stands.
        """
        if self.is_controlled:
            return
        free = [
            each.name
            for each in self.robot.joints
            if each.has_position and each.mimic is None and each.name not in self._commands
        ]
        claimed = [name for name in free if self.is_claimed(name)]
        if not claimed:
            return
        held = held_without_commands(self.robot)
        self._are_claimed = True
        self.command([name for name in free if name in held or name in claimed], *_STATES)
        self.remarks.append(
            'there is no <ros2_control>: position, velocity and effort are simulated of the '
            f'joints that its controllers claim: {quote_all(claimed)}'
        )

    def _lone_joints(self) -> Sequence[str]:
        """Return a line about joints that nothing moves, if that is all of them."""
        joints = [joint.name for joint in self.robot.joints if joint.has_position]
        if self.is_controlled or self._commands or self._moves_base or not joints:
            return ()
        free = [name for name in joints if name not in held_without_commands(self.robot)]
        which = f'; its joints are free, as there: {quote_all(free)}' if free else ''
        lacks = 'there is no <ros2_control>, and no drive plugin of Gazebo'
        return (f'nothing drives it: {lacks}{which}',)

    def _joint_hardware(self) -> tuple[HardwareInfo, ...]:
        joints = tuple(
            ComponentInfo(
                joint.name,
                ComponentType.JOINT,
                tuple(InterfaceInfo(each) for each in self._commands.get(joint.name, ())),
                self._states(joint.name),
                mimic=joint.mimic,
            )
            for joint in self.robot.joints
            if joint.has_position
            and (joint.name in self._commands or not self.is_controlled)
            and joint.name not in self.controlled  # it has the interfaces there
        )
        sensors = tuple(
            ComponentInfo(
                name,
                ComponentType.SENSOR,
                state_interfaces=tuple(InterfaceInfo(each) for each in interfaces),
                parameters=parameters,
            )
            for name, (interfaces, parameters) in self.instruments.items()
        )
        if not (self.controllers or self._are_claimed) or not (joints or sensors):
            return ()
        name, plugin = (
            CLAIMED_JOINTS if self._are_claimed else JOINTS,
            'amr_description/MujocoSystem',
        )
        return (HardwareInfo(name, HardwareType.SYSTEM, plugin, joints=joints, sensors=sensors),)

    def _states(self, joint: str) -> tuple[InterfaceInfo, ...]:
        initial = {'position': self._initial.get(joint)}
        return tuple(InterfaceInfo(each, initial_value=initial.get(each)) for each in _STATES)

    def _base_hardware(self) -> tuple[HardwareInfo, ...]:
        states = tuple(InterfaceInfo(each) for each in TRUTH)
        sensors = tuple(
            ComponentInfo(truth_prefix(link), ComponentType.SENSOR, state_interfaces=states)
            for link in self._truths
        )
        commands = tuple(InterfaceInfo(each) for each in COMMAND_AXES)
        gpios = (ComponentInfo(BASE, ComponentType.GPIO, commands),) if self._moves_base else ()
        if not sensors and not gpios:
            return ()
        plugin = 'amr_description/SimulatedBase'
        return (HardwareInfo(BASE, HardwareType.SYSTEM, plugin, sensors=sensors, gpios=gpios),)

    def _limited(self, name: str) -> Joint:
        """Return a joint, its torque limited as a plugin says."""
        joint = self.robot.joint(name)
        if name not in self._torques:
            return joint
        limit = joint.limit or Limit(-math.inf, math.inf, 0.0, 0.0)
        return replace(joint, limit=replace(limit, effort=self._torques[name]))


def _names_of(lacking: Sequence[tuple[str, str, str]]) -> str:
    """Return one line that names sensors by their type, and plugins by their library."""
    parts = []
    for what in ('sensor', 'plugin'):
        kinds: dict[str, list[str]] = {}
        for each, name, kind in lacking:
            if each == what:
                names = kinds.setdefault(kind or 'without a type', [])
                if (known := name or 'without a name') not in names:  # one plugin may stand often
                    names.append(known)
        if kinds:
            named = ', '.join(f'{kind} ({", ".join(names)})' for kind, names in kinds.items())
            count = sum(map(len, kinds.values()))
            parts.append(f'{what}{"s" if count > 1 else ""} {named}')
    return f'declared for Gazebo and not simulated: {"; ".join(parts)}' if parts else ''


def node_name(name: str, default: str) -> str:
    """Return a plugin's name as that of a node; the default if it has blanks, colons or none."""
    if _NO_NAME.search(name) or not name or name[0].isdigit():
        return default
    return name


def origin_of(plugin: PluginElement) -> str:
    """Return what a plugin is called in messages."""
    return f'plugin {quote(plugin.name or plugin.filename)}'


def gz_sensor_topic(sensor: etree._Element) -> str:
    """
    Return the topic of a sensor of new Gazebo as it is usually bridged; '' if the tag names none.

    With and without a leading slash it is the same one there; here it is in the robot's namespace.
    """
    topic = gz_topic(PluginElement(sensor), 'topic', '').strip('/')
    return '' if topic == '__default_topic__' else topic


def gz_topic(plugin: PluginElement, element: str, default: str) -> str:
    """Return a topic of new Gazebo as it is usually bridged to ROS."""
    given = _MODEL.sub('', plugin.text(element), count=1)
    return 'odom' if given == 'odometry' and default == 'odom' else given or default
