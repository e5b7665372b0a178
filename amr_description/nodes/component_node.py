# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A ROS node for a hardware component that knows no ROS: its logger, and the usual services."""

from collections.abc import Sequence
import re

from rclpy.node import Node

from amr_description.nodes.node_log import LogThread
from amr_description.nodes.node_parameters import let_parameter_events_be_overridden
from amr_description.nodes.outgoing import Outgoing


class ComponentNode:
    """``log`` is what the component says; ``node`` is named after it, in lower case."""

    def __init__(
        self,
        name: str,
        arguments: Sequence[str],
        *,
        namespace: str,
        outgoing: Outgoing,
        logs: LogThread,
    ) -> None:
        """``name``: of the ``<ros2_control>`` block; ``arguments``: ROS arguments."""
        self._outgoing = outgoing
        self.node: Node = outgoing.make_node(node_name(name), namespace, arguments)
        let_parameter_events_be_overridden(self.node)
        self.log = logs.log_of(self.node.get_logger())

    def destroy(self) -> None:
        """Remove the node."""
        self._outgoing.destroy_node(self.node)


def node_name(component: str) -> str:
    """
    Return a component's name as ROS allows it for a node: ``Amr-System 2`` is ``amr_system_2``.
    """
    name = re.sub(r'[^a-z0-9_]', '_', component.lower())
    return f'_{name}' if name[:1].isdigit() else name or '_'
