# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ``controller_manager`` node of one robot, over the pure manager of ``control``.

Its services (``manager_services.py``) and parameters (``manager_parameters.py``) stand apart; here
is what a request does: nodes and topics on the ROS thread, the rest on the owner's.
"""

from collections.abc import Sequence

from rclpy.node import Node

from amr_description.control.contracts import Log, Severity, World
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.controllers import CONTROLLERS
from amr_description.errors import AmrError, ControllerError
from amr_description.hardware import HARDWARE
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.nodes.bridge import ControllerNode
from amr_description.nodes.component_node import ComponentNode
from amr_description.nodes.controller_libraries import reload_modules
from amr_description.nodes.manager_parameters import ManagerParameters
from amr_description.nodes.manager_services import ManagerServices
from amr_description.nodes.node_log import LogThread
from amr_description.nodes.node_parameters import let_parameter_events_be_overridden
from amr_description.nodes.outgoing import Outgoing
from amr_description.nodes.owner import Owner
from amr_description.nodes.ros_arguments import inherited
from amr_description.nodes.runtime import argument_errors
from amr_description.nodes.threads import run_in_thread

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
        owner: Owner,
        outgoing: Outgoing,
        logs: LogThread,
        *,
        namespace: str,
        arguments: Sequence[str],
    ) -> None:
        """Make the node. Raises ParameterError: ``update_rate`` is not a positive integer."""
        self._owner = owner
        self._outgoing = outgoing
        self._logs = logs
        self._robot: Robot | None = None
        self._hardware: Sequence[tuple[HardwareInfo, ComponentNode]] = ()
        self._controllers: dict[str, ControllerNode] = {}
        self._modules: set[str] = set()
        self._arguments = arguments
        self.node: Node = outgoing.make_node(
            NODE_NAME, namespace, arguments, allow_undeclared_parameters=True
        )
        self.log: Log = logs.log_of(self.node.get_logger())
        try:
            let_parameter_events_be_overridden(self.node)
            self.parameters = ManagerParameters(self.node, arguments)
        except Exception:
            self.destroy()
            raise

    def prepare(self, robot: Robot, hardware: Sequence[HardwareInfo]) -> None:
        """
        Take over what it is to control, and make a node for each component; on the ROS thread.

        May be called again after a failure.
        """
        self.forget_hardware()
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
        resources = ResourceManager(self.log, self._robot, enforce)
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
        ManagerServices(self)

    def nodes(self) -> list[Node]:
        """This node and those of its components and controllers."""
        others = [*(node for _, node in self._hardware), *self._controllers.values()]
        return [self.node, *(each.node for each in others)]

    def forget_hardware(self) -> None:
        """Remove the nodes of components that could not be brought up."""
        for _, component in self._hardware:
            component.destroy()
        self._hardware = ()

    def destroy(self) -> None:
        """Remove all nodes; the owner must have stopped, or dropped the manager, before."""
        for controller in self._controllers.values():
            controller.destroy()
        self.forget_hardware()
        self._outgoing.destroy_node(self.node)

    # --- what the services do; coroutines of the ROS thread --------------------------------------

    async def load(self, name: str) -> None:
        """Make the controller and its node here, and let the owner take it in."""
        if name in self._controllers:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        entry = self.parameters.entry_of(name)
        self.log(Severity.INFO, f"Loading controller : '{name}' of type '{entry.type}'")
        try:
            controller_class = CONTROLLERS.find(entry.type)
        except ControllerError as error:
            raise ControllerError(
                f"Loader for controller '{name}' (type '{entry.type}') not found. {error}"
            ) from error
        self._modules.add(controller_class.__module__)
        arguments = self.parameters.arguments_of(entry)
        self.log(Severity.INFO, f"Loading controller '{name}'")
        self.log(
            Severity.INFO, f"Controller '{name}' node arguments: --ros-args {' '.join(arguments)} "
        )
        with argument_errors():
            bridge = ControllerNode(
                name,
                controller_class,
                arguments,
                namespace=self.node.get_namespace(),
                update_rate=self.parameters.update_rate,
                robot=self._robot,
                outgoing=self._outgoing,
                logs=self._logs,
            )
        # Before the owner is asked: others may see the controller in the list at once.
        self._controllers[name] = bridge
        self.node.executor.add_node(bridge.node)
        try:
            await self._owner.submit(
                lambda: self.manager.load(
                    bridge.controller, entry.type, entry.fallback_controllers, bridge.watch
                )
            )
        except Exception:
            self._forget(name)
            raise

    async def configure(self, name: str) -> None:
        """
        Configure a controller and make its topics. Raises ControllerError, ParameterError.

        What takes long, the controller's own part, neither the owner nor this thread waits for.
        """
        bridge = self._controllers.get(name)
        if bridge is None:
            raise ControllerError(
                f"Could not configure controller with name '{name}' because no controller with "
                'this name exists'
            )
        self.log(Severity.INFO, f"Configuring controller: '{name}'")
        parameters = bridge.parameters()
        try:
            configuring = await self._owner.submit(lambda: self.manager.begin_configure(name))
            await run_in_thread(
                lambda: configuring.run(parameters), self.node.executor, f'configure {name}'
            )
            await self._owner.submit(lambda: self.manager.finish_configure(configuring))
        except AmrError:
            states = {each.name: each.state for each in self.manager.snapshot.controllers}
            if states.get(name) is LifecycleState.UNCONFIGURED:
                bridge.disconnect()
            raise
        if self._controllers.get(name) is not bridge:
            return  # it was unloaded since
        try:
            with argument_errors():
                bridge.connect()
        except Exception:
            await self.cleanup(name)
            raise

    async def cleanup(self, name: str) -> None:
        """Bring a controller back to unconfigured, without topics. Raises ControllerError."""
        await self._owner.submit(lambda: self.manager.cleanup(name))
        if name in self._controllers:  # and was not unloaded since
            self._controllers[name].disconnect()

    async def unload(self, name: str) -> None:
        """Remove a controller and its node. Raises ControllerError."""
        await self._owner.submit(lambda: self.manager.unload(name))
        self._forget(name)

    async def reload_libraries(self, *, force: bool) -> None:
        """Unload every controller, and import anew what they were made of."""
        active = self.manager.snapshot.active_controllers
        if active and not force:
            raise ControllerError(
                'Cannot reload controller libraries because there are still active controllers: '
                f'{", ".join(active)}; deactivate them, or ask with force_kill'
            )
        if active:
            await self._owner.submit(
                lambda: self.manager.switch([], active, Strictness.STRICT, self._owner.loop.time)
            )
        for name in list(self._controllers):
            await self.unload(name)
        reload_modules(self._modules)

    async def switch(
        self, activate: Sequence[str], deactivate: Sequence[str], strictness: int, timeout: int
    ) -> str:
        """Switch controllers, as in the request; ``timeout``: ns. Raises ControllerError."""
        defaults = self.parameters.defaults()

        def switch() -> str:
            self.manager.defaults = defaults
            time = self._owner.loop.time
            return self.manager.switch(activate, deactivate, strictness, time, timeout)

        message = await self._owner.submit(switch)
        self.log(Severity.INFO, message)
        return message

    async def set_component_state(self, name: str, state: LifecycleState) -> None:
        """Bring a hardware component to a state. Raises HardwareError."""
        await self._owner.submit(
            lambda: self.manager.set_component_state(name, state, self._owner.loop.time)
        )

    def _forget(self, name: str) -> None:
        """Remove the node of a controller that the manager does not know, or no longer."""
        bridge = self._controllers.pop(name)
        self.node.executor.remove_node(bridge.node)
        bridge.destroy()
