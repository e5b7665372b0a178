# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The real-time factor of a running simulator, measured from outside."""

import time

from rclpy.client import Client
from rclpy.node import Node
from simulation_interfaces.srv import GetEntityState

from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import call_with, wait_until

GET_STATE = '/mujoco_sim/get_entity_state'
_TIMEOUT = 60.0


def real_time_factor(node: Node, get_state: Client, entity: str, seconds: float) -> float:
    """
    Return simulated over wall time.

    Args:
        node: Spun while waiting.
        get_state: Client of :data:`GET_STATE`.
        entity: Any entity; the stamps of its states are used.
        seconds: Wall time of the measurement.
    """

    def now() -> tuple[float, float]:
        """Return simulated and wall time, s."""
        request = GetEntityState.Request(entity=entity)
        state = call_with(node, get_state, request, timeout=_TIMEOUT).state
        return nanoseconds(state.header.stamp) * 1e-9, time.monotonic()

    simulated_before, wall_before = now()
    deadline = wall_before + seconds
    wait_until(node, lambda: time.monotonic() >= deadline or None)
    simulated_after, wall_after = now()
    return (simulated_after - simulated_before) / (wall_after - wall_before)
