# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ros2_control without ROS: no ROS, no simulator, no clock. One thread, the control thread, runs it.

============================ =====================================================================
``contracts.py``             the page to read: Controller, HardwareComponent, Port, Log
``world.py``                 … the simulated world of a hardware component: World, JointGroup
``interfaces.py``            the terms: interface names, state and command interfaces, lifecycle
``samples.py``               what the shipped controllers publish and subscribe to
``dof_samples.py``           … of PID controllers and grippers
``trajectory_samples.py``    … trajectories of joints
``sensor_samples.py``        … of sensors, batteries and GPIOs

``loaded_component.py``      a hardware component inside the manager: lifecycle, read, write
``joint_limits.py``          the limits of joints, and how commands are kept within them
``recorded_commands.py``     which commands of a controller are recorded
``resource_manager.py``      all components of a robot, their interfaces, and the claims

``loaded_controller.py``     a controller inside the manager: lifecycle, interfaces, update
``chains.py``                which controllers command or read others; the order of updates
``controller_list.py``       all controllers of a manager, in that order
``switching.py``             switch_controller: request, checks, plan, execution
``failure_handling.py``      controllers that fail are deactivated, fallbacks activated
``controller_manager.py``    load, configure, switch; read → update → write

``manager_parameters.py``    the parameters of a manager, and those of every controller

``snapshot.py``              the state of a manager, for readers on other threads
``statistics.py``            running mean and deviation of execution times and rates
``introspection.py``         the values of a manager that are published, and their names
``diagnostic_thresholds.py`` when ``/diagnostics`` shows a warning or an error: parameters
``diagnostics.py``           the diagnostics of a manager

``loop.py``                  the control loop: queued calls → managers → publish → step → pace

``ros/``                     controller manager node, services, topics, client, spawner
============================ =====================================================================
"""
