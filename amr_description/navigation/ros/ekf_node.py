# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The node of ``ekf_node``: sensors in, ``odometry/filtered`` and the transform of the robot out.

========================  ===========================================  =========================
name                      type                                         QoS
========================  ===========================================  =========================
``odom0``, ``imu0`` …     what the parameters of these names say       best effort, ``_queue_size``
``set_pose``              PoseWithCovarianceStamped                    reliable, depth 1
``cmd_vel``               Twist, or TwistStamped; with ``use_control``  reliable, depth 1
``odometry/filtered``     nav_msgs/Odometry                            reliable, depth 10
``accel/filtered``        AccelWithCovarianceStamped                   reliable, depth 10
``/tf``                   world_frame → base_link_frame_output         reliable, depth 100
``/diagnostics``          with ``print_diagnostics``                   reliable, depth 1
========================  ===========================================  =========================

Services: ``enable`` and ``reset``, std_srvs/Empty; ``set_pose`` SetPose and ``toggle``
ToggleFilterProcessing, robot_localization/srv. Names, types, parameters and rules are those of
robot_localization 3.8 (Jazzy).
"""

from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, TwistStamped
from nav_msgs.msg import Odometry
import numpy as np
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.clock import Clock, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, QoSReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.time import ClockType
from rclpy.timer import Timer
from robot_localization.srv import SetPose, ToggleFilterProcessing
from std_srvs.srv import Empty

from amr_description.clock import NANOSECONDS, TimeJumpFilter
from amr_description.model.frames import Transform
from amr_description.navigation.ekf import ControlInput, Measurement, Outcome
from amr_description.navigation.ekf_diagnostics import FilterDiagnostics, RateDiagnostics
from amr_description.navigation.ekf_estimator import Estimator
from amr_description.navigation.ekf_parameters import (
    EkfInput,
    EkfParameters,
    read_parameters,
    rows_of,
)
from amr_description.navigation.ros.ekf_inputs import InputReader, MESSAGE_TYPES
from amr_description.navigation.ros.ekf_outputs import (
    acceleration_message,
    diagnostic_array,
    odometry_message,
    Outputs,
)
from amr_description.navigation.ros.messages import is_place
from amr_description.navigation.ros.transform_queue import transform_at
from amr_description.parameters import Spec
from amr_description.ros.messages import nanoseconds, vector_of
from amr_description.ros.parameters import PUBLISHER_POLICIES
from amr_description.ros.rclpy_internals import parameter_overrides, set_parameter_override
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

_QUIET = 5.0
"""s between two warnings about the same."""


class EkfNode(Node):
    """Fuses what its parameters name; see the module."""

    def __init__(self) -> None:
        super().__init__('ekf_filter_node')
        self._settings = self._declare()
        for note in self._settings.notes:
            self.get_logger().warning(note)
        self._buffer = Buffer(clock=self.get_clock())
        waits = self._settings.number('transform_timeout') > 0.0
        # Who waits for a transform in a callback must not keep it from being received.
        self._listener = TransformListener(
            self._buffer, None if waits else self, spin_thread=waits
        )
        self._diagnostics = FilterDiagnostics(self._settings)
        self._rate = RateDiagnostics(self._settings.number('frequency'))
        self._estimator = Estimator(self._settings.tuning, self._settings.timing, self._on_outcome)
        self._reader = InputReader(self._settings, self._estimator, self._lookup, self._complain)
        self._outputs = Outputs(self, self._settings, QoSOverridingOptions(PUBLISHER_POLICIES))
        self._is_enabled = not self._settings.is_on('disabled_at_startup')
        self._takes_measurements = True
        self._last_published = -1
        self._missing: dict[str, int] = {}
        self._jumps = TimeJumpFilter()
        self._subscribe()
        self._serve()
        self._timer = self._new_timer()
        self._is_timer_stuck = False
        self._watch_time()
        if self._settings.is_on('print_diagnostics'):
            self.create_timer(
                self._settings.number('diagnostic_updater.period'),
                self._publish_diagnostics,
                clock=Clock(clock_type=ClockType.STEADY_TIME),
            )

    # --- begin --------------------------------------------------------------------------------

    def _declare(self) -> EkfParameters:
        """Declare the parameters, as they are known by what was given. Raises ParameterError."""
        given = {
            name: each.value
            for name, each in parameter_overrides(self).items()
            if each.type_ != Parameter.Type.NOT_SET
        }
        parameters = read_parameters(given)
        for row in rows_of(given):
            self._declare_one(row, parameters)
        return parameters

    def _declare_one(self, row: Spec, parameters: EkfParameters) -> None:
        name, kind_in_ros = row.name, Parameter.Type[row.type.upper()]
        value = parameters.values.get(name)
        descriptor = ParameterDescriptor(read_only=True)
        if value is None:
            self.declare_parameter(name, kind_in_ros, descriptor)
            return
        if name in parameter_overrides(self):
            set_parameter_override(self, Parameter(name, kind_in_ros, value))
        self.declare_parameter(name, value, descriptor)

    def _subscribe(self) -> None:
        for entry in self._settings.inputs:
            if not entry.is_used:
                continue
            qos = QoSProfile(depth=entry.queue_size, reliability=QoSReliabilityPolicy.BEST_EFFORT)
            self.create_subscription(
                MESSAGE_TYPES[entry.kind],
                entry.topic,
                lambda message, entry=entry: self._on_message(entry, message),
                qos,
            )
        self.create_subscription(
            PoseWithCovarianceStamped, 'set_pose', self._on_set_pose, QoSProfile(depth=1)
        )
        if self._settings.tuning.control is None:
            return
        if self._settings.is_on('stamped_control'):
            self.create_subscription(
                TwistStamped, 'cmd_vel', self._on_stamped_control, QoSProfile(depth=1)
            )
        else:
            self.create_subscription(Twist, 'cmd_vel', self._on_control, QoSProfile(depth=1))

    def _serve(self) -> None:
        self.create_service(Empty, 'enable', self._on_enable)
        self.create_service(Empty, 'reset', self._on_reset)
        self.create_service(SetPose, 'set_pose', self._on_set_pose_request)
        self.create_service(ToggleFilterProcessing, 'toggle', self._on_toggle)

    def _new_timer(self) -> Timer:
        return self.create_timer(1.0 / self._settings.number('frequency'), self._update)

    def _watch_time(self) -> None:
        threshold = JumpThreshold(
            min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=False
        )
        clock = self.get_clock()
        self._jump_handle = clock.create_jump_callback(threshold, post_callback=self._on_jump)

    def destroy_node(self) -> None:
        """End with all that it has."""
        self._listener.unregister()
        super().destroy_node()

    # --- messages -----------------------------------------------------------------------------

    def _on_message(self, entry: EkfInput, message: object) -> None:
        header = message.header  # type: ignore[attr-defined]
        if self._is_timer_stuck and self.get_clock().now().nanoseconds > 0:
            self._is_timer_stuck = False
            self.destroy_timer(self._timer)
            self._timer = self._new_timer()
        self._jumps.observe(self.get_clock().now().nanoseconds)
        if not self._jumps.is_stale(nanoseconds(header.stamp)):
            self._reader.read(entry, message)

    def _on_control(self, message: Twist) -> None:
        self._follow(message, self.get_clock().now().nanoseconds)

    def _on_stamped_control(self, message: TwistStamped) -> None:
        frame, base = message.header.frame_id, self._settings.base_link_frame
        if frame not in ('', base):
            self.get_logger().warning(
                f"Commanded velocities must be given in the robot's body frame ({base}). Message "
                f'frame was {frame}',
                throttle_duration_sec=_QUIET,
            )
            return
        self._follow(message.twist, nanoseconds(message.header.stamp))

    def _follow(self, twist: Twist, time: int) -> None:
        velocity = np.array([*vector_of(twist.linear), *vector_of(twist.angular)])
        control = ControlInput(velocity, time)
        self._reader.control = control
        self._estimator.set_control(control)

    def _on_outcome(self, measurement: Measurement, outcome: Outcome) -> None:
        name = measurement.source
        if outcome is Outcome.REJECTED:
            self._diagnostics.add(
                f'{name}_rejection',
                f'A measurement was farther from the state than the rejection threshold '
                f'{measurement.threshold:g}, and was ignored.',
            )
        elif outcome is Outcome.UNUSABLE:
            self._diagnostics.add(
                f'{name}_values', 'A measurement or its covariance is no number, and was ignored.'
            )

    # --- services -----------------------------------------------------------------------------

    def _on_set_pose(self, message: PoseWithCovarianceStamped) -> None:
        if not (is_place(message.pose.pose) and np.isfinite(message.pose.covariance).all()):
            self.get_logger().error(
                'set_pose: its position or its covariance is no number, or too large: the pose '
                'stays as it is'
            )
            return
        values = self._reader.values_of_pose(message)
        if values is None:
            self.get_logger().error(
                f"set_pose: there is no transform from '{message.header.frame_id}' to "
                f"'{self._settings.world_frame}': the pose stays as it is"
            )
            return
        self._reader.reset(nanoseconds(message.header.stamp))
        now = self.get_clock().now().nanoseconds
        covariance = values.covariance.copy()
        covariance[6:, 6:] = np.eye(9) * 1e-6
        self._estimator.set_state(values.values, covariance, now)

    def _on_set_pose_request(
        self, request: SetPose.Request, response: SetPose.Response
    ) -> SetPose.Response:
        self._on_set_pose(request.pose)
        return response

    def _on_toggle(
        self, request: ToggleFilterProcessing.Request, response: ToggleFilterProcessing.Response
    ) -> ToggleFilterProcessing.Response:
        """Take measurements again, or drop them while the last state is published."""
        response.status = request.on != self._takes_measurements
        self._takes_measurements = request.on
        word = 'on' if request.on else 'off'
        if response.status:
            self.get_logger().info(f'Toggling filter measurement filtering to {word}.')
        else:
            self.get_logger().warning(
                f'Service was called to toggle filter processing {word}, but it is {word} already'
            )
        return response

    def _on_enable(self, request: Empty.Request, response: Empty.Response) -> Empty.Response:
        if self._is_enabled:
            self.get_logger().warning(
                f'[{self.get_name()}:] Asking for enabling filter service, but the filter was '
                'already enabled! Use param disabled_at_startup.'
            )
        else:
            self.get_logger().info(f'[{self.get_name()}:] Enabling filter...')
            self._is_enabled = True
        return response

    def _on_reset(self, request: Empty.Request, response: Empty.Response) -> Empty.Response:
        self.get_logger().info('Received a request to reset filter.')
        self._reset()
        return response

    def _reset(self) -> None:
        self._reader.reset()
        self._estimator.reset()
        self._last_published = -1
        self._missing.clear()

    def _on_jump(self, jump: TimeJump) -> None:
        """Begin anew when a simulation does, if that is asked; else say what happens."""
        now, step = self.get_clock().now().nanoseconds, jump.delta.nanoseconds
        self._jumps.observe(now - step)
        self._jumps.observe(now)
        # A timer of rcl misses a jump to 0, and waits until the former time has passed again.
        self._is_timer_stuck = True
        seconds = f'from {(now - step) / NANOSECONDS:.3f} s to {now / NANOSECONDS:.3f} s'
        if self._settings.is_on('reset_on_time_jump'):
            self.get_logger().info(f'Time jumped back {seconds}: the filter begins anew')
            self._reset()
        elif self._estimator.filter.is_initialized:
            self.get_logger().warning(
                f'Time jumped back {seconds}: nothing is published until it has passed again, as '
                "reset_on_time_jump is false; call the service 'reset', or set it"
            )

    # --- cycle --------------------------------------------------------------------------------

    def _update(self) -> None:
        """Take what has come, and publish."""
        if not self._is_enabled:
            self.get_logger().info(
                'Filter is disabled. To enable it call the '
                f'{self.resolve_service_name("enable")} service',
                once=True,
            )
            return
        now = self.get_clock().now().nanoseconds
        self._jumps.observe(now)
        if self._takes_measurements:
            self._estimator.integrate(now)
        else:
            self._estimator.clear()
            self._estimator.filter.time = now  # else all of it would be predicted afterwards
        if self._estimator.filter.is_initialized:
            self._publish()
        elapsed = (self.get_clock().now().nanoseconds - now) / NANOSECONDS
        if elapsed > 1.0 / self._settings.number('frequency'):
            self.get_logger().error(
                f'Failed to meet update rate! Took {elapsed} seconds. Try decreasing the rate, '
                'limiting sensor output frequency, or limiting the number of sensors.',
                throttle_duration_sec=_QUIET,
            )

    def _publish(self) -> None:
        each = self._estimator.filter
        if not (np.isfinite(each.state).all() and np.isfinite(each.covariance).all()):
            self.get_logger().error(
                'Critical Error, NaNs were detected in the output state of the filter. This was '
                'likely due to poorly coniditioned process, noise, or sensor covariances. The '
                'filter begins anew.'
            )
            self._reset()
            return
        # A late measurement changed a state that was published: tf2 warns of the same stamp again.
        is_correction = self._last_published >= each.time
        if is_correction and not self._settings.is_on('permit_corrected_publication'):
            return
        self._last_published = each.time
        odometry = odometry_message(each, self._settings)
        self._broadcast(odometry)
        self._outputs.odometry.publish(odometry)
        self._rate.tick()
        if self._outputs.acceleration is not None:
            self._outputs.acceleration.publish(
                acceleration_message(self._estimator, self._settings)
            )

    def _broadcast(self, odometry: Odometry) -> None:
        """Publish odom → base link, or, of a filter in map, map → odom."""
        parameters = self._settings
        if self._outputs.transform is None:
            return
        if parameters.world_frame == parameters.odom_frame:
            self._outputs.send_transform(odometry)
        elif parameters.world_frame == parameters.map_frame:
            odom_in_base = self._lookup(parameters.base_link_frame, parameters.odom_frame, 0)
            if odom_in_base is None:
                self._complain(
                    'odom_transform',
                    f'Could not obtain transform from {parameters.odom_frame}->'
                    f'{parameters.base_link_frame}: {parameters.map_frame}->'
                    f'{parameters.odom_frame} is not published',
                )
                return
            self._outputs.send_map_transform(odometry, odom_in_base)

    def _publish_diagnostics(self) -> None:
        now = self.get_clock().now().nanoseconds
        is_full = self._settings.is_on('diagnostic_updater.use_fqn')
        name = self.get_fully_qualified_name() if is_full else self.get_name()
        found = [self._diagnostics.take(), self._rate.take(now)]
        self._outputs.diagnostics.publish(diagnostic_array(name, found, now))

    # --- transforms and complaints ------------------------------------------------------------

    def _lookup(self, target: str, source: str, time: int) -> Transform | None:
        """Return a transform at a time, else the latest; None: there is none."""
        timeout = self._settings.nanoseconds('transform_timeout')
        return transform_at(self._buffer, target, source, time, timeout)

    def _complain(self, key: str, text: str) -> None:
        """Put it into the diagnostics; a transform that goes on missing into the log, too."""
        self._diagnostics.add(key, text)
        if not key.endswith('_transform'):
            return
        now = self.get_clock().now().nanoseconds
        since = self._missing.setdefault(key, now)
        # Right after the start transforms may not have come yet, which is no reason to complain.
        if now - since >= _QUIET * NANOSECONDS:
            self._missing[key] = now
            self.get_logger().warning(text)
