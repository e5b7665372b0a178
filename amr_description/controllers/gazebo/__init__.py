# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Controllers that stand for the plugins of Gazebo, for robots that have only these.

========================= =========================================================================
``diff_drive.py``         a differential drive as Gazebo's plugins drive one
``wheels.py``             mecanum wheels and a car, likewise
``planar_move.py``        a body that moves as commanded, whatever its wheels do
``joint_command.py``      one number for a joint, or for several alike
``odometry_publisher.py`` the true pose of a link as odometry
========================= =========================================================================
"""
