# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Observes what Nav2 and slam_toolbox demand, where one of them is there."""

from amr_description.doctor.ros.probe_context import ProbeContext
from amr_description.navigation.contract.observations import ContractFrames, ContractObservations
from amr_description.navigation.ros.contract.collector import Collector

_NODES = frozenset(
    (
        'amcl',
        'bt_navigator',
        'controller_server',
        'navigator',
        'planner_server',
        'slam_toolbox',
    )
)


class NavigationProbe:
    """Observes ``navigation``."""

    def __init__(self) -> None:
        self._collector: Collector | None = None

    def begin(self, context: ProbeContext) -> None:
        """Subscribe, if a node of navigation is in the namespace of the examiner."""
        node = context.node
        here = node.get_namespace()
        names = {n for n, namespace in node.get_node_names_and_namespaces() if namespace == here}
        if names & _NODES:
            self._collector = Collector(node, ContractFrames(), is_stamped=False)

    @property
    def is_done(self) -> bool:
        """Whether enough has come."""
        return self._collector is None or not self._collector.awaited()

    def observe(self) -> ContractObservations | None:
        """Return what was seen; None: nothing of navigation is there."""
        return None if self._collector is None else self._collector.observations()
