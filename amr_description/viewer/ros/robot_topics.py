# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics of everything that moves, polled when the page's server assembles a state.

Created and destroyed on the ROS thread, polled on the server's thread.
"""

from collections.abc import Callable, Iterator, Sequence, Set as AbstractSet
import math
from time import monotonic
from typing import Any

from control_msgs.msg import DynamicJointState
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from pal_statistics_msgs.msg import StatisticsNames, StatisticsValues
from rclpy.node import Node
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.qos import LATCHED, TF_STATIC
from amr_description.ros.readers import (
    DYNAMIC_JOINT_STATE,
    InterfaceValues,
    JOINT_STATE,
    JointValues,
    ODOMETRY,
    STATISTICS_NAMES,
    STATISTICS_VALUES,
    TRANSFORMS,
    TWIST,
    TWIST_STAMPED,
)
from amr_description.viewer.graph import FoundRobot, TWISTS
from amr_description.viewer.protocol import FrameInfo, RobotAges, RobotLayout
from amr_description.viewer.requests import Part
from amr_description.viewer.ros.command_topic import CommandTopic, NO_TWIST
from amr_description.viewer.states import Floats, RobotFloats

COMMAND_TYPES = dict(zip(TWISTS, (TwistStamped, Twist), strict=True))
_DEAD = 1.0
"""s without a message after which values are not known any more, if nobody publishes the topic."""
_RECENT = 0.5
"""s for which a velocity says whether the robot moves."""
_STILL_LINEAR, _STILL_ANGULAR = 0.01, 0.03
"""m/s and rad/s below which a robot is at rest."""
_STILL_JOINT = 0.1
"""rad/s below which a wheel is."""
_LINEAR, _ANGULAR, _LATERAL = 7, 8, 9
"""Where an odometry has its velocities."""
WHEEL_VALUES = ('contact', 'normal_force', 'slip_along', 'slip_across')


class TransformTopics:
    """
    /tf and /tf_static: the tree of frames, and their latest poses.

    Robots with a TF of their own, such as ``/robot1/tf``, use the same frame names as others. Here
    these frames get the prefix ``robot1/``, as they would on a shared ``/tf``.
    """

    def __init__(self, node: Node, namespaces: Sequence[str] = ()) -> None:
        """Subscribe; ``namespaces``: those with a TF of their own."""
        self._topics: list[tuple[str, PolledTopic[Any]]] = []
        for namespace in ('', *namespaces):
            static, moving = f'{namespace}/tf_static', f'{namespace}/tf'
            prefix = f'{namespace[1:]}/' if namespace else ''
            self._topics += [
                (prefix, PolledTopic(node, TFMessage, static, TRANSFORMS.reader(), qos=TF_STATIC)),
                (prefix, PolledTopic(node, TFMessage, moving, TRANSFORMS.reader(), depth=100)),
            ]
        self._poses: dict[str, tuple[float, ...]] = {}
        self._parents: dict[str, str] = {}
        self._came: float | None = None

    def destroy(self) -> None:
        """Unsubscribe."""
        for _, topic in self._topics:
            topic.destroy()

    def take(self) -> tuple[set[str], bool]:
        """Poll the topics; return the frames with a new pose, and whether the tree has changed."""
        moved: set[str] = set()
        is_changed = False
        for prefix, topic in self._topics:
            while (transforms := topic.take()) is not None:
                if not topic.topic.endswith('/tf_static'):
                    self._came = monotonic()
                for each in transforms:
                    name, parent = _prefixed(prefix, each.name), _prefixed(prefix, each.parent)
                    is_changed |= self._parents.get(name) != parent
                    self._parents[name] = parent
                    self._poses[name] = each.pose
                    moved.add(name)
        return moved, is_changed

    def age(self, now: float) -> float | None:
        """Return that of the latest transform that moves, s; ``now`` of a monotonic clock."""
        return None if self._came is None else now - self._came

    def pose(self, name: str) -> tuple[float, ...]:
        """Return the latest pose of a frame in its parent: x y z (m), qx qy qz qw."""
        return self._poses[name]

    def tree(self) -> tuple[FrameInfo, ...]:
        """Return the frames, parents before children, without those that form a loop."""
        children: dict[str, list[str]] = {}
        for name, parent in self._parents.items():
            children.setdefault(parent, []).append(name)
        pending = sorted(parent for parent in children if parent not in self._parents)
        frames: list[FrameInfo] = []
        while pending:
            parent = pending.pop(0)
            below = sorted(children.get(parent, ()))
            frames += [FrameInfo(name, parent) for name in below]
            pending += below
        return tuple(frames)


def _prefixed(prefix: str, name: str) -> str:
    return name if name.startswith(prefix) else f'{prefix}{name}'


class CommandedVelocities:
    """
    The command interfaces ``<joint>/velocity``, from the introspection topics of a manager.

    ``names`` has the names, rarely; ``values`` the values, after every cycle. The manager
    publishes them while there are subscribers. Polled like a :class:`PolledTopic`.

    Args:
        node: of the viewer.
        prefix: of the two topics, ``…/introspection_data``.
        joints: whose commands are wanted.
    """

    def __init__(self, node: Node, prefix: str, joints: Sequence[str]) -> None:
        self._wanted = [f'command_interface.{joint}/velocity' for joint in joints]
        self._names = PolledTopic(
            node, StatisticsNames, f'{prefix}/names', STATISTICS_NAMES.reader(), qos=LATCHED
        )
        self._values = PolledTopic(
            node, StatisticsValues, f'{prefix}/values', STATISTICS_VALUES.reader()
        )
        self._version: int | None = None
        self._indices: list[int | None] = []

    def take(self) -> tuple[float, ...] | None:
        """Return the latest, rad/s or m/s; NaN: no such interface. None: nothing new."""
        latest = self._values.take()
        if latest is None:
            return None
        if latest.version != self._version:
            self._read_names()
        if latest.version != self._version:
            return None  # the names of these values have not arrived yet
        count = len(latest.values)
        return tuple(
            latest.values[index] if index is not None and index < count else math.nan
            for index in self._indices
        )

    def _read_names(self) -> None:
        names = self._names.take()
        if names is not None:
            indices = {name: index for index, name in enumerate(names.names)}
            self._indices = [indices.get(name) for name in self._wanted]
            self._version = names.version

    def destroy(self) -> None:
        """Unsubscribe."""
        self._names.destroy()
        self._values.destroy()


class WheelContacts:
    """
    How the wheels of a robot stand on the ground, from the topic ``ground_truth/wheels``.

    Whoever hears it has the simulator read all contacts of the wheels, a tenth of a cycle of a
    control loop. So it is subscribed to until it has given the names of the wheels, and after that
    only while pages show the values. Polled like a :class:`PolledTopic`.
    """

    def __init__(self, node: Node, topic: str) -> None:
        self.names: tuple[str, ...] | None = None
        """Of the joints; None: no message has been received yet."""
        self._node = node
        self._name = topic
        self._topic: PolledTopic[InterfaceValues] | None = None
        self._is_watched = self._is_known = False
        self.watch(False)

    def watch(self, is_watched: bool) -> None:
        """Subscribe or unsubscribe, on the ROS thread; again when names may be known by now."""
        self._is_watched = is_watched
        if not is_watched and self.names is not None:
            self.destroy()
        elif self._topic is None:
            self._topic = PolledTopic(
                self._node, DynamicJointState, self._name, DYNAMIC_JOINT_STATE.reader()
            )

    def take(self) -> InterfaceValues | None:
        """Return the latest, once without any values when nobody watches; None: nothing new."""
        topic = self._topic
        latest = topic.take() if topic is not None else None
        if latest is not None:
            self.names = tuple(latest.names)
        if self._is_watched:
            self._is_known |= latest is not None
            return latest
        was_known, self._is_known = self._is_known, False
        return InterfaceValues([], []) if was_known else None

    def destroy(self) -> None:
        """Unsubscribe."""
        topic, self._topic = self._topic, None
        if topic is not None:
            topic.destroy()


class RobotTopics:
    """
    All other topics of one robot; ``joints``: those of its description that move.

    Nothing is watched at first, see :meth:`watch`.
    """

    def __init__(self, node: Node, found: FoundRobot, joints: Sequence[str]) -> None:
        self.found = found
        self._joints = {name: index for index, name in enumerate(joints)}
        self.layout = RobotLayout(found.id, tuple(joints), ())
        """Joints and wheels; the wheels are known when their topic has been received."""
        self._latest: dict[str, Any] = {}
        self._writers: dict[str, Callable[[Any, RobotFloats], None]] = {
            'joint_states': self._write_joints,
            'commanded': lambda values, floats: _copy(values, floats.commanded),
            'odometry': lambda motion, floats: _copy(motion, floats.odometry),
            'truth': lambda motion, floats: _copy(motion, floats.truth),
            'wheels': _write_wheels,
            'command': lambda command, floats: _copy(command, floats.command),
        }
        self._came: dict[str, float] = {}
        """When the latest message of each part came, s of a monotonic clock."""
        self.unpublished: frozenset[str] = frozenset()
        """The parts whose topics nobody publishes; the ROS thread replaces it."""
        self._topics: dict[str, PolledTopic[Any] | CommandedVelocities | WheelContacts] = {
            part: PolledTopic(node, message_type, topic, read)
            for part, message_type, topic, read in _sources(found)
            if topic is not None
        }
        self.command = _command_topic(node, found)
        """Of velocity commands; None: the robot takes none."""
        self._wheels = WheelContacts(node, found.wheels) if found.wheels is not None else None
        if self._wheels is not None:
            self._topics['wheels'] = self._wheels
        if found.introspection is not None:
            self._topics['commanded'] = CommandedVelocities(node, found.introspection, joints)

    def destroy(self) -> None:
        """Unsubscribe."""
        for topic in self._topics.values():
            topic.destroy()
        if self.command is not None:
            self.command.destroy()

    def keep_joint_states(self, before: 'RobotTopics') -> None:
        """
        Begin with what the topics in whose place these are have last heard of the joints.

        Whoever stops a joint now has it stay where it was measured, not go on.
        """
        latest = before._latest.get('joint_states')
        if latest is not None and before.found.joint_states == self.found.joint_states:
            self._latest['joint_states'] = latest

    def watch(self, parts: AbstractSet[Part]) -> None:
        """
        Subscribe, of the parts that are collected on demand, to these, and to no others.

        To be called now and then, for those that are wanted until something of them is known.
        """
        if self._wheels is not None:
            self._wheels.watch('wheels' in parts)

    def take(self, time: int) -> list[str]:
        """Poll the topics, at ROS time ``time`` (ns); return the parts that have new values."""
        new, now = self._forget_dead(monotonic()), monotonic()
        if self.command is not None:
            twist = self.command.take(time, now)
            if twist is not None:
                self._latest['command'] = twist
                new.append('command')
                if twist is not NO_TWIST:
                    self._came['command'] = now
        for part, topic in self._topics.items():
            message = topic.take()
            if message is not None:
                self._latest[part] = message
                self._came[part] = now
                new.append(part)
        wheels = self._wheels.names if self._wheels is not None else None
        if wheels is not None and wheels != self.layout.wheels:
            self.layout = RobotLayout(self.layout.id, self.layout.joints, wheels)
        return new

    def _forget_dead(self, now: float) -> list[str]:
        """Forget what nobody publishes any more; return the parts that are not known now."""
        dead = [
            part
            for part in self.unpublished
            if part in self._came and now - self._came[part] > _DEAD
        ]
        for part in dead:
            del self._came[part]
            self._latest[part] = None
        return dead

    def ages(self, now: float) -> RobotAges:
        """Return the ages of the latest messages; ``now`` is s of a monotonic clock."""

        def age(part: str) -> float | None:
            came = self._came.get(part)
            return None if came is None else hundredths(now - came)

        parts = (age(part) for part in ('command', 'odometry', 'truth', 'joint_states'))
        return RobotAges(self.found.id, *parts)

    def motion(self, now: float) -> float | None:
        """
        Return how the robot moves, in multiples of what counts as at rest.

        By its odometry, else by its turning wheels; None: neither was received lately.
        """

        def recent(part: str) -> Any:
            came = self._came.get(part)
            return self._latest[part] if came is not None and now - came < _RECENT else None

        if (motion := recent('odometry')) is not None:
            linear = math.hypot(motion[_LINEAR], motion[_LATERAL])
            return max(linear / _STILL_LINEAR, abs(motion[_ANGULAR]) / _STILL_ANGULAR)
        if (states := recent('joint_states')) is not None:
            speeds = [abs(each) for each in states.velocities if math.isfinite(each)]
            return max(speeds) / _STILL_JOINT if speeds else None
        return None

    def positions(self) -> dict[str, float]:
        """Return the latest positions of the joints, rad or m, as far as they are known."""
        latest = self._latest.get('joint_states')
        if latest is None:
            return {}
        pairs = zip(latest.names, latest.positions, strict=False)  # the positions may be missing
        return {name: position for name, position in pairs if math.isfinite(position)}

    def write(self, floats: RobotFloats, parts: Sequence[str] | None = None) -> None:
        """Write the latest values of these parts, or of all, into a state."""
        for part in self._latest if parts is None else parts:
            latest = self._latest[part]
            if latest is None:
                _forget(part, floats)
            else:
                self._writers[part](latest, floats)

    def _write_joints(self, message: JointValues, floats: RobotFloats) -> None:
        for values, target in (
            (message.positions, floats.positions),
            (message.velocities, floats.velocities),
        ):
            for name, value in zip(
                message.names, values, strict=False
            ):  # either array may be empty
                index = self._joints.get(name)
                if index is not None:
                    target[index] = value


def _sources(found: FoundRobot) -> Iterator[tuple[str, Any, str | None, Callable[[bytes], Any]]]:
    """Yield part of the state, message type, topic, and the function that decodes a message."""
    yield 'joint_states', JointState, found.joint_states, JOINT_STATE.reader()
    yield 'odometry', Odometry, found.odometry, ODOMETRY.reader()
    yield 'truth', Odometry, found.truth, ODOMETRY.reader()


def hundredths(age: float | None) -> float | None:
    """Return an age (s) as pages are sent it, often."""
    return None if age is None else round(age, 2)


def _command_topic(node: Node, found: FoundRobot) -> CommandTopic | None:
    if found.command is None:
        return None
    message_type = COMMAND_TYPES[found.command.message]
    row = TWIST if message_type is Twist else TWIST_STAMPED
    return CommandTopic(node, message_type, found.command.topic, row.reader())


def _forget(part: str, floats: RobotFloats) -> None:
    """Write that the values of a part are not known."""
    names = ('positions', 'velocities') if part == 'joint_states' else (part,)
    for name in names:
        getattr(floats, name)[:] = math.nan


def _write_wheels(message: InterfaceValues, floats: RobotFloats) -> None:
    floats.wheels[:] = math.nan
    for index, values in enumerate(message.values[: len(floats.wheels)]):
        floats.wheels[index] = [values.get(name, math.nan) for name in WHEEL_VALUES]


def _copy(values: tuple[float, ...], floats: Floats) -> None:
    floats[:] = values
