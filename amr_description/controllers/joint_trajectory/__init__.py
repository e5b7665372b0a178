# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
joint_trajectory_controller: joints follow trajectories, from an action or a topic.

================= =================================================================================
``controller.py`` the controller
``parameters.py`` its parameters
``interfaces.py`` interfaces of its joints, and their combinations
``splines.py``    splines between points in time
``checks.py``     why a trajectory is not accepted; how far a joint may be from it
================= =================================================================================
"""
