# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Build ROS 2 interface packages against the ROS of PyPI, without CMake.

PyPI has rclpy and the common interfaces of Jazzy, but not tf2_msgs, controller_manager_msgs and
others. Its wheels do carry the rosidl generators, headers and libraries, so what CMake's
``rosidl_generate_interfaces`` does can be done here, with the same type hashes: a robot started
with these packages and one started with the distribution's understand each other.

Every folder next to this one that holds a ``package.xml`` is built, in dependency order:

======================  ===========================================================================
:mod:`.packages`        what there is to build: names, dependencies, interface files
:mod:`.generators`      ``.msg .srv .action`` → ``.idl`` → type descriptions → C, C++ and Python
:mod:`.toolchain`       a C and C++ compiler that works: $CC and $CXX, gcc, clang, or zig from PyPI
:mod:`.libraries`       compile and link: five shared libraries and three Python extensions each
:mod:`.stage`           the tree to lay over a prefix: lib/, share/, include/, Python packages
:mod:`.build`           the order of all this
======================  ===========================================================================

``python -m interface_build --stage DIR`` builds without making a wheel; ``pip wheel`` comes here
through ``setup.py``.
"""


class BuildError(Exception):
    """An interface package cannot be built; ``str(error)`` says what was found and what to do."""

    exit_code = 1


class CompilerError(BuildError):
    """There is no compiler that works."""

    exit_code = 3
