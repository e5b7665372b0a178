# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ``controller_manager`` node of one robot: ros2_control's services over the pure manager.

``list_…`` answers from the snapshot. What changes something is an async callback that awaits the
owner, so that nothing here ever blocks the executor: a slow configure delays no list.
"""

from collections.abc import Awaitable, Sequence
import traceback
from typing import Any

from controller_manager_msgs import srv
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import HistoryPolicy, QoSProfile

from amr_description.control.contracts import Log
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.controllers import CONTROLLERS
from amr_description.errors import AmrError, ControllerError, ParameterError
from amr_description.model.robot import Robot
from amr_description.nodes.bridge import ControllerNode
from amr_description.nodes.controller_libraries import reload_modules
from amr_description.nodes.manager_messages import (
    component_message,
    controller_message,
    interface_message,
)
from amr_description.nodes.node_log import LogThread
from amr_description.nodes.outgoing import Outgoing, SIM_TIME
from amr_description.nodes.owner import Owner
from amr_description.nodes.runtime import argument_errors

NODE_NAME = 'controller_manager'
_SERVICE_QOS = QoSProfile(history=HistoryPolicy.KEEP_ALL)
_BASE_CLASS = 'controller_interface::ControllerInterface'
_CHAINABLE_BASE_CLASS = 'controller_interface::ChainableControllerInterface'


class ControllerManagerNode:
    """
    Node, parameters and services of one manager.

    ``arguments`` are ROS arguments (remaps, ``--params-file``) for the node and for every
    controller that it loads. :meth:`start` makes the services: whoever waits for them finds a
    manager whose hardware is ready.
    """

    def __init__(
        self,
        owner: Owner,
        outgoing: Outgoing,
        logs: LogThread,
        *,
        namespace: str,
        robot: Robot,
        arguments: Sequence[str],
    ) -> None:
        """Make the node. Raises ParameterError: ``update_rate`` is not a positive integer."""
        self._owner = owner
        self._outgoing = outgoing
        self._logs = logs
        self._robot = robot
        self._arguments = list(arguments)
        self._controllers: dict[str, ControllerNode] = {}
        self._loading: set[str] = set()
        self._modules: set[str] = set()
        self.node = Node(
            NODE_NAME,
            namespace=namespace,
            use_global_arguments=False,
            cli_args=['--ros-args', *arguments],
            parameter_overrides=[SIM_TIME],
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        outgoing.own_clock_of(self.node)
        self.log: Log = logs.log_of(self.node.get_logger())
        self.update_rate = self._read_update_rate()

    def start(self, resources: ResourceManager, period: int) -> ControllerManager:
        """
        Make the manager and its services; ``period``: of its tick, ns.

        The caller hands the manager to the owner's loop.
        """
        self.manager = ControllerManager(resources, self.update_rate, self.log, period=period)
        group = ReentrantCallbackGroup()
        for service_type, callback in (
            (srv.ListControllers, self._list_controllers),
            (srv.ListControllerTypes, self._list_controller_types),
            (srv.ListHardwareComponents, self._list_hardware_components),
            (srv.ListHardwareInterfaces, self._list_hardware_interfaces),
            (srv.LoadController, self._load_controller),
            (srv.ConfigureController, self._configure_controller),
            (srv.SwitchController, self._switch_controller),
            (srv.CleanupController, self._cleanup_controller),
            (srv.UnloadController, self._unload_controller),
            (srv.ReloadControllerLibraries, self._reload_controller_libraries),
            (srv.SetHardwareComponentState, self._set_hardware_component_state),
        ):
            name = callback.__name__.removeprefix('_')
            self.node.create_service(
                service_type,
                f'~/{name}',
                callback,
                qos_profile=_SERVICE_QOS,
                callback_group=group,
            )
        return self.manager

    def nodes(self) -> list[Node]:
        """This node and those of its controllers."""
        return [self.node, *(each.node for each in self._controllers.values())]

    def destroy(self) -> None:
        """Remove all nodes; the owner must have stopped, or dropped the manager, before."""
        for controller in self._controllers.values():
            controller.destroy()
        self._outgoing.release_clock_of(self.node)
        self.node.destroy_node()

    # --- services that look -------------------------------------------------------------------

    def _list_controllers(
        self, _: srv.ListControllers.Request, response: srv.ListControllers.Response
    ) -> srv.ListControllers.Response:
        response.controller = [controller_message(c) for c in self.manager.snapshot.controllers]
        return response

    def _list_controller_types(
        self, _: srv.ListControllerTypes.Request, response: srv.ListControllerTypes.Response
    ) -> srv.ListControllerTypes.Response:
        for name in CONTROLLERS.names:
            controller = CONTROLLERS.find(name)
            response.types.append(name)
            response.base_classes.append(
                _CHAINABLE_BASE_CLASS if controller.is_chainable else _BASE_CLASS
            )
        return response

    def _list_hardware_components(
        self, _: srv.ListHardwareComponents.Request, response: srv.ListHardwareComponents.Response
    ) -> srv.ListHardwareComponents.Response:
        response.component = [component_message(c) for c in self.manager.snapshot.components]
        return response

    def _list_hardware_interfaces(
        self, _: srv.ListHardwareInterfaces.Request, response: srv.ListHardwareInterfaces.Response
    ) -> srv.ListHardwareInterfaces.Response:
        snapshot = self.manager.snapshot
        response.command_interfaces = [interface_message(i) for i in snapshot.commands]
        response.state_interfaces = [interface_message(i) for i in snapshot.states]
        return response

    # --- services that change -----------------------------------------------------------------

    async def _load_controller(
        self, request: srv.LoadController.Request, response: srv.LoadController.Response
    ) -> srv.LoadController.Response:
        response.ok = await self._succeeds(self._load(request.name))
        return response

    async def _configure_controller(
        self, request: srv.ConfigureController.Request, response: srv.ConfigureController.Response
    ) -> srv.ConfigureController.Response:
        response.ok = await self._succeeds(self._configure(request.name))
        return response

    async def _cleanup_controller(
        self, request: srv.CleanupController.Request, response: srv.CleanupController.Response
    ) -> srv.CleanupController.Response:
        response.ok = await self._succeeds(self._cleanup(request.name))
        return response

    async def _unload_controller(
        self, request: srv.UnloadController.Request, response: srv.UnloadController.Response
    ) -> srv.UnloadController.Response:
        response.ok = await self._succeeds(self._unload(request.name))
        return response

    async def _reload_controller_libraries(
        self,
        request: srv.ReloadControllerLibraries.Request,
        response: srv.ReloadControllerLibraries.Response,
    ) -> srv.ReloadControllerLibraries.Response:
        response.ok = await self._succeeds(self._reload_libraries(force=request.force_kill))
        return response

    async def _switch_controller(
        self, request: srv.SwitchController.Request, response: srv.SwitchController.Response
    ) -> srv.SwitchController.Response:
        strictness = self._strictness(request.strictness)
        try:
            response.message = await self._owner.submit(
                lambda: self.manager.switch(
                    request.activate_controllers,
                    request.deactivate_controllers,
                    strictness,
                    self._owner.loop.time,
                )
            )
            response.ok = True
        except AmrError as error:
            self.node.get_logger().error(str(error))
            response.message = str(error)
        return response

    async def _set_hardware_component_state(
        self,
        request: srv.SetHardwareComponentState.Request,
        response: srv.SetHardwareComponentState.Response,
    ) -> srv.SetHardwareComponentState.Response:
        target = request.target_state
        state = _state_of(target.id, target.label)
        response.ok = await self._succeeds(
            self._owner.submit(
                lambda: self.manager.set_component_state(
                    request.name, state, self._owner.loop.time
                )
            )
        )
        for component in self.manager.snapshot.components:
            if component.name == request.name:
                response.state.id = component.state
                response.state.label = component.state.label
        return response

    # --- how --------------------------------------------------------------------------------

    async def _load(self, name: str) -> None:
        """Make the controller and its node here, and let the owner take it in."""
        if name in self._controllers or name in self._loading:
            raise ControllerError(
                f"A controller named '{name}' was already loaded inside the controller manager"
            )
        type_name = self._parameter(f'{name}.type')
        if not type_name:
            raise ControllerError(
                f"The 'type' param was not defined for '{name}'. Controllers with a type in the "
                f'parameters of {self.node.get_fully_qualified_name()}: '
                f'{", ".join(self._typed_controllers()) or "none"}'
            )
        controller_class = CONTROLLERS.find(type_name)
        self._modules.add(controller_class.__module__)
        self._loading.add(name)
        try:
            with argument_errors():
                bridge = ControllerNode(
                    name,
                    controller_class,
                    self._controller_arguments(name),
                    namespace=self.node.get_namespace(),
                    update_rate=self.update_rate,
                    robot=self._robot,
                    outgoing=self._outgoing,
                    logs=self._logs,
                )
            try:
                await self._owner.submit(lambda: self.manager.load(bridge.controller, type_name))
            except AmrError:
                bridge.destroy()
                raise
            self._controllers[name] = bridge
            self.node.executor.add_node(bridge.node)
        finally:
            self._loading.discard(name)

    async def _configure(self, name: str) -> None:
        bridge = self._controllers.get(name)
        if bridge is None:
            raise ControllerError(
                f"Could not configure controller with name '{name}' because no controller with "
                'this name exists'
            )
        parameters = bridge.parameters()
        try:
            await self._owner.submit(lambda: self.manager.configure(name, parameters))
        except AmrError:
            states = {each.name: each.state for each in self.manager.snapshot.controllers}
            if states.get(name) is LifecycleState.UNCONFIGURED:
                bridge.disconnect()
            raise
        bridge.connect()

    async def _cleanup(self, name: str) -> None:
        await self._owner.submit(lambda: self.manager.cleanup(name))
        self._controllers[name].disconnect()

    async def _unload(self, name: str) -> None:
        await self._owner.submit(lambda: self.manager.unload(name))
        bridge = self._controllers.pop(name)
        self.node.executor.remove_node(bridge.node)
        bridge.destroy()

    async def _reload_libraries(self, *, force: bool) -> None:
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
            await self._unload(name)
        reload_modules(self._modules)

    async def _succeeds(self, work: Awaitable[Any]) -> bool:
        """Await the work; what it refuses is logged, as the services only answer ok or not."""
        try:
            await work
        except AmrError as error:
            self.node.get_logger().error(str(error))
            return False
        except Exception:  # a stranger's class may raise anything; the robot must go on
            self.node.get_logger().error(traceback.format_exc())
            return False
        return True

    # --- parameters -----------------------------------------------------------------------------

    def _parameter(self, name: str) -> Any:
        return self.node.get_parameter_or(name, Parameter(name)).value

    def _typed_controllers(self) -> list[str]:
        return sorted(
            name.removesuffix('.type')
            for name in self.node.get_parameters_by_prefix('')
            if name.endswith('.type')
        )

    def _controller_arguments(self, name: str) -> list[str]:
        """The manager's own arguments, then the controller's files and options."""
        files = self._parameter(f'{name}.params_file') or []
        files = [files] if isinstance(files, str) else files
        options = self._parameter(f'{name}.node_options_args') or []
        return [
            *self._arguments,
            *(argument for path in files for argument in ('--params-file', path)),
            *(option for option in options if option != '--ros-args'),
        ]

    def _read_update_rate(self) -> int:
        rate = self._parameter('update_rate')
        rate = 100 if rate is None else rate
        if type(rate) is not int or rate <= 0:
            raise ParameterError(
                f"parameter 'update_rate' of {NODE_NAME} must be an integer above 0 Hz, "
                f'found {rate!r}'
            )
        return rate

    def _strictness(self, requested: int) -> Strictness:
        if requested == Strictness.STRICT:
            return Strictness.STRICT
        if requested == 0 and self._parameter('defaults.switch_controller.strictness') == 'strict':
            return Strictness.STRICT
        return Strictness.BEST_EFFORT


def _state_of(number: int, label: str) -> LifecycleState:
    """Return the state that a request names by number, or by label where that is 0."""
    for state in LifecycleState:
        if state == number and number or state.label == label:
            return state
    return LifecycleState.UNKNOWN
