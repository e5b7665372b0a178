# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``nav2_simple_commander``: what programs in Python ask Nav2 for, or the navigator in its place.

Names, arguments and lines of the log are those of Jazzy. It is written anew.

=============================== ===================================================================
``robot_navigator.py``          ``BasicNavigator``, ``TaskResult``
``costmap_2d.py``               ``PyCostmap2D``: the cells of an OccupancyGrid
``line_iterator.py``            ``LineIterator``: the points of a line
``footprint_collision_checker.py`` ``FootprintCollisionChecker``: the costs below a footprint
``turtlebot4_navigator.py``     ``TurtleBot4Navigator``, as turtlebot4_navigation has it: a dock
=============================== ===================================================================
"""
