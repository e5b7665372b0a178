# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What callbacks raise is logged, requests are answered, and the node serves on."""

import json

from nav2_msgs.srv import LoadMap
import pytest
from rcl_interfaces.msg import Parameter as ParameterMessage, ParameterValue, SetParametersResult
from rcl_interfaces.srv import GetParameterTypes, SetParameters, SetParametersAtomically
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from simulation_interfaces.srv import SpawnEntity
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger
from support.ros_processes import PATIENCE

from amr_description.errors import CallbackError
from amr_description.ros import firewall
from amr_description.ros.firewall import Firewall, guard, MOST_A_SECOND, refuse, REPEAT_PERIOD
from amr_description.ros.rclpy_internals import mend_parameter_services
from amr_description.ros.runtime import ExecutorThread, spinning
from amr_description.ros.service_calls import wait_until
from amr_description.ros.subscription_thread import SubscriptionThread

EXECUTORS = [EventsExecutor, SingleThreadedExecutor]


def stumble(*_):
    raise ValueError('what nobody\nthought of')


async def stumble_later(*_):
    raise ValueError('what nobody\nthought of')


class Clock:
    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


class Lines(list):
    __call__ = list.append


@pytest.fixture
def lines():
    return Lines()


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def guarding(clock):
    return Firewall(clock)


def catch(guarding, lines, raise_=stumble, what='the callback of /scan'):
    try:
        raise_()
    except ValueError as error:
        guarding.caught(error, what, lines)


def test_the_first_has_its_place_and_traceback_and_the_next_ones_are_counted(
    guarding, clock, lines
):
    line = stumble.__code__.co_firstlineno + 1
    for _ in range(8):
        catch(guarding, lines)
        clock.now += 1.0
    (first,) = lines
    assert first.splitlines()[0] == (
        'the callback of /scan has raised ValueError: what nobody thought of '
        f'(test_firewall.py:{line}); the node serves on'
    )
    assert first.splitlines()[1] == 'Traceback (most recent call last):'
    clock.now = REPEAT_PERIOD
    catch(guarding, lines)
    assert lines[1] == (
        'the callback of /scan has raised 8 times more, the last: '
        f'ValueError: what nobody thought of (test_firewall.py:{line})'
    )
    catch(guarding, lines)
    assert len(lines) == 2


def test_what_a_library_raises_has_its_place_there(guarding, lines):
    with pytest.raises(ValueError, match='Expecting property name') as raised:
        json.loads('{')
    raised.value.__traceback__ = raised.value.__traceback__.tb_next  # as if rclpy had called it
    guarding.caught(raised.value, 'the callback of /clock', lines)
    assert '(decoder.py:' in lines[0].splitlines()[0]


def test_another_place_or_another_topic_is_told_by_itself(guarding, lines):
    def elsewhere():
        raise ValueError('here')

    catch(guarding, lines)
    catch(guarding, lines, elsewhere)
    catch(guarding, lines, what='the callback of /map')
    assert [each.count('Traceback') for each in lines] == [1, 1, 1]


def test_more_than_many_a_second_are_the_end_with_one_line(guarding, clock, lines):
    for _ in range(MOST_A_SECOND):
        catch(guarding, lines)
    with pytest.raises(CallbackError, match=r'^callbacks have raised more than 100 times within'):
        catch(guarding, lines)


def test_as_many_in_a_longer_time_are_none(guarding, clock, lines):
    for _ in range(3 * MOST_A_SECOND):
        catch(guarding, lines)
        clock.now += 1.01 / MOST_A_SECOND


# --- nodes ------------------------------------------------------------------------------------


@pytest.fixture
def client(monkeypatch):
    monkeypatch.setattr(firewall, 'FIREWALL', Firewall())
    mend_parameter_services()
    rclpy.init(args=[])
    node = Node('client')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def until(node, condition):
    assert wait_until(node, lambda: condition() or None, every=0.02, timeout=PATIENCE)


def ask(node, service_type, name, request=None):
    """Return the answer; nobody may be asked twice, as the second answer would do, too."""
    asking = node.create_client(service_type, name)
    until(node, asking.service_is_ready)
    future = asking.call_async(service_type.Request() if request is None else request)
    until(node, future.done)
    return future.result()


class Guest(Node):
    """Raises wherever it is called, but for the service ``works``."""

    def __init__(self, *, is_late=False):
        super().__init__('guest', allow_undeclared_parameters=True)
        self.raised = 0
        self.threads = SubscriptionThread(self, stumble)
        if not is_late:
            self.equip()
        guard(self)
        if is_late:
            self.equip()

    def equip(self):
        self.create_subscription(String, 'words', self.on_word, 10)
        self.create_subscription(String, 'told', self.on_told, 10)
        self.threads.subscribe(String, 'apart', self.on_told, 10)
        self.timer = self.create_timer(0.01, self.on_time)
        self.create_service(Trigger, 'fails', stumble)
        self.create_service(Trigger, 'works', self.works)

    def on_word(self, message):
        self.raised += 1
        raise ValueError(message.data)

    def on_told(self, message, info):
        self.raised += 1
        raise ValueError(f'{message.data} {info["publication_sequence_number"]}')

    def on_time(self):
        self.timer.cancel()
        raise ValueError('late')

    def works(self, _, response):
        response.success = True
        return response

    def destroy_node(self):
        self.threads.end()
        super().destroy_node()


