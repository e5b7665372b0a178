# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Build ROS 2 interface packages against the ROS of PyPI.

PyPI has rclpy and the common interfaces of Jazzy, but not tf2_msgs, controller_manager_msgs and
others, and none of a user's own. Its wheels do carry the rosidl generators, headers and libraries,
so what CMake's ``rosidl_generate_interfaces`` does can be done here, with the same type hashes: a
robot started with these packages and one started with the distribution's understand each other.

========================== =======================================================================
``definitions.py``         ``.msg``, ``.srv`` and ``.action`` files: what is wrong, line and column
``packages.py``            names, dependencies and interface files; the packages that are installed
``generators.py``          ``.msg .srv .action`` → ``.idl`` → type descriptions → C, C++ and Python
``toolchain.py``           a compiler that works: $CC and $CXX, gcc, clang, or zig from PyPI
``libraries.py``           compile and link: five shared libraries and three Python extensions each
``stage.py``               the tree to lay over a prefix: lib/, share/, include/, Python packages
``build.py``               the order of all this; what is up to date is not made again
``cmake_target.py``        what ``rosidl_generate_interfaces`` of a CMakeLists.txt runs
``records.py``             files that are up to date are left alone
``wheel.py``               the tree as a wheel
========================== =======================================================================

It has three users: ``interfaces/setup.py``, which makes the wheel of the packages that this
project brings; ``colcon build`` of a workspace, by way of ``rosidl_generate_interfaces.cmake``;
and ``ros2 run amr_description build_interfaces``.
"""
