# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Collects from a ROS graph what the rules of ``navigation/contract/`` are applied to.

===================  =============================================================================
module               what it holds
===================  =============================================================================
``collector.py``     subscriptions with the QoS of Nav2 and slam_toolbox, until enough has come
``graph.py``         endpoints of topics; parameters of all nodes
``driving.py``       commands to the robot, and what odometry says of them
===================  =============================================================================
"""
