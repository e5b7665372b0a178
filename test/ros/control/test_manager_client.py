# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a program hears of a controller manager that answers badly, or not at all."""

from controller_manager_msgs.srv import ListControllers, SwitchController
import pytest
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParameters
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from rosgraph_msgs.msg import Clock
from support.manager_host import ros_in_this_process
from support.ros_processes import PATIENCE
from support.serving import serving

from amr_description.control.ros import absence_diagnosis
from amr_description.control.ros.client import ManagerClient
from amr_description.errors import ControllerError, NoAnswerError
from amr_description.ros.service_calls import wait_until

TIMED_OUT = 'Switch controller timed out after 5 seconds!'


class Manager(Node):
    """Answers nothing while ``silent``, switches never, and takes no parameter."""

    def __init__(self):
        super().__init__('controller_manager', allow_undeclared_parameters=True)
        self.silent = False
        self.switches, self.asked = [], []
        group = ReentrantCallbackGroup()
        for service_type, name, serve in (
            (ListControllers, '~/list_controllers', self.list_controllers),
            (SwitchController, '~/switch_controller', self.switch_controller),
        ):
            self.create_service(service_type, name, serve, callback_group=group)
        self.add_on_set_parameters_callback(
            lambda _: SetParametersResult(successful=False, reason='it is full')
        )
        self.clock = self.create_publisher(Clock, '/clock', 10)

    async def list_controllers(self, _, response):
        self.asked.append('list')
        if self.silent:
            await Future()
        return response

    async def switch_controller(self, request, response):
        self.switches.append(request)
        self.asked.append('switch')
        if self.silent:
            await Future()
        response.message = TIMED_OUT
        return response


@pytest.fixture(scope='module')
def manager():
    with ros_in_this_process():
        node, executor = Manager(), SingleThreadedExecutor()
        node.create_timer(0.01, lambda: node.clock.publish(Clock()))
        executor.add_node(node)
        with serving(executor):
            yield node
        node.destroy_node()


@pytest.fixture
def client(manager, monkeypatch):
    """Made while the manager answers."""
    monkeypatch.setattr(absence_diagnosis, '_CLOCK_TIMEOUT', 1.0)
    monkeypatch.setattr(manager, 'switches', [])
    node = Node('asker')
    soon = (SwitchController, SetParameters)
    yield ManagerClient(node, 'controller_manager', call_timeout=0.5, soon=soon)
    node.destroy_node()


@pytest.fixture
def silence(manager, client, monkeypatch):
    monkeypatch.setattr(manager, 'silent', True)


def test_a_manager_that_does_not_answer_is_asked_once_and_its_clock_is_looked_at(
    manager, client, silence
):
    with pytest.raises(NoAnswerError) as error:
        client.switch(activate=['a'], timeout=0.1)
    service, clock = str(error.value).split('. ')
    assert service == (
        'Could not successfully call service /controller_manager/switch_controller after 3 '
        'attempts'
    )
    assert clock.startswith('/clock stands still at 0.000 s: is the simulation paused?')
    assert len(manager.switches) == 1


def test_what_changes_nothing_is_waited_for_too(client, silence):
    with pytest.raises(NoAnswerError, match='/list_controllers after 3 attempts'):
        client.states()


def test_a_switch_that_timed_out_is_explained_by_the_clock(client):
    assert client.switch(activate=['a'], timeout=0.1) == (
        f'{TIMED_OUT}; /clock stands still at 0.000 s: is the simulation paused?'
    )


def test_a_switch_has_the_time_that_was_asked_for(manager, client):
    client.request_switch(['a'], ['b'], 1, timeout=2.5, activate_asap=False)
    (request,) = manager.switches
    assert (request.activate_controllers, request.deactivate_controllers) == (['a'], ['b'])
    assert (request.strictness, request.activate_asap) == (1, False)
    assert (request.timeout.sec, request.timeout.nanosec) == (2, 500_000_000)


def test_a_parameter_that_is_refused_is_told(client):
    with pytest.raises(ControllerError) as error:
        client.set_parameters('arm', {'type': 'a/Type'})
    assert str(error.value) == (
        'Could not set controller param "type" to "a/Type" for arm: /controller_manager refuses '
        'it: it is full'
    )
    assert not client.has_type('arm')


def test_a_manager_that_never_answers_keeps_nobody(manager, monkeypatch):
    monkeypatch.setattr(manager, 'silent', True)
    monkeypatch.setattr(absence_diagnosis, '_CLOCK_TIMEOUT', 1.0)
    node = Node('hopeful')
    with pytest.raises(NoAnswerError, match='after 3 attempts'):
        ManagerClient(node, '/controller_manager', call_timeout=0.1)
    node.destroy_node()


def test_an_answer_is_kept_until_it_is_taken_though_others_are_answered_meanwhile(client):
    """As where this process waits for a processor."""
    node = Node('other')
    other = ManagerClient(node, 'controller_manager')
    answer = client._client(SwitchController).call_async(SwitchController.Request())
    for _ in range(20):
        other.request_switch(['a'], [], 1)
    assert wait_until(client._node, lambda: answer.done() or None, timeout=PATIENCE)
    node.destroy_node()


def test_its_clients_are_made_once_and_those_that_are_needed_soon_before_the_first(manager):
    node = Node('ready')
    try:
        services = (SwitchController, SetParameters)
        client = ManagerClient(node, 'controller_manager', soon=services)
        made = [each.srv_type for each in node.clients]
        assert made == [*services, ListControllers]
        client.switch(activate=['a'], timeout=0.1)
        client.states()
        assert [each.srv_type for each in node.clients if each.srv_type in made] == made
        client.close()
        assert not {each.srv_type for each in node.clients} & {*made}
    finally:
        node.destroy_node()


def test_a_client_that_the_manager_may_not_know_asks_for_a_list_before_its_first_call(
    manager, monkeypatch
):
    order = []
    monkeypatch.setattr(manager, 'asked', order)
    node = Node('late')
    try:
        client = ManagerClient(node, 'controller_manager')
        del order[:]
        for _ in range(2):
            client.switch(activate=['a'], timeout=0.1)
        first = order.index('switch')
        assert first > 0
        assert {*order[:first]} == {'list'}  # more than one, if an answer is lost
        assert order[first:] == ['switch', 'switch']
        kinds = [each.srv_type for each in node.clients]
        assert kinds.count(ListControllers) == 1  # the one that only asked is gone
    finally:
        node.destroy_node()
