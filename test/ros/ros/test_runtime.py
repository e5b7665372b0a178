# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How programs start and end: exit codes, signals, the lifeline, one line for what went wrong."""

import os
import re
import signal
import sys
import threading

import pytest
import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Empty, String
from support.running_programs import PATIENCE, Program

from amr_description.errors import ParameterError, UsageError
from amr_description.ros.runtime import (
    argument_errors,
    await_executor,
    end_wait,
    ExecutorThread,
    program,
    ros,
    run,
    spin,
    spinning,
)
from amr_description.ros.service_calls import wait_until
from amr_description.ros.signals import StopRequests

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]

NODE = """
import sys
from amr_description.ros.runtime import run
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Fixture(Node):
    def __init__(self):
        super().__init__('fixture')
        self.publisher = self.create_publisher(String, 'farewell', 10)
        self.create_timer(0.01, self.say_up)

    def say_up(self):
        print('up for', self.publisher.get_subscription_count())

    def destroy_node(self):
        self.publisher.publish(String(data='bye'))
        self.publisher.wait_for_all_acked()
        super().destroy_node()

sys.exit(run(Fixture, sys.argv[2:], executor=globals()[sys.argv[1]]))
"""

OWN_LOOP = """
import sys, threading
import rclpy
from amr_description.ros.runtime import program, ros

def body():
    with ros([]) as stop:
        node = rclpy.create_node('fixture')
        node.create_timer(0.01, lambda: print('up'))
        {wait}

sys.exit(program(body))
"""

# No ROS in it, so it is quick: what a request does by where the program is.
PHASES = """
import os, signal, sys, threading
from amr_description.ros.signals import StopRequested, StopRequests

def say(*words):  # a line at a time, from any thread
    os.write(1, (' '.join(words) + os.linesep).encode())

def wait():  # in turns: the handler of a signal just before a call that blocks runs after it
    while not threading.Event().wait(0.05):
        pass

try:
    with StopRequests(wake=lambda: say('woken')) as stop:
        {body}
except StopRequested as request:
    say('raised', request.signum.name)
say('asked by', stop.signum.name)
"""


@pytest.fixture
def context():
    rclpy.init(args=[])
    yield
    rclpy.try_shutdown()


@pytest.fixture
def listener(context):
    node = Node('listener')
    yield node
    node.destroy_node()


@pytest.mark.parametrize(
    ('executor', 'signum'),
    [
        ('EventsExecutor', signal.SIGINT),
        ('EventsExecutor', signal.SIGTERM),
        ('EventsExecutor', signal.SIGHUP),
        ('SingleThreadedExecutor', signal.SIGTERM),
    ],
)
def test_a_node_ends_on_each_signal_with_0_and_without_a_word(signum, executor):
    with Program.of(NODE, executor) as node:
        node.expect('up')
        assert node.end(signum) == 0
        assert set(node.lines) == {'up for 0'}


def test_a_node_can_still_publish_when_it_is_asked_to_stop(listener):
    heard = []
    listener.create_subscription(String, 'farewell', heard.append, 10)
    with Program.of(NODE, 'EventsExecutor') as node:
        node.expect('up for 1')
        node.signal(signal.SIGTERM)
        assert wait_until(
            listener, lambda: heard or None, lambda: None, every=60.0, timeout=20.0
        ) == [String(data='bye')]


@pytest.mark.parametrize(
    ('signum', 'wait'),
    [
        (signal.SIGINT, 'rclpy.spin(node)'),
        (signal.SIGTERM, 'rclpy.spin_until_future_complete(node, rclpy.Future())'),
        (signal.SIGHUP, "print('up')\n        while not threading.Event().wait(0.05): pass"),
    ],
)
def test_a_program_is_interrupted_wherever_it_waits(signum, wait):
    with Program.of(OWN_LOOP.format(wait=wait)) as waiting:
        waiting.expect('up')
        assert waiting.end(signum) == 128 + signum
        assert set(waiting.lines) == {'up'}


