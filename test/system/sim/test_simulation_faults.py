# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the running simulator does when the physics goes wrong: it says so, and stops if asked."""

import re

import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import (
    GetSimulationState,
    ResetSimulation,
    SetSimulationState,
    SpawnEntity,
)
from support.running_programs import PATIENCE, Program

from amr_description.ros.service_calls import call, wait_until
from amr_description.sim.ros.loop_timing import CONTROLLERS, PHYSICS, PUBLISHING

GHOST = """<robot name="ghost"><link name="ghost"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""
SLOW_WORLD = """<mujoco><option timestep="1e-5"/><worldbody>
    <geom type="plane" size="0 0 1"/></worldbody></mujoco>"""
TOO_SLOW = (
    r'real time is not kept: factor (\S+) instead of 1e\+06\. Of the time goes to (.+%)\. (.+)\. '
    'Results are right all the same'
)
FALLEN = r"robot 'ghost' is below the ground: its root is at z = -0\.\d+ m at \d\.\d+ s\. Likely"


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('test_simulation_faults')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def ask(node, service_type, service, /, **fields):
    service = f'/mujoco_sim/{service}'
    return call(node, service_type, service, service_type.Request(**fields), timeout=PATIENCE)


def state(node):
    return ask(node, GetSimulationState, 'get_simulation_state').state.state


def test_a_fault_pauses_if_asked_and_a_reset_lets_it_come_again(node, tmp_path):
    options = ('--ros-args', '-p', 'on_fault:=pause')
    with Program.module('mujoco_sim', *options, cwd=tmp_path) as sim:
        sim.expect('waiting for robots')
        ask(node, SpawnEntity, 'spawn_entity', name='ghost', resource_string=GHOST)
        sim.expect(FALLEN)
        sim.expect('paused, as on_fault says')
        assert state(node) == SimulationState.STATE_PAUSED

        since = len(sim.output)
        client = AsyncParameterClient(node, 'mujoco_sim')
        assert client.wait_for_services(PATIENCE)
        future = client.set_parameters([Parameter('on_fault', value='continue')])
        assert wait_until(node, lambda: future.done() or None, timeout=PATIENCE)
        assert future.result().results[0].successful
        ask(node, ResetSimulation, 'reset_simulation', scope=ResetSimulation.Request.SCOPE_STATE)
        playing = SimulationState(state=SimulationState.STATE_PLAYING)
        ask(node, SetSimulationState, 'set_simulation_state', state=playing)
        sim.expect(FALLEN, since)
        assert state(node) == SimulationState.STATE_PLAYING
        assert 'paused' not in sim.output[since:]
    assert list(tmp_path.iterdir()) == []


def test_a_factor_that_cannot_be_kept_is_told_with_the_stage_that_takes_the_time(tmp_path):
    world = tmp_path / 'slow.xml'
    world.write_text(SLOW_WORLD)
    options = ('--ros-args', '-p', f'world:={world}', '-p', 'real_time_factor:=1e6')
    with Program.module('mujoco_sim', *options) as sim:
        factor, shares, cause = sim.expect(TOO_SLOW).groups()
    assert 0.0 < float(factor) < 1e6
    stages = dict(part.rsplit(' ', 1) for part in shares.split(', '))
    assert next(iter(stages)) == PHYSICS
    assert set(stages) == {PHYSICS, CONTROLLERS, PUBLISHING}
    # On a busy machine the cause is another one.
    assert re.match('Most goes to physics: fewer robots|The loop has the processor for ', cause)


def test_another_word_for_on_fault_is_refused():
    with Program.module('mujoco_sim', '--ros-args', '-p', 'on_fault:=reset') as sim:
        assert sim.end() == 1
        assert "parameter 'on_fault' must be one of continue, pause, found reset" in sim.output
