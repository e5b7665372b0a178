# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ``controller_manager`` node of one robot, over the pure manager of ``control``.

Here is how it comes to life, and how it ends. Its services (``manager_services.py``), what they do
(``manager_requests.py``) and its parameters (``manager_parameters.py``) stand apart.

What a controller manager tells of itself, from the moment its node is there.
"""

from collections.abc import Sequence
from time import monotonic_ns

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.contracts import Log, Severity, World
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import LoopThread
from amr_description.control.ros.parameters import ManagerParameters
from amr_description.control.ros.plugin_nodes import ComponentNode, ControllerNode
from amr_description.control.ros.requests import ManagerRequests
from amr_description.control.ros.services import ManagerServices
from amr_description.control.ros.status_topics import (
    ActivityTopic,
    DiagnosticsTopic,
    Introspection,
)
from amr_description.control.snapshot import ManagerSnapshot
from amr_description.hardware import HARDWARE
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.ros.arguments import inherited
from amr_description.ros.log_thread import LogThread
from amr_description.ros.parameters import add_parameter_event_qos_overrides


class ManagerTopics:
    """
    ``~/activity``, ``/diagnostics``, ``~/introspection_data/…`` and ``~/statistics/…``; and what
    is said of overruns.

    Made on the ROS thread; the owner hands the manager over with :meth:`watch`.
    """

    def __init__(
        self, node: Node, owner: LoopThread, outgoing: LoopPublisher, parameters: ManagerParameters
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


NODE_NAME = 'controller_manager'


class ControllerManagerNode:
    """
    Node, parameters and services of one manager.

    ``arguments`` are ROS arguments (remaps, ``--params-file``) for the node and for every
    controller that it loads. It has no robot at first: :meth:`prepare`, :meth:`bring_up` on the
    owner's thread, :meth:`start`, which makes the services. Whoever waits for those finds a
    manager whose hardware is ready.
    """

    def __init__(
        self,
        owner: LoopThread,
        outgoing: LoopPublisher,
        logs: LogThread,
        *,
        name: str = NODE_NAME,
        namespace: str,
        arguments: Sequence[str],
    ) -> None:
        """Make the node. Raises ParameterError: ``update_rate`` is not a positive integer."""
        self._owner = owner
        self._outgoing = outgoing
        self._logs = logs
        self._robot: Robot | None = None
        self._hardware: Sequence[tuple[HardwareInfo, ComponentNode]] = ()
        self._requests: ManagerRequests | None = None
        self._arguments = arguments
        self.node: Node = outgoing.make_node(
            name, namespace, arguments, allow_undeclared_parameters=True
        )
        self.log: Log = logs.log_of(self.node.get_logger())
        try:
            add_parameter_event_qos_overrides(self.node)
            self.parameters = ManagerParameters(self.node, arguments)
            self._topics = ManagerTopics(self.node, owner, outgoing, self.parameters)
        except Exception:
            self.destroy()
            raise

    def prepare(self, robot: Robot, hardware: Sequence[HardwareInfo]) -> None:
        """
        Take over what it is to control, and make a node for each component; on the ROS thread.

        May be called again after a failure.
        """
        self.forget_hardware()
        self._topics.expect_hardware()
        self._robot = robot
        self._hardware = [
            (
                info,
                ComponentNode(
                    info.name,
                    inherited(self._arguments),
                    namespace=self.node.get_namespace(),
                    outgoing=self._outgoing,
                    logs=self._logs,
                ),
            )
            for info in hardware
        ]

    def bring_up(self, world: World | None, period: int) -> ControllerManager:
        """
        Make components and manager and start the hardware; return it, for the owner's loop.

        On the owner's thread. ``world``: as components see it; ``period``: of the tick, ns. Raises
        HardwareError, or what a foreign component raises; the hardware is then down again.
        """
        enforce = self.parameters.start.enforce_command_limits
        initial = self.parameters.start.hardware_components_initial_state
        if not enforce:
            self.log(
                Severity.INFO,
                'Enforcing command limits is disabled. Command limits from URDF will be ignored.',
            )
        resources = ResourceManager(self.log, self._robot, enforce, monotonic_ns)
        try:
            for info, node in self._hardware:
                resources.load(info, HARDWARE.find, world, node.log)
            resources.start_components(
                initial.unconfigured,
                initial.inactive,
                initial.shutdown_on_initial_state_failure,
            )
        except Exception:
            resources.shut_down()
            raise
        self.manager = ControllerManager(
            resources,
            self.parameters.update_rate,
            self.log,
            period,
            self.parameters.defaults(),
        )
        for name in resources.components:
            self.log(Severity.INFO, f'Registering statistics for : {name}')
        self._topics.watch(self.manager, may_overrun=world is None)
        return self.manager

    def start(self) -> None:
        """Make the services, once there is a manager, and its node has an executor."""
        for _, component in self._hardware:
            self.node.executor.add_node(component.node)
        self.log(
            Severity.INFO,
            'Resource Manager has been successfully initialized. Starting Controller Manager '
            'services...',
        )
        self._requests = ManagerRequests(
            self.node,
            self.log,
            self.parameters,
            self.manager,
            robot=self._robot,
            owner=self._owner,
            outgoing=self._outgoing,
            logs=self._logs,
        )
        ManagerServices(self._requests)

    def nodes(self) -> list[Node]:
        """This node and those of its components and controllers."""
        others = [*(node for _, node in self._hardware), *self._controllers()]
        return [self.node, *(each.node for each in others)]

    def forget_hardware(self) -> None:
        """Remove the nodes of components that could not be brought up."""
        for _, component in self._hardware:
            component.destroy()
        self._hardware = ()

    def destroy(self) -> None:
        """Remove all nodes; the owner must have stopped, or dropped the manager, before."""
        for controller in self._controllers():
            controller.destroy()
        self.forget_hardware()
        self._outgoing.destroy_node(self.node)

    def _controllers(self) -> list[ControllerNode]:
        return list(self._requests.controllers.values()) if self._requests else []
