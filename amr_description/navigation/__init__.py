# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Navigation without ROS: costs, paths, filters, and what Nav2 and slam_toolbox demand.

Everything here is in a plane: lengths in m, angles in rad, counter-clockwise from the x axis.
Time and chance are arguments, nothing here knows of ROS; ``navigation/ros/`` is the face towards
it, and the executables (``map_server``, ``twist_mux`` …) are in ``nodes/``.

=============================  ===================================================================
module                         what it holds
=============================  ===================================================================
``distance_field.py``          how far each cell is from the nearest occupied one
``twist_mux.py``               which of several velocity commands goes on to the wheels

``scan_matching.py``           a scan matched against a map: ``ScanMatcher``
``localization.py``            the same from scan to scan, with odometry: ``ScanTracker``

``footprint.py``               the robot seen from above, as a polygon
``costmap.py``                 what it costs to be in a cell: map, scan, inflation
``planner.py``                 a path over a costmap: A*, smoothed
``path_follower.py``           where on a path the robot is, and what is ahead of it
``regulated_pure_pursuit.py``  the velocity that follows a path
``plugins.py``                 planners and followers of users: functions
``behaviors.py``               turn, back up, drive straight, wait, assisted teleop
``waypoints.py``               one goal after the other, some of which may be missed
``drive.py``                   a goal from the first step to the end: all of these together

``contract/``                  what Nav2 and slam_toolbox demand of a robot, as rules
``ros/``                       the face towards ROS

``navsat.py``                  latitude and longitude ↔ metres, as navsat_transform_node has it

``ekf.py``                     the extended Kalman filter of robot_localization: 15 states
``ekf_estimator.py``           measurements through it in order, late ones too
``ekf_measurement.py``         what sensors say → measurements of its states
``ekf_parameters.py``          its parameters, by their names in robot_localization
``ekf_diagnostics.py``         what is wrong with its settings and its data
=============================  ===================================================================
"""
