# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The names of the ROS graph as discovery (viewer/discovery.py) wants them."""

from rclpy.node import Node

from amr_description.viewer.discovery import (
    ACTIVITY,
    DYNAMIC_JOINT_STATE,
    JOINT_STATE,
    MARKERS,
    Names,
    ODOMETRY,
    STATISTICS_VALUES,
    STRING,
    TF,
    TWISTS,
)

_PUBLISHED = {
    ACTIVITY,
    DYNAMIC_JOINT_STATE,
    JOINT_STATE,
    MARKERS,
    ODOMETRY,
    STATISTICS_VALUES,
    STRING,
    TF,
}
_HEARD = {JOINT_STATE, *TWISTS}


def names_in(node: Node) -> Names:
    """Return what others publish, hear and serve, as far as it may matter to a page."""
    published, heard = {}, {}
    for topic, types in node.get_topic_names_and_types():
        if not _PUBLISHED.isdisjoint(types) and node.count_publishers(topic):
            published[topic] = types
        if not _HEARD.isdisjoint(types):
            wanted = {
                each.topic_type
                for each in node.get_subscriptions_info_by_topic(topic)
                if (each.node_name, each.node_namespace) != (node.get_name(), node.get_namespace())
            }
            if wanted:
                heard[topic] = sorted(wanted)
    return Names(published, heard, dict(node.get_service_names_and_types()))
