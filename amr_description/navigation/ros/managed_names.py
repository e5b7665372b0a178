# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The states of lifecycle nodes of Nav2 in whose place a node is, by their names.

``nav2_simple_commander``, and programs like it, ask ``bt_navigator/get_state`` until that is
active, and do nothing before. Here one node has the work of several, and is no lifecycle node: it
is active once it can do its work, and inactive until then.
"""

from collections.abc import Callable, Iterable

from lifecycle_msgs.msg import State
from lifecycle_msgs.srv import GetState
from rclpy.node import Node


class ManagedNames:
    """The services ``<name>/get_state`` (``lifecycle_msgs/srv/GetState``) of some names."""

    def __init__(self, node: Node, names: Iterable[str], is_active: Callable[[], bool]) -> None:
        """Serve; ``is_active``: whether the node can do its work now."""
        self._is_active = is_active
        self._services = [
            node.create_service(GetState, f'{name}/get_state', self._answer) for name in names
        ]

    def _answer(self, request: GetState.Request, response: GetState.Response) -> GetState.Response:
        is_active = self._is_active()
        response.current_state = State(
            id=State.PRIMARY_STATE_ACTIVE if is_active else State.PRIMARY_STATE_INACTIVE,
            label='active' if is_active else 'inactive',
        )
        return response
