# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics of a simulation, with ROS or without: what is published at the end of a cycle.

=========================== =======================================================================
``advertising.py``          how topics are made: the contract
``names.py``                names of topics and frames
``ground_truth.py``         ``ground_truth/odom`` and ``ground_truth/wheels`` of every robot
``link_transforms.py``      transforms of links, for a recording
``world_markers.py``        ``~/world``: the static geometry as markers

``sensor_manager.py``       all sensors of all robots: which one measures, and when
``sensor_factory.py``            what they measure with; loaded with the first sensor
``sensor_topics.py``        what the topics of one sensor are: the contract of the modules below
``contact.py``              contact sensors and bumpers
``worker.py``               the thread that measures what takes long
``camera.py``               cameras: pictures, depth, points
``lidar.py``                lidars and range finders: scans, points, ranges
=========================== =======================================================================
"""
