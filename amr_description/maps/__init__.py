# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Maps without ROS: occupancy grids, their files, and shapes drawn into them.

Everything here is in a plane: lengths in m, angles in rad, counter-clockwise from the x axis.

=====================  ===========================================================================
module                 what it holds
=====================  ===========================================================================
``pose.py``            a pose in the plane
``grid.py``            ``OccupancyGrid``: what is free, occupied and unknown, in cells
``rasterization.py``   shapes as the cells that they touch, and what can be reached
``images.py``          PGM and PNG files
``map_files.py``       maps in files: ``.yaml`` and image, as map_server has them
=====================  ===========================================================================
"""
