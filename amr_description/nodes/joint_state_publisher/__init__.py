# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
r"""
``joint_state_publisher``: joint states for a robot that has no controllers, to look at it.

``ros2 run joint_state_publisher joint_state_publisher [FILE [NAME:=VALUE …]]``. FILE is a URDF or
a xacro file with its arguments; without one the node waits for ``robot_description``. With or
without, each other description that comes on that topic takes the place of the one before.

========= ============================ ========================== ===============================
direction topic                        type                       QoS
========= ============================ ========================== ===============================
publishes ``joint_states``             ``sensor_msgs/JointState`` reliable, volatile, depth 10
hears     ``robot_description``        ``std_msgs/String``        reliable, transient local,
                                                                  depth 1
hears     ``~/set_joint_positions``    ``sensor_msgs/JointState`` reliable, volatile, depth 10
hears     each of ``source_list``      ``sensor_msgs/JointState`` reliable, volatile, depth 10
========= ============================ ========================== ===============================

**To move joints** publish their names and positions on ``~/set_joint_positions``; there they
stay. That is what sliders do, a browser's or one's own, and so can a terminal::

    ros2 topic pub --once /joint_state_publisher/set_joint_positions \
        sensor_msgs/msg/JointState '{name: [shoulder], position: [0.5]}'

Velocities and efforts may be set likewise. Mimic joints follow, and cannot be set.

The parameters are in :class:`Settings`, and besides:

* ``rate`` (Hz, an integer or a double, 10): how often ``joint_states`` is published;
* ``zeros.<joint>`` (rad; m): where a joint starts; else at 0 or, where that is outside of its
  limits, in the middle between them;
* ``dependent_joints.<joint>.parent``, ``.factor`` (1.0), ``.offset`` (0.0): the joint follows
  another, whatever the description says. (In the original these have no effect.)

``rate`` and ``delta`` may be set at run time. A description that cannot be used is told and the
old one kept; one that the command line names ends the program, with one line and exit code 1.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, ParameterError
from amr_description.model.urdf import parse
from amr_description.nodes.joint_state_publisher.joint_positions import (
    dependent_joints_of,
    JointOptions,
    JointPositions,
    PREFIXES,
    zeros_of,
)
from amr_description.parameters import parameter
from amr_description.ros.arguments import read_description, split_arguments
from amr_description.ros.parameters import declare, values
from amr_description.ros.runtime import run

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_QUIET = 5.0  # s between two complaints


@dataclass(frozen=True)
class Settings:
    """The parameters of joint_state_publisher that are the same for every robot."""

    publish_default_positions: bool = parameter(
        True, 'Publish positions before a source tells them', read_only=True
    )
    publish_default_velocities: bool = parameter(
        False, 'Publish velocities of 0 before a source tells them', read_only=True
    )
    publish_default_efforts: bool = parameter(
        False, 'Publish efforts of 0 before a source tells them', read_only=True
    )
    use_mimic_tags: bool = parameter(True, 'Let mimic joints follow', read_only=True)
    use_smallest_joint_limits: bool = parameter(
        True, 'Keep to the soft limits of <safety_controller> too', read_only=True
    )
    source_list: tuple[str, ...] = parameter(
        (), 'Topics with joint states that are taken over', read_only=True
    )
    delta: float = parameter(
        0.0, 'How far each joint moves by itself between two messages', unit='rad; m', minimum=0.0
    )


class JointStatePublisher(Node):
    """
    The node; see the module.

    :param description: FILE and its arguments, or nothing.
    :param options: Keywords of :class:`rclpy.node.Node`.
    :raises AmrError: The file or a parameter cannot be used.
    """

    def __init__(self, description: Sequence[str] = (), **options: Any) -> None:
        super().__init__('joint_state_publisher', **options)
        self._settings = declare(self, Settings)
        self._options = self._declare_options()
        self._joints: JointPositions | None = None
        self._text = ''
        self._publisher = self.create_publisher(JointState, 'joint_states', 10)
        self._timer = self.create_timer(1.0 / self._declare_rate(), self._publish)
        if description:
            self._configure(read_description(description, self.get_logger().warning))
        else:
            self.get_logger().info(
                'Waiting for robot_description to be published on the robot_description topic...'
            )
        self.create_subscription(String, 'robot_description', self._on_description, _LATCHED)
        for topic in ('~/set_joint_positions', *self._settings.source_list):
            self._hear(topic)
        self.add_on_set_parameters_callback(self._judge)
        self.add_post_set_parameters_callback(self._adopt)

    def _declare_rate(self) -> float:
        """Declare ``rate``, which is an integer or a double; return it. Raises ParameterError."""
        about = ParameterDescriptor(
            description='How often joint_states is published [Hz]', dynamic_typing=True
        )
        return _rate(self.declare_parameter('rate', 10, about).value)

    def _declare_options(self) -> JointOptions:
        """Declare what the node was given for single joints. Raises ParameterError."""
        given = {}
        for name, override in self._parameter_overrides.items():
            if name.startswith(PREFIXES):
                about = ParameterDescriptor(read_only=True)
                given[name] = self.declare_parameter(name, override.value, about).value
        settings = self._settings
        return JointOptions(
            use_mimic_tags=settings.use_mimic_tags,
            use_smallest_joint_limits=settings.use_smallest_joint_limits,
            publish_default_positions=settings.publish_default_positions,
            publish_default_velocities=settings.publish_default_velocities,
            publish_default_efforts=settings.publish_default_efforts,
            zeros=zeros_of(given),
            dependent_joints=dependent_joints_of(given),
        )

    def _hear(self, topic: str) -> None:
        """Take joint states from a topic. Raises ParameterError for the node's own."""
        if self.resolve_topic_name(topic) == self._publisher.topic_name:
            raise ParameterError(
                f"source_list holds '{topic}', on which this node publishes itself; name the "
                'topics of others'
            )
        self.create_subscription(JointState, topic, self._on_joint_state, 10)

    def _on_description(self, message: String) -> None:
        if message.data == self._text:
            return  # somebody started anew: the joints stay where they are
        try:
            self._configure(message.data)
        except AmrError as error:
            kept = 'the old one is kept' if self._joints else 'waiting for another'
            self.get_logger().warning(f'robot_description cannot be used, {kept}: {error}')

    def _configure(self, text: str) -> None:
        """Put the joints of a description where they start. Raises DescriptionError."""
        joints = JointPositions(parse(text, 'robot_description'), self._options)
        self._joints, self._text = joints, text
        for warning in joints.warnings:
            self.get_logger().warning(warning)

    def _on_joint_state(self, message: JointState) -> None:
        count = len(message.name)
        arrays = (message.position, message.velocity, message.effort)
        if any(len(array) not in (0, count) for array in arrays):
            self.get_logger().warning(
                f'a JointState with {count} names and {", ".join(str(len(a)) for a in arrays)} '
                'positions, velocities, efforts is ignored; each has as many, or none',
                throttle_duration_sec=_QUIET,
            )
        elif self._joints is not None:
            self._joints.take(message.name, *arrays)

    def _publish(self) -> None:
        if self._joints is None or not self._joints.names:
            return
        if self._settings.delta:
            self._joints.advance(self._settings.delta)
        sample = self._joints.sample()
        message = JointState(
            name=sample.names,
            position=sample.positions,
            velocity=sample.velocities,
            effort=sample.efforts,
        )
        message.header.stamp = self.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _judge(self, changed: list[Parameter]) -> SetParametersResult:
        """Refuse parameters that cannot be used, before any of them is changed."""
        try:
            values(self, Settings, changed)
            for each in changed:
                if each.name == 'rate':
                    _rate(each.value)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _adopt(self, _changed: list[Parameter]) -> None:
        """Take checked parameters."""
        self._settings = values(self, Settings)
        period = round(NANOSECONDS / _rate(self.get_parameter('rate').value))
        if period != self._timer.timer_period_ns:
            self._timer.timer_period_ns = period
            self._timer.reset()


def _rate(value: object) -> float:
    """Return a rate in Hz. Raises ParameterError."""
    if type(value) not in (int, float) or not 0.0 < value <= 1000.0:
        raise ParameterError(f"parameter 'rate' must be above 0 and at most 1000, found {value}")
    return float(value)


def main(args: list[str] | None = None) -> int:
    """Run the node until Ctrl-C; ``args`` as for every executable of this package."""
    description, ros_args = split_arguments(args)
    return run(lambda: JointStatePublisher(description), ros_args)
