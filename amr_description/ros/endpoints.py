# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The publishers and subscriptions of the graph, by their nodes."""

from rclpy.topic_endpoint_info import TopicEndpointInfo

UNKNOWN_NODE_NAME = '_NODE_NAME_UNKNOWN_'
"""What rmw calls the node of an endpoint that was discovered a moment before the node was."""


def endpoint_node(endpoint: TopicEndpointInfo) -> str | None:
    """Return the full name of the node that an endpoint is of; None: not known, or not yet."""
    if endpoint.node_name == UNKNOWN_NODE_NAME:
        return None
    return f'{endpoint.node_namespace.rstrip("/")}/{endpoint.node_name}'
