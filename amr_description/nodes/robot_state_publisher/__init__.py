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
stamps (``robot_state.JointThrottle``). It differs from the original as follows:

* a joint state with a zero stamp, which the original never publishes, is treated as stamped on
  arrival, and so are its transforms: TF cannot use stamp 0;
* the first message about a joint is always published, also in the first 50 ms of simulation time;
* ``publish_frequency`` is kept on average, at any rate of joint states; 0 publishes every message;
* joint states whose stamps jump back by more than a second are published even if the node's own
  clock does not jump back (a restarted simulator, ``use_sim_time`` forgotten);
* an unusable description ends the node with one line and exit code 1, instead of an abort;
* ``/tf_static`` has the fixed joints of the present description only.

Joint states are taken as bytes, in a thread of their own, and no messages are made of them.
While the only publisher's next message is not due yet by its stamps, that thread rests, and then
takes in their order what has come meanwhile: which messages are published does not depend on it.
One that comes earlier than those before let expect is published late, by 50 ms at most.

At 20 Hz of transforms, 100 messages per second of four wheels take 1.6 % of a core (3.1 % with a
callback for each), 0.5 % of it for receiving them; 1000 per second take 5.0 % (12 %).
``use_sim_time`` with a /clock of 100 Hz adds 0.4 %.
"""

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
import math
import threading
import time
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_sensor_data, QoSProfile
from rclpy.qos_overriding_options import QosCallbackResult, QoSOverridingOptions
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS, TimeJumpFilter
from amr_description.errors import AmrError, DescriptionError, ParameterError
from amr_description.model.urdf import parse
from amr_description.nodes.robot_state_publisher.robot_state import (
    Arrivals,
    JointThrottle,
    period_of,
    RobotState,
)
from amr_description.nodes.robot_state_publisher.transforms import TransformEncoder
from amr_description.parameters import parameter
from amr_description.ros.arguments import read_description, split_arguments
from amr_description.ros.node_help import DESCRIPTION, print_help
from amr_description.ros.parameters import (
    add_parameter_event_qos_overrides,
    declare,
    PUBLISHER_POLICIES,
    values,
)
from amr_description.ros.polled_topic import PollingNode
from amr_description.ros.qos import LATCHED
from amr_description.ros.readers import JOINT_STATE
from amr_description.ros.runtime import run
from amr_description.ros.subscription_thread import SubscriptionThread

_WARNING_PERIOD = 5.0  # s between two equal warnings
_LEAST_FREQUENCY = 1e-3  # Hz
_RESET_GAP = NANOSECONDS // 10
"""
ns by which the stamps of one publisher go back at a reset. It is seen by the clock, too, unless
that is past the last time that was looked at already, after a rest on a busy machine.
"""
_QUEUE = 100  # joint states; at 1 kHz 50 come in the longest rest


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


class RobotStatePublisher(PollingNode):
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
        self._throttle = JointThrottle()
        self._arrivals = Arrivals()
        self._lock = threading.Lock()  # of all that joint states and parameters have in common
        self._read = JOINT_STATE.reader()
        self._time_jumps = TimeJumpFilter()
        self._latest = 0  # stamp, ns
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
        self._thread = SubscriptionThread(self)
        self._joint_states = self._thread.subscribe(
            JointState,
            'joint_states',
            self._on_joint_state,
            copy(qos_profile_sensor_data),
            raw=True,
            qos_overriding_options=QoSOverridingOptions.with_default_policies(callback=_deepen),
        )
        self.add_on_set_parameters_callback(self._validate)
        self.add_post_set_parameters_callback(lambda _changed: self._set())
        self._thread.start()

    def destroy_node(self) -> None:
        """Destroy the node, after the last transforms."""
        self._thread.end()
        super().destroy_node()

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

    def _set(self) -> None:
        """Apply the settings that were validated last."""
        with self._lock:
            self._apply(*self._candidate)
        self._thread.wake()

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
            self._encoder = TransformEncoder(settings.frame_prefix)
            now = self.get_clock().now().nanoseconds
            self._static.publish(self._encoder.message(state.static, now))

    def _on_joint_state(self, data: bytes, info: Mapping[str, int]) -> float:
        """Handle a serialized JointState; return for how long no other will be published, s."""
        with self._lock:
            if not self._thin(data, info['received_timestamp']):
                return 0.0
            earliest = self._throttle.earliest
            if earliest is None or self._settings.ignore_timestamp:
                return 0.0
            rest = self._arrivals.rest(earliest, time.time_ns()) / NANOSECONDS
        return rest if self._joint_states.get_publisher_count() == 1 else 0.0

    def _thin(self, data: bytes, arrival: int) -> bool:
        """
        Publish a serialized JointState if it is due; most are not.

        Returns:
            Whether it counts as published, with transforms or without.
        """
        now = self.get_clock().now().nanoseconds
        if self._time_jumps.observe(now):
            self.get_logger().warning('Moved backwards in time, re-publishing joint transforms!')
            self._throttle.forget()
        try:
            state = self._read(data)
            names, stamp = tuple(state.names), state.stamp or now
            before, self._latest = self._latest, stamp
            if stamp < before - _RESET_GAP and self._joint_states.get_publisher_count() == 1:
                self._throttle.forget()
            if self._time_jumps.is_stale(stamp):
                return False
            if not (self._throttle.admit(names, stamp) or self._settings.ignore_timestamp):
                return False
        except ValueError as error:
            self._log_invalid(str(error))
            return False
        if len(names) != len(state.positions):
            self._log_mismatch(names, state.positions)
            return False
        self._throttle.note(names, stamp, self._period)
        self._arrivals.note(stamp, arrival)
        transforms = self._state.moving(dict(zip(names, state.positions, strict=True)))
        if transforms:
            self._moving.publish(self._encoder.encode(transforms, stamp))
        return True

    def _log_mismatch(self, names: Sequence[str], positions: Sequence[float]) -> None:
        """Log that names and positions of a joint state do not match."""
        if positions:
            self._log_invalid(f'{len(names)} names, {len(positions)} positions')
        else:
            joints = ','.join(f'"{name}"' for name in names)
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


def _deepen(qos: QoSProfile) -> QosCallbackResult:
    """Have a queue for what comes while the thread rests, whatever the parameters say of it."""
    qos.depth = max(qos.depth, _QUEUE)
    return QosCallbackResult(successful=True)


def main(args: list[str] | None = None) -> int:
    """Run the node until Ctrl-C; ``args`` as for every executable of this package."""
    purpose = 'Publish the description of a robot, and the poses of its links by its joint states.'
    if print_help(
        args, 'robot_state_publisher', purpose, RobotStatePublisherSettings, words=DESCRIPTION
    ):
        return 0
    description, ros_args = split_arguments(args)
    return run(lambda: RobotStatePublisher(description), ros_args)
