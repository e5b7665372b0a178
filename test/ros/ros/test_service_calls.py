# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Calls of services that are slow, silent or not there."""

from contextlib import ExitStack
from random import Random
import time

from example_interfaces.action import Fibonacci
import pytest
import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger
from support.manager_host import ros_in_this_process
from support.ros_processes import PATIENCE
from support.serving import serving
from support.waiting import until
from tf2_msgs.action import LookupTransform

from amr_description.errors import NoAnswerError
from amr_description.ros import service_calls
from amr_description.ros.service_calls import (
    ActionReadiness,
    ask_until_answered,
    call,
    call_with,
    ServiceReadiness,
    wait_until,
)


class Server(Node):
    """Answers the first request when it is told to, and no other."""

    def __init__(self):
        super().__init__('server')
        self.requests = 0
        self.answer = Future()
        self.leaves = False
        group = ReentrantCallbackGroup()
        self.service = self.create_service(Trigger, 'slow', self.serve, callback_group=group)

    async def serve(self, _, response):
        self.requests += 1
        if self.leaves:
            self.destroy_service(self.service)
        response.message = await self.answer
        return response


class ClientOfTheDeparted:
    """Its server is there at the first looks; the response is ready some looks later."""

    srv_name = '/departed'

    def __init__(self, looks, there=2):
        self.looks = looks
        self.there = there
        self.seen_ready = 0

    def service_is_ready(self):
        self.seen_ready += 1
        return self.seen_ready <= self.there

    def call_async(self, _):
        return self

    def done(self):
        self.looks -= 1
        return self.looks < 0

    def result(self):
        return 'the last answer'


@pytest.fixture(scope='module', autouse=True)
def ros():
    with ros_in_this_process():
        yield


@pytest.fixture
def server():
    node, executor = Server(), SingleThreadedExecutor()
    executor.add_node(node)
    with serving(executor):
        yield node
    node.destroy_node()


@pytest.fixture
def caller():
    node = Node('caller')
    yield node
    node.destroy_node()


def trigger(caller, **options):
    return call(caller, Trigger, '/slow', Trigger.Request(), **options)


def test_a_silent_service_is_asked_once_and_waited_for_thrice(server, caller, capfd):
    trigger_failed = r'^Could not successfully call service /slow after 3 attempts\.$'
    with pytest.raises(NoAnswerError, match=trigger_failed):
        trigger(caller, timeout=0.2, attempts=3)
    assert server.requests == 1
    said = [line.partition(': ')[2] for line in capfd.readouterr().err.splitlines()]
    assert said == [
        f'Failed getting a result from calling /slow in 0.2. (Attempt {attempt} of 3.)'
        for attempt in (1, 2, 3)
    ]
    server.answer.set_result('late')


def test_an_answer_in_a_later_wait_is_taken(server, caller, monkeypatch):
    log = caller.get_logger()
    monkeypatch.setattr(caller, 'get_logger', lambda: Listener(log, server))
    assert trigger(caller, timeout=0.5, attempts=3).message == 'here'
    assert server.requests == 1


class Listener:
    """A logger that has the server answer at the first complaint."""

    def __init__(self, log, server):
        self.log, self.server = log, server

    def warning(self, text):
        self.log.warning(text)
        self.server.executor.create_task(self.server.answer.set_result, 'here')


def test_a_single_wait_has_words_of_its_own(server, caller):
    with pytest.raises(NoAnswerError, match=r'^service /slow has not answered within 0\.2 s$'):
        trigger(caller, timeout=0.2)
    server.answer.set_result('late')


def test_a_service_that_is_not_there_is_told(caller):
    with pytest.raises(NoAnswerError, match=r'^service /slow is not there after 0\.1 s; '):
        trigger(caller, timeout=0.1)


def test_a_server_that_goes_away_is_not_waited_for(server, caller):
    server.leaves = True
    with pytest.raises(NoAnswerError, match='^service /slow went away before it answered$'):
        trigger(caller, timeout=PATIENCE)
    server.answer.set_result('late')


