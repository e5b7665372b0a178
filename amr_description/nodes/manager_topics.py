# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a controller manager tells of itself, from the moment its node is there."""

from collections.abc import Sequence

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.snapshots import ManagerSnapshot
from amr_description.nodes.activity import ActivityTopic
from amr_description.nodes.diagnostics import DiagnosticsTopic
from amr_description.nodes.introspection import Introspection
from amr_description.nodes.manager_parameters import ManagerParameters
from amr_description.nodes.outgoing import Outgoing
from amr_description.nodes.owner import Owner


class ManagerTopics:
    """
    ``~/activity``, ``/diagnostics``, ``~/introspection_data/…`` and ``~/statistics/…``; and what
    is said of overruns.

    Made on the ROS thread; the owner hands the manager over with :meth:`watch`.
    """

    def __init__(
        self, node: Node, owner: Owner, outgoing: Outgoing, parameters: ManagerParameters
    ) -> None:
        self._node = node
        self._owner = owner
        self._parameters = parameters
        self._manager: ControllerManager | None = None
        self._may_overrun = False
        self._warns_of_overruns = parameters.start.overruns.print_warnings
        self._activity = ActivityTopic(node)
        self._diagnostics = DiagnosticsTopic(node, owner, parameters)
        self._introspection = Introspection(node, owner, outgoing)
        node.add_post_set_parameters_callback(self._mind_parameters)

    def expect_hardware(self) -> None:
        """The description is known: from now on it is an error that there is no hardware."""
        self._diagnostics.has_description = True

    def watch(self, manager: ControllerManager, *, may_overrun: bool) -> None:
        """
        Tell of a manager from now on; on the owner's thread.

        ``may_overrun``: it has only so much time for a cycle; a simulated world would wait.
        """

        def tell(snapshot: ManagerSnapshot) -> None:
            if not self._node.context.ok():
                return  # nobody can hear it, and the motors have to be stopped all the same
            self._activity.tell(snapshot)
            self._introspection.watch(manager)

        self._manager, self._may_overrun = manager, may_overrun
        self._apply()
        manager.on_change = tell
        tell(manager.snapshot)
        self._diagnostics.manager = manager

    def _mind_parameters(self, _: Sequence[Parameter]) -> None:
        """One was set; on the ROS thread."""
        now = self._parameters.now()  # not each second: it takes half a millisecond
        self._diagnostics.thresholds = now.diagnostics
        self._warns_of_overruns = now.overruns.print_warnings
        if self._manager is not None:
            self._owner.submit(self._apply)

    def _apply(self) -> None:
        self._manager.warns_of_overruns = self._may_overrun and self._warns_of_overruns
