# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulator that serves simulation_interfaces, asked on behalf of the pages."""

from collections.abc import Callable, Iterable
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
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
from amr_description.nodes.converters import fill_pose
from amr_description.nodes.viewer_services import Services
from amr_description.viewer.protocol import SimulatorInfo
from amr_description.viewer.requests import (
    Delete,
    Play,
    Request,
    ResetSimulation as Reset,
    SetFactor,
    Spawn,
    Step,
)

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
