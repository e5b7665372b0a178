# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The page in a real browser, over a real simulation: what a person sees, presses and lets go.

What the robot does is heard on its topics by the test itself, not believed of the page.
"""

from contextlib import contextmanager, ExitStack, suppress
from math import dist, hypot
import os
from pathlib import Path
import re
import signal
import time

from ament_index_python.packages import get_package_prefix
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import JointState
from support import chromium
from support.needs import need
from support.page import kept_port, Page
from support.running_programs import PATIENCE, Program
from test_viewer_stop import AHEAD, graph, Stranger

from amr_description.clock import NANOSECONDS
from amr_description.testing.program import own_domain

BRINGUP = Path(get_package_prefix('amr_description'), 'lib', 'amr_description', 'bringup')
AT_REST = 0.01  # m/s
CONTACTS = 'button[title="Load and slip of the wheels"]'
COMMANDS = '/diff_drive_controller/cmd_vel'
PRESSABLE = """(() => {
  const stop = document.querySelector('.stop');
  const { left, top, width, height } = stop.getBoundingClientRect();
  const hit = document.elementFromPoint(left + width / 2, top + height / 2);
  return width >= 44 && height >= 40 && stop.contains(hit);
})()"""
STOPS_WITHIN = 0.5
"""s of simulated time, from the command to stop; from 0.5 m/s the controller's limits allow it."""


@pytest.fixture(scope='module')
def simulation():
    with Program(BRINGUP, 'simulation', 'viewer:=false') as stack:
        stack.expect('ready in')
        yield stack
        assert stack.end(signal.SIGINT) == 0


@pytest.fixture(scope='module')
def viewer(simulation):
    with serving() as program:
        yield program
        assert program.end(signal.SIGINT) == 0
        assert 'Traceback' not in program.output


def serving(port=0):
    """A viewer that sends 20 states a second, not 60: each costs its page processor time."""
    return Program.module('viewer', '--ros-args', '-p', f'port:={port}', '-p', 'rate:=20.0')


def url_of(program):
    return program.expect(r'The page is at (http://\S+)')[1]


class Ears(Node):
    """What the test hears of the robot."""

    def __init__(self, context):
        super().__init__('test_page_in_browser', context=context)
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self)
        self.truth = []
        self.commands = []
        self.joints = {}
        self.create_subscription(Odometry, '/ground_truth/odom', self.truth.append, 50)
        self.create_subscription(
            TwistStamped, '/diff_drive_controller/cmd_vel', self.commands.append, 50
        )
        self.create_subscription(JointState, '/joint_states', self.hear_joints, 10)

    def hear_joints(self, message):
        self.joints.update(zip(message.name, message.position, strict=True))

    @property
    def position(self):
        """Where it truly is on the ground, m, shape (2,)."""
        position = self.truth[-1].pose.pose.position
        return position.x, position.y

    @property
    def is_upright(self):
        turn = self.truth[-1].pose.pose.orientation
        return 1.0 - 2.0 * (turn.x**2 + turn.y**2) > 0.999

    @property
    def speed(self):
        velocity = self.truth[-1].twist.twist.linear
        return hypot(velocity.x, velocity.y)

    @property
    def commanded(self):
        """The last speed that anybody commanded, m/s."""
        return self.commands[-1].twist.linear.x if self.commands else 0.0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._executor.shutdown()
        self.destroy_node()

    def wait(self, condition):
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, 'waited in vain'
            self._executor.spin_once(0.05)

    def drives(self):
        self.wait(lambda: self.truth and self.speed > 0.3 and self.commanded > 0.3)

    def has_stopped(self):
        """Wait until it rests, and return how long that took from the command to stop, s."""
        self.wait(
            lambda: (
                self.commands
                and self.commanded == 0.0
                and self.speed < AT_REST
                and stamp_of(self.truth[-1]) > stamp_of(self.commands[-1])
            )
        )
        moving = [number for number, each in enumerate(self.commands) if each.twist.linear.x]
        begin = stamp_of(self.commands[moving[-1] + 1])
        rest = next(
            stamp_of(each)
            for each in self.truth
            if stamp_of(each) > begin and abs(each.twist.twist.linear.x) < AT_REST
        )
        return rest - begin


def stamp_of(message):
    """When it was made, s of simulated time."""
    return message.header.stamp.sec + message.header.stamp.nanosec / NANOSECONDS


