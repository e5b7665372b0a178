# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
rclpy as every node of this package uses it; start with ``runtime.py``.

========================= =========================================================================
``runtime.py``            start, spin and end a program; exit codes
``firewall.py``           what callbacks raise: log it, answer, serve on
``participant_end.py``    have a DDS participant end while discovery goes on
``signals.py``            SIGINT, SIGTERM, SIGHUP and the bring-up's end as one request to stop
``discovery.py``          have Fast DDS find other processes at once
``transport.py``          have Fast DDS send by UDP, so that no killed process holds us up
``udp_sockets.py``        which UDP ports of this host are in use
``rclpy_internals.py``    the private members of rclpy that are used, and nothing else uses

``arguments.py``          the robot description that a command line names, beside its ROS arguments
``node_help.py``          ``--help`` of an executable that has no other options
``parameters.py``         parameters of a node from a table of ``amr_description.parameters``
``log_thread.py``         logging that never blocks the caller
``qos.py``                QoS profiles that several nodes share

``service_calls.py``      wait for something, and call services, in a program that then ends
``wait_clock.py``         the time for which a program has waited, on a busy machine too
``polled_topic.py``       a subscription without a callback
``subscription_thread.py`` subscriptions with a thread that calls their callbacks
``endpoints.py``          publishers and subscriptions of the graph, by their nodes
``local_participants.py`` DDS participants on this host, from the UDP ports in use
``node_lists.py``         what each participant says of its nodes and their endpoints
``publisher_gids.py``     which publisher a message is of
``type_mismatch.py``      endpoints of one topic with different types; Twist or TwistStamped

``standing_clock.py``     the clock of an action server, which wakes nobody between goals
``messages.py``           stamps, poses and velocities ↔ messages
``message_fields.py``     what was typed -> the fields of a message; ``auto`` and ``now``
``message_text.py``       a message → YAML, CSV, plain data
``message_types.py``      classes of messages, services and actions by their names
``layouts.py``            messages as bytes: their layouts, and templates that make them (``cdr/``)
``readers.py``            … read without making messages of them: a row for each type
========================= =========================================================================
"""
