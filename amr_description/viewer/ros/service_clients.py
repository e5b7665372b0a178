# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulator that serves simulation_interfaces, asked on behalf of the pages.

Services of others, awaited on the asyncio thread of the page's server.

Clients are made and removed on the ROS thread, as soon as their services are there: a server that
does not know a client yet throws its response away.

A controller manager, asked on behalf of the pages.
"""

import asyncio
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from controller_manager_msgs.srv import (
    ConfigureController,
    ListControllers,
    ListHardwareComponents,
    LoadController,
    SwitchController,
)
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import (
    DeleteEntity,
    GetEntities,
    GetSimulationState,
    ResetSimulation,
    SetSimulationState,
    SpawnEntity,
    StepSimulation,
)

from amr_description.errors import ViewerError
from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_pose
from amr_description.text import unwrap
from amr_description.viewer.protocol import (
    ControllerInfo,
    Controllers,
    HardwareComponentInfo,
    SimulatorInfo,
)
from amr_description.viewer.requests import (
    Delete,
    Play,
    Request,
    ResetSimulation as Reset,
    SetFactor,
    Spawn,
    Step,
    Switch,
)

_READY_TIMEOUT = 5.0
_POLL = 0.05


class Services:
    """Clients by the names of their services."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}

    def keep(self, wanted: Mapping[str, type]) -> None:
        """Have these clients and no others; on the ROS thread."""
        kept = {name: each for name, each in self._clients.items() if name in wanted}
        gone = [each for name, each in self._clients.items() if name not in wanted]
        for name, service_type in wanted.items():
            if name not in kept:
                kept[name] = self._node.create_client(service_type, name)
        self._clients = kept
        for client in gone:
            self._node.destroy_client(client)

    def __contains__(self, name: str) -> bool:
        """Tell whether there is such a service; on any thread."""
        return name in self._clients

    async def call(self, name: str, request: Any, timeout: float = 10.0) -> Any:
        """Return the response; on the asyncio thread. Raises ViewerError."""
        client = self._clients.get(name)
        if client is None:
            raise ViewerError(f'there is no service {name}; is its node running?')
        await _ready(client)
        loop = asyncio.get_running_loop()
        answered = loop.create_future()
        pending = client.call_async(request)

        def settle(_: Future) -> None:
            loop.call_soon_threadsafe(lambda: answered.done() or answered.set_result(None))

        pending.add_done_callback(settle)
        try:
            await asyncio.wait_for(answered, timeout)
        except TimeoutError:
            raise ViewerError(f'service {name} has not answered within {timeout:g} s') from None
        finally:
            client.remove_pending_request(pending)
        return pending.result()


async def _ready(client: Client) -> None:
    loop = asyncio.get_running_loop()
    deadline = loop.time() + _READY_TIMEOUT
    while not client.service_is_ready():
        if loop.time() > deadline:
            raise ViewerError(
                f'service {client.srv_name} is not there after {_READY_TIMEOUT:g} s; is its node '
                'running?'
            )
        await asyncio.sleep(_POLL)


_WORLD_FRAME = 'world'
_FACTOR = 'real_time_factor'
_STATES = {
    SimulationState.STATE_STOPPED: 'stopped',
    SimulationState.STATE_PLAYING: 'playing',
    SimulationState.STATE_PAUSED: 'paused',
}
_TYPES = {
    'set_simulation_state': SetSimulationState,
    'get_simulation_state': GetSimulationState,
    'step_simulation': StepSimulation,
    'reset_simulation': ResetSimulation,
    'spawn_entity': SpawnEntity,
    'delete_entity': DeleteEntity,
    'get_entities': GetEntities,
    'get_parameters': GetParameters,
    'set_parameters': SetParameters,
}
_STEP_TIMEOUT = 60.0
"""s: thousands of steps may be asked, and a spawned robot be large."""


def clients_of(simulator: str, services: Iterable[str]) -> dict[str, type]:
    """Return the services of a simulator that are asked here, with their types."""
    wanted = {f'{simulator}/{name}': service_type for name, service_type in _TYPES.items()}
    return {name: wanted[name] for name in services if name in wanted}


