# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The rules, a module for each family. Each has its functions in ``RULES``, root causes first.

===================  =============================================================================
``machine.py``       system, Python, memory, disks, network
``environment.py``   environment variables
``processes.py``     processes of this host
``graph.py``         nodes; its table has those of the next three too
``qos.py``           … QoS of topics
``topic_names.py``   … names of topics
``clock.py``         simulated time
``commands.py``      velocity commands
``transforms.py``    frames
``description.py``   ``robot_description``
``controllers.py``   controller managers, controllers, hardware
``sensors.py``       scans, pictures, odometry
``navigation.py``    what Nav2 and slam_toolbox demand
``unexamined.py``    what could not be observed, or not be judged
``wording.py``       nodes, types and times in the text of findings
===================  =============================================================================
"""
