# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controllers, by their type.

A new controller is a module here and an entry in :data:`CONTROLLERS`. One of another package needs
neither: its type is ``my_package.my_module/MyClass``.

====================================== ============================================================
``diff_drive_controller.py``           a twist → wheel speeds; wheel states → odometry
``diff_drive_parameters.py``           … its parameters
``command_reception.py``               … which velocity command is in force
``rate_limiter.py``                    … limits of velocity, acceleration and jerk
``odometry.py``                        … wheel speeds ↔ velocity of the base; the pose
``wheeled_drive.py``                   … their life, and the topics that they share
``mecanum_drive_controller.py``        a twist → four mecanum wheels; wheel states → odometry
``mecanum_drive_parameters.py``        … its parameters
``omni_wheel_drive_controller.py``     a twist → three or more omni wheels; wheel states → odometry
``holonomic_odometry.py``              … the pose of a robot that can go sideways
``steering_controllers.py``            a twist → driven and steered wheels; their states → odometry
``steering_parameters.py``             … their parameters
``steering_kinematics.py``             … bicycle, tricycle, Ackermann steering
``tricycle_controller.py``             a twist → one wheel that is driven and steered; odometry
``tricycle_limiters.py``               … its limits
``joint_trajectory_controller.py``     joints follow trajectories, from an action or a topic
``joint_trajectory_parameters.py``     … its parameters
``joint_trajectory_interfaces.py``     … interfaces of its joints, and their combinations
``joint_trajectory.py``                … splines between points in time
``trajectory_tolerances.py``           … how far a joint may be from them
``trajectory_checks.py``               … why a trajectory is not accepted
``pid.py``                             control_toolbox's PID, with its anti-windup strategies
``forward_command_controller.py``      commands from a topic, forwarded; joint group controllers
``joint_state_broadcaster.py``         joint states → ``/joint_states``
``sensor_broadcaster.py``              what the broadcasters below have in common
``imu_sensor_broadcaster.py``          an inertial measurement unit → ``~/imu``
``force_torque_sensor_broadcaster.py`` … a wrench → ``~/wrench``
``pose_broadcaster.py``                … a pose → ``~/pose``, ``/tf``
``range_sensor_broadcaster.py``        … a distance → ``~/range``
``gps_sensor_broadcaster.py``          … a satellite fix → ``~/gps/fix``
``magnetometer_broadcaster.py``        … a magnetic field → ``~/magnetic_field``
``battery_state_broadcaster.py``       … batteries → ``~/battery_state``
``state_interfaces_broadcaster.py``    … any states, as numbers
``gpio_command_controller.py``         GPIOs: commands from a topic, states on one
``filters.py``                         … filters of numbers, and chains of them
``chained_filter_controller.py``       states, filtered, for other controllers
``gripper_action_controller.py``       goals of a gripper: position, effort, stalling
``pid_controller.py``                  a PID for each degree of freedom, alone or in a chain
``gazebo_diff_drive.py``               a differential drive as Gazebo's plugins drive one
``gazebo_wheels.py``                   mecanum wheels and a car, likewise
``gazebo_planar_move.py``              a body that moves as commanded, whatever its wheels do
``gazebo_joint_command.py``            one number for a joint, or for several alike
``gazebo_odometry_publisher.py``       the true pose of a link as odometry