@contextmanager
def ros():
    context = Context()
    context.init([])
    yield context
    context.try_shutdown()


@pytest.fixture(scope='module')
def context(simulation):
    with ros() as context:
        yield context


@pytest.fixture
def ears(context):
    with Ears(context) as ears:
        ears.wait(lambda: ears.truth and ears.joints)
        yield ears


@pytest.fixture(scope='module')
def tab(browser, viewer):
    page = browser.open(url_of(viewer))
    is_shown(page)
    yield page
    assert page.errors == []
    page.close()


@pytest.fixture
def page(tab):
    """The page, where nobody drives; the tests share it, as to open it costs a second of CPU."""
    tab.wait_until('!document.hidden && amr.now.driver === null && !amr.now.driving')
    tab.wait_until("document.body.dataset.form === 'desk'")
    tab.evaluate('document.activeElement.blur()')  # arrow keys would go from tab to tab
    yield tab
    tab.let_go()
    tab.look_like()


def is_shown(page):
    page.wait_until("amr.now.link === 'open' && amr.now.states > 5 && amr.now.robot")


def test_it_loads_without_an_error_and_asks_nobody_else(page, viewer):
    page.wait_until('amr.now.scene.frames > 1 && amr.now.scene.triangles > 500')
    assert page.errors == []
    host = re.match(r'http://([^/]+)/', url_of(viewer))[1]
    assert len(page.requests) > 3
    assert [url for url in page.requests if f'//{host}/' not in url] == []


def test_a_key_drives_and_its_release_stops(page, ears):
    page.key_down('KeyW')
    ears.drives()
    page.wait_until('amr.now.driver === amr.now.client')
    page.wait_until("document.body.innerText.match('You drive')")
    page.key_up('KeyW')
    assert ears.has_stopped() < STOPS_WITHIN
    page.wait_until('amr.now.driver === null')


def test_the_other_keys(page, ears):
    begin = ears.truth[-1].pose.pose.position.x
    page.key_down('ArrowDown')
    ears.wait(lambda: ears.commanded < -0.3 and ears.truth[-1].pose.pose.position.x < begin)
    page.key_up('ArrowDown')
    ears.has_stopped()
    page.key_down('KeyA')
    ears.wait(lambda: ears.commands[-1].twist.angular.z > 0.5)  # to the left
    page.key_up('KeyA')
    ears.wait(lambda: ears.commands[-1].twist.angular.z == 0.0)


@pytest.mark.parametrize(
    'happening',
    [
        "window.dispatchEvent(new Event('blur'))",
        "Object.defineProperty(document, 'hidden', {value: true, configurable: true});"
        "document.dispatchEvent(new Event('visibilitychange'))",
        "window.dispatchEvent(new Event('pagehide'))",
    ],
    ids=['blur', 'hidden', 'left'],
)
def test_who_looks_away_stops(page, ears, happening):
    page.key_down('KeyW')
    ears.drives()
    page.evaluate(happening)
    assert ears.has_stopped() < STOPS_WITHIN
    page.key_up('KeyW')
    page.evaluate('delete document.hidden')


def test_a_page_that_is_busy_drawing_drives_on(page, ears):
    page.call('Debugger.enable')
    page.key_down('KeyW')
    ears.drives()
    page.call('Debugger.pause')  # as if it were drawing, but without the processor time
    before, begin = len(ears.commands), stamp_of(ears.commands[-1])
    ears.wait(lambda: stamp_of(ears.commands[-1]) > begin + 0.6)
    page.call('Debugger.resume')
    meanwhile = [each for each in ears.commands[before:] if stamp_of(each) < begin + 0.6]
    assert {each.twist.linear.x > 0.0 for each in meanwhile} == {True}
    page.call('Debugger.disable')
    page.key_up('KeyW')
    ears.has_stopped()


def test_a_page_that_was_busy_for_long_lets_go_and_says_so(page, ears):
    page.call('Debugger.enable')
    page.key_down('KeyW')
    ears.drives()
    page.call('Debugger.pause')
    ears.has_stopped()
    page.call('Debugger.resume')
    page.wait_until('!amr.now.driving')
    toast = page.wait_until("document.querySelector('.toast p')?.textContent")
    said = r'The page was busy for \d+\.\d s: the robot was stopped. Let go and hold again.'
    assert re.fullmatch(said, toast)
    page.call('Debugger.disable')
    page.key_up('KeyW')
    page.key_down('KeyW')
    ears.drives()
    page.key_up('KeyW')
    ears.has_stopped()


