# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of ``simulation_interfaces`` for the simulation as a whole: state, time, world.

What the standard leaves to the simulator:

- A step is one physics step, the length of which ``~/get_simulator_features`` reports. Steps are
  made as fast as possible, whatever the real-time factor.
- ``STATE_STOPPED`` is paused and reset with SCOPE_ALL. It can be played and paused; it can be
  stepped once it is paused.
- SCOPE_DEFAULT is SCOPE_ALL, which removes the spawned robots. SCOPE_TIME + SCOPE_STATE (3) keeps
  them with their controllers, at their spawn poses and time 0.
- The named poses are those at which entities were spawned, under their names.
- A world can be loaded, from a file, but not unloaded: there always is one. What is not there
  replies ``RESULT_FEATURE_UNSUPPORTED``, with the reason.
"""

from collections.abc import Awaitable, Callable, Sequence
from pathlib import Path
from typing import Any

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import NamedPose, Result, SimulatorFeatures, WorldResource
from simulation_interfaces.srv import (
    GetAvailableWorlds,
    GetCurrentWorld,
    GetNamedPoseBounds,
    GetNamedPoses,
    GetSimulationState,
    GetSimulatorFeatures,
    LoadWorld,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
    UnloadWorld,
)

from amr_description.ament_index import resolve_uri, shipped_worlds, world_path
from amr_description.errors import RequestError, ResourceError, SimulationError
from amr_description.log import Severity
from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_pose
from amr_description.ros.standing_clock import StandingClockNode
from amr_description.sim.ros.entity_services import has_tags
from amr_description.sim.ros.service_replies import create_services, fill_error
from amr_description.sim.ros.simulation import Simulation, SimulationState
from amr_description.sim.ros.source_folders import folder_of
from amr_description.trusted_files import distrust

FEATURES = (
    SimulatorFeatures.NAMED_POSES,
    SimulatorFeatures.WORLD_LOADING,
    SimulatorFeatures.SIMULATION_RESET,
    SimulatorFeatures.SIMULATION_RESET_TIME,
    SimulatorFeatures.SIMULATION_RESET_STATE,
    SimulatorFeatures.SIMULATION_RESET_SPAWNED,
    SimulatorFeatures.SIMULATION_STATE_GETTING,
    SimulatorFeatures.SIMULATION_STATE_SETTING,
    SimulatorFeatures.SIMULATION_STATE_PAUSE,
    SimulatorFeatures.STEP_SIMULATION_SINGLE,
    SimulatorFeatures.STEP_SIMULATION_MULTIPLE,
    SimulatorFeatures.STEP_SIMULATION_ACTION,
    SimulatorFeatures.WORLD_INFO_GETTING,
    SimulatorFeatures.AVAILABLE_WORLDS,
)
"""What these services support."""
_SPAWN_TAG = 'spawn'
"""Of the named poses at which entities were spawned."""

_TIME, _STATE = ResetSimulation.Request.SCOPE_TIME, ResetSimulation.Request.SCOPE_STATE
_SPAWNED, _ALL = ResetSimulation.Request.SCOPE_SPAWNED, ResetSimulation.Request.SCOPE_ALL


class SimulationServices:
    """State, steps and reset of the simulation, and the features of the simulator."""

    def __init__(
        self,
        node: Node,
        simulation: Simulation,
        features: Sequence[int],
        spawn_formats: Sequence[str],
    ) -> None:
        """``features``, ``spawn_formats``: for ``~/get_simulator_features``."""
        self._simulation = simulation
        self._features = features
        self._spawn_formats = spawn_formats
        self._transitions: dict[SimulationState, Callable[[], Awaitable[None]]] = {
            SimulationState.STOPPED: simulation.stop,
            SimulationState.PLAYING: simulation.play,
            SimulationState.PAUSED: simulation.pause,
            SimulationState.QUITTING: simulation.quit,
        }
        node.create_service(
            GetSimulatorFeatures, '~/get_simulator_features', self._get_simulator_features
        )
        create_services(
            node,
            simulation.log,
            (
                (GetSimulationState, self._get_simulation_state),
                (SetSimulationState, self._set_simulation_state),
                (StepSimulation, self._step_simulation),
                (ResetSimulation, self._reset_simulation),
            ),
        )
        self._action_node = StandingClockNode(node)
        self._action = ActionServer(
            self._action_node,
            SimulateSteps,
            '~/simulate_steps',
            self._simulate_steps,
            goal_callback=self._accept_steps,
            callback_group=ReentrantCallbackGroup(),
            cancel_callback=lambda _goal: CancelResponse.ACCEPT,
        )

    def close(self) -> None:
        """Destroy the action server; the services are destroyed with the node."""
        self._action.destroy()

    def _accept_steps(self, _: SimulateSteps.Goal) -> GoalResponse:
        self._action_node.set_time()
        return GoalResponse.ACCEPT

    def _get_simulator_features(
        self, _: GetSimulatorFeatures.Request, response: GetSimulatorFeatures.Response
    ) -> GetSimulatorFeatures.Response:
        response.features.features = sorted(self._features)
        response.features.spawn_formats = self._spawn_formats
        step = self._simulation.world.timestep
        response.features.custom_info = (
            f'MuJoCo; a step is {step / 1e6:g} ms, entities are robots spawned from URDF or xacro'
        )
        return response

    async def _get_simulation_state(
        self, _: GetSimulationState.Request, response: GetSimulationState.Response
    ) -> None:
        response.state.state = self._simulation.state

    async def _set_simulation_state(
        self, request: SetSimulationState.Request, response: SetSimulationState.Response
    ) -> None:
        present, target = self._simulation.state, request.state.state
        if target == present:
            raise RequestError(
                f'the simulation is {present.name} already', response.ALREADY_IN_TARGET_STATE
            )
        if present is SimulationState.QUITTING or target not in self._transitions:
            choices = ', '.join(f'{state.name} ({state})' for state in self._transitions)
            raise RequestError(
                f'state {target} is asked of a simulation that is {present.name}; there are: '
                f'{choices}',
                response.INCORRECT_TRANSITION,
            )
        try:
            await self._transitions[SimulationState(target)]()
        except Exception as error:
            raise RequestError(str(error), response.STATE_TRANSITION_ERROR) from error
        self._simulation.log(Severity.INFO, f'The simulation is {SimulationState(target).name}')

    async def _reset_simulation(
        self, request: ResetSimulation.Request, _: ResetSimulation.Response
    ) -> None:
        scope = request.scope or _ALL
        if scope != _ALL and scope & ~(_TIME | _STATE | _SPAWNED):
            raise RequestError(
                f'scope {scope} is asked; TIME (1), STATE (2) and SPAWNED (4), or sums of them, '
                'DEFAULT (0) and ALL (255) are known',
                Result.RESULT_FEATURE_UNSUPPORTED,
            )
        if scope & _SPAWNED:
            count = await self._simulation.entities.remove_all()
            self._simulation.log(
                Severity.INFO,
                f'Reset: {count} robots are removed; scope TIME + STATE (3) would keep them',
            )
        if scope & (_TIME | _STATE):
            time, state = bool(scope & _TIME), bool(scope & _STATE)
            await self._simulation.reset(time=time, state=state)

    async def _step_simulation(
        self, request: StepSimulation.Request, _: StepSimulation.Response
    ) -> None:
        await self._step(request.steps)

    async def _simulate_steps(self, goal: ServerGoalHandle) -> SimulateSteps.Result:
        """Make steps one by one, each with a feedback."""
        total, result = goal.request.steps, SimulateSteps.Result()
        try:
            self._require_paused()
            for completed in range(1, total + 1):
                if goal.is_cancel_requested:
                    goal.canceled()
                    raise RequestError(
                        f'canceled after {completed - 1} of {total} steps',
                        Result.RESULT_OPERATION_FAILED,
                    )
                await self._step(1)
                goal.publish_feedback(
                    SimulateSteps.Feedback(
                        completed_steps=completed, remaining_steps=total - completed
                    )
                )
            goal.succeed()
            result.result.result = Result.RESULT_OK
        except Exception as error:
            if goal.is_active:
                goal.abort()
            fill_error(result.result, error)
        return result

    async def _step(self, count: int) -> None:
        """Make steps. Raises RequestError: not paused, or not all were made."""
        self._require_paused()
        try:
            missing = await self._simulation.step(count)
        except SimulationError as error:
            raise RequestError(str(error), Result.RESULT_INCORRECT_STATE) from error
        if missing:
            raise RequestError(
                f'{missing} of {count} steps were not made: the simulation was played, paused, '
                'reset or ended meanwhile',
                Result.RESULT_OPERATION_FAILED,
            )

    def _require_paused(self) -> None:
        state = self._simulation.state
        if state is not SimulationState.PAUSED:
            raise RequestError(
                f'the simulation is {state.name}; steps are made while it is PAUSED '
                f'(~/set_simulation_state, {SimulationState.PAUSED})',
                Result.RESULT_INCORRECT_STATE,
            )


class WorldServices:
    """The present world and the available ones; the rest is unsupported."""

    def __init__(self, node: Node, simulation: Simulation) -> None:
        self._simulation = simulation
        create_services(
            node,
            simulation.log,
            (
                (GetCurrentWorld, self._get_current_world),
                (GetAvailableWorlds, self._get_available_worlds),
                (LoadWorld, self._load_world),
                (UnloadWorld, self._unload_world),
                (GetNamedPoses, self._get_named_poses),
                (GetNamedPoseBounds, self._get_named_pose_bounds),
            ),
        )

    async def _get_current_world(
        self, _: GetCurrentWorld.Request, response: GetCurrentWorld.Response
    ) -> None:
        response.world = _resource(world_path(self._simulation.engine.world_name))

    async def _get_available_worlds(
        self, request: GetAvailableWorlds.Request, response: GetAvailableWorlds.Response
    ) -> None:
        """List the shipped worlds and the MJCF files of further folders; no world has tags."""
        try:
            paths = list(shipped_worlds().values())
        except ResourceError as error:
            raise RequestError(str(error), response.DEFAULT_SOURCES_FAILED) from error
        for source in request.additional_sources:
            try:
                paths += _worlds_in(source)
            except RequestError:
                if not request.continue_on_error:
                    raise
        if has_tags((), request.filter):
            response.worlds = [_resource(path) for path in paths]

    async def _load_world(self, request: LoadWorld.Request, response: LoadWorld.Response) -> None:
        """Remove all entities, and leave the new world STOPPED, as the standard asks."""
        if not request.uri:
            if request.resource_string:
                raise RequestError(
                    'a world is loaded from a file; write it to one, and give its uri',
                    response.UNSUPPORTED_FORMAT,
                )
            raise RequestError('uri is empty; file:// or a path will do', response.NO_RESOURCE)
        try:
            path = world_path(_file_of(request.uri))
            is_shipped = path.resolve() in {each.resolve() for each in shipped_worlds().values()}
            if not is_shipped and (reason := distrust(path)):
                raise SimulationError(f'world {path} {reason}')
            await self._simulation.load_world(str(path))
        except (ResourceError, SimulationError) as error:
            raise RequestError(str(error), response.RESOURCE_PARSE_ERROR) from error
        response.world = _resource(path)

    async def _unload_world(self, _: UnloadWorld.Request, __: UnloadWorld.Response) -> None:
        raise _unsupported('the world stays as long as the simulator')

    async def _get_named_poses(
        self, request: GetNamedPoses.Request, response: GetNamedPoses.Response
    ) -> None:
        """List where the entities were spawned, by name; ``~/set_entity_state`` takes it."""
        if not has_tags((_SPAWN_TAG,), request.tags):
            return
        world = self._simulation.world

        def read() -> dict[str, Transform]:
            return {name: world.robot(name).spawn_pose for name in world.names}

        for name, pose in (await self._simulation.loop_thread.submit(read)).items():
            named = NamedPose(
                name=name, description=f"where '{name}' was spawned", tags=[_SPAWN_TAG]
            )
            fill_pose(pose, named.pose)
            response.poses.append(named)

    async def _get_named_pose_bounds(self, _: GetNamedPoseBounds.Request, __: Any) -> None:
        raise _unsupported('named poses have no bounds here')


def _file_of(uri: str) -> str:
    """Return the path of a URI, or the name of a shipped world as it is. Raises ResourceError."""
    return uri if uri in shipped_worlds() else str(resolve_uri(uri))


def _worlds_in(source: str) -> list[Path]:
    """Return the MJCF files of a folder. Raises RequestError."""
    return sorted(folder_of(source).glob('*.xml'))


def _resource(path: Path) -> WorldResource:
    world = WorldResource(name=path.stem)
    world.world_resource.uri = path.resolve().as_uri()
    return world


def _unsupported(reason: str) -> RequestError:
    return RequestError(reason, Result.RESULT_FEATURE_UNSUPPORTED)
