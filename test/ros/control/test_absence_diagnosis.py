# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is seen of a controller manager that does not come, over real DDS."""

from contextlib import contextmanager

from controller_manager_msgs.srv import ListControllers
import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from simulation_interfaces.srv import SpawnEntity
from std_msgs.msg import String
from support.manager_host import ros_in_this_process
from support.serving import serving

from amr_description.control.ros import (
    absence_diagnosis,
    client,
)
from amr_description.control.ros.absence_diagnosis import (
    DescriptionObservation,
    errors_of,
    ManagerProbe,
)
from amr_description.control.ros.client import ManagerClient
from amr_description.errors import ControllerError
from amr_description.ros.runtime import argument_errors
from amr_description.ros.service_calls import wait_until

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SIM_TIME = [Parameter('use_sim_time', value=True)]
NAME, TOPIC = '/left/controller_manager', '/left/robot_description'


@pytest.fixture(scope='module', autouse=True)
def ros():
    with ros_in_this_process():
        yield


@pytest.fixture
def seeker(monkeypatch):
    monkeypatch.setattr(absence_diagnosis, '_DISCOVERY_TIME', 0.3)
    monkeypatch.setattr(absence_diagnosis, '_CLOCK_TIMEOUT', 0.5)
    node = Node('seeker')
    yield node
    node.destroy_node()


@contextmanager
def served(*nodes):
    """Serve what the others ask these nodes for."""
    executor = SingleThreadedExecutor()
    for node in nodes:
        executor.add_node(node)
    try:
        with serving(executor):
            yield nodes
    finally:
        for node in nodes:
            node.destroy_node()


def waiting_manager(topic=TOPIC, **options):
    """A manager that has no services, as it waits for its description."""
    node = Node('controller_manager', namespace='/left', **options)
    node.create_subscription(String, topic, lambda _: None, LATCHED)
    return node


def look(seeker, until, manager=NAME):
    """Look until it is seen; what is never seen ends the test."""
    probe = ManagerProbe(seeker, manager)
    found = wait_until(
        seeker, lambda: seen if until(seen := probe.observe()) else None, timeout=20.0
    )
    assert found is not None, probe.observe()
    return found


def test_nobody_is_there(seeker):
    found = ManagerProbe(seeker, NAME).observe()
    assert not found.is_there
    assert (found.others, found.simulators, found.clock.publishers) == (
        (),
        (),
        0,
    )
    assert found.domain == seeker.context.get_domain_id()
    assert ManagerProbe(seeker, NAME).explain().startswith('there is no controller manager in')


def test_managers_of_others_and_simulators_are_named(seeker):
    other = Node('other')
    other.create_service(ListControllers, '/right/cm/list_controllers', lambda _, answer: answer)
    other.create_client(ListControllers, '/nowhere/cm/list_controllers')
    other.create_service(SpawnEntity, '/sim/spawn_entity', lambda _, answer: answer)
    with served(other, waiting_manager()):
        found = look(seeker, lambda s: len(s.others) == 2 and s.simulators, '/controller_manager')
    assert found.others == (NAME, '/right/cm')
    assert found.simulators == ('/sim',)


def test_a_manager_waits_for_a_description_that_nobody_publishes(seeker):
    with served(waiting_manager(), Node('elsewhere')) as (_, elsewhere):
        found = look(seeker, lambda s: s.is_there)
        assert found.description == DescriptionObservation(TOPIC)
        elsewhere.create_publisher(String, '/robot_description', LATCHED)
        found = look(seeker, lambda s: s.description.elsewhere)
        assert found.description == DescriptionObservation(
            TOPIC, elsewhere=('/robot_description',)
        )


def test_a_remapped_description_that_is_not_latched_is_seen(seeker):
    with served(waiting_manager('/the_urdf'), Node('publisher')) as (_, publisher):
        publisher.create_publisher(String, '/the_urdf', 10)
        found = look(seeker, lambda s: s.is_there and s.description.publishers)
        assert found.description == DescriptionObservation('/the_urdf', publishers=1)


def test_what_the_manager_says_of_its_description_is_told(seeker):
    with served(waiting_manager(), Node('publisher')) as (manager, publisher):
        publisher.create_publisher(String, TOPIC, LATCHED)
        manager.get_logger().error('the robot has no <ros2_control> block')
        found = look(seeker, lambda s: s.is_there and s.description.errors)
        assert found.description == DescriptionObservation(
            TOPIC, 1, 1, errors=('the robot has no <ros2_control> block',)
        )
        assert errors_of(seeker, ['/left/nobody']) == []


def test_a_manager_without_the_clock_that_it_needs(seeker):
    with served(waiting_manager(parameter_overrides=SIM_TIME)):
        found = look(seeker, lambda s: s.needs_clock)
        assert found.clock.publishers == 0
        fault = ManagerProbe(seeker, NAME).explain_clock()
        assert fault.startswith('there is no clock: use_sim_time is true, and nobody publishes')


def test_a_clock_that_stands_still_and_one_that_runs(seeker):
    with served(Node('simulation')) as (simulation,):
        publisher = simulation.create_publisher(Clock, '/clock', 10)
        message = Clock()
        message.clock.sec = 12
        probe = ManagerProbe(seeker, NAME)
        simulation.create_timer(0.01, lambda: publisher.publish(message))
        assert wait_until(
            seeker,
            lambda: (
                probe.explain_clock()
                == '/clock stands still at 12.000 s: is the simulation paused?'
                or None
            ),
            timeout=20.0,
        )
        simulation.create_timer(
            0.01, lambda: setattr(message.clock, 'nanosec', message.clock.nanosec + 10_000_000)
        )
        assert wait_until(seeker, lambda: not probe.explain_clock() or None, timeout=20.0)


def test_a_wait_that_goes_on_tells_each_time_what_is_missing(seeker, monkeypatch, capfd):
    monkeypatch.setattr(client, '_LOG_PERIOD', 0.1)
    service = f'{NAME}/list_controllers'
    with pytest.raises(ControllerError) as error:
        ManagerClient(seeker, NAME, timeout=0.3)
    assert str(error.value).startswith(
        f'Could not contact service {service} within 0.3 s: there is no controller manager in ROS '
    )
    lines = [line.partition(': ')[2] for line in capfd.readouterr().err.splitlines()]
    waiting = f'waiting for service {service} to become available...'
    assert lines[0] == waiting
    assert lines[1].startswith(f'Could not contact service {service}: there is no controller man')
    assert lines[2] == waiting


def test_a_name_that_is_none_is_told(seeker):
    with pytest.raises(Exception, match='failed to resolve name: ') as error, argument_errors():
        ManagerClient(seeker, 'a b')
    assert '\n' not in str(error.value)
