# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controllers, by the type that a YAML file names.

A new one is a file here and a line in the table; one of another package needs neither, its type
is ``my_package.my_module/MyClass``.
"""

from amr_description.errors import ControllerError
from amr_description.registry import Registry

CONTROLLERS = Registry(
    'controller type',
    {
        'diff_drive_controller/DiffDriveController': (
            'amr_description.controllers.diff_drive_controller:DiffDriveController'
        ),
        'effort_controllers/JointGroupEffortController': (
            'amr_description.controllers.forward_command_controller:JointGroupEffortController'
        ),
        'forward_command_controller/ForwardCommandController': (
            'amr_description.controllers.forward_command_controller:ForwardCommandController'
        ),
        'forward_command_controller/MultiInterfaceForwardCommandController': (
            'amr_description.controllers.forward_command_controller:'
            'MultiInterfaceForwardCommandController'
        ),
        'imu_sensor_broadcaster/IMUSensorBroadcaster': (
            'amr_description.controllers.imu_sensor_broadcaster:IMUSensorBroadcaster'
        ),
        'joint_state_broadcaster/JointStateBroadcaster': (
            'amr_description.controllers.joint_state_broadcaster:JointStateBroadcaster'
        ),
        'position_controllers/JointGroupPositionController': (
            'amr_description.controllers.forward_command_controller:JointGroupPositionController'
        ),
        'velocity_controllers/JointGroupVelocityController': (
            'amr_description.controllers.forward_command_controller:JointGroupVelocityController'
        ),
    },
    ControllerError,
)
