# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``control`` over ROS: the ``controller_manager`` node, and the programs that ask it.

Two threads: the *control thread* runs the loop, and with it every manager; the *ROS thread* of a
node serves its callbacks, and submits to the control thread what concerns a manager. A third one
of each controller that subscribes to something takes its messages.

============================== ====================================================================
``loop_thread.py``             the control thread, its queue of calls, and the LoopContext
``loop_watchdog.py``           logs when the loop stands, and in which call
``pacing.py``                  when the next cycle is due: by wall, system or received clock
``message_recorder.py``        hands what is published, and the commands, to who records it
``loop_publisher.py``          publishes ``/clock`` and what controllers send, after each cycle
``realtime.py``                time slice, priority, cores and memory of the control thread

``controller_manager_node.py`` the node, and how a manager is brought up
``robot_description.py``       the topic from which it has its robot
``node_parameters.py``         parameters of managers and controllers, in their nodes
``plugin_nodes.py``            the nodes of controllers and hardware components
``port_servers.py``            their services and actions
``encoders.py``                makes bytes of their samples, as rclpy would
``services.py``                its services: requests in, responses out
``status_topics.py``           activity, diagnostics, introspection

``client.py``                  calls the services of a manager
``absence_diagnosis.py``       why a manager does not come, in words
``spawner_lock.py``            two spawners never work on one controller
============================== ====================================================================
"""
