# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""STOP, with a stranger who drives on: it holds until it is released, whatever pages become."""

from contextlib import contextmanager, ExitStack
import os
import signal
import time

from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import (
    ListControllers,
    ListHardwareComponents,
    SwitchController,
)
from fixtures.sim.driving import AMR
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, String
from support.page import Page
from support.serving import serving
from test_viewer_server import url_of, viewer

from benchmarks.churn import processor_waits

AHEAD = 0.3
ACCELERATION = 0.5
CREEPING = 0.05
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
MANAGER = '/controller_manager'


class Base(Node):
    """
    A base that does what it was commanded last, as fast as it accelerates.

    It publishes its speed at 50 Hz, and keeps it, with the time.
    """

    def __init__(self, context, *, has_lock):
        super().__init__('base_driver', context=context)
        self.samples = []
        self.locks = []
        self.target = self.speed = 0.0
        self._time = time.monotonic()
        self.state = 'active'
        self.create_publisher(String, '/robot_description', LATCHED).publish(String(data=AMR))
        self._odometry = self.create_publisher(Odometry, '/odom', 10)
        self.create_subscription(TwistStamped, '/cmd_vel', self._take, 10)
        if has_lock:
            self.create_subscription(Bool, '/emergency_stop', self._lock, 10)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(0.02, self._measure, clock=steady)

    def _take(self, message):
        if self.state == 'active' and not (self.locks and self.locks[-1]):
            self._roll()
            self.target = message.twist.linear.x

    def _lock(self, message):
        self.locks.append(message.data)
        if message.data:
            self._roll()
            self.target = 0.0

    def _roll(self):
        """Accelerate towards the target, as it was until now."""
        self._time, before = time.monotonic(), self._time
        most = ACCELERATION * (self._time - before)
        self.speed += min(max(self.target - self.speed, -most), most)

    def _measure(self):
        self._roll()
        self.samples.append(self.speed)
        odometry = Odometry()
        odometry.twist.twist.linear.x = self.speed
        self._odometry.publish(odometry)

    def serve_manager(self):
        """Be a controller, and its manager."""
        self.create_service(ListControllers, f'{MANAGER}/list_controllers', self._list)
        self.create_service(
            ListHardwareComponents,
            f'{MANAGER}/list_hardware_components',
            lambda _, response: response,
        )
        self.create_service(SwitchController, f'{MANAGER}/switch_controller', self._switch)

    def _list(self, _, response):
        response.controller = [ControllerState(name='base_driver', state=self.state)]
        return response

    def _switch(self, request, response):
        self.state = 'active' if request.activate_controllers else 'inactive'
        self._roll()
        self.target = 0.0
        response.ok = True
        return response


class Stranger(Node):
    """Somebody who commands 0.3 m/s at 10 Hz, whatever is said."""

    def __init__(self, context, topic='/cmd_vel'):
        super().__init__('planner', context=context)
        self._commands = self.create_publisher(TwistStamped, topic, 10)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(0.1, self._command, clock=steady)

    def _command(self):
        command = TwistStamped()
        command.twist.linear.x = AHEAD
        self._commands.publish(command)


@contextmanager
def graph(make):
    """Nodes that are not of the viewer, each served by a thread of its own."""
    context = Context()
    context.init(args=[])
    nodes = make(context)
    try:
        with ExitStack() as served:
            for node in nodes:
                executor = SingleThreadedExecutor(context=context)
                executor.add_node(node)
                served.enter_context(serving(executor))
            yield nodes
    finally:
        for node in nodes:
            node.destroy_node()
        context.try_shutdown()


@pytest.fixture(scope='module')
def program():
    """The viewer of most tests."""
    with viewer() as program:
        yield program
        assert program.end(signal.SIGINT) == 0
        assert len(program.lines) == 1, program.output


@pytest.fixture(scope='module')
def url(program):
    return url_of(program)


@pytest.fixture(params=['lock', 'no lock'])
def base(request):
    """A base that a stranger drives."""
    has_lock = request.param == 'lock'
    with graph(lambda context: (Base(context, has_lock=has_lock), Stranger(context))) as nodes:
        yield nodes[0]


def held(page):
    """The robot that is held, as last told; None: none is."""
    told = page.last('emergency_stop')
    return told['robots'][0] if told and told['robots'] else None


def rolls(page, base):
    """Wait until the stranger drives the base, and the page knows both."""
    page.say('release', robot=None)  # of a test that has failed
    page.wait(lambda: page.last('model') and base.speed == AHEAD)
    page.wait(lambda: (commanders(page) or {}).get('nodes') == ['/planner'])


def commanders(page):
    return page.last('commanders')


def stands(page, base, program):
    """
    Wait until the base is at rest, and then for a second: it must not move.

    Without a lock it may creep: a command of the stranger is in force until its zero comes, which
    takes a millisecond, or as long as who sends it waits for a processor. In a wait of w s it
    accelerates, and then brakes as long: it goes ACCELERATION·w² m, in a second or more.
    """
    page.wait(lambda: held(page) and base.speed < CREEPING)
    is_firm = bool(base.locks) or base.state == 'inactive'
    if is_firm:
        page.wait(lambda: held(page)['state'] == 'holds' and base.speed == 0.0)
    before = waits(program)
    speeds = from_now_on(page, base)
    rolled = ACCELERATION * waited_since(before, program) ** 2
    assert sum(speeds) / len(speeds) <= (0.0 if is_firm else CREEPING + rolled)


