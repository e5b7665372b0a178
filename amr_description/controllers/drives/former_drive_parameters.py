# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What parameter files of earlier releases say of drives, and what is made of it.

From ros2_controllers' migration notes (Humble to Jazzy), and what Humble's controllers read.
"""

from collections.abc import Mapping
import math
from typing import Any

from amr_description.former_parameters import (
    FormerParameter,
    FormerValue,
    ignored,
    OF_BEFORE,
    replaced,
)


def _stamped(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
    if value is False and 'enable_cmd_vel_unstamped' not in given:
        return FormerValue(
            f'{OF_BEFORE}Humble: plain Twist is taken on ~/cmd_vel_unstamped, besides '
            'TwistStamped on ~/cmd_vel; Jazzy takes TwistStamped only',
            {'enable_cmd_vel_unstamped': True},
        )
    return None


def _stamped_only(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
    if value is False:
        return FormerValue(
            f'{OF_BEFORE}Humble, and has no effect: TwistStamped is all that is taken', {}
        )
    return None


def _tilde(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
    if value == '~':
        return FormerValue(
            f'{OF_BEFORE}releases after Jazzy: the namespace of the node, as an empty one is here',
            {'tf_frame_prefix': ''},
        )
    return None


def _lowest_acceleration(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
    """
    Read Humble's bounds of Δv/Δt, [min_acceleration, max_acceleration], whichever way it drives.

    Without it, or if it is −max_acceleration, what the others say is the same.
    """
    names = ('max_deceleration', 'max_acceleration_reverse')
    highest = given.get('max_acceleration', math.nan)
    if not _is_number(value) or not _is_number(highest) or value > 0.0 or value == -highest:
        return None
    if any(name in given for name in names) or given.get('has_acceleration_limits') is False:
        return None
    return FormerValue(
        f'{OF_BEFORE}Humble: taken as {" and ".join(names)}', dict.fromkeys(names, float(value))
    )


def _jerk(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
    if not _is_number(value) or value != 0.0 or given.get('has_jerk_limits') is False:
        return None
    return FormerValue(
        'with it the robot would never move: taken as no limit, .nan',
        {'max_jerk': math.nan, 'min_jerk': math.nan},
    )


def _is_number(value: Any) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool) and value == value


_SUM = 'kinematics.sum_of_robot_center_projection_on_X_Y_axis'


def _renamed(name: str, new: str) -> FormerParameter:
    """Return a parameter of another mecanum drive that has one of another name here."""

    def read(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
        if new in given:
            return None
        values = {new: value}
        if new == 'front_left_wheel_command_joint_name' and 'reference_timeout' not in given:
            values['reference_timeout'] = given.get('cmd_vel_timeout', _FORKS_TIMEOUT)
        return FormerValue(f'{OF_BEFORE}{_FORKS}: taken as {" and ".join(values)}', values)

    return FormerParameter(name, read)


def _halves(name: str, other: str) -> FormerParameter:
    """Return the first of two distances between wheels, of another mecanum drive."""

    def read(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
        beside = given.get(other)
        if _SUM in given or not (_is_number(value) and _is_number(beside)):
            return None
        return FormerValue(
            f'{OF_BEFORE}{_FORKS}: half of it and of {other} is taken as {_SUM}',
            {_SUM: 0.5 * (value + beside)},
        )

    return FormerParameter(name, read)


def _four(kind: str) -> FormerParameter:
    """Return the list of the four wheels' joints that mecanum drives had before their release."""

    def read(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
        names = [f'{corner}_wheel_{kind}_joint_name' for corner in _CORNERS]
        is_list = isinstance(value, list) and len(value) == len(names)
        if not is_list or any(name in given for name in names):
            return None
        return FormerValue(
            f'{OF_BEFORE}an early mecanum drive controller: taken as the joints front left, '
            'rear left, rear right, front right',
            dict(zip(names, value, strict=True)),
        )

    return FormerParameter(f'{kind}_joint_names', read)


def _known(name: str) -> FormerParameter:
    """Return one that another says what is made of it."""
    return FormerParameter(name, lambda value, given: None)


_CORNERS = ('front_left', 'rear_left', 'rear_right', 'front_right')
_FORKS = 'another mecanum drive controller'
_FORKS_TIMEOUT = 0.5
"""s: what they have for cmd_vel_timeout."""
TF_PREFIX = (FormerParameter('tf_frame_prefix', _tilde),)
STAMPED_ONLY = (FormerParameter('use_stamped_vel', _stamped_only),)
SPEED_LIMITS = (
    FormerParameter('min_acceleration', _lowest_acceleration),
    FormerParameter('max_jerk', _jerk),
)
DIFF_DRIVE = (
    *TF_PREFIX,
    FormerParameter('use_stamped_vel', _stamped),
    ignored('wheels_per_side', 'Foxy', 'the names of the wheels say how many there are'),
    ignored('publish_wheel_data', 'ROS 1', '/joint_states has what the wheels do'),
    ignored('publish_cmd', 'ROS 1', 'publish_limited_velocity is what publishes ~/cmd_vel_out'),
    ignored('preserve_turning_radius', 'ROS 1', 'preserve_curvature keeps the arc here'),
    replaced(
        'wheel_radius_multiplier',
        'ROS 1',
        'left_wheel_radius_multiplier',
        'right_wheel_radius_multiplier',
    ),
)
MECANUM = (
    *TF_PREFIX,
    *(
        _renamed(name.format(row, side), f'{new}_{side}_wheel_command_joint_name')
        for side in ('left', 'right')
        for name, row, new in (
            ('{}_{}_wheel_name', 'front', 'front'),
            ('{}_{}_wheel_name', 'rear', 'rear'),
            ('{}_{}_joint_name', 'front', 'front'),
            ('{}_{}_joint_name', 'back', 'rear'),
            ('{}_{}_joint_name', 'rear', 'rear'),
        )
    ),
    _four('command'),
    _four('state'),
    _renamed('wheel_radius', 'kinematics.wheels_radius'),
    _halves('wheel_separation_x', 'wheel_separation_y'),
    _halves('wheel_base', 'wheel_separation'),
    *map(_known, ('wheel_separation_y', 'wheel_separation', 'cmd_vel_timeout', 'use_stamped_vel')),
)
"""Of Husarion's and of the tutorials': other names of the same, on ~/cmd_vel there."""
