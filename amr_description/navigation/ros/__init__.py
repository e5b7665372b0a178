# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Navigation's face towards ROS.

======================  ==========================================================================
module                  what it holds
======================  ==========================================================================
``contract/``           collects what the rules of ``navigation/contract/`` are applied to
``messages.py``         grids and poses ↔ ``nav_msgs`` and ``geometry_msgs``
``map_service.py``      a map on ``/map``, latched, and by ``~/map``

``localizer.py``        map → odom, ``amcl_pose`` and ``initialpose`` of a localizer
``transform_queue.py``  messages that wait for the transform at their stamp
``entity_mover.py``     puts a robot somewhere else in its simulator

``managed_names.py``    ``get_state`` under the names of Nav2's lifecycle nodes
``costmap_services.py`` costmaps: what they are, what is forgotten of them
``behavior_servers.py`` ``spin``, ``backup``, ``drive_on_heading``, ``wait``, ``assisted_teleop``
``goals.py``            action servers that take one goal at a time
``surroundings.py``     map, scan, pose and speed for who drives

``ekf_node.py``         ``EkfNode``: sensors in, ``odometry/filtered`` and a transform out
``ekf_inputs.py``       messages of sensors → measurements of the filter
``ekf_outputs.py``      the state of the filter → messages, and their publishers
======================  ==========================================================================
"""
