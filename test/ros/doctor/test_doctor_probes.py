# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the doctor sees of a graph without a robot: time, silent nodes, what it leaves behind."""

from functools import partial

from fixtures.cli.commands import running_node
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
from rclpy.node import Node
from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock
from support.contract_graph import clock, MS, transforms
from support.doctor_bench import bench, every, GRAPH, typed
from support.ros_processes import PATIENCE
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations.commands import ObservedDrive
from amr_description.doctor.ros import (
    clock as clock_probe,
    commands as command_probe,
    graph as graph_probe,
    transforms as transforms_probe,
)
from amr_description.doctor.ros.clock import ClockProbe, stamp_in
from amr_description.doctor.ros.collector import collect, RosExamination, what_is_made_goes
from amr_description.doctor.ros.commands import CommandProbe, drive_of
from amr_description.doctor.ros.graph import serves
from amr_description.doctor.ros.probe_context import ProbeContext
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.doctor.ros.transforms import TransformsProbe
from amr_description.ros.messages import fill_stamp
from amr_description.ros.service_calls import wait_until

TIME = {**GRAPH, 'clock': ClockProbe}
TWO = 2 * NANOSECONDS


@pytest.fixture(scope='module')
def graph():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(clock_probe, 'LISTEN', 0.5)
        patch.setattr(graph_probe, 'PATIENCE', 1.0)
        patch.setattr(command_probe, 'LISTEN', 0.2)
        with bench() as made:
            yield made


def test_no_clock_for_nodes_with_simulated_time(graph):
    with graph.intruder('mapper', use_sim_time=True):
        found = graph.first('no_clock', 'use_sim_time is true in /mapper', TIME)
        typed(found.fix)
        graph.healed(TIME)


def test_a_clock_that_goes_back_again_and_again(graph):
    with graph.intruder('player', use_sim_time=False) as node:
        publisher = node.create_publisher(Clock, '/clock', 10)
        times = iter(range(10**6))
        timer = every(node, 0.02, publisher, lambda: clock(TWO + next(times) % 10 * 100 * MS))
        graph.first('clock_goes_back', 'by /player', TIME)
        node.destroy_timer(timer)
        every(node, 0.02, publisher, lambda: clock(TWO + next(times) * 20 * MS))
        graph.healed(TIME)


def test_a_node_whose_callbacks_are_not_served(graph):
    with running_node('silent_node.py'):
        found = graph.first('frozen_nodes', ' does not answer its parameter services', GRAPH)
        assert 'kill -INT' in found.fix
    graph.healed(GRAPH)


def test_it_leaves_nothing_behind(graph):
    with graph.intruder('robot') as node:
        node.create_publisher(Odometry, '/odom', 10)
        node.create_publisher(TwistStamped, '/cmd_vel', 10)
        doctor = graph.doctor
        before = len([*doctor.subscriptions]), len([*doctor.clients])
        assert wait_until(
            doctor, lambda: doctor.count_publishers('/cmd_vel') or None, timeout=PATIENCE
        )
        graph.findings()
        assert (len([*doctor.subscriptions]), len([*doctor.clients])) == before


def test_a_node_that_serves_nobody_may_be_silent(graph):
    with graph.intruder('only_publishes') as one, graph.intruder('hears') as other:
        one.create_publisher(Odometry, '/odom', 10)
        other.create_subscription(Odometry, '/odom', print, 10)
        assert wait_until(
            graph.doctor, lambda: serves(graph.doctor, '/hears') or None, timeout=PATIENCE
        )
        assert not serves(graph.doctor, '/only_publishes')
        assert not serves(graph.doctor, '/nobody')
    with graph.intruder('bt_navigator_navigate_to_pose_rclcpp_node') as node:
        node.create_subscription(Odometry, '/odom', print, 10)
        assert wait_until(
            graph.doctor, lambda: graph.doctor.count_subscribers('/odom') or None, timeout=PATIENCE
        )
        assert not serves(graph.doctor, '/bt_navigator_navigate_to_pose_rclcpp_node')


def test_transforms_that_come_seldom_are_waited_for(graph, monkeypatch):
    monkeypatch.setattr(transforms_probe, '_LEAST', 0.0)
    monkeypatch.setattr(transforms_probe, '_MOST', PATIENCE)
    with graph.intruder('slow', use_sim_time=False) as node:
        publisher = node.create_publisher(TFMessage, '/tf', 10)
        doctor = graph.doctor

        def is_alone():  # of the tests before, somebody with a clock may still be in the graph
            counts = doctor.count_publishers('/tf'), doctor.count_publishers('/clock')
            return counts == (1, 0) or None

        assert wait_until(doctor, is_alone, timeout=PATIENCE), graph.announced()
        probe = TransformsProbe()
        with what_is_made_goes(doctor):
            probe.begin(ProbeContext(doctor))
            assert wait_until(
                doctor, lambda: publisher.get_subscription_count() or None, timeout=PATIENCE
            )
            assert not probe.is_done
            every(node, 0.05, publisher, lambda: transforms(TWO, ('odom', 'base')))
            assert wait_until(doctor, lambda: probe.is_done or None, timeout=PATIENCE)
            assert probe.observe().trees[0].frames == {'odom', 'base'}


