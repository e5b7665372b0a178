# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The speed of a simulator with many robots, each with its own manager and both controllers."""

from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
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
from amr_description.ros.service_calls import ask_until_answered, call_with
from benchmarks.bare_loop import bare_real_time_factor, fleet_pose
from benchmarks.figures import Figures
from benchmarks.real_time import GET_STATE, real_time_factor

SIZES = (1, 5, 10, 20)
"""Numbers of robots."""

_CONTROLLERS = ('joint_state_broadcaster', 'diff_drive_controller')
_TIMEOUT = 60.0
_STOP_TIMEOUT = 60.0
"""s. Fast DDS visits all other endpoints when one is removed: 8 s for 20 robots."""
_NAME = '/mujoco_sim'
_SETTLING = 1000
"""Steps of 2 ms: longer than from the drop to rest."""


def fleet_figures(node: Node, urdf: str, seconds: float) -> Figures:
    """
    Measure real-time factors at rest, and the wall time of the last spawn.

    The simulator is paused while ``mj_step`` alone is measured. ``seconds``: wall time of each
    measurement.
    """
    rows, values = [], {}
    with _simulator(), _Fleet(node, urdf) as fleet:
        for size in SIZES:
            duration = fleet.grow(size)
            full = real_time_factor(node, fleet.get_state, 'robot_0', seconds)
            fleet.pause()
            # Processor time, which other programs have no part in: nothing in it waits.
            bare = bare_real_time_factor(urdf, seconds / 2, clock=time.thread_time, robots=size)
            values = {'fleet': full, 'fleet bare': bare}
            rows.append(f'{size:6d} {bare:12.1f} {full:12.2f} {duration * 1e3:14.0f} ms')
    head = f'{"robots":>6} {"mj_step alone":>12} {"full stack":>11} {"spawn":>17}'
    return Figures(values, '\n'.join(('a fleet at rest, real-time factor', head, *rows)))


@contextmanager
def _simulator() -> Iterator[None]:
    """Run ``mujoco_sim`` as fast as possible, while inside."""
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
        self._is_paused = False

    def __enter__(self) -> '_Fleet':
        self.get_state = self._node.create_client(GetEntityState, GET_STATE)
        self._spawn = self._node.create_client(SpawnEntity, f'{_NAME}/spawn_entity')
        self._change = self._node.create_client(
            SetSimulationState, f'{_NAME}/set_simulation_state'
        )
        self._step = self._node.create_client(StepSimulation, f'{_NAME}/step_simulation')
        # Once it has responded, it has discovered the endpoints of this program.
        ask_until_answered(self._node, self.get_state, GetEntityState.Request(), timeout=_TIMEOUT)
        return self

    def __exit__(self, *_: object) -> None:
        for client in (self.get_state, self._spawn, self._change, self._step):
            self._node.destroy_client(client)

    def grow(self, size: int) -> float:
        """
        Add robots until there are ``size``; return the wall time of the last spawn, s.

        The simulation is paused meanwhile: running as fast as possible would delay its services.
        Then the robots come to rest.
        """
        duration = 0.0
        self.pause()
        for number in range(self._size, size):
            duration = self._add(f'robot_{number}', number)
            self._activate(f'robot_{number}', _CONTROLLERS)
        self._size = size
        settle = StepSimulation.Request(steps=_SETTLING)
        self._call(self._step, settle, 'the robots cannot settle')
        self._set_state(SimulationState.STATE_PLAYING)
        self._is_paused = False
        return duration

    def pause(self) -> None:
        """Have time stand still, until :meth:`grow` is done."""
        if not self._is_paused:
            self._set_state(SimulationState.STATE_PAUSED)
            self._is_paused = True

    def _add(self, name: str, number: int) -> float:
        request = SpawnEntity.Request(name=name, entity_namespace=name, resource_string=self._urdf)
        fill_pose(fleet_pose(number), request.initial_pose.pose)
        start = time.monotonic()
        self._call(self._spawn, request, f'{name} could not be spawned')
        return time.monotonic() - start

    def _set_state(self, state: int) -> None:
        request = SetSimulationState.Request(state=SimulationState(state=state))
        self._call(self._change, request, 'the simulator cannot change its state')

    def _call(self, client: Client, request: Any, complaint: str) -> None:
        """Call a service. Raises BringupError: the result is an error; NoAnswerError."""
        result = call_with(self._node, client, request, timeout=_TIMEOUT).result
        if result.result != Result.RESULT_OK:
            raise BringupError(f'{complaint}: {result.error_message}')

    def _activate(self, name: str, controllers: Sequence[str]) -> None:
        node, manager_name = self._node, f'/{name}/controller_manager'
        client = ManagerClient(node, manager_name, timeout=_TIMEOUT, silent=_TIMEOUT)
        with closing(client) as manager:
            for controller in controllers:
                if not (manager.load(controller) and manager.configure(controller)):
                    raise BringupError(f'{name}: {controller} could not be configured')
            failure = manager.switch(activate=controllers)
        if failure:
            raise BringupError(f'{name}: the controllers could not be activated: {failure}')
