# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Hardware components: what a controller's commands end in, and where its states come from.

``<plugin>`` of a ``<ros2_control>`` block names the class: one of the table below, or
``my_package.my_module/MyClass`` for one of yours, a
:class:`~amr_description.control.contracts.HardwareComponent`. Nothing is imported until its name
is asked for.
"""

from amr_description.errors import HardwareError
from amr_description.registry import Registry

_MUJOCO_SYSTEM = 'amr_description.hardware.mujoco_system:MujocoSystem'
_MOCK_SYSTEM = 'amr_description.hardware.mock_system:MockSystem'
_SERIAL_BASE_SYSTEM = 'amr_description.hardware.serial_base_system:SerialBaseSystem'

HARDWARE = Registry(
    'hardware plugin',
    {
        'amr_description/MujocoSystem': _MUJOCO_SYSTEM,
        # A description written for another simulator runs here unchanged.
        'gz_ros2_control/GazeboSimSystem': _MUJOCO_SYSTEM,
        'mujoco_ros2_control/MujocoSystemInterface': _MUJOCO_SYSTEM,
        'mock_components/GenericSystem': _MOCK_SYSTEM,
        'amr_description/SerialBaseSystem': _SERIAL_BASE_SYSTEM,
    },
    HardwareError,
)
"""Plugin name → class."""
