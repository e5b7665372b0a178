# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Simulations: what can be done with one, here without ROS, in ``testing/`` over it.

========================== ========================================================================
``api.py``                 what a simulation and its robots can do, wherever they run
``readings.py``            what is read of a robot: motion, joints, scans, pictures, clouds
``parameters.py``          the parameters of a simulation, which are those of the simulator's node
``tracebacks.py``          which of our frames a failed test shows

``worlds.py``              the world of a simulation
``managed_robots.py``      robots come and go with their controller managers
``manager_arguments.py``   what such a manager is given: parameter files
``plugin_controllers.py``  starts the controllers that stand for Gazebo's plugins
``spawned_controllers.py`` the controllers of a robot, as its files say; its topics
========================== ========================================================================
"""
