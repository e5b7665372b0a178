# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Requests to services of nodes that discover their client late, or never answer."""

from types import SimpleNamespace

import pytest
from rcl_interfaces.msg import ListParametersResult
from rcl_interfaces.srv import ListParameters, SetParameters
from rclpy.task import Future

from amr_description.cli import service_calls
from amr_description.cli.param import requests
from amr_description.ros.wait_clock import WaitClock

ROUNDS = 20
"""How often a condition is looked at before the time is over."""


class Client:
    """Of a server that throws the first ``lost`` responses away."""

    def __init__(self, lost):
        self.lost = lost
        self.sent = 0

    def service_is_ready(self):
        return True

    def call_async(self, _request):
        self.sent += 1
        future = Future()
        if self.sent > self.lost:
            names = ListParametersResult(names=['b', 'a'])
            future.set_result(ListParameters.Response(result=names))
        return future


class Session:
    """Without a graph: nodes by their names, each with how many responses it loses."""

    def __init__(self, **lost):
        self.clients = {f'/{name}/list_parameters': Client(count) for name, count in lost.items()}
        self.node = SimpleNamespace(
            create_client=lambda _type, name, **_: self.clients[name],
            destroy_client=lambda _: None,
        )
        self.clock = WaitClock()

    def spin(self, until, timeout):
        return any(until() for _ in range(ROUNDS))

    def sent(self, node):
        return self.clients[f'/{node}/list_parameters'].sent


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    monkeypatch.setattr(service_calls, '_REPEAT_PERIOD', 0.0)


def test_a_response_that_was_thrown_away_is_asked_for_again():
    session = Session(late=2, there=0)
    assert requests.list_all(session, ['/late', '/there']) == {
        '/late': ['a', 'b'],
        '/there': ['a', 'b'],
    }
    assert (session.sent('late'), session.sent('there')) == (3, 1)


def test_a_node_that_never_answers_is_left_out():
    session = Session(mute=1000, there=0)
    assert requests.list_all(session, ['/mute', '/there']) == {'/there': ['a', 'b']}


def test_what_changes_something_is_sent_once():
    session = Session(mute=1000)
    client = session.clients.pop('/mute/list_parameters')
    session.clients['/mute/set_parameters'] = client
    asked = {'/mute': SetParameters.Request()}
    assert requests.ask_all(session, 'set_parameters', SetParameters, asked, changes=True) == {}
    assert client.sent == 1


@pytest.mark.parametrize(
    ('changes', 'sent', 'answered'), [(False, (3, 1), 'late there'), (True, (1, 1), 'there')]
)
def test_services_of_several_nodes_are_asked_again_unless_that_changes_something(
    changes, sent, answered
):
    session = Session(late=2, there=0)
    asked = dict.fromkeys(session.clients, ListParameters.Request())
    found = service_calls.responses(session, ListParameters, asked, 1.0, changes=changes)
    assert sorted(found) == [f'/{name}/list_parameters' for name in answered.split()]
    assert (session.sent('late'), session.sent('there')) == sent
