# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Bags over ROS: what records topics, and what plays them.

========================= =========================================================================
``recorder.py``           the node ``rosbag2_recorder``
``recorder_services.py``  its services and events
``message_cache.py``      messages between who receives them and who writes them
``player.py``             the node ``rosbag2_player``
``player_services.py``    its services
``service_requests.py``   recorded requests of services, sent again
``keyboard.py``           keys of a terminal, read in a thread
``qos_profiles.py``       QoS profiles of bags as rclpy has them
``topic_types.py``        classes of the types of topics, of service events, too
========================= =========================================================================
"""
