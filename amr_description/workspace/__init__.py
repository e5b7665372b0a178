# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Workspaces of users: what ``colcon build`` needs beside colcon itself.

====================  =============================================================================
``cmake.py``          CMake as colcon starts it: why it failed, in one line where that is known
``cmake_errors.py``   that line, from the words of CMake
``python_half.py``    a package without the half that lacks a library of C++
``colcon.py``         an extension of colcon: a package that fails does not stop the others
====================  =============================================================================

No ROS: colcon starts ``cmake.py`` three times a package, without the packages of PyPI.
"""
