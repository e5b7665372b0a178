# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager, asked on behalf of the pages."""

from controller_manager_msgs.srv import (
    ListControllers,
    ListHardwareComponents,
    SwitchController,
)

from amr_description.errors import ViewerError
from amr_description.nodes.viewer_services import Services
from amr_description.viewer.protocol import ControllerInfo, Controllers, HardwareComponentInfo
from amr_description.viewer.requests import Switch

_SWITCH_TIMEOUT = 5.0


def manager_clients(manager: str) -> dict[str, type]:
    """Return the services of a controller manager that are asked here, with their types."""
    return {
        f'{manager}/list_controllers': ListControllers,
        f'{manager}/list_hardware_components': ListHardwareComponents,
        f'{manager}/switch_controller': SwitchController,
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
    asked = SwitchController.Request(
        activate_controllers=request.activate,
        deactivate_controllers=request.deactivate,
        strictness=SwitchController.Request.STRICT,
        activate_asap=True,
    )
    asked.timeout.sec = int(_SWITCH_TIMEOUT)
    response = await services.call(f'{manager}/switch_controller', asked, 2 * _SWITCH_TIMEOUT)
    if not response.ok:
        raise ViewerError(' '.join(response.message.split()) or 'the controller manager refuses')
    done = [f'{name} is active' for name in request.activate]
    done += [f'{name} is inactive' for name in request.deactivate]
    return ', '.join(done) or 'nothing was asked'
