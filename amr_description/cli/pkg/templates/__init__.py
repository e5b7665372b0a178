# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The files of a new package, as ``ros2 pkg create`` writes them.

``manifest.py`` has package.xml, ``python.py`` the files of ``ament_python``, ``cmake.py`` those of
``ament_cmake`` and ``cmake``, ``cpp.py`` the sources of their nodes and libraries. Names, targets
and folders are those of Jazzy's, so that what tutorials say about the files is true.
"""
