# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Launch files of ROS: what ``import launch`` and ``import launch_ros`` give while one is read.

PyPI has neither package. Here are the names that launch files use, with their arguments; a file is
read, its actions are visited in order, and each is translated into what a stack of
:mod:`amr_description.bringup` is made of. Nothing is started before all of it is translated.

========================= ========================================================================
``locations.py``          where something stands in a launch file: ``my.launch.py:7``
``context.py``            launch configurations, environment and scopes while a file is visited
``substitutions.py``      LaunchConfiguration, PathJoinSubstitution, Command and the others
``logic.py``              substitutions that are true or false, and PythonExpression
``conditions.py``         IfCondition, UnlessCondition
``descriptions.py``       LaunchDescription, what actions have in common, arguments
``actions.py``            the actions that start no process
``processes.py``          ExecuteProcess, Node
``ros_actions.py``        PushRosNamespace, SetParameter, SetRemap …
``text_syntax.py``        ``$(var …)`` and the like
``lifecycle.py``          LifecycleNode, ChangeState, OnStateTransition
``composition.py``        components of C++, which are values until one is reached
``rewriting.py``          RewrittenYaml and the others of nav2_common
``parameters.py``         ParameterValue, ParameterFile; parameters as nodes get them
``events.py``             OnProcessExit and the other event handlers; Shutdown
``including.py``          IncludeLaunchDescription and its sources
``opened_files.py``       which files of packages a launch file reads
``files_in_place.py``     a file of the package in place of a placeholder in its description
``driving.py``            what drives the robot of a launch file, to be typed next
``translation.py``        actions -> nodes, conditions and handlers of a stack
``handling.py``           … and what happens at events
``controller_spawners.py`` ``controller_manager.launch_utils``: descriptions that spawn controllers
``service.py``            LaunchService: descriptions run by a program beside other things
``counterparts.py``       packages that are not installed, and what takes their place
``gazebo_files.py``       launch files of ros_gz_sim, in whose place the simulator here is started
``modules.py``            the table of modules and names, and how files import them
``markup.py``             launch files in XML and YAML
``launch_file.py``        a launch file for ``ros2 launch``: its arguments, its stack
========================= ========================================================================
"""
