# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Services of simulators (simulation_interfaces) and controller managers, called for the pages.

Calls are awaited on the asyncio thread of the page's server. The clients are created and destroyed
on the ROS thread, and created as soon as their services are there: a server that has not
discovered a client yet drops the response to it.
"""

import asyncio
from collections.abc import Awaitable, Callable, Iterable, Mapping, Sequence
import contextlib
from typing import Any

from controller_manager_msgs.srv import (
    ConfigureController,
    ListControllers,
    ListHardwareComponents,
    LoadController,
    SwitchController,
)
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.client import Client
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from simulation_interfaces.msg import EntityState, Result, SimulationState
from simulation_interfaces.srv import (
    DeleteEntity,
    GetAvailableWorlds,
    GetCurrentWorld,
    GetEntities,
    GetNamedPoses,
    GetSimulationState,
    LoadWorld as LoadWorldService,
    ResetSimulation,
    SetEntityState,
    SetSimulationState,
    SpawnEntity,
    StepSimulation,
)

from amr_description.errors import ViewerError
from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_pose, transform_of
from amr_description.ros.qos import SERVICE_CLIENT
from amr_description.ros.service_calls import ServiceReadiness
from amr_description.text import unwrap
from amr_description.viewer.backend import Answer
from amr_description.viewer.protocol import (
    ControllerInfo,
    Controllers,
    HardwareComponentInfo,
    SimulatorInfo,
)
from amr_description.viewer.requests import (
    Delete,
    LoadWorld,
    Place,
    Play,
    ResetEntity,
    ResetSimulation as Reset,
    SetFactor,
    SimulatorRequest,
    Spawn,
    Step,
    Switch,
)

_READY_TIMEOUT = 5.0
_READY_PERIOD = 0.05
_CALL_TIMEOUT = 10.0
_SIMULATOR_TIMEOUT = 60.0
"""s: a request may be for thousands of steps, or for a large robot."""
_SWITCH_TIMEOUT = 5.0
_QUERY_TIMEOUTS = (1.0, 2.0)
"""s to wait for the first answers where what is asked changes nothing."""
_MANAGER_TIMEOUT = 20.0
_MANAGER_PERIOD = 0.1

_STEPS_FROM = {'': (LoadController, ConfigureController), 'unconfigured': (ConfigureController,)}
"""What makes a controller inactive, by its state; one that is not there has none."""

_TIMEOUTS = ('cmd_vel_timeout', 'reference_timeout')
_WORLD_FRAME = 'world'
_FACTOR = 'real_time_factor'
_STATES = {
    SimulationState.STATE_STOPPED: 'stopped',
    SimulationState.STATE_PLAYING: 'playing',
    SimulationState.STATE_PAUSED: 'paused',
}
_SIMULATOR_TYPES = {
    'set_simulation_state': SetSimulationState,
    'get_simulation_state': GetSimulationState,
    'step_simulation': StepSimulation,
    'reset_simulation': ResetSimulation,
    'spawn_entity': SpawnEntity,
    'delete_entity': DeleteEntity,
    'get_entities': GetEntities,
    'get_named_poses': GetNamedPoses,
    'get_available_worlds': GetAvailableWorlds,
    'get_current_world': GetCurrentWorld,
    'load_world': LoadWorldService,
    'set_entity_state': SetEntityState,
    'get_parameters': GetParameters,
    'set_parameters': SetParameters,
}
_MANAGER_TYPES = {
    'list_controllers': ListControllers,
    'list_hardware_components': ListHardwareComponents,
    'switch_controller': SwitchController,
    'load_controller': LoadController,
    'configure_controller': ConfigureController,
    'list_parameters': ListParameters,
}


class UnansweredError(ViewerError):
    """A service has not answered in time."""


class ServiceClients:
    """All clients, by the names of their services."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}
        self._found: Mapping[str, type] = {}
        self._more: Mapping[str, type] = {}

    def set_services(self, types: Mapping[str, type]) -> None:
        """Have clients for these services of the graph; on the ROS thread."""
        self._found = types
        self._update()

    def set_more(self, types: Mapping[str, type]) -> None:
        """Have clients for these services, too, and no others than before; on the ROS thread."""
        self._more = types
        self._update()

    def _update(self) -> None:
        types = {**self._more, **self._found}
        clients = {name: each for name, each in self._clients.items() if name in types}
        gone = [each for name, each in self._clients.items() if name not in types]
        for name, service_type in types.items():
            if name not in clients:
                clients[name] = self._node.create_client(
                    service_type, name, qos_profile=SERVICE_CLIENT
                )
        self._clients = clients
        for client in gone:
            self._node.destroy_client(client)

    def __contains__(self, name: str) -> bool:
        """Return whether there is such a service; on any thread."""
        return name in self._clients

    async def call(self, name: str, request: Any, timeout: float = _CALL_TIMEOUT) -> Any:
        """
        Return the response; on the asyncio thread.

        Args:
            name: Of the service.
            request: To it.
            timeout: s.

        Raises:
            UnansweredError: It has not answered in time.
            ViewerError: It is not there.
        """
        client = self._clients.get(name)
        if client is None:
            raise ViewerError(f'there is no service {name}; is its node running?')
        return await call_client(self._node, client, name, request, timeout)


