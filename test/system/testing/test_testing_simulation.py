# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot in the hands of a test: real processes, real DDS, the same bits every time."""

import os
import select
import shutil
import signal
import sys

from geometry_msgs.msg import Twist, TwistStamped
import pytest
import rclpy
from rclpy.context import Context
from support import preloaded
from support.paths import ROOT
from support.running_programs import PATIENCE, Program

from amr_description.errors import AmrError, SimulationError
from amr_description.testing.program import own_domain
from amr_description.testing.simulation import Simulation

URDF = ROOT / 'urdf' / 'amr.urdf'
CMD_VEL = '/diff_drive_controller/cmd_vel'

pytest_plugins = ['amr_description.testing.fixtures']


@pytest.fixture
def sim(simulation):
    return simulation(URDF)


def is_over(process):
    """Wait for the end of a process that is not our child, by its pidfd."""
    ready, _, _ = select.select([process], [], [], PATIENCE)
    os.close(process)
    return bool(ready)


def bits(sim):
    """All that can be read of it."""
    return sim.truth, sim.odometry, repr(sim.joints)


def command(linear, angular=0.0):
    message = TwistStamped()
    message.twist.linear.x, message.twist.angular.z = linear, angular
    return message


def test_a_command_is_sent_to_somebody_who_takes_it(sim, monkeypatch):
    monkeypatch.setattr('amr_description.testing.lock_step.TIMEOUT', 0.5)
    with pytest.raises(SimulationError, match='waited 0.5 s for a subscriber of .* in vain'):
        sim.send('/nobody/cmd_vel', Twist())


def test_the_nodes_of_the_test_are_served_while_it_waits(sim):
    heard = []
    sim.node.create_subscription(TwistStamped, 'mine', heard.append, 1)
    publisher = sim.node.create_publisher(TwistStamped, 'mine', 1)
    sim.wait(publisher.get_subscription_count, 'my own subscription')
    publisher.publish(command(1.0))
    sim.wait(lambda: heard, 'my own message')
    with pytest.raises(SimulationError, match='waited 0.1 s for a wonder, in vain'):
        sim.wait(lambda: False, 'a wonder', timeout=0.1)


@pytest.mark.parametrize('rtf', [0.0, 3.0])
def test_a_simulation_that_was_started_again_has_the_same_bits(sim, rtf):
    def scenario(sim):
        sim.drive(0.5, 0.8, seconds=0.5)
        return bits(sim)

    with Simulation(URDF, rtf=rtf) as other:
        assert scenario(other) == scenario(sim)


def test_a_test_that_has_ros_already_keeps_it(sim):
    context = Context()
    rclpy.init(args=[], context=context)
    domain = os.environ['ROS_DOMAIN_ID']
    with own_domain() as own:
        assert os.environ['ROS_DOMAIN_ID'] == str(own) != domain
    assert os.environ['ROS_DOMAIN_ID'] == domain
    assert context.ok()
    context.shutdown()


# --- what is wrong -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ({'urdf': 'no.urdf'}, 'no.urdf'),
        ({'urdf': '<robot'}, 'line 1'),
        ({'urdf': URDF, 'controllers': 'no.yaml'}, 'no.yaml'),
        ({'urdf': URDF, 'world': 'mars'}, "world 'mars': neither a file nor a shipped world"),
        ({'urdf': URDF, 'activate': ['nobody']}, 'nobody'),
        ({'urdf': URDF, 'parameters': {'on_fault': 'cry'}}, 'on_fault'),
        ({'urdf': URDF, 'rtf': -1.0}, 'rtf is -1.0'),
    ],
)
def test_what_cannot_be_started_says_so_in_a_line(arguments, message):
    before = dict(os.environ)
    with pytest.raises(AmrError, match=message) as refusal, Simulation(**arguments):
        pass
    assert '\n' not in str(refusal.value)
    kept = {'ROS_SUPER_CLIENT', 'FASTRTPS_DEFAULT_PROFILES_FILE'}  # by whatever uses ROS first
    assert {name: os.environ[name] for name in {*os.environ} - kept} == {
        name: before[name] for name in {*before} - kept
    }


def test_outside_of_its_block_it_does_nothing():
    with pytest.raises(SimulationError, match='runs inside its block'):
        Simulation(URDF).drive(1.0, 0.0, seconds=1.0)
    with Simulation(URDF, activate=[]) as sim:
        assert sim.truth.time == 0.0
        assert 'Spawned' in sim.log
        with pytest.raises(SimulationError, match='began without an active JointStateBroadcaster'):
            assert sim.joints
    for read in (lambda: sim.truth, lambda: sim.joints, lambda: sim.time, sim.reset):
        with pytest.raises(SimulationError, match='runs inside its block'):
            read()


def test_programs_that_are_started_meet_the_simulation_that_was_asked_for_last(simulation):
    domains = []
    for options in ({}, {'activate': []}, {}):
        simulation(URDF, **options)
        domains.append(os.environ['ROS_DOMAIN_ID'])
    assert domains[0] == domains[2] != domains[1]


def test_the_end_of_the_simulator_is_told_and_another_is_started(simulation):
    first = simulation(URDF, activate=[])
    with pytest.raises(SimulationError, match='no controller that drives .* is active'):
        first.drive(1.0, 0.0, seconds=1.0)
    first._simulator.process.kill()
    with pytest.raises(SimulationError, match='the simulator was killed by SIGKILL'):
        first.run(1.0)
    with pytest.warns(UserWarning, match='killed by SIGKILL; it is started again'):
        second = simulation(URDF, activate=[])
    assert second is not first
    second.run(0.01)


KILLED = """
import os, signal, sys
from amr_description.testing.simulation import Simulation
with Simulation(sys.argv[1], activate=[]) as sim:
    print('pid', sim._simulator.process.pid, sim._simulator._log.parent, flush=True)
    sys.stdin.read() if sys.argv[2] == 'wait' else 1 / 0
"""


def test_it_ends_with_the_test_that_is_killed():
    with Program.of(KILLED, str(URDF), 'wait', terminal=True) as test:
        _, pid, folder = test.expect(r'pid (\d+) (\S+)\s')[0].split()
        simulator = os.pidfd_open(int(pid))
        test.signal(signal.SIGKILL)
        test.end()
        assert is_over(simulator)
    shutil.rmtree(folder)  # nobody is left to do so


def test_it_ends_with_the_test_that_fails():
    ended = preloaded.run(
        [sys.executable, '-c', KILLED, str(URDF), 'fail'],
        timeout=60,
        env=os.environ | {'PYTHONPATH': os.pathsep.join(filter(None, sys.path))},
    )
    assert ended.returncode == 1
    assert ended.stderr.rstrip().endswith('ZeroDivisionError: division by zero')
    pid = int(ended.stdout.split()[1])
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
