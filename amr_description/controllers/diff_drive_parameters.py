# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of diff_drive_controller 4.x: names, types, defaults and bounds."""

from dataclasses import dataclass
import math
from typing import Any, ClassVar

from amr_description.controllers import former_drive_parameters
from amr_description.controllers.rate_limiter import RateLimiter
from amr_description.former_parameters import FormerParameter
from amr_description.parameters import group, parameter

_NO_LIMIT: dict[str, Any] = {'nan': True}
LENGTH = (1e-3, 100.0)
"""m: from a toy to a mining truck, with room."""
_FACTOR = (0.01, 100.0)
_DEPRECATED = 'Deprecated: set the limits themselves to .nan instead'


@dataclass(frozen=True)
class SpeedLimits:
    """Limits of one component of the commanded twist; NaN: no limit."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.SPEED_LIMITS
    has_velocity_limits: bool = parameter(True, _DEPRECATED)
    has_acceleration_limits: bool = parameter(True, _DEPRECATED)
    has_jerk_limits: bool = parameter(True, _DEPRECATED)
    max_velocity: float = parameter(math.nan, 'Highest velocity', minimum=0.0, **_NO_LIMIT)
    min_velocity: float = parameter(
        math.nan, 'Lowest velocity; .nan: -max_velocity', maximum=0.0, **_NO_LIMIT
    )
    max_acceleration: float = parameter(
        math.nan, 'Away from zero, forward', minimum=0.0, **_NO_LIMIT
    )
    max_deceleration: float = parameter(
        math.nan,
        'Towards zero, forward; .nan: max_acceleration_reverse',
        maximum=0.0,
        **_NO_LIMIT,
    )
    max_acceleration_reverse: float = parameter(
        math.nan, 'Away from zero, in reverse; .nan: -max_acceleration', maximum=0.0, **_NO_LIMIT
    )
    max_deceleration_reverse: float = parameter(
        math.nan, 'Towards zero, in reverse; .nan: max_acceleration', minimum=0.0, **_NO_LIMIT
    )
    min_acceleration: float = parameter(
        math.nan, 'Deprecated, ignored: use max_deceleration', **_NO_LIMIT
    )
    max_jerk: float = parameter(math.nan, 'Highest jerk', minimum=0.0, **_NO_LIMIT)
    min_jerk: float = parameter(math.nan, 'Lowest jerk; .nan: -max_jerk', maximum=0.0, **_NO_LIMIT)

    @property
    def uses_deprecated(self) -> tuple[str, ...]:
        """The ``has_…`` switches that are off."""
        switches = ('has_velocity_limits', 'has_acceleration_limits', 'has_jerk_limits')
        return tuple(name for name in switches if not getattr(self, name))

    def limiter(self) -> RateLimiter:
        """Return the limiter. Raises ParameterError: a lower limit is above its upper one."""
        limits: dict[str, float] = {}
        if self.has_velocity_limits:
            limits |= {'min_value': self.min_velocity, 'max_value': self.max_velocity}
        if self.has_acceleration_limits:
            limits |= {
                'max_acceleration_reverse': self.max_acceleration_reverse,
                'max_acceleration': self.max_acceleration,
                'max_deceleration': self.max_deceleration,
                'max_deceleration_reverse': self.max_deceleration_reverse,
            }
        if self.has_jerk_limits:
            limits |= {'min_jerk': self.min_jerk, 'max_jerk': self.max_jerk}
        return RateLimiter(**limits)


_SIX_ZEROS = (0.0,) * 6


@dataclass(frozen=True)
class DiffDriveParameters:
    """The table of diff_drive_controller/DiffDriveController."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.DIFF_DRIVE
    left_wheel_names: tuple[str, ...] = parameter(
        (), 'Joints of the wheels on the left', not_empty=True
    )
    right_wheel_names: tuple[str, ...] = parameter(
        (), 'Joints of the wheels on the right', not_empty=True
    )
    wheel_separation: float = parameter(
        0.0,
        'Shortest distance between the left and the right wheels',
        unit='m',
        above=0.0,
        magnitude=LENGTH,
    )
    wheel_radius: float = parameter(
        0.0, 'Radius of a wheel', unit='m', above=0.0, magnitude=LENGTH
    )
    wheel_separation_multiplier: float = parameter(
        1.0,
        'Factor on the separation: a skid-steered robot scrubs, and turns less',
        not_zero=True,
        magnitude=_FACTOR,
    )
    left_wheel_radius_multiplier: float = parameter(
        1.0, 'Factor on the radius, left', not_zero=True, magnitude=_FACTOR
    )
    right_wheel_radius_multiplier: float = parameter(
        1.0, 'Factor on the radius, right', not_zero=True, magnitude=_FACTOR
    )
    tf_frame_prefix_enable: bool = parameter(True, 'Put a prefix before the frame ids')
    tf_frame_prefix: str = parameter('', 'That prefix; empty: the namespace of the node')
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given')
    base_frame_id: str = parameter('base_link', 'Frame whose pose is given: the root of the URDF')
    pose_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of x, y, z, roll, pitch, yaw', unit='m², rad²', length=6
    )
    twist_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of the twist, in the same order', unit='m²/s², rad²/s²', length=6
    )
    open_loop: bool = parameter(False, 'Odometry from the limited commands, not from the wheels')
    position_feedback: bool = parameter(
        True, 'Odometry from the positions of the wheels, not from their velocities'
    )
    enable_odom_tf: bool = parameter(True, 'Publish the transform from odom to base on /tf')
    cmd_vel_timeout: float = parameter(
        0.5,
        'Age at which a command ends and the robot brakes; 0: never',
        unit='s',
        minimum=0.0,
        magnitude=(1e-6, 1e9),
    )
    publish_limited_velocity: bool = parameter(False, 'Publish the limited command, ~/cmd_vel_out')
    velocity_rolling_window_size: int = parameter(
        10, 'Samples in the mean of the estimated twist', minimum=1, magnitude=(1, 100_000)
    )
    publish_rate: float = parameter(
        50.0, 'Rate of odometry and transform', unit='Hz', above=0.0, magnitude=(1e-3, 1e5)
    )
    enable_cmd_vel_unstamped: bool = parameter(
        False,
        'Subscribe to plain Twist on ~/cmd_vel_unstamped too, which counts as stamped on arrival. '
        'Not in the original (use_stamped_vel of Humble: false moved all input there)',
    )
    preserve_curvature: bool = parameter(
        False,
        'Limit linear and angular velocity by one factor, so that the robot keeps to the arc. '
        'Not in the original',
    )
    linear: SpeedLimits = group('linear.x', SpeedLimits)
    angular: SpeedLimits = group('angular.z', SpeedLimits)

    def frame_ids(self, namespace: str) -> tuple[str, str]:
        """
        Return the ids of the odometry and the base frame, with their prefix.

        The prefix is ``tf_frame_prefix`` or, if that is empty, the namespace of the node.
        """
        prefix = tf_prefix(self.tf_frame_prefix_enable, self.tf_frame_prefix, namespace)
        return prefix + self.odom_frame_id, prefix + self.base_frame_id


def tf_prefix(is_enabled: bool, prefix: str, namespace: str) -> str:
    """
    Return what to put before frame ids: it ends with one slash and begins with none.

    Args:
        is_enabled: False: nothing.
        prefix: as written, where ``~`` stands for the namespace; empty: the namespace.
        namespace: of the controller's node.
    """
    if not is_enabled:
        return ''
    prefix = prefix.replace('~', namespace.strip('/')) or namespace
    return (prefix if prefix.endswith('/') else f'{prefix}/').removeprefix('/')
