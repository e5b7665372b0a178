# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Services that pages call by forms, and goals that they send: answered, followed, refused."""

import asyncio

from example_interfaces.action import Fibonacci
import pytest
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import SetBool
from support.ros_processes import PATIENCE
from support.serving import serving

from amr_description.errors import AmrError
from amr_description.viewer.forms import CallInfo, CallService, CancelSent, SendGoal
from amr_description.viewer.requests import Definition
from amr_description.viewer.ros import calls
from amr_description.viewer.ros.calls import FormCalls
from amr_description.viewer.ros.forms import define
from amr_description.viewer.ros.topic_list import list_services

SET_IT, COUNT = '/arm/set_it', '/arm/count'
SERVICE, ACTION = 'std_srvs/srv/SetBool', 'example_interfaces/action/Fibonacci'


class Host:
    """A node with a service and an action that ends when it is told, and the viewer's."""

    def __init__(self):
        self.context = Context()
        self.context.init([])
        self.viewer, self.node = (
            Node(name, context=self.context, start_parameter_services=False)
            for name in ('viewer', 'host')
        )
        self.executor = SingleThreadedExecutor(context=self.context)
        for each in (self.viewer, self.node):
            self.executor.add_node(each)
        self.handles, self.asked = [], []
        self.accepts = True
        self.ends = Future(executor=self.executor)
        self.node.create_service(SetBool, SET_IT, self._set_it)
        self.action = ActionServer(
            self.node,
            Fibonacci,
            COUNT,
            self._count,
            goal_callback=lambda _: GoalResponse.ACCEPT if self.accepts else GoalResponse.REJECT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def _set_it(self, request, response):
        self.asked.append(request.data)
        response.success, response.message = request.data, 'as asked'
        return response

    async def _count(self, handle):
        self.handles.append(handle)
        for length in range(1, 4):
            handle.publish_feedback(Fibonacci.Feedback(sequence=[0] * length))
        await self.ends
        handle.canceled() if handle.is_cancel_requested else handle.succeed()
        return Fibonacci.Result(sequence=[0, 1, 1])

    def end_action(self):
        """End the action, as destroy_node does not."""
        action, self.action = self.action, None
        if action is not None:
            action.destroy()

    def close(self):
        self.end_action()
        for each in (self.viewer, self.node):
            each.destroy_node()
        self.context.try_shutdown()


@pytest.fixture
def host():
    host = Host()
    with serving(host.executor):
        yield host
        host.executor.create_task(host.ends.set_result, None)
    host.close()


class Page:
    """Asks by forms; on the loop that runs."""

    def __init__(self, host):
        self.told, self.is_held = [], False
        loop = asyncio.get_running_loop()
        self.calls = FormCalls(
            host.viewer,
            host.executor,
            lambda action: f'STOP holds {action}' if self.is_held else None,
            lambda: 0,
            lambda page, progress: self.told.append((page, progress)),
            lambda call: loop.is_closed() or loop.call_soon_threadsafe(call),
        )

    async def send(self, page='page 1', values=()):
        return await self.calls.send_goal(SendGoal(7, COUNT, ACTION, dict(values)), page)

    async def is_told(self, state):
        return await come(
            lambda: self.told and self.told[-1][1].state == state and self.told[-1][1]
        )


async def come(condition):
    async with asyncio.timeout(PATIENCE):
        while not (found := condition()):
            await asyncio.sleep(0.005)
    return found


async def call(host, values, service=SET_IT, kind=SERVICE):
    return await Page(host).calls.call_service(CallService(1, service, kind, values), 'page 1')


def test_a_service_answers_with_its_response(host):
    answer = asyncio.run(call(host, {'data': True}))
    assert answer.message.startswith('/arm/set_it answered within 0.')
    assert answer.data == 'success: true\nmessage: as asked\n'
    assert host.asked == [True]
    listed = list_services(host.viewer).services
    assert tuple(each for each in listed if each.name.startswith('/arm/')) == (
        CallInfo(COUNT, ACTION, is_action=True),
        CallInfo(SET_IT, SERVICE, is_action=False),
    )


@pytest.mark.parametrize(
    ('asked', 'reason'),
    [
        ({'values': {'data': 'perhaps'}}, "'perhaps' is neither true nor false"),
        ({'values': {'datum': True}}, "has no attribute 'datum'; it has data"),
        ({'kind': 'std_srvs/srv/SetBol'}, 'did you mean SetBool'),
        ({'kind': 'std_srvs/msg/SetBool'}, 'is written as a message'),
        ({'service': 'no name'}, 'InvalidServiceNameException'),
        ({'service': '/nobody'}, 'service /nobody is not there after'),
    ],
)
def test_what_cannot_be_called_is_refused_in_one_line(host, asked, reason, monkeypatch):
    monkeypatch.setattr('amr_description.viewer.ros.service_clients._READY_TIMEOUT', 0.1)
    with pytest.raises(AmrError, match=reason) as refused:
        asyncio.run(call(host, **{'values': {}} | asked))
    assert '\n' not in str(refused.value)
    assert host.asked == []


def test_a_goal_is_followed_by_its_page_to_the_result(host):
    async def use():
        page = Page(host)
        assert await page.send(values={'order': 3}) == '/arm/count has accepted the goal'
        await page.is_told('active')
        host.executor.create_task(host.ends.set_result, None)
        return page, await page.is_told('succeeded')

    page, last = asyncio.run(use())
    assert host.handles[0].request.order == 3
    assert {name for name, _ in page.told} == {'page 1'}
    assert last.text == 'sequence:\n- 0\n- 1\n- 1\n'
    assert [each.goal for _, each in page.told] == [7] * len(page.told)


@pytest.mark.parametrize(
    ('end', 'reason'),
    [('cancel', ''), ('stop', '# STOP was pressed\n'), ('gone', '# page 1 has gone\n')],
)
def test_a_goal_ends_by_its_page_by_stop_and_with_its_page(host, end, reason):
    async def use():
        page = Page(host)
        await page.send()
        await come(lambda: host.handles)
        if end == 'cancel':
            with pytest.raises(AmrError, match='has ended already'):
                await page.calls.cancel(CancelSent(1, 8), 'page 1')
            said = await page.calls.cancel(CancelSent(1, 7), 'page 1')
            assert said == '/arm/count cancels the goal'
        elif end == 'stop':
            page.calls.stop()
            page.is_held = True
            page.calls.stop()
        else:
            page.calls.forget('page 2')
            page.calls.forget('page 1')
        await come(lambda: host.handles[0].is_cancel_requested)
        host.executor.create_task(host.ends.set_result, None)
        return await page.is_told('canceled')

    assert asyncio.run(use()).text == f'{reason}sequence:\n- 0\n- 1\n- 1\n'


def test_no_goal_is_sent_to_who_is_stopped_nor_when_its_page_has_gone(host):
    async def use():
        page = Page(host)
        asked = asyncio.create_task(page.send())
        await asyncio.sleep(0)  # it waits for its client
        page.calls.forget('page 1')
        with pytest.raises(AmrError, match='page 1 has gone: no goal was sent'):
            await asked
        page.is_held = True
        with pytest.raises(AmrError, match='STOP holds /arm/count'):
            await page.send()
        page.is_held = host.accepts = False
        kept = len([*host.viewer.waitables])
        with pytest.raises(AmrError, match='/arm/count refuses the goal; its log says why'):
            await page.send()
        await come(lambda: len([*host.viewer.waitables]) == kept)

    asyncio.run(use())
    assert host.handles == []


def test_a_goal_is_lost_with_its_server(host, monkeypatch):
    monkeypatch.setattr(calls, '_LOOK_PERIOD', 0.05)

    async def use():
        page = Page(host)
        await page.send()
        host.executor.create_task(host.end_action)
        return await page.is_told('lost')

    assert asyncio.run(use()).text == '/arm/count has gone'


def fields_of(kind):
    return {each.name: each for each in asyncio.run(define(Definition(1, kind), 'page 1')).data}


def test_forms_have_the_constants_of_what_is_sent():
    state = fields_of('simulation_interfaces/srv/SetSimulationState')['state'].fields[0]
    assert (state.name, state.value, state.constants['STATE_PAUSED']) == ('state', 0, 2)
    marker = fields_of('visualization_msgs/msg/Marker')
    assert marker['type'].constants['SPHERE'] == 2, 'they name no field: each number may be one'
    assert marker['ns'].constants == {}
    assert fields_of(ACTION)['order'].value == 0
    assert fields_of('std_srvs/srv/Trigger') == {}