def test_commands_are_listened_to_until_all_who_publish_them_are_connected(graph, monkeypatch):
    monkeypatch.setattr(command_probe, 'LISTEN', 0.0)
    with graph.intruder('navigator', use_sim_time=False) as node:
        node.create_publisher(TwistStamped, '/cmd_vel', 10)
        doctor = graph.doctor
        assert wait_until(
            doctor, lambda: doctor.count_publishers('/cmd_vel') or None, timeout=PATIENCE
        )
        probe = CommandProbe()
        with what_is_made_goes(doctor):
            with monkeypatch.context() as patch:
                patch.setattr(TopicProbe, 'is_connected', False)
                probe.begin(ProbeContext(doctor))
                assert not wait_until(doctor, lambda: probe.is_done or None, timeout=0.2)
            assert wait_until(doctor, lambda: probe.is_done or None, timeout=PATIENCE)
            assert [each.name for each in probe.observe().topics] == ['/cmd_vel']


@pytest.mark.parametrize(
    ('sockets', 'expected'), [(1, {b'seen'}), (2, {b'seen', b'of a container'})]
)
def test_processes_that_are_not_seen_run_where_there_are_sockets_of_them(
    monkeypatch, sockets, expected
):
    pids = {b'seen': [7], b'of a container': []}
    monkeypatch.setattr(graph_probe, 'processes_of', pids.get)
    monkeypatch.setattr(
        graph_probe, 'local_participants', lambda _domain: {(n, n) for n in range(sockets)}
    )
    assert graph_probe.running_of(pids, 7) == expected


class Broken:
    """A probe that raises in one of its calls."""

    def __init__(self, where):
        self.where = where

    def begin(self, context):
        self._fails('begin')
        context.listen()

    @property
    def is_done(self):
        self._fails('is_done')
        return True

    def observe(self):
        self._fails('observe')

    def _fails(self, where):
        if where == self.where:
            raise ValueError(f'in {where}')


@pytest.mark.parametrize('where', ['begin', 'is_done', 'observe'])
def test_a_probe_that_raises_takes_no_other_with_it(graph, where):
    clients = [*graph.doctor.clients]
    seen = collect(
        graph.doctor,
        lambda until, timeout: wait_until(graph.doctor, lambda: until() or None, timeout=timeout),
        probes={'sensors': partial(Broken, where), **GRAPH},
    )
    assert seen.faults == {'sensors': f'ValueError: in {where}'}
    assert seen.sensors is None
    assert seen.graph is not None
    assert [*graph.doctor.clients] == clients


def test_an_examination_that_is_broken_off_leaves_no_client(graph):
    node = Node('page', start_parameter_services=False)
    with graph.intruder('asked', use_sim_time=False):
        assert wait_until(
            node, lambda: node.count_services('/asked/get_parameters') or None, timeout=PATIENCE
        )
        examination = RosExamination(node, TIME)
        assert [*node.clients]
        examination.end()
        assert [*node.clients] == []
    node.destroy_node()


def test_the_stamp_of_serialized_messages():
    message = Odometry()
    fill_stamp(TWO + 5, message.header.stamp)
    assert stamp_in(serialize_message(message), 4) == TWO + 5
    assert stamp_in(serialize_message(transforms(TWO + 7, ('odom', 'base'))), 8) == TWO + 7
    assert stamp_in(serialize_message(TFMessage()), 8) is None
    assert stamp_in(b'\0\1\0\0', 4) is None
    assert stamp_in(b'', 4) is None


LIMITS = {'linear.x.max_velocity': 0.5, 'linear.x.min_velocity': float('nan')}


@pytest.mark.parametrize(
    ('topic', 'values', 'expected'),
    [
        (
            '/d/cmd_vel',
            {'cmd_vel_timeout': 0.5, **LIMITS},
            {'timeout': 0.5, 'limits': (('linear.x', -0.5, 0.5),)},
        ),
        (
            '/d/cmd_vel',
            {'cmd_vel_timeout': 0.5, 'linear.x.has_velocity_limits': False, **LIMITS},
            {'timeout': 0.5},
        ),
        ('/t/cmd_vel', {'cmd_vel_timeout': 500}, {'timeout': 0.5}),
        (
            '/m/reference',
            {'reference_timeout': 1.0},
            {'timeout': 1.0, 'timeout_parameter': 'reference_timeout'},
        ),
        ('/gazebo/cmd_vel', {'reference_timeout': 1.0}, None),
        ('/mux/cmd_vel', {}, None),
    ],
)
def test_a_drive_by_its_parameters(topic, values, expected):
    drive = expected and ObservedDrive(node='/n', topics=(topic,), **expected)
    assert drive_of('/n', (topic,), values) == drive
