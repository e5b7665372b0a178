# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The executables: ROS nodes and the programs that talk to them. Only here and in ``cli`` is rclpy imported.

One executable is one module with ``main(args: list[str] | None = None) -> int``; ``setup.py`` makes a
``console_scripts`` entry of it, which calls ``sys.exit(main())``. A module without ``main`` is a part of the
executables beside it and imports no rclpy where its docstring says so:

========================== ==========================================================================
``runtime``                init, spin, shutdown, exit code: once, for every executable
``stop_requests``          SIGINT, SIGTERM, SIGHUP and the lifeline as one request to stop (no rclpy)
========================== ==========================================================================
"""
