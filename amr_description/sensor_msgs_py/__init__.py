# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``sensor_msgs_py`` in Python, for nodes that run where the original is not installed.

In the environment of ``scripts/setup`` such a node imports it under its name::

    from sensor_msgs_py import point_cloud2

    for x, y, z in point_cloud2.read_points(cloud, ['x', 'y', 'z'], skip_nans=True):
        ...

``point_cloud2.py``   PointCloud2 messages from and to NumPy arrays and lists of points
``numpy_compat.py``   structured arrays as plain ones, and back
"""