async def call_client(node: Node, client: Client, name: str, request: Any, timeout: float) -> Any:
    """As :meth:`ServiceClients.call`, by a client of the node for the service."""
    loop = asyncio.get_running_loop()
    answered = asyncio.Event()
    try:
        await wait_until_ready(ServiceReadiness(node, client), f'service {name}')
        pending = client.call_async(request)
    except InvalidHandle:  # the ROS thread has destroyed it in the meantime
        raise ViewerError(f'service {name} has gone; is its node running?') from None

    pending.add_done_callback(lambda _: loop.call_soon_threadsafe(answered.set))
    try:
        await asyncio.wait_for(answered.wait(), timeout)
    except TimeoutError:
        raise UnansweredError(f'service {name} has not answered within {timeout:g} s') from None
    finally:
        client.remove_pending_request(pending)
    return pending.result()


async def wait_until_ready(is_ready: Callable[[], bool], what: str) -> None:
    """Wait until a service or an action is there. Raises ViewerError: it is not."""
    loop = asyncio.get_running_loop()
    deadline = loop.time() + _READY_TIMEOUT
    while not is_ready():
        if loop.time() > deadline:
            raise ViewerError(
                f'{what} is not there after {_READY_TIMEOUT:g} s; is its node running?'
            )
        await asyncio.sleep(_READY_PERIOD)


def simulator_service_types(simulator: str, services: Iterable[str]) -> dict[str, type]:
    """Return those services of a simulator that are called here, with their types."""
    types = {f'{simulator}/{name}': each for name, each in _SIMULATOR_TYPES.items()}
    return {name: types[name] for name in services if name in types}


