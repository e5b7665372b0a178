# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How many robots the simulator carries: each with its own manager and both controllers."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
import signal
import subprocess
import sys
import time
from typing import Any

from rclpy.client import Client
from rclpy.node import Node
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import (
    GetEntityState,
    SetSimulationState,
    SpawnEntity,
    StepSimulation,
)

from amr_description.ament_index import package_share
from amr_description.control.ros.client import ManagerClient
from amr_description.errors import BringupError
from amr_description.ros.messages import fill_pose
from amr_description.ros.service_calls import ask_until_answered, call_with, wait_until
from benchmarks.bare_loop import bare_real_time_factor, fleet_pose

SIZES = (1, 5, 10, 20)
"""Robots."""

_CONTROLLERS = ('joint_state_broadcaster', 'diff_drive_controller')
_TIMEOUT = 60.0
_STOP_TIMEOUT = 60.0
"""s. Fast DDS looks at all endpoints that are left when one goes: 8 s of work for 20 robots."""
_NAME = '/mujoco_sim'
_SETTLING = 1000
"""Steps of 2 ms from the drop to rest, and more."""


def fleet_figures(node: Node, urdf: str, seconds: float) -> str:
    """
    Measure, and return a table: real-time factors at rest, and the wall time of the last spawn.

    ``seconds``: wall time of each measurement.
    """
    rows = []
    with _simulator(), _Fleet(node, urdf) as fleet:
        for size in SIZES:
            took = fleet.grow(size)
            full = fleet.real_time_factor(seconds)
            bare = bare_real_time_factor(urdf, seconds / 2, robots=size)
            rows.append(f'{size:6d} {bare:12.1f} {full:12.2f} {took * 1e3:14.0f} ms')
    head = f'{"robots":>6} {"mj_step alone":>12} {"full stack":>11} {"spawn":>17}'
    return '\n'.join(('a fleet at rest, real-time factor', head, *rows))


@contextmanager
def _simulator() -> Iterator[None]:
    """``mujoco_sim`` as fast as possible; it is ended in every way out."""
    controllers = package_share('amr_description') / 'config' / 'controllers.yaml'
    process = subprocess.Popen(
        [
            *(sys.executable, '-m', 'amr_description.nodes.mujoco_sim'),
            *('--ros-args', '-p', 'real_time_factor:=0.0', '-p', f'controllers:={controllers}'),
            *('--log-level', 'warn'),
        ],
        stdin=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(_STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            raise BringupError(
                f'the simulator did not end within {_STOP_TIMEOUT:g} s of SIGINT'
            ) from None


class _Fleet:
    """The robots of the running simulator; ``robot_0`` is in the namespace ``/robot_0``."""

    def __init__(self, node: Node, urdf: str) -> None:
        self._node = node
        self._urdf = urdf
        self._size = 0

    def __enter__(self) -> '_Fleet':
        self._state = self._node.create_client(GetEntityState, f'{_NAME}/get_entity_state')
        self._spawn = self._node.create_client(SpawnEntity, f'{_NAME}/spawn_entity')
        self._change = self._node.create_client(
            SetSimulationState, f'{_NAME}/set_simulation_state'
        )
        self._step = self._node.create_client(StepSimulation, f'{_NAME}/step_simulation')
        # Once it has answered, it knows this program's endpoints.
        ask_until_answered(self._node, self._state, GetEntityState.Request(), timeout=_TIMEOUT)
        return self

    def __exit__(self, *_: object) -> None:
        for client in (self._state, self._spawn, self._change, self._step):
            self._node.destroy_client(client)

    def grow(self, size: int) -> float:
        """
        Add robots until there are ``size``; return how long the last spawn took, s.

        Time stands still meanwhile, as fast as possible it would keep the services waiting; then
        the robots come to rest.
        """
        took = 0.0
        self._set_state(SimulationState.STATE_PAUSED)
        for number in range(self._size, size):
            took = self._add(f'robot_{number}', number)
            self._activate(f'robot_{number}', _CONTROLLERS)
        self._size = size
        settle = StepSimulation.Request(steps=_SETTLING)
        self._do(self._step, settle, 'the robots cannot settle')
        self._set_state(SimulationState.STATE_PLAYING)
        return took

    def real_time_factor(self, seconds: float) -> float:
        """Simulated over wall time, over ``seconds`` of wall time."""
        simulated_before, wall_before = self._time()
        deadline = wall_before + seconds
        wait_until(self._node, lambda: time.monotonic() >= deadline or None)
        simulated_after, wall_after = self._time()
        return (simulated_after - simulated_before) / (wall_after - wall_before)

    def _add(self, name: str, number: int) -> float:
        request = SpawnEntity.Request(name=name, entity_namespace=name, resource_string=self._urdf)
        fill_pose(fleet_pose(number), request.initial_pose.pose)
        start = time.monotonic()
        self._do(self._spawn, request, f'{name} could not be spawned')
        return time.monotonic() - start

    def _set_state(self, state: int) -> None:
        request = SetSimulationState.Request(state=SimulationState(state=state))
        self._do(self._change, request, 'the simulator cannot change its state')

    def _do(self, client: Client, request: Any, complaint: str) -> None:
        """Have something done, which must be OK. Raises BringupError, NoAnswerError."""
        result = call_with(self._node, client, request, timeout=_TIMEOUT).result
        if result.result != Result.RESULT_OK:
            raise BringupError(f'{complaint}: {result.error_message}')

    def _activate(self, name: str, controllers: Sequence[str]) -> None:
        manager = ManagerClient(
            self._node, f'/{name}/controller_manager', timeout=_TIMEOUT, silent=_TIMEOUT
        )
        for controller in controllers:
            if not (manager.load(controller) and manager.configure(controller)):
                raise BringupError(f'{name}: {controller} could not be configured')
        failure = manager.switch(activate=controllers)
        if failure:
            raise BringupError(f'{name}: the controllers could not be activated: {failure}')

    def _time(self) -> tuple[float, float]:
        """Simulated time, s, and the wall time at which that was told."""
        request = GetEntityState.Request(entity='robot_0')
        stamp = call_with(self._node, self._state, request, timeout=_TIMEOUT).state.header.stamp
        return stamp.sec + stamp.nanosec * 1e-9, time.monotonic()