def test_the_joystick(page, ears):
    x, y = page.centre_of('.joystick')
    page.mouse('mousePressed', x, y)
    page.mouse('mouseMoved', x, y - 200)  # beyond its rim
    ears.drives()
    page.mouse('mouseReleased', x, y - 200)
    assert ears.has_stopped() < STOPS_WITHIN


@pytest.mark.parametrize('modifier', ['Shift', 'Control'])
def test_a_drag_with_shift_moves_and_one_with_ctrl_pulls_the_robot(page, ears, modifier):
    ears.wait(page.stands_still)  # it has come to where the robot was put back before
    x, y = page.centre_of('canvas.scene')  # the camera follows the robot
    begin = ears.position
    page.mouse('mousePressed', x, y, [modifier])
    page.mouse('mouseMoved', x + 500, y, [modifier])
    ears.wait(lambda: dist(ears.position, begin) > 0.03)
    page.mouse('mouseReleased', x + 500, y, [modifier])
    ears.wait(lambda: ears.speed < AT_REST)
    assert ears.commands == []
    page.click('#tab-simulation')  # the others find it as it was
    page.click('[title^="Put amr back"]')
    ears.wait(lambda: dist(ears.position, (0.0, 0.0)) < 0.01 and ears.is_upright)
    page.click('#tab-model')


@pytest.mark.usefixtures('released')
def test_one_drives_and_everybody_may_stop(browser, viewer, page, ears):
    other = browser.open(url_of(viewer), webgl=False, is_beside=True)
    is_shown(other)
    page.key_down('KeyW')
    ears.drives()
    name = page.evaluate('amr.now.client')
    other.wait_until(f"document.body.innerText.match('{name} drives')")
    other.click('.stop')
    assert ears.has_stopped() < STOPS_WITHIN
    page.wait_until('!amr.now.driving')  # though the key is still down
    page.wait_until("document.querySelector('.stop-word').textContent.includes('Stopped by page')")
    page.click('.release')
    other.wait_until("document.querySelector('.release') === null")
    page.wait_until("document.querySelector('.release') === null && !amr.now.driving")
    assert ears.commanded == 0.0  # the key that is still down drives nothing
    page.key_up('KeyW')
    other.close()


@pytest.fixture
def stranger(ears):
    """Somebody who publishes 0.3 m/s at 10 Hz, whatever is pressed."""
    with graph(lambda context: (Stranger(context, COMMANDS),)):
        ears.wait(lambda: ears.speed > 0.25)
        yield


def stands_still(ears):
    """Wait until it is at rest, and half a second more: it must not move, though commanded."""
    ears.wait(lambda: ears.speed < 0.001)
    begin, before = len(ears.truth), len(ears.commands)

    def is_commanded():
        return any(each.twist.linear.x == AHEAD for each in ears.commands[before:])

    ears.wait(lambda: len(ears.truth) > begin + 25 and is_commanded())
    velocities = (each.twist.twist.linear for each in ears.truth[begin:])
    assert max(hypot(each.x, each.y) for each in velocities) < 0.001


@pytest.fixture
def released(viewer):
    """After the test no robot is held, also where it failed: the others drive it, too."""
    yield
    with Page(url_of(viewer)) as last:
        last.wait(lambda: last.last('hello'))
        last.say('release', robot=None)
        last.ask('play', 1, simulator='/none')  # what is answered after that
        told = last.last('emergency_stop')
        assert told is None or not told['robots']


@pytest.mark.usefixtures('released', 'stranger')
def test_stop_holds_against_a_stranger_until_it_is_released(browser, viewer, ears):
    page = browser.open(url_of(viewer), webgl=False)  # else it would draw a robot that drives
    is_shown(page)
    page.wait_until("document.querySelector('.drive-head').innerText.match('/planner drives')")
    page.key_down('Tab')  # what is focused from now on is seen to be
    page.evaluate("document.querySelector('.plot-tools [aria-pressed]').focus()")
    before = page.evaluate("document.activeElement.getAttribute('aria-pressed')")
    page.key_down('Space', ' ')
    page.key_up('Space', ' ')
    page.wait_until("document.querySelector('.stop-word').textContent.match('Stands still')")
    page.wait_until("document.querySelector('.stop-word').textContent.includes('/planner, 10 Hz')")
    assert page.evaluate("document.activeElement.getAttribute('aria-pressed')") == before
    stands_still(ears)
    page.close()
    stands_still(ears)
    page = browser.open(url_of(viewer), webgl=False)
    is_shown(page)
    page.wait_until("document.querySelector('.stop-word').textContent.match('Stands still')")
    page.click('.release')
    ears.wait(lambda: ears.speed > 0.25)
    page.close()