class SimulatorClient:
    """
    One simulator; on the server's thread.

    Args:
        name: the node of the simulator.
        services: the clients.
        description_of: returns the URDF of a robot of the graph; raises ViewerError.
    """

    def __init__(
        self, name: str, services: ServiceClients, description_of: Callable[[str], str]
    ) -> None:
        self.name = name
        self.state = 'unknown'
        self.factor: float | None = None
        """The parameter ``real_time_factor``; None: the simulator has none."""
        self.entities: tuple[str, ...] = ()
        self.world = ''
        """The name of the present world; empty: it is not told."""
        self.worlds: Mapping[str, str] = {}
        """The worlds that can be loaded: name -> URI."""
        self.has_new_world = True
        """Whether :attr:`world` is to be asked for: anybody may load another one."""
        self._services = services
        self._description_of = description_of

    @property
    def info(self) -> SimulatorInfo:
        """The simulator as in the graph message."""
        return SimulatorInfo(self.name, self.entities, self.world, tuple(self.worlds))

    async def refresh(self) -> None:
        """Query its state, real-time factor and entities. Raises ViewerError."""
        response = await self._call('get_simulation_state', GetSimulationState.Request())
        self.state = _STATES.get(response.state.state, 'unknown')
        if self._offers('get_parameters'):
            values = await self._call('get_parameters', GetParameters.Request(names=[_FACTOR]))
            known = [v for v in values.values if v.type == ParameterType.PARAMETER_DOUBLE]
            self.factor = known[0].double_value if known else None
        if self._offers('get_entities'):
            entities = await self._call('get_entities', GetEntities.Request())
            self.entities = tuple(entities.entities)
        if not self._offers('load_world'):
            return
        if not self.worlds:
            found = await self._call('get_available_worlds', GetAvailableWorlds.Request())
            self.worlds = {each.name: each.world_resource.uri for each in found.worlds}
        if self.has_new_world:
            self.has_new_world = False  # before it is asked: another one may come meanwhile
            try:
                current = await self._call('get_current_world', GetCurrentWorld.Request())
            except ViewerError:
                self.has_new_world = True
                raise
            self.world = current.world.name

    async def play(self, request: Play) -> str:
        """Have time go on, or stand still; return one line about it. Raises ViewerError."""
        if request.type == 'play':
            return await self._set_state(SimulationState.STATE_PLAYING, 'time goes on')
        return await self._set_state(SimulationState.STATE_PAUSED, 'time stands still')

    async def step(self, request: Step) -> str:
        """Make steps; return one line about it. Raises ViewerError."""
        await self._do('step_simulation', StepSimulation.Request(steps=request.steps))
        return f'{request.steps} steps were made'

    async def reset(self, _: Reset) -> str:
        """Begin anew with the same robots; return one line about it. Raises ViewerError."""
        reset = ResetSimulation.Request
        await self._do('reset_simulation', reset(scope=reset.SCOPE_TIME | reset.SCOPE_STATE))
        return 'time is 0, and every robot where it was spawned'

    async def _set_state(self, state: int, done: str) -> str:
        request = SetSimulationState.Request(state=SimulationState(state=state))
        response = await self._call('set_simulation_state', request, _SIMULATOR_TIMEOUT)
        if response.result.result != response.ALREADY_IN_TARGET_STATE:
            _check(response.result)
        return done

    async def set_factor(self, request: SetFactor) -> str:
        """Set how fast time goes; return one line about it. Raises ViewerError."""
        factor = request.factor
        value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=factor)
        parameter = Parameter(name=_FACTOR, value=value)
        response = await self._call(
            'set_parameters', SetParameters.Request(parameters=[parameter])
        )
        (result,) = response.results
        if not result.successful:
            raise ViewerError(result.reason)
        return f'the real-time factor is {factor:g}' if factor else 'as fast as possible'

    async def spawn_asked(self, request: Spawn) -> str:
        """Spawn the robot that a page asks for; return one line about it. Raises ViewerError."""
        if request.like is None and request.urdf is None:
            raise ViewerError('a robot to spawn has a URDF, or is like another one')
        urdf = request.urdf or self._description_of(request.like or '')
        pose = Transform.from_xyz_rpy(request.position, (0.0, 0.0, request.yaw))
        return await self.spawn(request.name, request.namespace, urdf, pose)

    async def spawn(self, name: str, namespace: str, urdf: str, pose: Transform) -> str:
        """Spawn a robot; return one line about it. Raises ViewerError."""
        call = SpawnEntity.Request(
            name=name, allow_renaming=False, entity_namespace=namespace, resource_string=urdf
        )
        call.initial_pose.header.frame_id = _WORLD_FRAME
        fill_pose(pose, call.initial_pose.pose)
        response = await self._do('spawn_entity', call)
        return f"'{response.entity_name}' is in the world"

    async def place(self, request: Place) -> Answer:
        """Put an entity elsewhere; return one line about it. Raises ViewerError."""
        turned = (0.0, 0.0, request.yaw)
        pose = Transform.from_xyz_rpy(request.position, turned)
        warning = await self._place(request.name, pose)
        return Answer(warning or f"'{request.name}' stands where it was put", bool(warning))

    async def reset_entity(self, request: ResetEntity) -> str:
        """Put an entity where it was spawned; return one line about it. Raises ViewerError."""
        await self._place(request.name, await self._spawn_pose(request.name))
        return f"'{request.name}' stands where it was spawned"

    async def delete(self, request: Delete) -> str:
        """Remove an entity; return one line about it. Raises ViewerError."""
        await self._do('delete_entity', DeleteEntity.Request(entity=request.name))
        return f"'{request.name}' has left the world"

    async def load_world(self, request: LoadWorld) -> str:
        """Load another world; return one line about it. Raises ViewerError."""
        name = request.name
        if name not in self.worlds:
            known = ', '.join(self.worlds) or 'none'
            raise ViewerError(f'there is no world {name!a} to load; there are: {known}')
        response = await self._do('load_world', LoadWorldService.Request(uri=self.worlds[name]))
        self.world = response.world.name
        return f"the world is '{self.world}'"

    async def _place(self, name: str, pose: Transform) -> str:
        """Return what the simulator says about it, though it is done; mostly nothing."""
        call = SetEntityState.Request(entity=name, state=EntityState())
        call.state.header.frame_id = _WORLD_FRAME
        fill_pose(pose, call.state.pose)
        result: Result = (await self._do('set_entity_state', call)).result
        return result.error_message

    async def spawn_poses(self) -> dict[str, Transform]:
        """Return where the entities were spawned, by their names. Raises ViewerError."""
        poses = (await self._do('get_named_poses', GetNamedPoses.Request())).poses
        return {each.name: transform_of(each.pose) for each in poses}

    async def _spawn_pose(self, name: str) -> Transform:
        poses = await self.spawn_poses()
        if name not in poses:
            known = ', '.join(poses) or 'none'
            raise ViewerError(f"where '{name}' was spawned is not known; of these it is: {known}")
        return poses[name]

    def _offers(self, service: str) -> bool:
        return f'{self.name}/{service}' in self._services

    async def _do(self, service: str, request: Any) -> Any:
        response = await self._call(service, request, _SIMULATOR_TIMEOUT)
        _check(response.result)
        return response

    async def _call(self, service: str, request: Any, timeout: float = _CALL_TIMEOUT) -> Any:
        return await self._services.call(f'{self.name}/{service}', request, timeout)


