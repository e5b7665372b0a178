# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager, asked on behalf of the pages."""

import asyncio
from collections.abc import Sequence

from controller_manager_msgs.srv import (
    ConfigureController,
    ListControllers,
    ListHardwareComponents,
    LoadController,
    SwitchController,
)

from amr_description.errors import ViewerError
from amr_description.nodes.viewer_services import Services
from amr_description.viewer.protocol import ControllerInfo, Controllers, HardwareComponentInfo
from amr_description.viewer.requests import Switch

_SWITCH_TIMEOUT = 5.0
_MANAGER_TIMEOUT = 20.0
_POLL = 0.1


def manager_clients(manager: str) -> dict[str, type]:
    """Return the services of a controller manager that are asked here, with their types."""
    return {
        f'{manager}/list_controllers': ListControllers,
        f'{manager}/list_hardware_components': ListHardwareComponents,
        f'{manager}/switch_controller': SwitchController,
        f'{manager}/load_controller': LoadController,
        f'{manager}/configure_controller': ConfigureController,
    }


async def list_controllers(services: Services, manager: str, robot: str) -> Controllers:
    """Ask what a manager has. Raises ViewerError."""
    controllers = await services.call(f'{manager}/list_controllers', ListControllers.Request())
    components = await services.call(
        f'{manager}/list_hardware_components', ListHardwareComponents.Request()
    )
    return Controllers(
        robot,
        tuple(
            ControllerInfo(each.name, each.type, each.state, tuple(each.claimed_interfaces))
            for each in controllers.controller
        ),
        tuple(
            HardwareComponentInfo(each.name, each.plugin_name or each.type, each.state.label)
            for each in components.component
        ),
    )


async def switch_controllers(services: Services, manager: str, request: Switch) -> str:
    """Activate and deactivate; return what was done. Raises ViewerError."""
    await _switch(services, manager, request.activate, request.deactivate)
    done = [f'{name} is active' for name in request.activate]
    done += [f'{name} is inactive' for name in request.deactivate]
    return ', '.join(done) or 'nothing was asked'


async def start_like(services: Services, model: str, manager: str) -> list[str]:
    """
    Load and activate in a new manager what is active in another; return the names.

    Raises ViewerError.
    """
    listed = await services.call(f'{model}/list_controllers', ListControllers.Request())
    names = [each.name for each in reversed(listed.controller) if each.state == 'active']
    deadline = asyncio.get_running_loop().time() + _MANAGER_TIMEOUT
    while f'{manager}/load_controller' not in services:
        if asyncio.get_running_loop().time() > deadline:
            raise ViewerError(f'{manager} is not there after {_MANAGER_TIMEOUT:g} s')
        await asyncio.sleep(_POLL)
    for name in names:
        for step in (LoadController, ConfigureController):
            verb = step.__name__.removesuffix('Controller').lower()
            response = await services.call(f'{manager}/{verb}_controller', step.Request(name=name))
            if not response.ok:
                raise ViewerError(f'{manager} does not {verb} {name}; its log says why')
    await _switch(services, manager, names, [])
    return names


async def _switch(
    services: Services, manager: str, activate: Sequence[str], deactivate: Sequence[str]
) -> None:
    asked = SwitchController.Request(
        activate_controllers=activate,
        deactivate_controllers=deactivate,
        strictness=SwitchController.Request.STRICT,
        activate_asap=True,
    )
    asked.timeout.sec = int(_SWITCH_TIMEOUT)
    response = await services.call(f'{manager}/switch_controller', asked, 2 * _SWITCH_TIMEOUT)
    if not response.ok:
        raise ViewerError(' '.join(response.message.split()) or f'{manager} refuses')
