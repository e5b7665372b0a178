# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The interfaces of a simulated robot's body as a whole: it is moved, and its truth is read."""

BASE = 'gazebo_base'
"""The name of the hardware component, and what its command interfaces begin with."""
COMMAND_AXES = ('linear.x', 'linear.y', 'angular.z')
"""Its command interfaces: velocity of the root link in its own axes, m/s and rad/s."""
TRUTH = (
    *(f'position.{axis}' for axis in 'xyz'),
    *(f'orientation.{axis}' for axis in 'xyzw'),
    *(f'linear_velocity.{axis}' for axis in 'xyz'),
    *(f'angular_velocity.{axis}' for axis in 'xyz'),
)
"""
Its state interfaces of a link: the pose in the world, m and a unit quaternion; the velocity of the
link's origin in the link's own axes, m/s and rad/s.
"""

_SUFFIX = '/ground_truth'


def truth_prefix(link: str) -> str:
    """Return what the state interfaces of a link's true motion begin with."""
    return f'{link}{_SUFFIX}'


def link_of(prefix: str) -> str:
    """Return the link of :func:`truth_prefix`."""
    return prefix.removesuffix(_SUFFIX)