``absent_types.py``                    public types that are not here, and what would do
``former_drive_parameters.py``         what files of earlier releases say of drives
``parameter_sections.py``              the sections of parameter files, with their lines
``parameter_faults.py``                what is wrong in them, by its cause: misspelt names, types
``drive_files.py``                     the differential drives of them, for ``check_urdf``
``wheeled_drive_files.py``             the other wheeled drives of them, held against a robot
``roller_files.py``                    the mecanum and omni wheels of them, for the simulator
``drive_calibration.py``               multipliers of a differential drive from known motion
====================================== ============================================================
"""

from amr_description.controllers.absent_types import ABSENT
from amr_description.errors import ControllerError
from amr_description.registry import Registry

CONTROLLERS = Registry(
    'controller type',
    {
        'ackermann_steering_controller/AckermannSteeringController': (
            'amr_description.controllers.steering_controllers:AckermannSteeringController'
        ),
        'amr_description/GazeboAckermannDrive': (
            'amr_description.controllers.gazebo_wheels:GazeboAckermannDrive'
        ),
        'amr_description/GazeboDiffDrive': (
            'amr_description.controllers.gazebo_diff_drive:GazeboDiffDrive'
        ),
        'amr_description/GazeboJointCommand': (
            'amr_description.controllers.gazebo_joint_command:GazeboJointCommand'
        ),
        'amr_description/GazeboMecanumDrive': (
            'amr_description.controllers.gazebo_wheels:GazeboMecanumDrive'
        ),
        'amr_description/GazeboOdometryPublisher': (
            'amr_description.controllers.gazebo_odometry_publisher:GazeboOdometryPublisher'
        ),
        'amr_description/GazeboPlanarMove': (
            'amr_description.controllers.gazebo_planar_move:GazeboPlanarMove'
        ),
        'battery_state_broadcaster/BatteryStateBroadcaster': (
            'amr_description.controllers.battery_state_broadcaster:BatteryStateBroadcaster'
        ),
        'bicycle_steering_controller/BicycleSteeringController': (
            'amr_description.controllers.steering_controllers:BicycleSteeringController'
        ),
        'chained_filter_controller/ChainedFilter': (
            'amr_description.controllers.chained_filter_controller:ChainedFilter'
        ),
        'diff_drive_controller/DiffDriveController': (
            'amr_description.controllers.diff_drive_controller:DiffDriveController'
        ),
        'effort_controllers/GripperActionController': (
            'amr_description.controllers.gripper_action_controller:EffortGripperActionController'
        ),
        'effort_controllers/JointGroupEffortController': (
            'amr_description.controllers.forward_command_controller:JointGroupEffortController'
        ),
        'force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster': (
            'amr_description.controllers.force_torque_sensor_broadcaster:'
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
            'amr_description.controllers.gps_sensor_broadcaster:GPSSensorBroadcaster'
        ),
        'imu_sensor_broadcaster/IMUSensorBroadcaster': (
            'amr_description.controllers.imu_sensor_broadcaster:IMUSensorBroadcaster'
        ),
        'joint_state_broadcaster/JointStateBroadcaster': (
            'amr_description.controllers.joint_state_broadcaster:JointStateBroadcaster'
        ),
        'joint_trajectory_controller/JointTrajectoryController': (
            'amr_description.controllers.joint_trajectory_controller:JointTrajectoryController'
        ),
        'magnetometer_broadcaster/MagnetometerBroadcaster': (
            'amr_description.controllers.magnetometer_broadcaster:MagnetometerBroadcaster'
        ),
        'mecanum_drive_controller/MecanumDriveController': (
            'amr_description.controllers.mecanum_drive_controller:MecanumDriveController'
        ),
        'omni_wheel_drive_controller/OmniWheelDriveController': (
            'amr_description.controllers.omni_wheel_drive_controller:OmniWheelDriveController'
        ),
        'parallel_gripper_action_controller/GripperActionController': (
            'amr_description.controllers.gripper_action_controller:ParallelGripperActionController'
        ),
        'pid_controller/PidController': 'amr_description.controllers.pid_controller:PidController',
        'pose_broadcaster/PoseBroadcaster': (
            'amr_description.controllers.pose_broadcaster:PoseBroadcaster'
        ),
        'position_controllers/GripperActionController': (
            'amr_description.controllers.gripper_action_controller:PositionGripperActionController'
        ),
        'position_controllers/JointGroupPositionController': (
            'amr_description.controllers.forward_command_controller:JointGroupPositionController'
        ),
        'range_sensor_broadcaster/RangeSensorBroadcaster': (
            'amr_description.controllers.range_sensor_broadcaster:RangeSensorBroadcaster'
        ),
        'state_interfaces_broadcaster/StateInterfacesBroadcaster': (
            'amr_description.controllers.state_interfaces_broadcaster:StateInterfacesBroadcaster'
        ),
        'tricycle_controller/TricycleController': (
            'amr_description.controllers.tricycle_controller:TricycleController'
        ),
        'tricycle_steering_controller/TricycleSteeringController': (
            'amr_description.controllers.steering_controllers:TricycleSteeringController'
        ),
        'velocity_controllers/JointGroupVelocityController': (
            'amr_description.controllers.forward_command_controller:JointGroupVelocityController'
        ),
    },
    ControllerError,
    absent=ABSENT,
)
