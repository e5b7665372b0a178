# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Simulations: what can be done with one, here without ROS, in ``testing/`` over it.

========================== ========================================================================
``api.py``                 what a simulation and its robots can do, wherever they run
``readings.py``            what is read of a robot: motion, joints, scans, pictures, clouds
``tracebacks.py``          which of our frames a failed test shows

``spawned_controllers.py`` the controllers of a robot, as its files say; its topics
========================== ========================================================================
"""
