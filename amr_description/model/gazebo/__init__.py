# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``<gazebo>`` blocks: what a robot that was made for Gazebo says, of ROS 2 and of ROS 1.

====================== ============================================================================
``tags.py``            plugins and sensors, and the plugin that hosts ros2_control
``physics.py``         ``<gazebo reference="…">``: friction, springs, gravity, self-collision
``slip.py``            … wheels that slip in proportion to the force
``sensors.py``         lidars, cameras and contact sensors of ``<sensor>`` tags
``sensor_tags.py``     … the values of these tags, checked
``classic_sensors.py`` … what Gazebo Classic's plugins in them publish
``plugins.py``         the plugins that drive a robot without ros2_control, and what they say
``translation.py``     what they become: ``translate(robot)``
``builder.py``         … collects it: hardware, controllers, lines to say
``drives.py``          … of drives and odometry
``joints.py``          … of plugins of single joints
``instruments.py``     … of sensors whose values are state interfaces
``bridge.py``          … files of ros_gz_bridge: what topics are called in ROS
====================== ============================================================================
"""
