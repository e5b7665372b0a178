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
        'joint_state_broadcaster/JointStateBroadcaster': (
            'amr_description.controllers.joint_state_broadcaster:JointStateBroadcaster'
        ),
    },
    ControllerError,
)
