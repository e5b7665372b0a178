# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Try robots as they are: ``scripts/try_robots FOLDER|FILE…``; and ``scripts/try_launch_files``.

Each robot in a process, a simulator and a ROS domain of its own: checked, spawned, left alone for
three seconds, its controllers brought up, driven and moved, and compared with the truth.

==================== ==============================================================================
``command.py``       the options, the robots one after the other, the table and the exit code
``inputs.py``        descriptions of a folder; the parameter file of a robot; texts replaced

``one_robot.py``     what is done with a robot, in order
``bring_up.py``      its controllers, each as far as it goes
``driving.py``       a metre forward, a quarter turn, sideways
``moving.py``        joints, by commands and trajectories
``findings.py``      what is found, as data
``parts.py``         controllers that stay out, and whether the robot lacks them
``posture.py``       whether it stands, falls, tips over or explodes; what legs can do
``verdict.py``       what a robot did: as told, off, or not at all, and why; a row of the table
``launch_trial.py``  one launch file: whether it comes up, and its robot drives
``launch_command.py``  launch files one after the other, their options and their table
==================== ==============================================================================
"""
