# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Packages of ROS that are Python and that nodes of robots import, where they are not installed.

Each is importable by its own name, has the functions of Jazzy, and is written anew.

========================== =====================================================================
``cv_bridge.py``           images ↔ arrays; with OpenCV, where it is installed, also more formats
``diagnostic_updater.py``  what a node says of its health on ``/diagnostics``
``image_geometry.py``      points in space ↔ pixels of a camera
``interactive_markers.py`` handles and menus that RViz shows, and what is done with them
``laser_geometry.py``      scans → point clouds
``launch_testing_ros.py``  topics that tests wait for; the rest is in ``launch_testing/``
``ros2_api.py``            what ``ros2node.api``, ``ros2param.api`` and their like ask of a graph
``rosbag2_py.py``          bags read and written, one message after the other
``rosidl_runtime_py.py``   messages as YAML, CSV and dictionaries; classes by their names
``tf_transformations.py``  quaternions, Euler angles, homogeneous matrices
``urdf_parser_py.py``      robot descriptions as objects
========================== =====================================================================
"""
