# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Types of controllers that are public, and not here: what does, or would do, in their place."""

_TRAJECTORIES = 'joint_trajectory_controller/JointTrajectoryController'
_JOINTS = f'move the joints by {_TRAJECTORIES}'
_VENDOR = 'it needs the hardware of its vendor, and the simulated robot does without it'

ABSENT: dict[str, str] = {
    'admittance_controller/AdmittanceController': (
        f'{_JOINTS}; ~/wrench of a force_torque_sensor_broadcaster tells the forces'
    ),
    'motion_primitives_controllers/MotionPrimitivesForwardController': _JOINTS,
    'motion_primitives_controllers/MotionPrimitivesFromTrajectoryController': _JOINTS,
    'swerve_drive_controller/SwerveController': (
        'steer and drive the wheels by two forward_command_controllers'
    ),
    'vda5050_safety_state_broadcaster/VDA5050SafetyStateBroadcaster': (
        'state_interfaces_broadcaster/StateInterfacesBroadcaster publishes its states'
    ),
    'ros2_control_demo_example_7/RobotController': _JOINTS,
    'cartesian_compliance_controller/CartesianComplianceController': _JOINTS,
    'cartesian_force_controller/CartesianForceController': _JOINTS,
    'cartesian_motion_controller/CartesianMotionController': _JOINTS,
    'ur_controllers/SpeedScalingStateBroadcaster': _VENDOR,
    'ur_controllers/GPIOController': 'gpio_controllers/GpioCommandController drives GPIOs',
    'ur_controllers/ForceModeController': _VENDOR,
    'ur_controllers/FreedriveModeController': _VENDOR,
    'ur_controllers/ToolContactController': _VENDOR,
    'ur_controllers/URConfigurationController': _VENDOR,
    'robotiq_controllers/RobotiqActivationController': _VENDOR,
}
"""Type → what would do."""

CLASSES: dict[str, str] = {
    'ForceTorqueStateBroadcaster': 'force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster',
    'JointStateController': 'joint_state_broadcaster/JointStateBroadcaster',
    'PassthroughTrajectoryController': _TRAJECTORIES,
    'ScaledJointTrajectoryController': _TRAJECTORIES,
}
"""Class of a vendor, or of a former release → the type that does the same here."""
