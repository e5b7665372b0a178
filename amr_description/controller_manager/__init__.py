# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A controller manager from a description and parameter files, with what can be asked of it; no ROS.

``control`` has the manager itself, which knows neither files nor plugins by name. Over ROS,
``control/ros`` serves what is here by nodes, services and topics; in a process without ROS
``simulation`` uses it directly.

======================== ==========================================================================
``parameters.py``        the parameters of a manager, and those that it keeps for a controller
``parameter_store.py``   … where they are: in a node, or in a plain table
``plain_parameters.py``  … the plain table, from ROS arguments and parameter files
``bring_up.py``          a manager with its hardware, started
``made_controllers.py``  a controller of a class, with its parameters
``requests.py``          load, configure, switch, unload

``spawner.py``           takes controllers through their states
``spawner_arguments.py`` … the command line of it
``spawner_files.py``     … parameter files of the controllers
======================== ==========================================================================
"""