@pytest.mark.parametrize(
    ('args', 'words'),
    [
        (['-p', 'x'], "Couldn't parse parameter override rule: '-p x'"),
        (['-r', 'foo'], "Couldn't parse remap rule: '-r foo'"),
        (['--params-file', '/nope.yaml'], "Couldn't parse params file: .*/nope.yaml"),
        (['--nonsense'], "unknown ROS arguments .'--nonsense'.: between --ros-args and --"),
        (['-p', 'use_sim_time:=5'], "Trying to set parameter 'use_sim_time' to '5' of type"),
    ],
)
def test_wrong_ros_arguments_are_one_line_and_exit_1(args, words, capfd):
    assert run(lambda: Node('fixture'), ['--ros-args', *args]) == 1
    error = capfd.readouterr().err
    assert re.search(words, error)
    assert error.count('[FATAL]') == 1
    assert 'Traceback' not in error
    assert '/project/src' not in re.sub(r'\[ERROR\].*', '', error)


@pytest.mark.parametrize('domain', ['233', 'abc', '-1'])
def test_a_number_that_is_no_domain_is_one_line_and_exit_1(domain, monkeypatch, capfd):
    monkeypatch.setenv('ROS_DOMAIN_ID', domain)
    assert run(lambda: Node('fixture'), []) == 1
    said = capfd.readouterr().err
    assert said.count('\n') == 1
    assert f'ROS_DOMAIN_ID={domain}: a ROS domain is an integer from 0 to 232' in said


def test_names_that_ros_refuses_are_argument_errors(context):
    with pytest.raises(ParameterError, match='Invalid node name'), argument_errors():
        Node('not a name')


def test_an_error_on_purpose_is_one_fatal_line_and_its_exit_code(capfd):
    def body():
        raise UsageError('what was asked, what would do')

    assert program(body) == 2
    error = capfd.readouterr().err
    assert re.fullmatch(r'\[FATAL\] \[[\d.]+\] \[.+\]: what was asked, what would do\n', error)


@pytest.mark.parametrize(('returned', 'code'), [(None, 0), (0, 0), (3, 3)])
def test_a_program_exits_with_what_its_body_returns(returned, code):
    assert program(lambda: returned) == code


def test_a_callback_that_raises_again_and_again_ends_the_node_in_order(capfd):
    destroyed = []

    class Faulty(Node):
        def __init__(self):
            super().__init__('faulty')
            self.create_timer(0.001, self.fail)

        def fail(self):
            raise ZeroDivisionError('a bug')

        def destroy_node(self):
            destroyed.append(self)
            super().destroy_node()

    assert run(Faulty, []) == 1
    assert destroyed
    said = capfd.readouterr().err
    assert 'callbacks have raised more than 100 times within a second, the last: ' in said
    assert said.count('Traceback') == 1
    assert not rclpy.ok()


def test_the_context_is_shut_down_in_every_way_out():
    with ros([]):
        assert rclpy.ok()
    assert not rclpy.ok()
    with pytest.raises(LookupError, match='mine'), ros([]):
        raise LookupError('mine')
    assert not rclpy.ok()


@pytest.mark.parametrize('make_executor', [EventsExecutor, SingleThreadedExecutor])
def test_spin_ends_when_the_context_is_shut_down(listener, make_executor):
    listener.create_timer(0.01, rclpy.try_shutdown)
    executor = make_executor()
    executor.add_node(listener)
    spin(executor, until=lambda: False)
    assert not rclpy.ok()
    executor.shutdown()


@pytest.mark.parametrize('make_executor', [EventsExecutor, SingleThreadedExecutor])
def test_spin_ends_when_its_condition_is_true(listener, make_executor):
    ticks = []
    listener.create_timer(0.01, lambda: ticks.append(1))
    executor = make_executor()
    executor.add_node(listener)
    spin(executor, until=lambda: len(ticks) >= 3)
    assert rclpy.ok()
    executor.shutdown()