def test_a_server_that_is_gone_at_the_first_look_for_its_answer_is_not_waited_for(caller):
    client = ClientOfTheDeparted(looks=10**9, there=1)
    with pytest.raises(NoAnswerError, match='^service /departed went away before it answered$'):
        call_with(caller, client, Trigger.Request(), timeout=PATIENCE)


def test_the_answer_of_a_server_that_is_gone_is_taken_behind_what_came_before_it(caller):
    client = ClientOfTheDeparted(looks=3)
    assert call_with(caller, client, Trigger.Request(), timeout=PATIENCE) == 'the last answer'


def test_a_question_is_asked_until_it_is_answered(server, caller):
    client = caller.create_client(Trigger, '/slow')
    with pytest.raises(NoAnswerError, match='after 2 attempts'):
        ask_until_answered(caller, client, Trigger.Request(), timeout=0.7, attempts=2)
    server.answer.set_result('here')
    assert ask_until_answered(caller, client, Trigger.Request()).message == 'here'


def test_a_client_that_is_never_ready_calls_what_is_in_the_graph(server, caller, monkeypatch):
    monkeypatch.setattr(service_calls, '_MATCHED_BY', 0.2)
    client = caller.create_client(Trigger, '/slow')
    monkeypatch.setattr(client, 'service_is_ready', lambda: False)
    is_ready = ServiceReadiness(caller, client)
    wait_until(caller, lambda: caller.count_services('/slow') or None, timeout=PATIENCE)
    assert not is_ready()
    server.answer.set_result('here')
    assert call_with(caller, client, Trigger.Request(), timeout=PATIENCE).message == 'here'


def test_a_client_of_an_action_that_is_never_ready_sends_goals_to_what_is_there(
    server, caller, monkeypatch
):
    monkeypatch.setattr(service_calls, '_MATCHED_BY', 0.2)
    action = ActionServer(server, Fibonacci, 'look', lambda _: Fibonacci.Result())
    client = ActionClient(caller, Fibonacci, '/look')
    wait_until(caller, lambda: client.server_is_ready() or None, timeout=PATIENCE)
    monkeypatch.setattr(client, 'server_is_ready', lambda: False)
    is_ready = ActionReadiness(caller, client, Fibonacci, '/look')
    assert not is_ready()
    assert wait_until(caller, lambda: is_ready() or None, timeout=PATIENCE)
    assert not ActionReadiness(caller, client, Fibonacci, '/hear')()
    monkeypatch.setattr(service_calls, '_MATCHED_BY', 0.0)
    assert not ActionReadiness(caller, client, LookupTransform, '/look')()
    client.destroy()
    action.destroy()


def test_a_service_of_another_type_is_not_ready(server, monkeypatch):
    monkeypatch.setattr(service_calls, '_MATCHED_BY', 0.0)
    context = Context()  # a topic has one type in a participant
    rclpy.init(args=[], context=context)
    node = Node('other', context=context)
    client = node.create_client(SetBool, '/slow')
    until(lambda: node.count_services('/slow'))
    assert not ServiceReadiness(node, client)()
    node.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize('rounds', [8, pytest.param(200, marks=pytest.mark.long)])
def test_a_server_may_go_while_another_of_its_name_comes(rounds):
    """As when a node is started anew: 1 of 7 clients is then never ready, says rmw_fastrtps."""
    random = Random(1)
    present = ExitStack()
    try:
        for _ in range(rounds):
            former, present = present, ExitStack()
            context = Context()
            rclpy.init(args=[], context=context)
            present.callback(context.try_shutdown)
            server, caller = (Node(name, context=context) for name in ('server', 'caller'))
            present.callback(server.destroy_node)
            present.callback(caller.destroy_node)
            server.create_service(Trigger, 'again', lambda _, response: response)
            client = caller.create_client(Trigger, 'again')
            time.sleep(0.03 * random.random())  # between the two discoveries, or after them
            former.close()
            executors = [SingleThreadedExecutor(context=context) for _ in range(2)]
            for executor, node in zip(executors, (server, caller), strict=True):
                executor.add_node(node)
                present.callback(executor.shutdown)
            with serving(executors[0]):
                assert call_with(caller, client, Trigger.Request(), timeout=PATIENCE)
    finally:
        present.close()
