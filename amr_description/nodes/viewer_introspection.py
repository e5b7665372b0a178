# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What joints are commanded: of the introspection topics of a controller manager.

``names`` says which number is which, ``values`` has the numbers after every cycle; the manager
publishes them as long as somebody listens.
"""

from collections.abc import Sequence
import math

from pal_statistics_msgs.msg import StatisticsNames, StatisticsValues
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from amr_description.nodes.cdr import read_statistics_names, read_statistics_values
from amr_description.nodes.polled_topic import PolledTopic

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class CommandedVelocities:
    """
    The command interfaces ``<joint>/velocity`` of these joints; taken as a polled topic is.

    ``place``: the name of the topics but for ``/names`` and ``/values``.
    """

    def __init__(self, node: Node, place: str, joints: Sequence[str]) -> None:
        self._wanted = [f'command_interface.{joint}/velocity' for joint in joints]
        self._names = PolledTopic(
            node, StatisticsNames, f'{place}/names', read_statistics_names, qos=_LATCHED
        )
        self._values = PolledTopic(
            node, StatisticsValues, f'{place}/values', read_statistics_values
        )
        self._version: int | None = None
        self._places: list[int | None] = []

    def take(self) -> tuple[float, ...] | None:
        """Return the latest, rad/s or m/s, NaN without such an interface; None: nothing new."""
        latest = self._values.take()
        if latest is None:
            return None
        if latest.version != self._version:
            self._read_names()
        if latest.version != self._version:
            return None  # they are still on their way
        count = len(latest.values)
        return tuple(
            latest.values[place] if place is not None and place < count else math.nan
            for place in self._places
        )

    def _read_names(self) -> None:
        names = self._names.take()
        if names is not None:
            places = {name: place for place, name in enumerate(names.names)}
            self._places = [places.get(name) for name in self._wanted]
            self._version = names.version

    def destroy(self) -> None:
        """Listen no more."""
        self._names.destroy()
        self._values.destroy()