@pytest.mark.parametrize('is_late', [False, True], ids=['has', 'will have'])
@pytest.mark.parametrize('executor', EXECUTORS)
def test_a_node_whose_callbacks_raise_serves_on(client, capfd, executor, is_late):
    guest = Guest(is_late=is_late)
    guest.threads.start()
    with spinning(guest, executor=executor):
        # EventsExecutor of rclpy 7.1.6 raises SystemError for a callback with two parameters, and
        # takes messages from a SubscriptionThread.
        others = ['told', 'apart'] if executor is SingleThreadedExecutor else []
        for topic in ['words', *others]:
            publisher = client.create_publisher(String, topic, 10)
            until(client, publisher.get_subscription_count)
            count = guest.raised
            for _ in range(2):
                publisher.publish(String(data='hostile'))
            until(client, lambda count=count: guest.raised == count + 2)
        refused = ask(client, Trigger, 'fails')
        assert not refused.success
        assert refused.message.startswith('ValueError: what nobody thought of (test_firewall.py:')
        assert ask(client, Trigger, 'works').success
        until(client, guest.timer.is_canceled)
    said = capfd.readouterr().err
    for topic in others:
        assert f'the callback of /{topic} has raised ValueError: hostile 1 (test_fire' in said
    for what in (
        'the callback of /words has raised ValueError: hostile (test_firewall.py:',
        'the callback of a timer has raised ValueError: late (test_firewall.py:',
        'the service /fails has raised ValueError: what nobody thought of (test_firewall.py:',
    ):
        assert said.count(what) == 1, what
    assert 'FATAL' not in said


def test_a_coroutine_is_answered_for_too_and_a_task_ends_nothing(client, capfd):
    guest = Node('guest')
    guard(guest)
    guest.create_service(SetBool, 'fails', stumble_later)
    failures = []
    thread = ExecutorThread('robot', lambda: failures.append('ended'))
    thread.executor.add_node(guest)
    thread.start()
    thread.executor.create_task(stumble)
    assert 'nobody thought of' in ask(client, SetBool, 'fails').message
    assert 'nobody thought of' in ask(client, SetBool, 'fails').message
    thread.end()
    thread.executor.shutdown()
    guest.destroy_node()
    assert not failures
    assert 'a callback has raised ValueError' in capfd.readouterr().err


def test_a_robot_whose_callbacks_raise_all_the_time_is_ended_with_one_line(client, capfd):
    failures = []
    thread = ExecutorThread('robot', lambda: failures.append('ended'))
    thread.start()
    for _ in range(MOST_A_SECOND + 1):
        thread.executor.create_task(stumble)
    until(client, lambda: failures)
    thread.end()
    thread.executor.shutdown()
    said = capfd.readouterr().err
    assert 'callbacks have raised more than 100 times within a second' in said
    assert said.count('Traceback') == 1, 'that of the first'


def test_a_response_says_why_as_far_as_it_can():
    assert refuse(Trigger.Response(success=False), 'why').message == 'why'
    spawned = refuse(SpawnEntity.Response(), 'why').result
    assert (spawned.result, spawned.error_message) == (spawned.RESULT_OPERATION_FAILED, 'why')
    assert refuse(LoadMap.Response(), 'why').result == LoadMap.Response.RESULT_UNDEFINED_FAILURE
    atomically = refuse(SetParametersAtomically.Response(), 'why').result
    assert atomically == SetParametersResult(successful=False, reason='why')
    assert refuse(GetParameterTypes.Response(), 'why') == GetParameterTypes.Response()


# --- parameters -------------------------------------------------------------------------------


def value(name, kind, **fields):
    return ParameterMessage(name=name, value=ParameterValue(type=kind, **fields))


@pytest.fixture(params=[True, False], ids=['undeclared allowed', 'declared only'])
def parameters(client, request):
    guest = Node('guest', allow_undeclared_parameters=request.param)
    guest.declare_parameter('speed', 1.0)
    guest.allows = request.param
    with spinning(guest):
        yield guest


def test_the_type_of_what_is_not_declared_is_0(client, parameters):
    request = GetParameterTypes.Request(names=['speed', 'nope', ''])
    types = ask(client, GetParameterTypes, 'guest/get_parameter_types', request).types
    # rclcpp answers with nothing where undeclared parameters are refused
    assert list(types) == ([3, 0, 0] if parameters.allows else [])


@pytest.mark.parametrize('kind', [77, 10, 255])
def test_a_value_of_no_type_is_refused_and_those_beside_it_are_set(client, parameters, kind):
    given = [value('speed', kind), value('speed', 3, double_value=2.0)]
    request = SetParameters.Request(parameters=given)
    bad, good = ask(client, SetParameters, 'guest/set_parameters', request).results
    assert not bad.successful
    assert bad.reason == f"'speed': a value is of type 0 to 9, not {kind}"
    assert good.successful
    assert parameters.get_parameter('speed').value == 2.0


def test_all_of_them_are_refused_together(client, parameters):
    given = [value('speed', 3, double_value=2.0), value('speed', 77)]
    request = SetParametersAtomically.Request(parameters=given)
    name = 'guest/set_parameters_atomically'
    assert not ask(client, SetParametersAtomically, name, request).result.successful
    assert parameters.get_parameter('speed').value == 1.0


@pytest.mark.parametrize('name', ['', 'a b', '/', 'x' * 10_000, 'speed'])
@pytest.mark.parametrize('kind', range(10))
def test_whatever_is_set_is_answered(client, parameters, name, kind):
    request = SetParameters.Request(parameters=[value(name, kind)])
    assert len(ask(client, SetParameters, 'guest/set_parameters', request).results) == 1


def test_what_a_callback_of_the_node_raises_is_the_reason(client, parameters):
    parameters.add_on_set_parameters_callback(stumble)
    request = SetParameters.Request(parameters=[value('speed', 3, double_value=2.0)])
    (result,) = ask(client, SetParameters, 'guest/set_parameters', request).results
    assert (result.successful, result.reason) == (False, 'what nobody thought of')