SIMULATOR_REQUESTS: Mapping[
    type[SimulatorRequest], Callable[[SimulatorClient, Any], Awaitable[Answer | str]]
] = {
    Play: SimulatorClient.play,
    Step: SimulatorClient.step,
    Reset: SimulatorClient.reset,
    SetFactor: SimulatorClient.set_factor,
    Place: SimulatorClient.place,
    ResetEntity: SimulatorClient.reset_entity,
    Delete: SimulatorClient.delete,
}
"""What a simulator carries out by itself, by the type of the request."""


def _check(result: Result) -> None:
    if result.result != Result.RESULT_OK:
        raise ViewerError(result.error_message or f'the simulator refuses: result {result.result}')


def manager_service_types(manager: str) -> dict[str, type]:
    """Return the services of a controller manager that are called here, with their types."""
    return {f'{manager}/{name}': each for name, each in _MANAGER_TYPES.items()}


async def _query(services: ServiceClients, name: str, request: Any) -> Any:
    """
    As :meth:`ServiceClients.call`, of what changes nothing: it is asked again.

    A server that has gone may still be taken for the one that has come in its place.
    """
    for timeout in _QUERY_TIMEOUTS:
        with contextlib.suppress(UnansweredError):
            return await services.call(name, request, timeout)
    return await services.call(name, request)


