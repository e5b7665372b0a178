# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The backend of the page's server for the robots of a ROS graph.

======================  ========================================================================
``backend.py``          :class:`GraphBackend`: what pages ask, and what they are sent
``graph_monitor.py``    watches the graph, and connects to its robots and simulators
``robot.py``            the connection to one robot: description, commands; a simulator's world
``joint_commands.py``   joints that pages move by controllers
``robot_topics.py``     what moves: transforms, joints, odometry, commands, wheels
``states.py``           … assembled into the binary states
``sensors.py``          topics of sensors, subscribed while a page shows them
``sensor_samples.py``   … converted for the page
``description.py``      a robot description for the page: joints, meshes, findings
``markers.py``          MarkerArray and /diagnostics, converted for the page
``service_clients.py``  services of simulators and controller managers
======================  ========================================================================

Subscriptions, publishers and clients are created and destroyed on the ROS thread, and used on the
server's thread.
"""
