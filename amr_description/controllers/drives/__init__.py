# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Controllers that drive a robot on wheels: a twist → wheels; wheel states → odometry.

================================== ================================================================
``wheeled_drive.py``               their life, and the topics that they share
``command_reception.py``           which velocity command is in force
``rate_limiter.py``                limits of velocity, acceleration and jerk
``odometry.py``                    wheel speeds ↔ velocity of the base; its pose, also sideways
``former_drive_parameters.py``     what files of earlier releases say of drives
``diff_drive_controller.py``       wheels on the left and on the right
``mecanum_drive_controller.py``    four mecanum wheels
``omni_wheel_drive_controller.py`` three or more omni wheels
``steering_controllers.py``        driven and steered wheels
``steering_kinematics.py``         … bicycle, tricycle, Ackermann steering
``tricycle_controller.py``         one wheel that is driven and steered
``twist_mux_controller.py``        before a drive: which of several commands it gets
================================== ================================================================
"""
