# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What Nav2 and slam_toolbox demand of a robot, as rules over what was observed of its ROS graph.

Observations are plain data: stamps, times of reception, frames, endpoints with their types and
QoS. A rule is a function from them to an outcome; the table of all is in ``rules.py``. Whoever
collects (``navigation/ros/contract/``) waits, subscribes and asks; nothing here does.

========================  =========================================================================
module                    what it holds
========================  =========================================================================
``observations.py``       what was seen of a robot
``findings.py``           the outcome of a rule: passed, failed, not checked
``series.py``             rates and order of stamps, and the time at which something was received
``scan_length.py``        how many ranges slam_toolbox expects of a scan
``time_rules.py``         ``/clock``, ``use_sim_time``, real-time factor
``frame_rules.py``        the tree of frames, the transform of odometry
``odometry_rules.py``     ``odom``
``scan_rules.py``         ``scan``
``command_rules.py``      ``cmd_vel``, speeds, brakes, progress
``map_rules.py``          ``map``, ``initialpose``, ``map → odom``
``rules.py``              the table of rules, and how they are applied
``report.py``             findings as lines, and as JSON
========================  =========================================================================
"""