@pytest.mark.parametrize('make_executor', [EventsExecutor, SingleThreadedExecutor])
def test_a_wait_of_an_executor_is_ended_from_another_thread(listener, make_executor):
    executor = make_executor()
    executor.add_node(listener)
    threading.Timer(0.05, end_wait, [executor]).start()
    waiter = threading.Thread(
        target=executor.spin_once, kwargs={'timeout_sec': 10 * PATIENCE}, daemon=True
    )
    waiter.start()
    waiter.join(PATIENCE)
    assert not waiter.is_alive()
    executor.shutdown()


def test_spinning_serves_a_node_in_a_thread_and_ends_it(context):
    node = Node('served')
    served = threading.Event()
    node.create_timer(0.01, served.set)
    with spinning(node):
        assert served.wait(20.0)
        assert 'spinning' in [thread.name for thread in threading.enumerate()]
    assert 'spinning' not in [thread.name for thread in threading.enumerate()]
    with pytest.raises(InvalidHandle, match='destr'), node.handle:
        pass


def test_a_thread_serves_its_nodes_and_ends_though_a_coroutine_awaits_for_ever(listener):
    begun, ended = threading.Event(), threading.Event()

    async def wait_for_ever():
        begun.set()
        try:
            await Future()
        finally:
            ended.set()

    listener.create_timer(0.01, wait_for_ever)
    thread = ExecutorThread('served', on_failure=lambda: None)
    thread.executor.add_node(listener)
    thread.start()
    assert begun.wait(20.0)
    thread.end()
    assert ended.is_set()
    assert 'served' not in [each.name for each in threading.enumerate()]
    thread.executor.shutdown()


@pytest.mark.parametrize('executor', [EventsExecutor, SingleThreadedExecutor])
def test_a_busy_executor_has_let_go_of_a_publisher_when_it_was_awaited(context, executor):
    node = Node('talker')
    publisher = node.create_publisher(String, 'topic', 10)
    busy, destroyed = threading.Event(), threading.Event()

    def handle_event():  # as an event's callback does, which uses the publisher
        with publisher.handle:
            busy.set()
            assert destroyed.wait(PATIENCE)

    with spinning(node, executor=executor):
        await_executor(node)
        node.executor.create_task(handle_event)
        assert busy.wait(PATIENCE)
        node.destroy_publisher(publisher)
        with pytest.raises(RCLError, match='incompatible type'):
            node.create_publisher(Empty, 'topic', 10)
        destroyed.set()
        await_executor(node)
        node.create_publisher(Empty, 'topic', 10)


def test_a_thread_whose_callback_leaves_says_so(listener, capfd):
    failed = threading.Event()

    def fail():
        raise SystemExit(4)

    listener.create_timer(0.01, fail)
    thread = ExecutorThread('served', failed.set)
    thread.executor.add_node(listener)
    thread.start()
    assert failed.wait(20.0)
    thread.end()
    thread.executor.shutdown()
    assert 'SystemExit' in capfd.readouterr().err


def phases(body, **options):
    return Program.of(PHASES.format(body=body), **options)


@pytest.mark.parametrize('signum', SIGNALS)
def test_a_request_interrupts_the_program_and_wakes_it(signum):
    with phases("say('up'); wait()") as waiting:
        waiting.expect('up')
        assert waiting.end(signum) == 0
        assert f'raised {signum.name}\nasked by {signum.name}\n' in waiting.output


def test_within_on_stop_a_request_calls_back_and_a_second_one_raises():
    body = """
        with stop.on_stop(lambda: say('called')):
            say('up')
            wait()"""
    with phases(body) as stubborn:
        stubborn.expect('up')
        stubborn.signal(signal.SIGTERM)
        stubborn.expect('called')
        assert stubborn.end(signal.SIGINT) == 0
        assert 'raised SIG' in stubborn.output
        assert 'woken' not in stubborn.output


