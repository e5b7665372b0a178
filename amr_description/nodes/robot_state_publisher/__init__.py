# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``robot_state_publisher``: publish the description of a robot, and the poses of its links.

========== ======================= ========================== ===================================
direction  topic                   type                       QoS
========== ======================= ========================== ===================================
publishes  ``robot_description``   ``std_msgs/String``        reliable, transient local, depth 1
publishes  ``/tf``                 ``tf2_msgs/TFMessage``     reliable, volatile, depth 100
publishes  ``/tf_static``          ``tf2_msgs/TFMessage``     reliable, transient local, depth 1
subscribes ``joint_states``        ``sensor_msgs/JointState`` best effort, volatile, depth 5
========== ======================= ========================== ===================================

``robot_state_publisher [FILE [NAME:=VALUE …]]``: a URDF file, or a xacro file with its arguments,
instead of the parameter ``robot_description``.

The parameters are in :class:`RobotStatePublisherSettings`; all can be set at run time. An unusable
``robot_description`` is rejected, and the present one kept.

Transforms have the stamp of their joint state. As in the original, messages are throttled by these
stamps (``robot_state.Throttle``). It differs from the original as follows:

* a joint state with a zero stamp, which the original never publishes, is treated as stamped on
  arrival, and so are its transforms: TF cannot use stamp 0;
* the first message about a joint is always published, also in the first 50 ms of simulation time;
* ``publish_frequency`` is kept on average, at any rate of joint states; 0 publishes every message;
* joint states whose stamps jump back by more than a second are published even if the node's own
  clock does not jump back (a restarted simulator, ``use_sim_time`` forgotten);
* an unusable description ends the node with one line and exit code 1, instead of an abort;
* ``/tf_static`` has the fixed joints of the present description only.