@pytest.mark.parametrize(
    ('width', 'height', 'form'),
    [
        (1440, 900, 'desk'),
        (960, 540, 'wide'),
        (390, 844, 'tall'),
        (320, 568, 'tall'),
        (844, 390, 'wide'),
        (667, 375, 'wide'),
    ],
)
def test_stop_can_be_pressed_whatever_is_shown(page, width, height, form):
    """Also with the panels open, without a robot that drives, without any, and without a link."""
    page.look_like(width, height, phone=width < 900)
    page.wait_until(f"innerWidth === {width} && document.body.dataset.form === '{form}'")
    opened = "document.querySelector('.sheet').inert"
    for is_open in (False, True):
        if page.evaluate(opened) == is_open:
            page.evaluate("document.querySelector('.open-panels').click()")
        page.wait_until(f'{opened} === {str(not is_open).lower()}')
        for kind in ('', 'still', 'blind'):
            page.evaluate(f"document.body.classList.toggle('{kind or 'x'}', true)")
            assert page.evaluate(PRESSABLE), (width, height, is_open, kind)
            page.evaluate(f"document.body.classList.toggle('{kind or 'x'}', false)")


def test_what_stands_still_is_said_to_be_old(page, simulation, ears):
    """The simulator is stopped as Ctrl-Z does, and goes on."""
    page.wait_until("document.querySelector('.chip.link').textContent === 'Connected'")
    (simulator,) = descendants(simulation.process.pid, 'mujoco_sim')
    os.kill(simulator, signal.SIGSTOP)
    try:
        # Or more: one that is busy does not show each second.
        page.wait_until(
            r"/No data for ([2-9]|\d\d) s/.test(document.querySelector('.chip.link').textContent)"
        )
        page.wait_until("document.querySelectorAll('.readout .stale').length === 2")
        page.wait_until("document.querySelector('.factor').textContent === '–'")
        page.wait_until("document.body.classList.contains('stale')")
    finally:
        os.kill(simulator, signal.SIGCONT)
    page.wait_until("document.querySelector('.chip.link').textContent === 'Connected'")
    page.wait_until("document.querySelectorAll('.readout .stale').length === 0")


def descendants(parent, name):
    """The processes below another one that run this program."""
    found = []
    for path in Path('/proc').glob(f'{parent}/task/*/children'):
        with suppress(FileNotFoundError, ProcessLookupError):  # the thread has ended since
            children = path.read_text().split()
            for child in children:
                with suppress(FileNotFoundError, ProcessLookupError):  # it has ended since
                    if f'/{name}\0' in Path(f'/proc/{child}/cmdline').read_text():
                        found.append(int(child))
                found += descendants(child, name)
    return found


def test_wheels_are_heard_while_their_table_or_their_layer_is_shown(page, ears):
    def are_heard(count):
        ears.wait(lambda: ears.count_subscribers('/ground_truth/wheels') == count)

    are_heard(0)
    load = "document.querySelector('#panel-health tbody td:nth-child(3)')?.textContent"
    for on, off in (('#tab-health', '#tab-model'), (CONTACTS, CONTACTS)):
        page.click(on)
        are_heard(1)
        if on == '#tab-health':
            page.wait_until(f'Number({load}) > 1')
        page.click(off)
        are_heard(0)


def test_pause_step_play_and_reset(page, ears):
    page.click('.transport .play')
    page.wait_until("document.querySelector('.transport .play').title === 'Play'")
    begin = page.evaluate('amr.now.time')
    page.click('.transport .step')
    page.wait_until(f'amr.now.time > {begin}')
    page.click('.transport .play')
    page.wait_until(f'amr.now.time > {begin} + 1')
    start = ears.position
    page.key_down('KeyW')
    ears.drives()
    ears.wait(lambda: dist(ears.position, start) > 0.3)
    page.key_up('KeyW')
    ears.has_stopped()
    before = page.evaluate('amr.now.time')
    page.click('.transport [title^=Reset]')
    page.wait_until(f'amr.now.time < {before} - 1')
    ears.wait(lambda: hypot(*ears.position) < 0.01)
    page.wait_until('amr.now.time > 1')
    assert page.errors == []


