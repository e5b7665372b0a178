# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A test is in no robot's domain, and notices at once who comes into its own."""

from contextlib import contextmanager
import os
import sys

from geometry_msgs.msg import TwistStamped
import pytest
from support import machines
from support.needs import need
from support.paths import ROOT
from support.running_programs import Program

from amr_description.errors import SimulationError
from amr_description.testing import simulation
from amr_description.testing.program import own_domain, require_alone, WAYS_TO_OTHERS
from amr_description.testing.simulation import Simulation

URDF = ROOT / 'urdf' / 'amr.urdf'
CMD_VEL = '/diff_drive_controller/cmd_vel'
RECEIVED = '/mujoco_sim/received'

LISTENER = """
import sys, rclpy
from geometry_msgs.msg import TwistStamped
rclpy.init()
node = rclpy.create_node(sys.argv[1])
node.create_subscription(TwistStamped, sys.argv[2], lambda message: None, 1)
print('there', flush=True)
rclpy.spin(node)
"""


@contextmanager
def listener(name):
    """Somebody's node in the domain of the environment, which takes the commands of a robot."""
    with Program.of(LISTENER, name, CMD_VEL) as program:
        program.expect('there')
        yield program


def test_nothing_of_the_shell_leads_to_others(monkeypatch):
    for variable in WAYS_TO_OTHERS:
        monkeypatch.setenv(variable, 'theirs')
    monkeypatch.setenv('FASTRTPS_DEFAULT_PROFILES_FILE', '/their/profile.xml')
    before = dict(os.environ)
    with own_domain() as domain:
        assert os.environ['ROS_DOMAIN_ID'] == str(domain) != before['ROS_DOMAIN_ID']
        assert os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] == 'LOCALHOST'
        assert 'their' not in ' '.join(os.environ.get(name, '') for name in before)
    assert dict(os.environ) == before


def test_who_has_come_meanwhile_is_named_before_anything_is_spawned(monkeypatch):
    with own_domain() as domain:
        require_alone(domain, os.getpid())
        with listener('somebody') as somebody:
            who = rf'ROS domain {domain} is that of this test, and pid {somebody.process.pid} ".*"'
            with pytest.raises(SimulationError, match=who) as refusal:
                require_alone(domain, os.getpid())
            require_alone(domain, somebody.process.pid)
    assert '\n' not in str(refusal.value)

    @contextmanager
    def domain_with_somebody():
        with own_domain() as domain, listener('somebody'):
            yield domain

    monkeypatch.setattr(simulation, 'own_domain', domain_with_somebody)
    monkeypatch.setattr(Simulation, '_insert', lambda *_: pytest.fail('a robot was spawned'))
    with pytest.raises(SimulationError, match=r'and pid .* has come into it \(UDP port \d+\)'):
        Simulation(URDF).__enter__()


def test_a_robot_that_comes_later_is_not_commanded():
    def names(sim):
        return sorted(each.node_name for each in sim.node.get_subscriptions_info_by_topic(CMD_VEL))

    with Simulation(URDF) as sim:
        domain = sim.node.context.get_domain_id()
        sim.drive(0.1, 0.0, seconds=0.1)
        with listener('recorder'):  # a program of the test, which may well listen
            found = ['diff_drive_controller', 'recorder']
            sim.wait(lambda: names(sim) == found, 'the recorder')
            sim.drive(0.1, 0.0, seconds=0.1)
            with listener('diff_drive_controller'):
                found = ['diff_drive_controller', *found]
                sim.wait(lambda: names(sim) == found, 'the robot')
                time = sim.time
                with pytest.raises(SimulationError) as refusal:
                    sim.send(CMD_VEL, TwistStamped())
                assert sim.time == time
    assert str(refusal.value) == (
        'a second controller /diff_drive_controller has come into ROS domain '
        f'{domain}, which is that of this test; give that another ROS_DOMAIN_ID, and run the '
        'test again'
    )


def test_a_simulator_that_comes_later_is_not_asked():
    # It is paused: a time ahead of that of the test would end the simulator of the test.
    later = ['--ros-args', '-p', 'paused:=true']
    with Simulation(URDF, activate=[]) as sim, Program.module('mujoco_sim', *later) as other:
        other.expect('waiting for robots')
        sim.wait(lambda: sim.node.count_publishers(RECEIVED) == 2, 'the other simulator')
        for ask in (sim.reset, sim.step):
            with pytest.raises(SimulationError, match='a second simulator /mujoco_sim has come'):
                ask()


NODE_BEFORE = """
import os, sys
import rclpy
from amr_description.ros.local_participants import discovery_sockets, is_on_the_network
from amr_description.testing.simulation import Simulation
rclpy.init()
node = rclpy.create_node('of_the_test')  # Fast DDS has read its profiles
with Simulation(sys.argv[1]) as sim:
    domain = int(os.environ['ROS_DOMAIN_ID'])
    sim.drive(0.5, 0.0, seconds=0.2)
    print(sim.truth.x > 0.05, len(discovery_sockets(domain)), is_on_the_network(domain))
"""


def test_a_test_that_has_had_a_node_before_stays_on_this_host_too():
    theirs = {'FASTRTPS_DEFAULT_PROFILES_FILE': ''}  # as in a shell
    with Program.of(NODE_BEFORE, str(URDF), env=theirs) as test:
        test.expect(r'True 2 False\n')  # the simulator and the client
        assert test.end() == 0


NODE = """
import os, sys
if len(sys.argv) > 2:
    os.environ |= {'ROS_DOMAIN_ID': sys.argv[2]}
import rclpy
from contextlib import nullcontext
from amr_description.ros.transport import udp_only
from amr_description.testing.program import own_domain
with own_domain() if sys.argv[1] == 'of_a_test' else nullcontext():
    with udp_only():
        rclpy.init()
    node = rclpy.create_node(sys.argv[1])
    print('domain', os.environ['ROS_DOMAIN_ID'], flush=True)
    names = set()
    while 'on_this_host' not in names:
        names = set(node.get_node_names())
        rclpy.spin_once(node, timeout_sec=0.05)
    print('sees', *sorted(names), flush=True)
    rclpy.spin(node)
"""


def node_on(machine, *args, **variables):
    """A node on a machine, until the end."""
    env = {'FASTRTPS_DEFAULT_PROFILES_FILE': ''} | variables  # as in a shell
    return Program(*machine.inside(), sys.executable, '-c', NODE, *args, env=env)


def test_a_robot_elsewhere_that_has_this_host_as_a_peer_does_not_see_a_test():
    need(not machines.missing(), f'{machines.missing()}')
    if refused := machines.refusal():
        pytest.skip(refused)
    open_network = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'}
    peer = {**open_network, 'ROS_STATIC_PEERS': '192.168.7.1'}
    with machines.one_network() as (here, elsewhere), node_on(here, 'of_a_test') as test:
        domain = test.expect(r'domain (\d+)\n')[1]
        with (
            node_on(elsewhere, 'robot', domain, **peer) as robot,
            node_on(here, 'on_this_host', domain, **open_network) as other,
        ):
            for program in (robot, other):
                program.expect(f'domain {domain}\n')
            test.expect(r'sees of_a_test on_this_host\n')
            robot.expect(r'sees on_this_host robot\n')
