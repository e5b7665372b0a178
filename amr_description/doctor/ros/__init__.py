# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Asks and listens to the ROS graph, by a probe for each section of what is observed.

===================  =============================================================================
``collector.py``     all sections within one window of time
``probe_context.py`` ``/clock`` and parameters, which several of them need
``topic_probe.py``   messages with their publishers, taken without callbacks
``queries.py``       services that change nothing, and parameters
``graph.py``         nodes, their processes and answers; topics
``clock.py``         ``/clock``, the real-time factor, stamps
``commands.py``      velocity commands, drives, locks
``description.py``   ``robot_description``
``controllers.py``   controller managers, and what they log
``transforms.py``    ``/tf`` and ``/tf_static``
``sensors.py``       sensors, joint states, odometry beside the truth
``navigation.py``    what Nav2 and slam_toolbox demand
===================  =============================================================================
"""
