# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The sensors of simulated robots that look at the world, as topics: lidars, cameras, contacts.

=========================== =======================================================================
``manager.py``              all sensors of all robots: which one measures, and when
``equipment.py``            what they measure with; loaded with the first sensor
``measure_service.py``     ``~/measure``: the present instant, while time stands still
``topics.py``               what the topics of one sensor are: the contract of the modules below
``contact.py``              contact sensors and bumpers
``worker.py``               the thread that measures what takes long
``camera.py``               cameras: pictures, depth, points
``image_messages.py``       … their messages
``lidar.py``                lidars and range finders: scans, points, ranges
``lidar_messages.py``       … their messages
=========================== =======================================================================
"""
