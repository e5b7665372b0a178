# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a manager makes of what it hears on robot_description."""

import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from support.control_fakes import FakeLog, LEFT, RIGHT
from support.manager_host import ros_in_this_process
from support.paths import ROOT
from support.ros_processes import run
from support.running_programs import PATIENCE
from support.serving import serving

from amr_description.bringup.stacks.hardware import swap_hardware
from amr_description.control.ros.robot_description import DescriptionSource
from amr_description.errors import HardwareError
from amr_description.model.urdf import parse
from amr_description.nodes import ros2_control_node
from amr_description.nodes.ros2_control_node import StandAloneManager
from amr_description.ros.service_calls import wait_until

URDF = ROOT / 'urdf' / 'amr.urdf'
GOOD = """<robot name="cart"><link name="base"/><ros2_control name="Cart" type="system"><hardware>
<plugin>mock_components/GenericSystem</plugin></hardware></ros2_control></robot>"""
IGNORED = 'ResourceManager has already loaded a urdf and is initialized. Ignoring attempt'
FAILED = 'Could not load and initialize hardware. Please check previous output for more details.'


class Wire:
    """A node that hears descriptions, one that says them, and what the first one logs."""

    def __init__(self):
        self.node, self.speaker = Node('controller_manager', namespace='amr'), Node('speaker')
        qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.publisher = self.speaker.create_publisher(String, '/amr/robot_description', qos)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.log = FakeLog()
        self.taken = []
        self.refusals = []

    async def take(self, robot, hardware):
        if self.refusals:
            raise self.refusals.pop(0)
        self.taken.append((robot.name, [info.name for info in hardware]))

    def said(self, *texts):
        """Spin until each of the texts has been logged; return all that was, and forget it."""
        while not all(text in '\n'.join(self.log.texts()) for text in texts):
            self.executor.spin_once(timeout_sec=PATIENCE)
        lines = '\n'.join(self.log.texts())
        self.log.lines.clear()
        return lines


@pytest.fixture
def wire():
    with ros_in_this_process():
        wire = Wire()
        yield wire
        wire.executor.shutdown()
        wire.node.destroy_node()
        wire.speaker.destroy_node()


def test_it_says_what_it_waits_for_until_a_description_comes(wire):
    DescriptionSource(wire.node, wire.log, wire.take)
    waiting = "Waiting for data on 'robot_description' topic to finish initialization"
    lines = wire.said(waiting)
    assert "Subscribing to '/amr/robot_description' topic for robot description." in lines
    wire.publisher.publish(String(data=GOOD))
    wire.said('Received robot description from topic.')
    assert wire.taken == [('cart', ['Cart'])]
    (subscription,) = wire.speaker.get_subscriptions_info_by_topic('/amr/robot_description')
    assert subscription.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL


def test_what_cannot_be_used_is_refused_and_the_next_one_is_taken(wire):
    source = DescriptionSource(wire.node, wire.log, wire.take)
    wire.refusals = [HardwareError('no such device'), ValueError('a third party')]
    for text, reason in (
        ('<robot', 'robot_description:1'),
        ('<robot name="cart"><link name="base"/></robot>', 'has no <ros2_control> block'),
        (GOOD, 'no such device'),
        (GOOD, 'ValueError: a third party'),
    ):
        wire.publisher.publish(String(data=text))
        wire.said(reason, FAILED)
        assert source.robot is None
    wire.publisher.publish(String(data=GOOD))
    wire.said('Received robot description')
    assert wire.taken == [('cart', ['Cart'])]
    wire.publisher.publish(String(data=GOOD))
    wire.said(IGNORED)
    assert wire.taken == [('cart', ['Cart'])]


def test_a_spawned_robot_is_only_contradicted_by_another_description(wire):
    DescriptionSource(wire.node, wire.log, robot=parse(GOOD))
    wire.publisher.publish(String(data=GOOD + '\n'))
    wire.executor.spin_once(timeout_sec=PATIENCE)
    assert wire.log.texts() == []
    wire.publisher.publish(String(data=GOOD.replace('cart', 'other')))
    wire.said(IGNORED)


def test_services_come_once_the_hardware_is_up_and_failed_components_leave_nothing(stderr):
    with ros_in_this_process():
        executor = SingleThreadedExecutor()
        robot = StandAloneManager(executor, [])
        observer = Node('observer')
        qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        publisher = observer.create_publisher(String, '/robot_description', qos)

        def service_names():
            return {name for name, _ in observer.get_service_names_and_types()}

        def refused():
            return FAILED in stderr() or None

        try:
            robot.start()
            with serving(executor):
                publisher.publish(String(data=GOOD.replace('mock_components', 'no_such_package')))
                assert wait_until(observer, refused, timeout=PATIENCE)
                assert "'no_such_package/GenericSystem' is not known" in stderr()
                assert '/controller_manager/list_controllers' not in service_names()
                assert 'cart' not in observer.get_node_names()
                publisher.publish(String(data=GOOD))
                assert wait_until(
                    observer,
                    lambda: '/controller_manager/list_controllers' in service_names() or None,
                    timeout=PATIENCE,
                )
                assert 'cart' in observer.get_node_names()
        finally:
            robot.close()
            observer.destroy_node()


@pytest.mark.parametrize(
    ('publisher', 'cause'),
    [('', 'nobody publishes /clock'), ('simulator', '/simulator has published nothing on /clock')],
)
def test_who_waits_for_a_clock_says_so_and_whose(stderr, monkeypatch, publisher, cause):
    monkeypatch.setattr(ros2_control_node, 'CLOCK_TIMEOUT', 0.1)
    with ros_in_this_process():
        executor = SingleThreadedExecutor()
        robot = StandAloneManager(executor, ['-p', 'use_sim_time:=true'])
        simulator = Node(publisher or 'nobody')
        try:
            if publisher:
                simulator.create_publisher(Clock, '/clock', 1)
            robot.start()
            while 'the controllers stand still' not in stderr():
                executor.spin_once(timeout_sec=PATIENCE)
        finally:
            executor.shutdown()
            robot.close()
            simulator.destroy_node()
    assert f'use_sim_time is true, and {cause}: the controllers stand still until' in stderr()


def test_hardware_that_does_not_reach_its_first_state_ends_the_process():
    sides = {'left_joints': ' '.join(LEFT), 'right_joints': ' '.join(RIGHT)}
    unplugged = swap_hardware(
        URDF.read_text(),
        'amr_description/SerialBaseSystem',
        {'port': '/dev/no_such_port', **sides},
    )
    with ros_in_this_process():
        speaker = Node('speaker')
        qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        publisher = speaker.create_publisher(String, '/robot_description', qos)
        publisher.publish(String(data=unplugged))
        ended = run('ros2_control_node')
        speaker.destroy_node()
    assert ended.returncode == 1
    *_, last = ended.stderr.splitlines()
    assert '[FATAL]' in last
    assert 'Failed to set the initial state of the component : AmrSystem to active.' in last
    assert '/dev/no_such_port' in last
    assert 'Overrun detected' not in ended.stderr