Joint states are received as bytes, and decoded only if they are published. At 20 Hz of transforms,
100 messages per second of four wheels cost 4 to 5 % of a core (2.3 % for receiving them), 1000 per
second 12 to 14 %; ``use_sim_time`` with a 100 Hz /clock adds 1 to 2 %.
"""

from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import dataclass
import math
from typing import Any

from geometry_msgs.msg import TransformStamped
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from amr_description.clock import TimeJumpFilter
from amr_description.errors import AmrError, DescriptionError, ParameterError
from amr_description.model.urdf import parse
from amr_description.nodes.robot_state_publisher.robot_state import (
    LinkTransform,
    period_of,
    RobotState,
    Throttle,
)
from amr_description.parameters import parameter
from amr_description.ros.arguments import read_description, split_arguments
from amr_description.ros.cdr import HeadReader
from amr_description.ros.messages import fill_stamp
from amr_description.ros.node_help import DESCRIPTION, print_help
from amr_description.ros.parameters import (
    add_parameter_event_qos_overrides,
    declare,
    PUBLISHER_POLICIES,
    values,
)
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import run

_WARNING_PERIOD = 5.0  # s between two equal warnings
_LEAST_FREQUENCY = 1e-3  # Hz


@dataclass(frozen=True)
class RobotStatePublisherSettings:
    """The parameters of robot_state_publisher."""

    robot_description: str = parameter('', 'The URDF of the robot: its text, not a file name')
    publish_frequency: float = parameter(
        20.0,
        'Maximum rate of the transforms of a joint, 0 to 1000; 0: no maximum',
        unit='Hz',
        magnitude=(_LEAST_FREQUENCY, math.inf),  # the greatest is checked with the original's text
    )
    frame_prefix: str = parameter('', "Put before every frame name; include your own '/'")
    ignore_timestamp: bool = parameter(False, 'Publish every joint state, whatever its stamp')


class RobotStatePublisher(Node):
    """
    The node; see the module.

    Args:
        description: FILE and its arguments, or nothing.
        options: keywords of :class:`rclpy.node.Node`.

    Raises:
        AmrError: the description or a parameter cannot be used.
    """

    def __init__(self, description: Sequence[str] = (), **options: Any) -> None:
        super().__init__('robot_state_publisher', **options)
        add_parameter_event_qos_overrides(self)
        self._settings = declare(self, RobotStatePublisherSettings)
        if not self._settings.robot_description and description:
            self._take_file(description)
        if not self._settings.robot_description:
            raise ParameterError(
                'robot_description parameter must not be empty; give it the text of a URDF in a '
                '--params-file, or name the URDF file as the argument'
            )
        self._state: RobotState | None = None
        self._throttle = Throttle()
        self._heads = HeadReader()
        self._transforms: dict[str, TransformStamped] = {}  # by link
        self._time_jumps = TimeJumpFilter()
        self._description = self.create_publisher(String, 'robot_description', LATCHED)
        self._static = self.create_publisher(
            TFMessage,
            '/tf_static',
            copy(LATCHED),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
        self._moving = self.create_publisher(
            TFMessage,
            '/tf',
            100,
            qos_overriding_options=QoSOverridingOptions(PUBLISHER_POLICIES),
        )
        self._apply(self._settings, self._state_for(self._settings))
        self.create_subscription(
            JointState,
            'joint_states',
            self._on_joint_state,
            qos_profile_sensor_data,
            raw=True,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
        self.add_on_set_parameters_callback(self._validate)
        self.add_post_set_parameters_callback(lambda _changed: self._apply(*self._candidate))

    def _take_file(self, description: Sequence[str]) -> None:
        """Read the description from a file, as in ROS 1."""
        self.get_logger().warning(
            'No robot_description parameter, but command-line argument available.  Assuming '
            'argument is name of URDF file.  This backwards compatibility fallback will be '
            'removed in the future.'
        )
        text = read_description(description, self.get_logger().warning)
        self.set_parameters([Parameter('robot_description', value=text)])
        self._settings = values(self, RobotStatePublisherSettings)

    def _validate(self, changed: list[Parameter]) -> SetParametersResult:
        """Reject invalid values before any parameter is changed."""
        try:
            settings = values(self, RobotStatePublisherSettings, changed)
            self._candidate = (settings, self._state_for(settings))
        except AmrError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _state_for(self, settings: RobotStatePublisherSettings) -> RobotState:
        """Validate settings, and read the robot if it is a new one. Raises AmrError."""
        if not 0.0 <= settings.publish_frequency <= 1000.0:
            raise ParameterError('publish_frequency must be between 0.0 and 1000.0')
        if not settings.robot_description:
            raise ParameterError('Empty URDF is not allowed')
        if self._state and settings.robot_description == self._settings.robot_description:
            return self._state
        try:
            return RobotState(parse(settings.robot_description, 'robot_description'))
        except DescriptionError as error:
            raise DescriptionError(
                f'Unable to initialize urdf::model from robot description: {error}'
            ) from error

    def _apply(self, settings: RobotStatePublisherSettings, state: RobotState) -> None:
        """Apply validated settings; publish what they change."""
        new_robot = state is not self._state
        new_frames = new_robot or settings.frame_prefix != self._settings.frame_prefix
        self._settings, self._state = settings, state
        self._period = period_of(settings.publish_frequency)
        self._throttle.forget()
        if new_robot:
            for warning in state.warnings:
                self.get_logger().warning(warning)
            self._description.publish(String(data=settings.robot_description))
            self.get_logger().info('Robot initialized')
        if new_frames:
            self._transforms.clear()
            self._static.publish(self._message(state.static, self.get_clock().now().nanoseconds))

    def _on_joint_state(self, data: bytes) -> None:
        """Handle a serialized JointState; most are not published, and so not decoded."""
        now = self.get_clock().now().nanoseconds
        if self._time_jumps.observe(now):
            self.get_logger().warning('Moved backwards in time, re-publishing joint transforms!')
            self._throttle.forget()
        try:
            head = self._heads.read(data)
        except ValueError as error:
            self._log_invalid(str(error))
            return
        stamp = head.stamp or now
        if self._time_jumps.is_stale(stamp):
            return
        if not (self._throttle.admit(head.names, stamp) or self._settings.ignore_timestamp):
            return
        message = deserialize_message(data, JointState)
        if len(message.name) != len(message.position):
            self._log_mismatch(message)
            return
        self._throttle.note(head.names, stamp, self._period)
        positions = dict(zip(message.name, message.position, strict=True))
        transforms = self._state.moving(positions)
        if transforms:
            self._moving.publish(self._message(transforms, stamp))

    def _log_mismatch(self, message: JointState) -> None:
        """Log that names and positions of a joint state do not match."""
        if message.position:
            names, positions = len(message.name), len(message.position)
            self._log_invalid(f'{names} names, {positions} positions')
        else:
            joints = ','.join(f'"{name}"' for name in message.name)
            self.get_logger().warning(
                'Robot state publisher ignored a JointState message about joint(s) '
                f'{joints} whose position member was empty.',
                throttle_duration_sec=_WARNING_PERIOD,
            )

    def _log_invalid(self, reason: str) -> None:
        self.get_logger().error(
            f'Robot state publisher ignored an invalid JointState message: {reason}',
            throttle_duration_sec=_WARNING_PERIOD,
        )

    def _message(self, links: Iterable[LinkTransform], stamp: int) -> TFMessage:
        """Return the transforms with ``stamp`` (ns); its parts are reused for the next message."""
        return TFMessage(transforms=[self._transform(link, stamp) for link in links])

    def _transform(self, link: LinkTransform, stamp: int) -> TransformStamped:
        message = self._transforms.get(link.child)
        if message is None:
            message = self._transforms[link.child] = TransformStamped()
            message.header.frame_id = self._settings.frame_prefix + link.parent
            message.child_frame_id = self._settings.frame_prefix + link.child
        fill_stamp(stamp, message.header.stamp)
        translation, rotation = message.transform.translation, message.transform.rotation
        translation.x, translation.y, translation.z = link.transform.translation
        rotation.x, rotation.y, rotation.z, rotation.w = link.transform.rotation
        return message


def main(args: list[str] | None = None) -> int:
    """Run the node until Ctrl-C; ``args`` as for every executable of this package."""
    purpose = 'Publish the description of a robot, and the poses of its links by its joint states.'
    if print_help(
        args, 'robot_state_publisher', purpose, RobotStatePublisherSettings, words=DESCRIPTION
    ):
        return 0
    description, ros_args = split_arguments(args)
    return run(lambda: RobotStatePublisher(description), ros_args)
