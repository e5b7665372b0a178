# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A ROS node for a controller that knows no ROS: its parameters and its topics, from outside just
as ros2_control has them.

The ROS thread makes node, parameters and endpoints; the owner only sees finished objects.
"""

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription

from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    Input,
    Output,
    Qos,
    Severity,
)
from amr_description.control.foreign_errors import describe
from amr_description.model.robot import Robot
from amr_description.nodes.manager_table import CommonParameters
from amr_description.nodes.message_types import message_type
from amr_description.nodes.node_log import LogThread
from amr_description.nodes.node_parameters import declare, refuse_what_the_table_refuses, values
from amr_description.nodes.outgoing import Outgoing
from amr_description.nodes.transition_events import TransitionEvents
from amr_description.registry import resolve


class ControllerNode:
    """
    One controller and its node.

    ``controller`` is unconfigured at first. Everything here runs on the ROS thread, but for what
    the owner calls: ``Outgoing.send``, by the ports, and ``watch``, which publishes transitions.
    """

    def __init__(
        self,
        name: str,
        controller_class: type[Controller],
        arguments: Sequence[str],
        *,
        namespace: str,
        update_rate: int,
        robot: Robot | None,
        outgoing: Outgoing,
        logs: LogThread,
    ) -> None:
        """
        Make node and controller; ``arguments``: ROS arguments of the node.

        Raises ParameterError, and whatever the constructor of a foreign controller raises.
        """
        self._outgoing = outgoing
        self._endpoints: list[Publisher | Subscription] = []
        self.node: Node = outgoing.make_node(name, namespace, arguments)
        try:
            self._table = controller_class.parameters_type
            self.log = logs.log_of(self.node.get_logger())
            self.watch = TransitionEvents(self.node)
            common = self._declare(update_rate)
            self.controller = controller_class(
                ControllerContext(
                    name=name,
                    log=self.log,
                    namespace=namespace,
                    update_rate=common.update_rate or update_rate,
                    robot=robot,
                )
            )
        except Exception:
            self.destroy()
            raise

    def parameters(self) -> Any:
        """Read the node's parameters into the controller's table. Raises ParameterError."""
        return values(self.node, self._table)

    def connect(self) -> None:
        """Make the topics that the configured controller declares, in place of earlier ones."""
        self.disconnect()
        for port in self.controller.inputs():
            self._endpoints.append(self._subscribe(port))
        for port in self.controller.outputs():
            self._endpoints.append(self._advertise(port))

    def disconnect(self) -> None:
        """Remove the topics; the owner must have cleaned the controller up before."""
        for endpoint in self._endpoints:
            if isinstance(endpoint, Publisher):
                self.node.destroy_publisher(endpoint)
            else:
                self.node.destroy_subscription(endpoint)
        self._endpoints.clear()

    def destroy(self) -> None:
        """Remove the node."""
        self.disconnect()
        self._outgoing.destroy_node(self.node)

    # --- parameters ---------------------------------------------------------------------------

    def _declare(self, manager_rate: int) -> CommonParameters:
        """Declare both tables; what is set later counts at the next configure."""
        declare(self.node, self._table)
        common = declare(self.node, CommonParameters, defaults={'update_rate': manager_rate})
        refuse_what_the_table_refuses(self.node, self._table, CommonParameters)
        if common.is_async:
            self.log(
                Severity.WARN,
                'is_async is true: the controller is updated in the control loop all the same',
            )
        return common

    # --- ports --------------------------------------------------------------------------------

    def _subscribe(self, port: Input[Any]) -> Subscription:
        convert = resolve(port.port.convert)

        def receive(message: Any, about: Any) -> None:
            try:
                sample = convert(message)
            except Exception as error:  # a stranger's converter; the robot must go on
                self.node.get_logger().error(
                    f"Cannot accept a message on '{port.port.name}': {describe(error)}",
                    throttle_duration_sec=1.0,
                )
                return
            if port.put(sample):
                self._outgoing.confirm(
                    subscription.topic_name, about['publication_sequence_number']
                )
            else:
                self.node.get_logger().warning(
                    "Can't accept new commands. subscriber is inactive", throttle_duration_sec=1.0
                )

        subscription = self.node.create_subscription(
            message_type(port.port.message), port.port.name, receive, qos(port.port.qos)
        )
        return subscription

    def _advertise(self, port: Output[Any]) -> Publisher:
        fill = resolve(port.port.convert)
        message_class = message_type(port.port.message)
        message = message_class()
        publisher = self.node.create_publisher(message_class, port.port.name, qos(port.port.qos))
        send = self._outgoing.send
        port.sink = lambda sample: send(fill, sample, message, publisher)
        return publisher


def qos(wanted: Qos) -> QoSProfile:
    """Return rclpy's profile; system defaults are left to the middleware."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST if wanted.depth else HistoryPolicy.SYSTEM_DEFAULT,
        depth=wanted.depth,
        reliability=ReliabilityPolicy[wanted.reliability.upper()],
        durability=DurabilityPolicy[wanted.durability.upper()],
    )
