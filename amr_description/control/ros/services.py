# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of a controller manager, with the types, names and QoS of ros2_control.

``list_…`` is answered from the manager's snapshot. What changes something is an async callback
that awaits the control thread: nothing blocks the executor, and a slow configure delays no list.
"""

from collections.abc import Awaitable, Iterable
from typing import Any

from controller_manager_msgs import srv
from controller_manager_msgs.msg import (
    ChainConnection,
    ControllerState,
    HardwareComponentState,
    HardwareInterface,
)
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile

from amr_description.control.interfaces import LifecycleState
from amr_description.control.snapshot import (
    ComponentSnapshot,
    ControllerSnapshot,
    InterfaceSnapshot,
)
from amr_description.controller_manager.requests import ManagerRequests
from amr_description.controllers import CONTROLLERS
from amr_description.plugin_errors import log_error

_QOS = QoSProfile(history=HistoryPolicy.KEEP_ALL)
_BASE_CLASS = 'controller_interface::ControllerInterface'
_CHAINABLE_BASE_CLASS = 'controller_interface::ChainableControllerInterface'


class ManagerServices:
    """Requests in, responses out."""

    def __init__(self, node: Node, requests: ManagerRequests) -> None:
        """Make the services on the node of the manager; ``requests`` carries them out."""
        self._requests = requests
        self._node = node
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
            self._node.create_service(
                service_type,
                f'~/{name}',
                callback,
                qos_profile=_QOS,
                callback_group=group,
            )

    # --- services that look -------------------------------------------------------------------

    def _list_controllers(
        self, _: srv.ListControllers.Request, response: srv.ListControllers.Response
    ) -> srv.ListControllers.Response:
        snapshot = self._requests.manager.snapshot
        response.controller = [controller_message(each) for each in snapshot.controllers]
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
        snapshot = self._requests.manager.snapshot
        response.component = [component_message(each) for each in snapshot.components]
        return response

    def _list_hardware_interfaces(
        self, _: srv.ListHardwareInterfaces.Request, response: srv.ListHardwareInterfaces.Response
    ) -> srv.ListHardwareInterfaces.Response:
        snapshot = self._requests.manager.snapshot
        response.command_interfaces = [interface_message(i) for i in snapshot.commands]
        response.state_interfaces = [interface_message(i) for i in snapshot.states]
        return response

    # --- services that change -----------------------------------------------------------------

    async def _load_controller(
        self, request: srv.LoadController.Request, response: srv.LoadController.Response
    ) -> srv.LoadController.Response:
        response.ok = await self._succeeds(self._requests.load(request.name))
        return response

    async def _configure_controller(
        self, request: srv.ConfigureController.Request, response: srv.ConfigureController.Response
    ) -> srv.ConfigureController.Response:
        response.ok = await self._succeeds(self._requests.configure(request.name))
        return response

    async def _cleanup_controller(
        self, request: srv.CleanupController.Request, response: srv.CleanupController.Response
    ) -> srv.CleanupController.Response:
        response.ok = await self._succeeds(self._requests.cleanup(request.name))
        return response

    async def _unload_controller(
        self, request: srv.UnloadController.Request, response: srv.UnloadController.Response
    ) -> srv.UnloadController.Response:
        response.ok = await self._succeeds(self._requests.unload(request.name))
        return response

    async def _reload_controller_libraries(
        self,
        request: srv.ReloadControllerLibraries.Request,
        response: srv.ReloadControllerLibraries.Response,
    ) -> srv.ReloadControllerLibraries.Response:
        response.ok = await self._succeeds(
            self._requests.reload_libraries(force=request.force_kill)
        )
        return response

    async def _switch_controller(
        self, request: srv.SwitchController.Request, response: srv.SwitchController.Response
    ) -> srv.SwitchController.Response:
        try:
            response.message = await self._requests.switch(
                request.activate_controllers,
                request.deactivate_controllers,
                request.strictness,
                Duration.from_msg(request.timeout).nanoseconds,
            )
            response.ok = True
        except Exception as error:  # a plugin may raise anything; the robot must go on
            response.message = log_error(self._requests.log, error)
        return response

    async def _set_hardware_component_state(
        self,
        request: srv.SetHardwareComponentState.Request,
        response: srv.SetHardwareComponentState.Response,
    ) -> srv.SetHardwareComponentState.Response:
        target = request.target_state
        state = state_of(target.id, target.label)
        response.ok = await self._succeeds(self._requests.set_component_state(request.name, state))
        for component in self._requests.manager.snapshot.components:
            if component.name == request.name:
                response.state.id = component.state
                response.state.label = component.state.label
        return response

    async def _succeeds(self, request: Awaitable[Any]) -> bool:
        """Await a request; its error is logged, as the response only says ok or not."""
        try:
            await request
        except Exception as error:  # a plugin may raise anything; the robot must go on
            log_error(self._requests.log, error)
            return False
        return True


def state_of(number: int, label: str) -> LifecycleState:
    """Return the state that a request names by its number, or by its label if that is 0."""
    for state in LifecycleState:
        if (state if number else state.label) == (number or label):
            return state
    return LifecycleState.UNKNOWN


def controller_message(controller: ControllerSnapshot) -> ControllerState:
    """Make one entry of ``list_controllers``."""
    return ControllerState(
        name=controller.name,
        type=controller.type,
        state=controller.state.label,
        update_rate=controller.update_rate,
        claimed_interfaces=controller.claimed,
        required_command_interfaces=controller.required_commands,
        required_state_interfaces=controller.required_states,
        is_chainable=controller.is_chainable,
        is_chained=controller.is_chained,
        exported_state_interfaces=_own(i.name for i in controller.exported_states),
        reference_interfaces=_own(i.name for i in controller.references),
        chain_connections=[
            ChainConnection(name=following, reference_interfaces=_own(references))
            for following, references in controller.chain_connections
        ],
    )


def _own(names: Iterable[str]) -> list[str]:
    """Remove the controller's own name, which stands in front."""
    return [name.partition('/')[2] for name in names]


def component_message(component: ComponentSnapshot) -> HardwareComponentState:
    """Make one entry of ``list_hardware_components``."""
    message = HardwareComponentState(
        name=component.name,
        type=component.type,
        rw_rate=component.rate,
        class_type=component.plugin,
        plugin_name=component.plugin,
        command_interfaces=[interface_message(each) for each in component.commands],
        state_interfaces=[interface_message(each) for each in component.states],
    )
    message.state.id = component.state
    message.state.label = component.state.label
    return message


def interface_message(interface: InterfaceSnapshot) -> HardwareInterface:
    """Make one interface of either list."""
    return HardwareInterface(
        name=interface.name,
        data_type=interface.data_type,
        is_available=interface.is_available,
        is_claimed=interface.is_claimed,
    )