async def list_controllers(services: ServiceClients, manager: str, robot: str) -> Controllers:
    """Return the controllers and hardware of ``robot``'s manager. Raises ViewerError."""
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


async def switch_controllers(services: ServiceClients, manager: str, request: Switch) -> str:
    """Switch controllers; return one line about what was done. Raises ViewerError."""
    await _switch(services, manager, request.activate, request.deactivate)
    done = [f'{name} is active' for name in request.activate]
    done += [f'{name} is inactive' for name in request.deactivate]
    return ', '.join(done) or 'nothing was asked'


async def command_timeout(services: ServiceClients, service: str) -> float | None:
    """
    Return the age at which a controller takes a command for outdated, s; 0: never.

    None: it does not say so, or each command counts for one update only. Raises ViewerError.
    """
    response = await services.call(service, GetParameters.Request(names=[*_TIMEOUTS]))
    for value in response.values:
        if value.type == ParameterType.PARAMETER_INTEGER:  # of tricycle_controller
            return value.integer_value / 1000.0
        if value.type == ParameterType.PARAMETER_DOUBLE:
            return value.double_value
    return None


async def active_controllers(services: ServiceClients, manager: str) -> list[str]:
    """Return the active controllers of a manager, in the order to activate them in."""
    listed = await _query(services, f'{manager}/list_controllers', ListControllers.Request())
    return [each.name for each in reversed(listed.controller) if each.state == 'active']


async def activate_controllers(
    services: ServiceClients, manager: str, names: Sequence[str] | None
) -> Sequence[str]:
    """
    Load and activate controllers in a new controller manager, which is waited for.

    Those that it brought up by itself, of the Gazebo sensors and plugins of a robot, are left as
    they are.

    Args:
        services: The clients.
        manager: The manager.
        names: Of the controllers; None: all that its parameter file has.

    Returns:
        Their names.

    Raises:
        ViewerError: the new manager is not there, or cannot activate one of them.
    """
    deadline = asyncio.get_running_loop().time() + _MANAGER_TIMEOUT
    needed = 'list_controllers', 'load_controller', 'list_parameters'
    while not all(f'{manager}/{name}' in services for name in needed):
        if asyncio.get_running_loop().time() > deadline:
            raise ViewerError(f'{manager} is not there after {_MANAGER_TIMEOUT:g} s')
        await asyncio.sleep(_MANAGER_PERIOD)
    if names is None:
        names = await _controllers_of_file(services, manager)
    listed = await _query(services, f'{manager}/list_controllers', ListControllers.Request())
    states = {each.name: each.state for each in listed.controller}
    for name in names:
        for step in _STEPS_FROM.get(states.get(name, ''), ()):
            verb = step.__name__.removesuffix('Controller').lower()
            response = await services.call(f'{manager}/{verb}_controller', step.Request(name=name))
            if not response.ok:
                raise ViewerError(f'{manager} does not {verb} {name}; its log says why')
    await _switch(services, manager, [each for each in names if states.get(each) != 'active'], [])
    return names


async def _controllers_of_file(services: ServiceClients, manager: str) -> list[str]:
    """Return the controllers that a manager has parameters of, which name their types."""
    response = await _query(services, f'{manager}/list_parameters', ListParameters.Request())
    names = [each.split('.') for each in response.result.names]
    return [name for name, *rest in names if rest == ['type']]


async def _switch(
    services: ServiceClients, manager: str, activate: Sequence[str], deactivate: Sequence[str]
) -> None:
    call = SwitchController.Request(
        activate_controllers=activate,
        deactivate_controllers=deactivate,
        strictness=SwitchController.Request.STRICT,
        activate_asap=True,
    )
    call.timeout.sec = int(_SWITCH_TIMEOUT)
    response = await services.call(f'{manager}/switch_controller', call, 2 * _SWITCH_TIMEOUT)
    if not response.ok:
        raise ViewerError(unwrap(response.message) or f'{manager} refuses')
