# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controllers, by their type.

A new controller is a module here, or in a folder below, and an entry in :data:`CONTROLLERS`. One
of another package needs neither: its type is ``my_package.my_module/MyClass``.

================================= =================================================================
``drives/``                       a twist → wheels; wheel states → odometry
``broadcasters/``                 states → topics
``joint_trajectory/``             joints follow trajectories
``gazebo/``                       what stands for the plugins of Gazebo
``checks/``                       parameter files, held against the tables and a robot

``forward_command_controller.py`` commands from a topic, forwarded; joint group controllers
``gpio_command_controller.py``    GPIOs: commands from a topic, states on one
``gripper_action_controller.py``  goals of a gripper: position, effort, stalling
``pid_controller.py``             a PID for each degree of freedom, alone or in a chain
``pid.py``                        control_toolbox's PID, with its anti-windup strategies
``filters.py``                    filters of numbers; states, filtered, for other controllers
``absent_types.py``               public types that are not here, and what would do
================================= =================================================================
"""

from amr_description.controllers.absent_types import ABSENT
from amr_description.errors import ControllerError
from amr_description.registry import Registry

CONTROLLERS = Registry(
    'controller type',
    {
        'ackermann_steering_controller/AckermannSteeringController': (
            'amr_description.controllers.drives.steering_controllers:AckermannSteeringController'
        ),
        'amr_description/GazeboAckermannDrive': (
            'amr_description.controllers.gazebo.wheels:GazeboAckermannDrive'
        ),
        'amr_description/GazeboDiffDrive': (
            'amr_description.controllers.gazebo.diff_drive:GazeboDiffDrive'
        ),
        'amr_description/GazeboJointCommand': (
            'amr_description.controllers.gazebo.joint_command:GazeboJointCommand'
        ),
        'amr_description/GazeboMecanumDrive': (
            'amr_description.controllers.gazebo.wheels:GazeboMecanumDrive'
        ),
        'amr_description/GazeboOdometryPublisher': (
            'amr_description.controllers.gazebo.odometry_publisher:GazeboOdometryPublisher'
        ),
        'amr_description/GazeboPlanarMove': (
            'amr_description.controllers.gazebo.planar_move:GazeboPlanarMove'
        ),
        'battery_state_broadcaster/BatteryStateBroadcaster': (
            'amr_description.controllers.broadcasters.battery_state_broadcaster:BatteryStateBroadcaster'
        ),
        'bicycle_steering_controller/BicycleSteeringController': (
            'amr_description.controllers.drives.steering_controllers:BicycleSteeringController'
        ),
        'chained_filter_controller/ChainedFilter': (
            'amr_description.controllers.filters:ChainedFilter'
        ),
        'diff_drive_controller/DiffDriveController': (
            'amr_description.controllers.drives.diff_drive_controller:DiffDriveController'
        ),
        'effort_controllers/GripperActionController': (
            'amr_description.controllers.gripper_action_controller:EffortGripperActionController'
        ),
        'effort_controllers/JointGroupEffortController': (
            'amr_description.controllers.forward_command_controller:JointGroupEffortController'
        ),
        'force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster': (
            'amr_description.controllers.broadcasters.force_torque_sensor_broadcaster:'
            'ForceTorqueSensorBroadcaster'
        ),
        'forward_command_controller/ForwardCommandController': (
            'amr_description.controllers.forward_command_controller:ForwardCommandController'
        ),
        'forward_command_controller/MultiInterfaceForwardCommandController': (
            'amr_description.controllers.forward_command_controller:'
            'MultiInterfaceForwardCommandController'
        ),
        'gpio_controllers/GpioCommandController': (
            'amr_description.controllers.gpio_command_controller:GpioCommandController'
        ),
        'gps_sensor_broadcaster/GPSSensorBroadcaster': (
            'amr_description.controllers.broadcasters.sensor_broadcasters:GPSSensorBroadcaster'
        ),
        'imu_sensor_broadcaster/IMUSensorBroadcaster': (
            'amr_description.controllers.broadcasters.sensor_broadcasters:IMUSensorBroadcaster'
        ),
        'joint_state_broadcaster/JointStateBroadcaster': (
            'amr_description.controllers.broadcasters.joint_state_broadcaster:JointStateBroadcaster'
        ),
        'joint_trajectory_controller/JointTrajectoryController': (
            'amr_description.controllers.joint_trajectory.controller:JointTrajectoryController'
        ),
        'magnetometer_broadcaster/MagnetometerBroadcaster': (
            'amr_description.controllers.broadcasters.sensor_broadcasters:MagnetometerBroadcaster'
        ),
        'mecanum_drive_controller/MecanumDriveController': (
            'amr_description.controllers.drives.mecanum_drive_controller:MecanumDriveController'
        ),
        'omni_wheel_drive_controller/OmniWheelDriveController': (
            'amr_description.controllers.drives.omni_wheel_drive_controller:OmniWheelDriveController'
        ),
        'parallel_gripper_action_controller/GripperActionController': (
            'amr_description.controllers.gripper_action_controller:ParallelGripperActionController'
        ),
        'passthrough_controller/PassthroughController': (
            'amr_description.controllers.forward_command_controller:PassthroughController'
        ),
        'pid_controller/PidController': 'amr_description.controllers.pid_controller:PidController',
        'pose_broadcaster/PoseBroadcaster': (
            'amr_description.controllers.broadcasters.sensor_broadcasters:PoseBroadcaster'
        ),
        'position_controllers/GripperActionController': (
            'amr_description.controllers.gripper_action_controller:PositionGripperActionController'
        ),
        'position_controllers/JointGroupPositionController': (
            'amr_description.controllers.forward_command_controller:JointGroupPositionController'
        ),
        'range_sensor_broadcaster/RangeSensorBroadcaster': (
            'amr_description.controllers.broadcasters.sensor_broadcasters:RangeSensorBroadcaster'
        ),
        'state_interfaces_broadcaster/StateInterfacesBroadcaster': (
            'amr_description.controllers.broadcasters.state_interfaces_broadcaster:StateInterfacesBroadcaster'
        ),
        'tricycle_controller/TricycleController': (
            'amr_description.controllers.drives.tricycle_controller:TricycleController'
        ),
        'tricycle_steering_controller/TricycleSteeringController': (
            'amr_description.controllers.drives.steering_controllers:TricycleSteeringController'
        ),
        'twist_mux_controller/TwistMuxController': (
            'amr_description.controllers.drives.twist_mux_controller:TwistMuxController'
        ),
        'velocity_controllers/JointGroupVelocityController': (
            'amr_description.controllers.forward_command_controller:JointGroupVelocityController'
        ),
    },
    ControllerError,
    absent=ABSENT,
    base='amr_description.control.contracts:Controller',
    needs={'parameters_type': 'the dataclass of its parameters'},
)
