# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Many clients at once, and a log that nobody reads: the simulator answers every request."""

import fcntl
from functools import partial
import random
import threading

from controller_manager_msgs.srv import SwitchController
import pytest
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from simulation_interfaces.msg import SimulationState as S
from simulation_interfaces.srv import (
    GetSimulationState,
    ResetSimulation,
    SetSimulationState,
    SpawnEntity,
    StepSimulation,
)
from support.ros_processes import PATIENCE, run, running
from support.simulator import SIMULATOR, Simulator, URDF

from amr_description.errors import NoAnswerError
from amr_description.ros.qos import SERVICE_CLIENT
from amr_description.ros.service_calls import ask_until_answered

CLIENTS, REQUESTS = 4, 40
CONTROLLERS = ('joint_state_broadcaster', 'diff_drive_controller')
SMALL_PIPE = 4096
"""Bytes, some 40 lines of the log."""


@pytest.fixture
def ros():
    rclpy.init(args=[])
    yield
    rclpy.try_shutdown()


class Client:
    """Sends random requests, each after the answer of the one before."""

    def __init__(self, number):
        self.random = random.Random(number)
        self.node = Node(f'client_{number}')
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        client = partial(self.node.create_client, qos_profile=SERVICE_CLIENT)
        state = client(SetSimulationState, f'{SIMULATOR}/set_simulation_state')
        self.makers = [
            (state, self.state),
            (state, self.state),
            (client(StepSimulation, f'{SIMULATOR}/step_simulation'), self.steps),
            (client(ResetSimulation, f'{SIMULATOR}/reset_simulation'), self.reset),
            (client(SetParameters, f'{SIMULATOR}/set_parameters'), self.factor),
            (client(SwitchController, '/controller_manager/switch_controller'), self.switch),
        ]
        self.failure = None

    def state(self):
        state = self.random.choice((S.STATE_PLAYING, S.STATE_PAUSED))
        return SetSimulationState.Request(state=S(state=state))

    def steps(self):
        return StepSimulation.Request(steps=self.random.choice((1, 5, 50)))

    def reset(self):
        return ResetSimulation.Request(scope=self.random.choice((1, 2, 3)))

    def factor(self):
        factor = Parameter('real_time_factor', value=self.random.choice((0.01, 1.0, 5.0)))
        return SetParameters.Request(parameters=[factor.to_parameter_msg()])

    def switch(self):
        names = [self.random.choice(CONTROLLERS)]
        if self.random.random() < 0.5:
            return SwitchController.Request(activate_controllers=names, strictness=1)
        return SwitchController.Request(deactivate_controllers=names, strictness=1)

    def run(self):
        try:
            for client, make in self.makers:
                assert client.wait_for_service(PATIENCE)
                # The simulator may not know this client yet: it throws its answer away then.
                ask_until_answered(self.node, client, make(), timeout=PATIENCE)
        except NoAnswerError as error:
            self.failure = str(error)
            return
        for _ in range(REQUESTS):
            client, make = self.random.choice(self.makers)
            request = make()
            future = client.call_async(request)
            self.executor.spin_until_future_complete(future, PATIENCE)
            if not future.done():
                self.failure = f'{client.srv_name} has not answered {request}'
                return

    def close(self):
        self.executor.shutdown()
        self.node.destroy_node()


def test_a_storm_of_four_clients_is_answered(ros):
    with running('mujoco_sim', until='waiting for robots'):
        node = Node('spawning')
        sim = Simulator(node)
        sim.do(SpawnEntity, name='amr', resource_string=URDF)
        assert run('spawner', *CONTROLLERS).returncode == 0
        clients = [Client(number) for number in range(CLIENTS)]
        threads = [threading.Thread(target=client.run) for client in clients]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for client in clients:
            client.close()
        node.destroy_node()
    assert [client.failure for client in clients if client.failure] == []


def test_a_log_that_nobody_reads_holds_up_nothing(ros):
    """As in a terminal that was stopped with Ctrl-S, or behind ``| less``."""
    with running('mujoco_sim', '--ros-args', '-p', 'paused:=true', until='waiting') as process:
        fcntl.fcntl(process.stderr, fcntl.F_SETPIPE_SZ, SMALL_PIPE)
        node = Node('changing')
        sim = Simulator(node)
        for _ in range(50):
            for state in (S.STATE_PLAYING, S.STATE_PAUSED):
                sim.do(SetSimulationState, state=S(state=state))
        sim.do(SetSimulationState, state=S(state=S.STATE_PLAYING))
        sim.clock.clear()
        sim.wait(lambda: len(sim.clock) > 100)  # time passes
        assert sim.do(GetSimulationState).state.state == S.STATE_PLAYING
        node.destroy_node()
