# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulated robot, nodes that make faults, and the doctor, who looks until it sees them."""

from contextlib import contextmanager, suppress
import re
import shlex
import signal

from fixtures.cli.commands import ros2
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from simulation_interfaces.srv import SpawnEntity
from support.contract_graph import Nodes
from support.ros_processes import PATIENCE, ROOT, run
from support.running_programs import Program

from amr_description.doctor.ros.clock import ClockProbe
from amr_description.doctor.ros.collector import collect
from amr_description.doctor.ros.commands import CommandProbe
from amr_description.doctor.ros.graph import GraphProbe
from amr_description.doctor.table import examine
from amr_description.ros.service_calls import call, wait_until
from amr_description.ros.transport import udp_only

FACTOR = 0.2
"""Real-time factor: one that a busy machine keeps."""
URDF = (ROOT / 'urdf/amr.urdf').read_text(encoding='utf-8')
CONTROLLERS = ROOT / 'config/controllers.yaml'
GRAPH = {'graph': GraphProbe}
ALL = {**GRAPH, 'clock': ClockProbe, 'commands': CommandProbe}
_COMMAND = re.compile(r"ros2 (?:[^,;()']|'[^']*'|\"[^\"]*\")+")
_SLOW = 'slow_simulation'
_STEADY = Clock(clock_type=ClockType.STEADY_TIME)


class Bench:
    """The doctor, and whoever makes faults, in contexts of their own, as on a real graph."""

    def __init__(self):
        self.doctor = Node('doctor')
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.doctor)
        self.nodes = Nodes()

    def close(self):
        self.nodes.end()
        self.executor.shutdown()
        self.doctor.destroy_node()

    def findings(self, probes=ALL):
        """What the doctor finds now."""

        def spin(until, timeout):
            return wait_until(self.doctor, lambda: until() or None, timeout=timeout)

        return examine(collect(self.doctor, spin, probes=probes))

    def until(self, holds, probes=ALL):
        """Look until the findings are such: who makes the fault has to be discovered first."""
        found = []

        def looked():
            found[:] = self.findings(probes)
            return holds(found) or None

        assert wait_until(self.doctor, looked, timeout=PATIENCE), (found, self.announced())
        return found

    def announced(self):
        """The nodes that are in the graph, by their names and by what all of them publish."""
        ends = self.doctor.get_publishers_info_by_topic('/parameter_events')
        return sorted(self.doctor.get_node_names()), sorted(each.node_name for each in ends)

    def first(self, rule, text, probes=ALL):
        """
        The first finding, once there is one of a rule whose text has all, which has to be that.

        Names of nodes are discovered after their publishers and subscriptions. That a busy machine
        does not keep the simulation's factor for a moment is of no fault that a node makes: looks
        at such a moment do not count.
        """

        def is_seen(found):
            is_slow = any(each.rule == _SLOW for each in found)
            is_there = any(each.rule == rule and text in each.what for each in found)
            return is_there and (rule == _SLOW or not is_slow)

        found = self.until(is_seen, probes)
        assert found[0].rule == rule, found
        return found[0]

    def healed(self, probes=ALL):
        """Wait until nothing is found."""
        self.until(lambda found: not found, probes)

    @contextmanager
    def intruder(self, name, *, use_sim_time=True):
        """A node that makes a fault, served by a thread."""
        node = self.nodes.make(name, use_sim_time=use_sim_time)
        try:
            yield node
        finally:
            self.remove(node)

    @contextmanager
    def stranger(self, name):
        """The same in a context of its own: one has no topic with two types."""
        nodes = Nodes()
        try:
            yield nodes.make(name)
        finally:
            nodes.end()

    def remove(self, node):
        """
        End a node, if it is there still, and wait until it is gone.

        rclpy keeps it until the executor has let go of it. Of another node of that name in its
        context, made meanwhile, rmw would never know what is its own: it looks for that by name.
        """
        if node in self.nodes.nodes:
            name = node.get_name()
            before = max(1, self.doctor.get_node_names().count(name))
            self.nodes.nodes.remove(node)
            self.nodes.executor.remove_node(node)
            node.destroy_node()

            def is_gone():
                return self.doctor.get_node_names().count(name) < before or None

            assert wait_until(self.doctor, is_gone, timeout=PATIENCE), self.announced()

    def set_parameter(self, node, name, value):
        """Set a parameter of a node."""
        parameter = Parameter(name, value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        service = f'{node}/set_parameters'
        (result,) = call(self.doctor, SetParameters, service, request).results
        assert result.successful, result.reason


def every(node, period, publisher, make):
    """Publish what is made, every ``period`` s of the machine."""

    def publish():
        with suppress(InvalidHandle):  # the test has ended the node meanwhile
            publisher.publish(make())

    return node.create_timer(period, publish, clock=_STEADY)


def command_in(fix):
    """The first ``ros2`` command in a fix."""
    return _COMMAND.search(fix)[0].strip()


def typed(fix):
    """Type the command of a fix."""
    _, *words = shlex.split(command_in(fix))
    ended = ros2(*words)
    assert ended.returncode == 0, (words, ended.stdout, ended.stderr)


@contextmanager
def bench():
    """A bench without a robot."""
    with udp_only():
        rclpy.init(args=[])
    try:
        made = Bench()
        yield made
        made.close()
    finally:
        rclpy.try_shutdown()


@contextmanager
def robot_bench():
    """A bench with a simulated robot, which is in good health."""
    options = ('-p', f'controllers:={CONTROLLERS}', '-p', f'real_time_factor:={FACTOR}')
    with Program.module('mujoco_sim', '--ros-args', *options) as program:
        program.expect('waiting for robots')
        with bench() as made:
            request = SpawnEntity.Request(name='amr', resource_string=URDF)
            call(made.doctor, SpawnEntity, '/mujoco_sim/spawn_entity', request, timeout=PATIENCE)
            names = 'joint_state_broadcaster', 'diff_drive_controller'
            ended = run('spawner', *names, '-p', str(CONTROLLERS))
            assert ended.returncode == 0, ended.stderr
            made.healed()
            yield made
        assert program.end(signal.SIGINT) == 0, program.output
