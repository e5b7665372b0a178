# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
r"""
``joint_state_publisher``: joint states for a robot without controllers, to inspect its model.

``ros2 run joint_state_publisher joint_state_publisher [FILE [NAME:=VALUE …]]``. FILE is a URDF or
a xacro file with its arguments; without one the node waits for ``robot_description``. In both
cases a new description on that topic replaces the present one.

========== ============================ ========================== ==============================
direction  topic                        type                       QoS
========== ============================ ========================== ==============================
publishes  ``joint_states``             ``sensor_msgs/JointState`` reliable, volatile, depth 10
subscribes ``robot_description``        ``std_msgs/String``        reliable, transient local,
                                                                   depth 1
subscribes ``~/set_joint_positions``    ``sensor_msgs/JointState`` reliable, volatile, depth 10
subscribes each of ``source_list``      ``sensor_msgs/JointState`` reliable, volatile, depth 10
========== ============================ ========================== ==============================

**To move joints** publish their names and positions on ``~/set_joint_positions``; they keep these
positions. The sliders of the browser page do that, and so can a terminal::

    ros2 topic pub --once /joint_state_publisher/set_joint_positions \
        sensor_msgs/msg/JointState '{name: [shoulder], position: [0.5]}'

Velocities and efforts are set in the same way. Mimic joints follow, and cannot be set.

The parameters are in :class:`JointStatePublisherSettings`, and besides:

* ``rate`` (Hz, an integer or a double, 10): how often ``joint_states`` is published;
* ``zeros.<joint>`` (rad; m): the initial position; by default 0, or the middle of the limits if
  0 is outside of them;
* ``dependent_joints.<joint>.parent``, ``.factor`` (1.0), ``.offset`` (0.0): the joint follows
  another, whatever the description says. (In the original these have no effect.)

``rate`` and ``delta`` can be set at run time. An unusable description on the topic is logged, and
the present one kept; an unusable FILE ends the program with one line and exit code 1.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
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
from amr_description.ros.node_help import DESCRIPTION, print_help
from amr_description.ros.parameters import declare, values
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import run

_WARNING_PERIOD = 5.0  # s between two equal warnings
_LEAST_RATE = 1e-3  # Hz


@dataclass(frozen=True)
class JointStatePublisherSettings:
    """The parameters of joint_state_publisher, without those named after joints."""

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
        0.0,
        'How far each joint moves by itself between two messages',
        unit='rad; m',
        minimum=0.0,
        magnitude=(1e-9, 1e6),
    )


class JointStatePublisher(Node):
    """
    The node; see the module.

    Args:
        description: FILE and its arguments, or nothing.
        options: keywords of :class:`rclpy.node.Node`.

    Raises:
        AmrError: the file or a parameter cannot be used.
    """

    def __init__(self, description: Sequence[str] = (), **options: Any) -> None:
        super().__init__('joint_state_publisher', **options)
        self._settings = declare(self, JointStatePublisherSettings)
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
        self.create_subscription(String, 'robot_description', self._on_description, LATCHED)
        for topic in ('~/set_joint_positions', *self._settings.source_list):
            self._subscribe_source(topic)
        self.add_on_set_parameters_callback(self._validate)
        self.add_post_set_parameters_callback(self._apply)

    def _declare_rate(self) -> float:
        """Declare ``rate``, an integer or a double; return it in Hz. Raises ParameterError."""
        about = ParameterDescriptor(
            description='How often joint_states is published [Hz]', dynamic_typing=True
        )
        return _rate(self.declare_parameter('rate', 10, about).value)

    def _declare_options(self) -> JointOptions:
        """Declare the parameters named after joints that were given. Raises ParameterError."""
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

    def _subscribe_source(self, topic: str) -> None:
        """Subscribe to a source. Raises ParameterError for the node's own topic."""
        if self.resolve_topic_name(topic) == self._publisher.topic_name:
            raise ParameterError(
                f"source_list holds '{topic}', on which this node publishes itself; name the "
                'topics of others'
            )
        self.create_subscription(JointState, topic, self._on_joint_state, 10)

    def _on_description(self, message: String) -> None:
        if message.data == self._text:
            return  # its publisher was restarted: the joints keep their positions
        try:
            self._configure(message.data)
        except AmrError as error:
            kept = 'the old one is kept' if self._joints else 'waiting for another'
            self.get_logger().warning(f'robot_description cannot be used, {kept}: {error}')

    def _configure(self, text: str) -> None:
        """Read a description, and reset the joints. Raises DescriptionError."""
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
                throttle_duration_sec=_WARNING_PERIOD,
            )
        elif self._joints is not None:
            self._joints.set(message.name, *arrays)

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

    def _validate(self, changed: list[Parameter]) -> SetParametersResult:
        """Reject invalid values before any parameter is changed."""
        try:
            values(self, JointStatePublisherSettings, changed)
            for each in changed:
                if each.name == 'rate':
                    _rate(each.value)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _apply(self, _changed: list[Parameter]) -> None:
        """Apply validated parameters."""
        self._settings = values(self, JointStatePublisherSettings)
        period = round(NANOSECONDS / _rate(self.get_parameter('rate').value))
        if period != self._timer.timer_period_ns:
            self._timer.timer_period_ns = period
            self._timer.reset()


def _rate(value: Any) -> float:
    """Return a rate in Hz. Raises ParameterError."""
    if type(value) not in (int, float) or not 0.0 < value <= 1000.0:
        raise ParameterError(f"parameter 'rate' must be above 0 and at most 1000, found {value}")
    if value < _LEAST_RATE:
        raise ParameterError(
            f"parameter 'rate' must be at least {_LEAST_RATE:g}, found {value} Hz"
        )
    return float(value)


def main(args: list[str] | None = None) -> int:
    """Run the node until Ctrl-C; ``args`` as for every executable of this package."""
    purpose = 'Publish joint states for a robot without controllers, to inspect its model.'
    if print_help(
        args, 'joint_state_publisher', purpose, JointStatePublisherSettings, words=DESCRIPTION
    ):
        return 0
    description, ros_args = split_arguments(args)
    return run(lambda: JointStatePublisher(description), ros_args)