@pytest.mark.parametrize('line', [1, 2, 3])
def test_a_second_request_within_the_handler_of_the_first_one_raises(line):
    body = f"""
        lines = []

        def trace(frame, event, _):
            if event == 'line' and frame.f_code.co_name == '_handle':
                lines.append(frame.f_lineno)
                if len(lines) == {line}:
                    signal.raise_signal(signal.SIGINT)
            return trace

        with stop.on_stop(lambda: say('called')):
            sys.settrace(trace)
            signal.raise_signal(signal.SIGTERM)"""
    with phases(body) as program_:
        assert program_.end() == 0
        assert 'raised SIG' in program_.output


def test_a_request_before_on_stop_is_not_lost():
    body = """
        try:
            signal.raise_signal(signal.SIGTERM)
        except StopRequested:
            pass
        with stop.on_stop(lambda: say('called')):
            pass"""
    with phases(body) as late:
        assert late.end() == 0
        assert 'called\n' in late.output
        assert late.output.endswith('asked by SIGTERM\n')


@pytest.mark.parametrize('first', ['with stop.on_stop(say): pass', 'stop.leave()'])
def test_requests_during_the_clean_up_are_ignored(first):
    body = f"""
        {first}
        for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            signal.raise_signal(signum)
        say('cleaned up')"""
    with phases(body) as cleaning:
        assert cleaning.end() == 0
        assert cleaning.output == 'cleaned up\nasked by SIGINT\n'


def test_a_process_that_was_asked_to_stop_cannot_be_interrupted_on_its_last_steps():
    ending = PHASES.format(body='signal.raise_signal(signal.SIGINT)') + (
        'signal.raise_signal(signal.SIGINT)\nsignal.raise_signal(signal.SIGHUP)\n'
    )
    with Program.of(ending) as program_:
        assert program_.end() == 0


def test_the_lifeline_stops_the_program_when_its_last_writer_is_gone():
    reader, writer = os.pipe()
    lifeline = {'AMR_LIFELINE_FD': str(reader)}
    body = "say('up'); wait()"
    with phases(body, env=lifeline, pass_fds=[reader]) as child:
        os.close(reader)
        child.expect('up')
        os.close(writer)
        assert child.end() == 0
        assert 'raised SIGTERM\nasked by SIGTERM\n' in child.output


@pytest.mark.parametrize('number', ['0', '99', 'three', ''])
def test_a_variable_without_a_lifeline_means_nothing(number):
    with phases("say('up'); wait()", env={'AMR_LIFELINE_FD': number}) as child:
        child.expect('up')
        assert child.end(signal.SIGINT) == 0
        assert 'asked by SIGINT' in child.output


def test_hang_up_stays_ignored_under_nohup():
    code = PHASES.format(body="say('up'); wait()")
    with Program('nohup', sys.executable, '-c', code) as child:
        child.expect('up')
        child.signal(signal.SIGHUP)
        assert child.end(signal.SIGTERM) == 0
        assert 'asked by SIGTERM' in child.output


def test_handlers_are_put_back_when_nobody_asked():
    before = [signal.getsignal(signum) for signum in SIGNALS]
    with StopRequests(wake=lambda: None):
        assert all(signal.getsignal(s) != b for s, b in zip(SIGNALS, before, strict=True))
    assert [signal.getsignal(signum) for signum in SIGNALS] == before
    assert signal.set_wakeup_fd(-1) == -1
    assert 'stop_requests' not in [thread.name for thread in threading.enumerate()]


def test_a_process_ends_before_the_destructors_of_its_libraries():
    # Those of Fast DDS sleep; this one would end it with SIGABRT.
    code = """
import ctypes, sys
from amr_description.ros.runtime import ros
libc = ctypes.CDLL(None)
libc.on_exit(libc.abort, None)
with ros([]):
    pass
libc.printf(b'in a buffer of C\\n')
print('in one of Python')
sys.exit(7)
"""
    with Program.of(code, env={'PYTHONUNBUFFERED': ''}) as program:
        assert program.end() == 7
        assert sorted(program.lines) == ['in a buffer of C', 'in one of Python']
