# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ``controller_manager`` node of one robot, over the pure manager of ``control``.

It comes to life in three steps, each an object that has what is allowed then; ``destroy()`` of the
latest one removes all that the former ones made::

    ControllerManagerNode   node, parameters and status topics; no robot yet
      .prepare(robot, …)    on the ROS thread
    PreparedManager         … and the nodes of the hardware components
      .bring_up(world, …)   on the control thread: starts the hardware
      .serve(manager)       on the ROS thread
    RunningManager          … and services, and the nodes of the controllers

Whoever waits for the services so finds a manager whose hardware is ready.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from time import monotonic_ns

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.contracts import World
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.node_parameters import NodeParameters
from amr_description.control.ros.plugin_nodes import ComponentNode, NodeHost
from amr_description.control.ros.services import ManagerServices
from amr_description.control.ros.status_topics import (
    ActivityTopic,
    DiagnosticsTopic,
    IntrospectionTopics,
)
from amr_description.control.snapshot import ManagerSnapshot
from amr_description.controller_manager.bring_up import bring_up
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.controller_manager.requests import ManagerRequests
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.ros.parameters import add_parameter_event_qos_overrides
from amr_description.ros.runtime import destroy_node
from amr_description.ros_arguments import inherited

NODE_NAME = 'controller_manager'


class ControllerManagerNode:
    """A manager without hardware: its node, parameters and status topics."""

    def __init__(
        self,
        context: LoopContext,
        *,
        name: str = NODE_NAME,
        namespace: str,
        arguments: Sequence[str],
    ) -> None:
        """
        Make the node.

        Args:
            context: Of the process.
            name: Of the node.
            namespace: Of the node, its components and its controllers.
            arguments: ROS arguments (remaps, ``--params-file``) for the node and for every
                component and controller.

        Raises:
            ParameterError: A parameter is no good, as an ``update_rate`` of 0.
        """
        self.context = context
        self.arguments = arguments
        self.node: Node = context.publisher.make_node(
            name, namespace, arguments, allow_undeclared_parameters=True
        )
        self.log: Log = context.logs.log_of(self.node.get_logger())
        try:
            add_parameter_event_qos_overrides(self.node)
            self.parameters = ManagerParameters(NodeParameters(self.node), arguments, self.log)
            self.topics = StatusTopics(self.node, context, self.parameters)
        except Exception:
            self.destroy()
            raise

    def prepare(
        self, robot: Robot | None, hardware: Sequence[HardwareInfo]
    ) -> 'PreparedManagerNode':
        """
        Make a node for each hardware component; on the ROS thread.

        Args:
            robot: Handed to controllers; its joints' limits are enforced, if that is wanted.
            hardware: What its ``<ros2_control>`` blocks say.
        """
        self.topics.expect_hardware()
        components: list[tuple[HardwareInfo, ComponentNode]] = []
        for info in hardware:
            node = ComponentNode(
                info.name,
                inherited(self.arguments),
                namespace=self.node.get_namespace(),
                context=self.context,
            )
            components.append((info, node))
        return PreparedManagerNode(self, robot, components)

    def destroy(self) -> None:
        """Remove the node; on the ROS thread."""
        self.context.publisher.forget((), tuple(self.node.publishers))
        destroy_node(self.node)


