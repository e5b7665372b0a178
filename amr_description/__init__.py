# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Drive a physically true ROS 2 robot: model, control, simulation, bring-up and command line.

======================  ==========================================================================
``messages/``           messages of ROS as plain data, and their definitions
``model/``              the robot description: URDF, xacro, ``<ros2_control>``, meshes, kinematics
``control/``            ros2_control without ROS; in ``control/ros/`` its nodes and services
``controller_manager/`` a controller manager from a description and parameter files, without ROS
``controllers/``        diff_drive_controller, joint_state_broadcaster and the other plugins
``hardware/``           hardware components: MuJoCo, mock, serial
``sim/``                MuJoCo without ROS; in ``sim/ros/`` the services of simulation_interfaces
``simulation/``         a simulation in this process, without ROS
``trials/``             functions that drive it, run with many seeds: how often they pass
``tf2_ros/``            Buffer, TransformListener, broadcasters
``message_filters/``    synchronizers and caches of topics, as ``import message_filters``
``ros_packages/``       other packages of ROS in Python: ``cv_bridge``, ``tf_transformations`` …
``sensor_msgs_py/``     point clouds as arrays, as ``import sensor_msgs_py``
``ament_copyright/``    the linter of copyright notices, as ``import ament_copyright``
``viewer/``             the browser page's server; in ``viewer/ros/`` the robots of the graph
``maps/``               occupancy grids and their files
``nav2_simple_commander/`` ``BasicNavigator``: what programs in Python ask Nav2 for
``navigation/``         paths and filters; in ``navigation/ros/`` their topics
``cdr/``                messages of ROS as the bytes that DDS sends and bags have, without ROS
``bag/``                recordings of topics: MCAP files; in ``bag/ros/`` recorder and player
``doctor/``             what is wrong, and what mends it; ``doctor/host/`` reads the machine,
                        ``doctor/ros/`` the graph
``ros/``                rclpy as every node uses it
``nodes/``              executables, one a ``ros2 run amr_description NAME``
``bringup/``            the launcher: stacks, conditions, processes
``launch_api/``         launch files of ROS: ``import launch``, ``import launch_ros``
``launch_testing/``     tests that launch processes: ``launch_testing``, ``launch_pytest``
``cli/``                the ``ros2`` command and ``check_urdf``
``workspace/``          what ``colcon build`` of packages of users needs
``interface_build/``    message packages: what CMake of a workspace calls, and wheels of them
``testing/``            a simulation in lock-step, for tests of users

``gym.py``              a robot with its controllers as an environment of Gymnasium, without ROS
``errors.py``           every error that is raised on purpose
``log.py``              how a component logs; lines that come again and again
``plugin_errors.py``    exceptions of third-party controllers and components, as log lines
``parameters.py``       tables of parameters: type, default, unit, bounds
``former_parameters.py`` parameters of earlier releases, and what is made of them
``limited_child.py``    programs with limits of time and memory
``ownership.py``        who else can change a file, or may read it
``trusted_files.py``    which files a request may name
``launch_log.py``       what a bring-up has warned of, for what it starts
``launch_variables.py`` ``$(var …)`` of launch files in parameters
``parameter_files.py``  ROS parameter files: read, searched for a node's sections, written
``stand_ins.py``        packages of ROS that are not installed, and what is in their place
``registry.py``         names of plugins → ``module:attribute``, imported when used
``argument_types.py``   numbers of command lines, for argparse
``ros_arguments.py``    ROS arguments: ``--ros-args -r from:=to -p name:=value``
``ament_index.py``      packages, executables, ``package://`` and ``file://``
``clock.py``            nanoseconds; messages of before a jump back in time
``png.py``              PNG files, written
``text.py``             one line, quoted, shortened; the closest known word
``colors.py``           colors of a terminal
``terminal.py``         the keys in what a terminal sends, and whose the terminal is
``streams.py``          standard streams that are closed, full, or without a reader
``forking.py``          an interpreter that is forked into programs, which start quicker so
``entry.py``            where console scripts begin: Ctrl-C is quiet while libraries are imported
======================  ==========================================================================
"""

import importlib
from typing import Any

_EXPORTS = {'Simulation': 'amr_description.simulation.in_process'}
"""What users import from here, and where it is."""


def __getattr__(name: str) -> Any:
    """Return what is exported, imported when it is used: MuJoCo takes a quarter second."""
    if name not in _EXPORTS:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(importlib.import_module(_EXPORTS[name]), name)
