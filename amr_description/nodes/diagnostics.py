# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``/diagnostics`` of a controller manager, as diagnostic_updater publishes it.

The period is one of the machine's clock: a simulation that runs as fast as it can, or is paused,
says once a second how it is, too.
"""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import ClockType

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.diagnostics import HARDWARE_ID, Report, reports
from amr_description.control.measurements import take_measurements
from amr_description.nodes.manager_parameters import ManagerParameters
from amr_description.nodes.owner import Owner


class DiagnosticsTopic:
    """The topic and its timer; everything here runs on the ROS thread."""

    def __init__(self, node: Node, owner: Owner, parameters: ManagerParameters) -> None:
        """``parameters``: of which only those at the start count, but for the thresholds."""
        self.manager: ControllerManager | None = None
        """Set once there is hardware."""
        self.has_description = False
        """True once there should be."""
        self.thresholds = parameters.start.diagnostics
        """As they are now."""
        self._node = node
        self._owner = owner
        self._update_rate = parameters.update_rate
        updater = parameters.start.diagnostic_updater
        name = node.get_fully_qualified_name() if updater.use_fqn else node.get_name()
        self._prefix = f'{name}: '
        self._publisher = node.create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=1)
        )
        # A group of its own: while the owner is awaited, parameters go on being served.
        node.create_timer(
            updater.period,
            self._tell,
            callback_group=MutuallyExclusiveCallbackGroup(),
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    async def _tell(self) -> None:
        manager = self.manager
        measured = None
        if manager is not None:
            measured = await self._owner.submit(
                lambda: take_measurements(manager), self._node.executor
            )
        found = reports(
            measured,
            self.thresholds,
            self._update_rate,
            has_description=self.has_description,
        )
        message = DiagnosticArray(
            status=[_status(self._prefix + task, report) for task, report in found.items()]
        )
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)


def _status(name: str, report: Report) -> DiagnosticStatus:
    return DiagnosticStatus(
        level=bytes([report.level]),
        name=name,
        message=report.message,
        hardware_id=HARDWARE_ID,
        values=[KeyValue(key=key, value=value) for key, value in report.values],
    )