def test_a_spawned_robot_comes_into_view_and_a_deleted_one_goes_with_its_trails(page):
    page.click('#tab-simulation')
    places = (
        "[...document.querySelectorAll('.spawn input[type=number]')].map((e) => e.value).join()"
    )
    page.wait_until("document.querySelector('.spawn [name=x]').value !== ''")
    offered = page.evaluate(places)
    page.click('.spawn [type=submit]')
    page.wait_until("/Spawning robot1/.test(document.querySelector('.spawn').innerText)")
    page.wait_until("'/robot1' in amr.now.scene.trails")
    page.wait_until("!document.querySelector('.spawn [type=submit]').disabled")
    page.wait_until(f'{places} !== "{offered}"')  # the next place that is free
    names = "[...document.querySelectorAll('header option')].map((each) => each.innerText).join()"
    assert page.evaluate(names) == 'amr,robot1'
    # In one go: who is slow is asked again, and the list may move between two mouse clicks.
    button = """document.querySelector('[title="Take robot1 out of the world"]')"""
    page.evaluate(f'{button}.click(), {button}.click()')
    page.wait_until("!('/robot1' in amr.now.scene.trails)")
    page.wait_until(f'{names} === "amr"')
    page.click('#tab-model')


def test_the_page_comes_back_when_the_server_does(browser, simulation):
    with ExitStack() as stack:
        port = stack.enter_context(kept_port())
        first = stack.enter_context(serving(port))
        url = url_of(first)
        page = browser.open(url, webgl=False)
        is_shown(page)
        assert first.end(signal.SIGKILL) == -signal.SIGKILL
        page.wait_until("amr.now.link !== 'open'")
        second = stack.enter_context(serving(port))
        assert url_of(second) == url
        count = page.evaluate('amr.now.states')
        page.wait_until(f"amr.now.link === 'open' && amr.now.states > {count} + 20")
        page.close()
        assert second.end(signal.SIGINT) == 0


def still_drives(page, ears):
    is_shown(page)
    assert page.evaluate('amr.now.scene') is None
    page.wait_until("document.body.innerText.match('WebGL')")
    page.key_down('KeyW')
    ears.drives()
    page.key_up('KeyW')
    assert ears.has_stopped() < STOPS_WITHIN
    assert page.errors == []


def test_without_webgl_one_still_drives_and_a_closed_tab_stops(browser, viewer, ears):
    page = browser.open(url_of(viewer), webgl=False)
    still_drives(page, ears)
    page.key_down('KeyW')
    ears.drives()
    page.close()
    assert ears.has_stopped() < STOPS_WITHIN


@pytest.mark.long
def test_in_a_browser_without_webgl_one_still_drives(viewer, ears):
    need(chromium.executable(), 'no chromium; apt install chromium')
    with chromium.Chromium('--disable-3d-apis') as browser:
        page = browser.open(url_of(viewer))
        still_drives(page, ears)
        page.close()


def test_an_empty_graph_says_what_to_start(browser):
    with own_domain(), serving() as program:
        page = browser.open(url_of(program), webgl=False)
        page.wait_until("document.body.innerText.match('nothing publishes /robot_description')")
        assert page.evaluate(PRESSABLE)
        page.key_down('Escape')
        page.wait_until(
            "document.querySelector('.stop-word').textContent.match('No robot is there')"
        )
        page.click('.release')
        page.wait_until("document.querySelector('.release') === null")
        assert page.errors == []
        page.close()
        assert program.end(signal.SIGINT) == 0


def test_sliders_move_joints(browser):
    """The stack ``display`` in a domain of its own, its page included."""
    with own_domain(), Program(BRINGUP, 'display') as stack:
        page = browser.open(url_of(stack), webgl=False)
        is_shown(page)
        page.click('[role=tab]:nth-child(2)')
        page.evaluate(
            """(() => {
              const slider = document.querySelector(
                'input[type=range][aria-label^=joint_wheel_front_left]');
              slider.value = '1.25';
              slider.dispatchEvent(new Event('input', {bubbles: true}));
            })()"""
        )
        with ros() as context, Ears(context) as ears:
            ears.wait(lambda: abs(ears.joints.get('joint_wheel_front_left', 0.0) - 1.25) < 1e-6)
        page.close()
        assert stack.end(signal.SIGINT) == 0