class Simulator:
    """
    One simulator, on the server's thread.

    ``description_of`` returns the URDF of a robot that is in the graph; raises ViewerError.
    """

    def __init__(
        self, name: str, services: Services, description_of: Callable[[str], str]
    ) -> None:
        self.name = name
        self.state = 'unknown'
        self.factor: float | None = None
        """Asked for; None: it has no such parameter."""
        self.entities: tuple[str, ...] = ()
        self._services = services
        self._description_of = description_of

    @property
    def info(self) -> SimulatorInfo:
        """What pages are told of it."""
        return SimulatorInfo(self.name, self.entities)

    async def refresh(self) -> None:
        """Ask for what is told of it. Raises ViewerError."""
        response = await self._call('get_simulation_state', GetSimulationState.Request())
        self.state = _STATES.get(response.state.state, 'unknown')
        if self._offers('get_parameters'):
            values = await self._call('get_parameters', GetParameters.Request(names=[_FACTOR]))
            known = [v for v in values.values if v.type == ParameterType.PARAMETER_DOUBLE]
            self.factor = known[0].double_value if known else None
        if self._offers('get_entities'):
            entities = await self._call('get_entities', GetEntities.Request())
            self.entities = tuple(entities.entities)

    async def answer(self, request: Request) -> str:
        """Do what a page asks; return what was done. Raises ViewerError."""
        match request:
            case Play(type='play'):
                return await self._set_state(SimulationState.STATE_PLAYING, 'time goes on')
            case Play():
                return await self._set_state(SimulationState.STATE_PAUSED, 'time stands still')
            case Step():
                await self._do('step_simulation', StepSimulation.Request(steps=request.steps))
                return f'{request.steps} steps were made'
            case Reset():
                asked = ResetSimulation.Request
                scope = asked.SCOPE_TIME | asked.SCOPE_STATE
                await self._do('reset_simulation', asked(scope=scope))
                return 'time is 0, and every robot where it was spawned'
            case SetFactor():
                return await self._set_factor(request.factor)
            case Spawn():
                return await self._spawn(request)
            case Delete():
                await self._do('delete_entity', DeleteEntity.Request(entity=request.name))
                return f"'{request.name}' has left the world"
        raise ViewerError(f'a simulator is not asked {request}')

    async def _set_state(self, state: int, done: str) -> str:
        request = SetSimulationState.Request(state=SimulationState(state=state))
        response = await self._call('set_simulation_state', request, _STEP_TIMEOUT)
        if response.result.result != response.ALREADY_IN_TARGET_STATE:
            _require(response.result)
        return done

    async def _set_factor(self, factor: float) -> str:
        value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=factor)
        parameter = Parameter(name=_FACTOR, value=value)
        response = await self._call(
            'set_parameters', SetParameters.Request(parameters=[parameter])
        )
        (result,) = response.results
        if not result.successful:
            raise ViewerError(result.reason)
        return f'the real-time factor is {factor:g}' if factor else 'as fast as possible'

    async def _spawn(self, request: Spawn) -> str:
        asked = SpawnEntity.Request(
            name=request.name,
            allow_renaming=False,
            entity_namespace=request.namespace,
            resource_string=self._description_of(request.like),
        )
        asked.initial_pose.header.frame_id = _WORLD_FRAME
        pose = Transform.from_xyz_rpy(request.position, (0.0, 0.0, request.yaw))
        fill_pose(pose, asked.initial_pose.pose)
        response = await self._do('spawn_entity', asked)
        return f"'{response.entity_name}' is in the world"

    def _offers(self, service: str) -> bool:
        return f'{self.name}/{service}' in self._services

    async def _do(self, service: str, request: Any) -> Any:
        response = await self._call(service, request, _STEP_TIMEOUT)
        _require(response.result)
        return response

    async def _call(self, service: str, request: Any, timeout: float = 10.0) -> Any:
        return await self._services.call(f'{self.name}/{service}', request, timeout)


def _require(result: Result) -> None:
    if result.result != Result.RESULT_OK:
        raise ViewerError(result.error_message or f'the simulator refuses: result {result.result}')


_SWITCH_TIMEOUT = 5.0
_MANAGER_TIMEOUT = 20.0
_MANAGER_POLL = 0.1


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
        await asyncio.sleep(_MANAGER_POLL)
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
        raise ViewerError(unwrap(response.message) or f'{manager} refuses')