def waits(program):
    """What each thread of the viewer and of this process has waited for a processor, ns."""
    pids = os.getpid(), program.process.pid
    return {(pid, thread): ns for pid in pids for thread, ns in processor_waits(pid).items()}


def waited_since(before, program):
    """What two threads, one after the other, have waited at the most, s."""
    times = sorted(ns - before.get(thread, 0) for thread, ns in waits(program).items())
    return sum(times[-2:]) * 1e-9


def from_now_on(page, base):
    """How it moves in the next second."""
    begin = len(base.samples)
    page.wait(lambda: len(base.samples) > begin + 50)
    return base.samples[begin:]


def is_free(page, base):
    page.wait(lambda: held(page) is None and base.speed == AHEAD)


def test_stop_holds_until_anybody_releases_it(url, program, base):
    with Page(url) as presser, Page(url) as other:
        rolls(presser, base)
        presser.say('press_stop', robot=None)
        stands(presser, base, program)
        assert held(presser)['is_locked'] == bool(base.locks)
        name = presser.last('hello')['client']
        assert held(presser)['client'] == name
        other.wait(lambda: held(other))  # what one page was told may be on its way to another
        assert held(other)['client'] == other.last('emergency_stop')['client'] == name
        with Page(url) as late:
            late.wait(lambda: (robot := held(late)) and robot['client'] == name)
        other.say('release', robot=None)
        is_free(presser, base)
        assert presser.last('emergency_stop')['client'] is None


@pytest.mark.parametrize('ending', ['close', 'vanish'])
@pytest.mark.parametrize('base', ['lock', 'no lock'], indirect=True)
def test_a_stop_outlives_its_page_and_all_others(url, program, base, ending):
    with Page(url) as presser:
        rolls(presser, base)
        presser.say('press_stop', robot=None)
        name = presser.last('hello')['client']
        presser.wait(lambda: held(presser))
        presser.close() if ending == 'close' else presser.vanish()
    with Page(url) as late:
        stands(late, base, program)
        assert held(late)['client'] == name
        late.say('release', robot='/')
        late.wait(lambda: held(late) is None)
        assert late.last('emergency_stop')['client'] == name  # of all others
        late.say('release', robot=None)
        is_free(late, base)


@pytest.mark.parametrize('base', ['lock'], indirect=True)
def test_a_page_drives_a_stopped_robot_only_after_it_has_let_go(url, base):
    with Page(url) as page:
        rolls(page, base)
        # One after the other: a key that is held says so more often than a busy machine answers.
        page.say('press_stop', robot='/')
        page.say('drive', robot='/', linear=1.0, angular=0.0)
        page.say('release', robot='/')
        page.say('drive', robot='/', linear=1.0, angular=0.0)
        held, let_go = page.wait(lambda: len(told := page.of('notice')) == 2 and told)
        assert held['text'].startswith('STOP holds /, pressed by page')
        assert let_go['text'].startswith('/ was stopped by another page')
        is_free(page, base)
        page.say('stop', robot='/')
        page.wait(
            lambda: page.say('drive', robot='/', linear=1.0, angular=0.0) or base.speed == 1.0
        )
        page.say('stop', robot='/')


def test_a_stop_that_does_not_hold_is_said_and_the_drive_can_be_deactivated(url, program):
    """The base takes only what the stranger says, on a topic of its own."""

    def make(context):
        base = Base(context, has_lock=False)
        base.serve_manager()
        base.create_subscription(TwistStamped, '/direct', base._take, 10)
        return base, Stranger(context, '/direct')

    with graph(make) as (base, _), Page(url) as page:
        page.wait(lambda: page.last('model') and page.last('controllers'))
        page.say('press_stop', robot=None)
        page.wait(lambda: (robot := held(page)) and robot['state'] == 'moves')
        assert held(page)['controllers'] == ['base_driver']
        reply = page.ask('deactivate_drive', 1, robot='/')
        assert reply['ok'], reply
        stands(page, base, program)
        assert held(page)['deactivated'] == ['base_driver']
        page.say('release', robot=None)
        is_free(page, base)
        assert base.state == 'active'
        assert not page.ask('deactivate_drive', 2, robot='/')['ok']


@pytest.mark.parametrize('base', ['lock'], indirect=True)
def test_the_lock_outlives_the_viewer_which_says_how_to_release_it(base):
    with viewer() as program, Page(url_of(program)) as page:
        rolls(page, base)
        page.say('press_stop', robot=None)
        stands(page, base, program)
        program.signal(signal.SIGTERM)
        assert program.end() == 0
        assert 'ros2 topic pub -1 /emergency_stop std_msgs/msg/Bool "{data: false}"' in (
            program.output
        )
        assert len(program.lines) == 2, program.output
        assert False not in base.locks
        assert base.speed == 0.0


@pytest.mark.parametrize('base', ['lock'], indirect=True)
def test_who_commands_and_how_often_is_told_and_so_are_ages(url, base):
    with Page(url) as page:
        rolls(page, base)
        page.wait(lambda: commanders(page)['rate'] == 10.0)
        (ages,) = page.wait(lambda: (told := page.last('ages'))['robots'] and told)['robots']
        assert ages['robot'] == '/'
        # None: nothing has come yet.
        page.wait(lambda: 0.0 <= (page.last('ages')['robots'][0]['odometry'] or -1.0) < 0.5)
        assert ages['joint_states'] is page.last('ages')['clock'] is None