@dataclass(frozen=True)
class PreparedManagerNode:
    """A manager whose hardware is not up yet; it may be brought up once."""

    manager_node: ControllerManagerNode
    robot: Robot | None
    components: Sequence[tuple[HardwareInfo, ComponentNode]]

    @property
    def namespace(self) -> str:
        """Of its node, absolute."""
        return self.manager_node.node.get_namespace()

    @property
    def update_rate(self) -> int:
        """Hz."""
        return self.manager_node.parameters.update_rate

    def bring_up(
        self, world: World | None, period: int, simulates_mocks: bool = False
    ) -> ControllerManager:
        """
        Make components and manager, and start the hardware; on the control thread.

        Args:
            world: As simulated components see it; None: the hardware is real.
            period: Between two cycles, ns.
            simulates_mocks: Mock hardware is simulated, if there is a world.

        Returns:
            The manager, for the control loop.

        Raises:
            HardwareError: A component cannot be started; the others are shut down again.
            Exception: Whatever a third party's component raises; likewise.
        """
        manager_node = self.manager_node
        manager = bring_up(
            manager_node.parameters,
            manager_node.log,
            self.robot,
            [(info, component.log) for info, component in self.components],
            world=world,
            period=period,
            simulates_mocks=simulates_mocks,
            stopwatch=monotonic_ns,
        )
        manager_node.topics.watch(manager, may_overrun=world is None)
        return manager

    def serve(self, manager: ControllerManager) -> 'RunningManager':
        """
        Make the services of a manager that was brought up here; on the ROS thread.

        The manager's node must be in an executor, which serves the components' nodes too.
        """
        manager_node = self.manager_node
        for _, component in self.components:
            manager_node.node.executor.add_node(component.node)
        manager_node.log(
            Severity.INFO,
            'Resource Manager has been successfully initialized. Starting Controller Manager '
            'services...',
        )
        requests = ManagerRequests(
            NodeHost(manager_node.node, manager_node.context),
            manager_node.log,
            manager_node.parameters,
            manager,
            robot=self.robot,
        )
        ManagerServices(manager_node.node, requests)
        return RunningManager(self, manager, requests)

    def release(self) -> None:
        """Remove the nodes of the components only: another description may be prepared."""
        for _, component in self.components:
            component.destroy()

    def destroy(self) -> None:
        """Remove all nodes; on the ROS thread."""
        self.release()
        self.manager_node.destroy()


@dataclass(frozen=True)
class RunningManager:
    """A manager with hardware and services."""

    prepared: PreparedManagerNode
    manager: ControllerManager
    """For the control thread."""
    requests: ManagerRequests

    @property
    def node(self) -> Node:
        """The node ``controller_manager``."""
        return self.prepared.manager_node.node

    def destroy(self) -> None:
        """Remove all nodes; the control thread must have stopped, or dropped, the manager."""
        for controller in self.requests.controllers.values():
            controller.destroy()
        self.prepared.destroy()


class StatusTopics:
    """
    What a manager publishes about itself, from the moment its node is there.

    ``~/activity``, ``/diagnostics``, ``~/introspection_data/…`` and ``~/statistics/…``; it also
    decides whether overruns are logged. Made on the ROS thread.
    """

    def __init__(self, node: Node, context: LoopContext, parameters: ManagerParameters) -> None:
        self._node = node
        self._loop_thread = context.loop_thread
        self._parameters = parameters
        self._manager: ControllerManager | None = None
        self._may_overrun = False
        self._warns_of_overruns = parameters.start.overruns.print_warnings
        self._activity = ActivityTopic(node, context.publisher)
        self._diagnostics = DiagnosticsTopic(node, context.loop_thread, parameters)
        self._introspection = IntrospectionTopics(node, context)
        node.add_post_set_parameters_callback(self._on_parameters_set)

    def expect_hardware(self) -> None:
        """The description is known: from now on it is an error that there is no hardware."""
        self._diagnostics.has_description = True

    def watch(self, manager: ControllerManager, *, may_overrun: bool) -> None:
        """
        Publish the status of a manager from now on; on the control thread.

        ``may_overrun``: its cycles have a deadline; a simulated world would wait.
        """

        def publish(snapshot: ManagerSnapshot) -> None:
            if not self._node.context.ok():
                return  # nothing can be published, and the motors have to be stopped all the same
            self._activity.publish(snapshot)
            self._introspection.watch(manager)

        self._manager, self._may_overrun = manager, may_overrun
        self._apply()
        manager.on_change = publish
        publish(manager.snapshot)
        self._diagnostics.manager = manager

    def _on_parameters_set(self, _: Sequence[Parameter]) -> None:
        now = self._parameters.now()  # not each second: it takes half a millisecond
        self._diagnostics.thresholds = now.diagnostics
        self._warns_of_overruns = now.overruns.print_warnings
        if self._manager is not None:
            self._loop_thread.submit(self._apply)

    def _apply(self) -> None:
        if self._manager is not None:
            self._manager.warns_of_overruns = self._may_overrun and self._warns_of_overruns
