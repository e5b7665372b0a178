# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node viewer with a real simulator: time, worlds, robots and controllers, asked by a page."""

from contextlib import contextmanager
import math
import signal
import struct

from fixtures.sim.driving import AMR
import numpy as np
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from simulation_interfaces.msg import Result
from simulation_interfaces.srv import LoadWorld
from std_msgs.msg import String
from support.page import Page
from support.ros_processes import PATIENCE, run, running
from test_viewer_server import url_of, viewer

from amr_description.ros.service_calls import call

SIMULATOR = '/mujoco_sim'
CONTROLLERS = ('joint_state_broadcaster', 'diff_drive_controller')
LINKS = {f'robot1/{name}' for name in ('base_link', 'wheel_front_left', 'wheel_back_right')}
"""Frames of a robot that a page spawned: of a fixed joint, of moving ones."""

pytestmark = pytest.mark.in_order('one simulator: its world is changed, and its robot deleted')


class Asker:
    """Numbers the requests of a page to the simulator."""

    def __init__(self, page):
        self.page = page
        self._count = 0

    def __call__(self, kind, **fields):
        """Whether it was done, and the message."""
        self._count += 1
        reply = self.page.ask(kind, self._count, **fields)
        return reply['ok'], reply['message']

    def simulator(self, kind, **fields):
        return self(kind, simulator=SIMULATOR, **fields)

    def spawn(self, name, namespace, x):
        place = {'position': [x, 0.5, 0.0], 'yaw': 0.5}
        return self.simulator('spawn', name=name, namespace=namespace, like='/', **place)


@contextmanager
def described():
    """A node that publishes the description of the shipped robot."""
    rclpy.init(args=[])
    node = Node('described')
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = node.create_publisher(String, '/robot_description', latched)
    publisher.publish(String(data=AMR))
    try:
        yield
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


@contextmanager
def page_of_walls():
    """The page of a simulator that has no robot yet; the viewer has nothing to complain of."""
    with (
        described(),
        running('mujoco_sim', '--ros-args', '-p', 'world:=walls', until='waiting for robots'),
        viewer() as program,
        Page(url_of(program)) as page,
    ):
        page.wait(lambda: page.last('model'))
        page.wait(lambda: simulators(page))
        yield page
        assert len(program.lines) == 1, program.output


@pytest.fixture(scope='module')
def page():
    with page_of_walls() as page:
        yield page


@pytest.fixture(scope='module')
def ask(page):
    return Asker(page)


@pytest.fixture(scope='module')
def driven(page, ask):
    """The robot of the root namespace, in the world, its controllers active."""
    ok, message = ask.spawn('amr', '/', 0.0)
    assert ok, message
    ended = run('spawner', *CONTROLLERS)
    assert ended.returncode == 0, ended.stderr
    page.wait(lambda: states_of(page, '/') == dict.fromkeys(CONTROLLERS, 'active'))
    page.wait(lambda: robot(page, '/')['command'] and robot(page, '/')['truth'])


def diagnosed(page, name):
    """Names of the statuses of a robot's diagnostics, as last told."""
    told = [each for each in page.of('diagnostics') if each['robot'] == name]
    return {each['name'] for each in told[-1]['items']} if told else set()


def simulators(page):
    return (page.last('graph') or {'simulators': []})['simulators']


def status(page, key):
    """Of the simulation, as last told; None: nothing was told yet."""
    return (page.last('simulation') or {}).get(key)


def robot(page, name):
    return next((each for each in page.last('graph')['robots'] if each['id'] == name), None)


def entities_of(page):
    """What each robot is in the simulator's world, as last told."""
    robots = {each['id']: each['entity'] for each in page.last('graph')['robots']}
    assert {each['simulator'] for each in robots.values() if each} <= {SIMULATOR}
    return {name: each and each['name'] for name, each in robots.items()}


def drives(page, ask, name, namespace):
    """A robot like the one of the root that has gone has its controllers, and goes."""
    active = f"'{name}' is in the world; active: {', '.join(CONTROLLERS)}"
    assert ask.spawn(name, namespace, 0.0) == (True, active)
    page.wait(lambda: entities_of(page).get(namespace) == name)
    page.wait(lambda: robot(page, namespace)['present'] and robot(page, namespace)['command'])
    start = page.wait(lambda: place(page, namespace))
    drive_until(page, namespace, lambda: distance(page, namespace, start) > 0.05)


def states_of(page, name):
    """Controller → state, as last told."""
    told = [each for each in page.of('controllers') if each['robot'] == name]
    return {each['name']: each['state'] for each in told[-1]['controllers']} if told else {}


def last_state(page, name):
    """A robot's layout, and its numbers in the last state; None: not known."""
    if not page.states:
        return None
    state = page.states[-1]
    number = struct.unpack_from('<H', state, 2)[0]
    layout = next((each for each in page.of('layout')[::-1] if each['id'] == number), None)
    if layout is None:
        return None
    numbers = np.frombuffer(state, '<f4', offset=16)[7 * len(layout['frames']) :]
    for each in layout['robots']:
        size = 3 * len(each['joints']) + 23 + 4 * len(each['wheels'])
        if each['id'] == name:
            return each, numbers[:size]
        numbers = numbers[size:]
    return None


def place(page, name):
    """Where the robot truly is, x and y, by the last state; None: not known."""
    found = last_state(page, name)
    if found is None:
        return None
    layout, numbers = found
    x, y = numbers[3 * len(layout['joints']) + 10 :][:2].tolist()
    return None if math.isnan(x) else (x, y)


def height(page, name):
    """Of the robot's base over the ground, m, by the last state; not a number: not known."""
    found = last_state(page, name)
    return float(found[1][3 * len(found[0]['joints']) + 12]) if found else math.nan


def speed(page, name):
    """How fast the robot truly goes ahead, m/s, by the last state; not a number: not known."""
    found = last_state(page, name)
    return float(found[1][3 * len(found[0]['joints']) + 17]) if found else math.nan


def commanded(page, name):
    """What the joints are commanded by the last state, rad/s; empty: not known."""
    found = last_state(page, name)
    if found is None:
        return []
    layout, numbers = found
    count = len(layout['joints'])
    return numbers[2 * count : 3 * count].tolist()


def command(page, name):
    """The velocity that is commanded ahead by the last state, m/s; not a number: none is."""
    found = last_state(page, name)
    return float(found[1][3 * len(found[0]['joints']) + 20]) if found else math.nan


def wheels_of(page, name):
    """Contact, normal force and slip of each wheel by the last state; None: no wheel is known."""
    found = last_state(page, name)
    if found is None or not found[0]['wheels']:
        return None
    return found[1][-4 * len(found[0]['wheels']) :].reshape(-1, 4)


def distance(page, name, start):
    """How far it is from there, m; 0 while that is not known."""
    return math.dist(place(page, name) or start, start)


def drive_on_until(page, name, condition):
    """Drive until something is so, at the pace of the states that come, and do not stop."""

    def drive_on():
        page.say('drive', robot=name, linear=0.3, angular=0.0)
        return condition()

    page.wait(drive_on)


def drive_until(page, name, condition):
    """Drive until something is so, and stop."""
    drive_on_until(page, name, condition)
    page.say('stop', robot=name)


def test_a_page_sees_the_world(page):
    world = page.wait(lambda: page.last('world'))
    assert [shape['name'] for shape in world['shapes']][:2] == ['ground', 'east']


def test_a_page_lets_time_stand_still_step_and_go_on(page, ask):
    assert ask.simulator('pause') == (True, 'time stands still')
    assert ask.simulator('pause')[0]
    page.wait(lambda: status(page, 'state') == 'paused')
    assert ask.simulator('step', steps=5) == (True, '5 steps were made')
    assert ask.simulator('play')[0]
    page.wait(lambda: status(page, 'state') == 'playing')
    ok, message = ask.simulator('step', steps=1)
    assert (ok, 'steps are made while it is PAUSED' in message) == (False, True)


def test_a_page_sets_the_real_time_factor(page, ask):
    assert ask.simulator('set_factor', factor=0.5) == (True, 'the real-time factor is 0.5')
    page.wait(lambda: status(page, 'factor') == 0.5)
    ok, message = ask.simulator('set_factor', factor=-1.0)
    assert (ok, 'at least 0' in message) == (False, True)
    assert ask.simulator('set_factor', factor=1.0)[0]
    page.wait(lambda: status(page, 'factor') == 1.0)


def test_a_page_sees_what_wheels_are_commanded(page, driven):
    def all_turn():
        speeds = commanded(page, '/')
        return speeds and all(speed > 1.0 for speed in speeds)

    drive_until(page, '/', all_turn)
    page.wait(lambda: set(commanded(page, '/')) == {0.0})


def test_wheels_are_heard_only_while_a_page_shows_them(page, driven):
    """By default none does: the simulator need not read their contacts. Their names are known."""
    counter = Node('counter')

    def is_heard():
        return counter.count_subscribers('/ground_truth/wheels') > 0

    page.wait(lambda: wheels_of(page, '/') is not None and not is_heard())
    assert np.isnan(wheels_of(page, '/')).all()
    page.say('watch', parts=['wheels'])
    page.wait(lambda: np.isfinite(wheels_of(page, '/')).all())
    page.wait(lambda: counter.count_subscribers('/ground_truth/wheels') == 1)
    contact, load, *_ = wheels_of(page, '/').T
    assert (contact.min(), load.sum() > 10.0) == (1.0, True)
    page.say('watch', parts=[])
    page.wait(lambda: np.isnan(wheels_of(page, '/')).all() and not is_heard())
    counter.destroy_node()


def test_a_page_drives_the_robot_in_truth(page, driven):
    start = page.wait(lambda: place(page, '/'))
    drive_until(page, '/', lambda: distance(page, '/', start) > 0.05)


def test_a_robot_stops_by_itself_when_the_viewer_is_killed(page, driven):
    """Nobody says stop: the time-out of the robot's controller is the last that is left."""
    with viewer() as killed, Page(url_of(killed)) as driver:
        driver.wait(lambda: driver.last('model') and robot(driver, '/')['command'])
        drive_on_until(driver, '/', lambda: speed(page, '/') > 0.1)
        killed.signal(signal.SIGKILL)
        driver.wait_closed()
    page.wait(lambda: abs(speed(page, '/')) < 0.01)
    page.wait(lambda: math.isnan(command(page, '/')))  # its time-out has ended the command


def test_a_page_switches_controllers(page, ask, driven):
    name = 'diff_drive_controller'
    off = {'robot': '/', 'activate': [], 'deactivate': [name]}
    assert ask('switch', **off) == (True, f'{name} is inactive')
    page.wait(lambda: states_of(page, '/')[name] == 'inactive')
    on = {'robot': '/', 'activate': [name], 'deactivate': []}
    assert ask('switch', **on) == (True, f'{name} is active')
    page.wait(lambda: states_of(page, '/')[name] == 'active')
    ok, message = ask('switch', robot='/', activate=['no_such'], deactivate=[])
    assert (ok, 'no_such' in message) == (False, True)


def test_a_page_spawns_another_that_can_be_driven_and_deletes_it(page, ask, driven):
    ok, message = ask.spawn('robot1', '/robot1', 1.0)
    assert (ok, message) == (
        True, f"'robot1' is in the world; active: {', '.join(CONTROLLERS)}"
    )  # fmt: skip
    page.wait(lambda: any(each['robot'] == '/robot1' for each in page.of('model')))
    page.wait(lambda: robot(page, '/robot1') and robot(page, '/robot1')['command'])
    page.wait(lambda: entities_of(page) == {'/': 'amr', '/robot1': 'robot1'})
    start = page.wait(lambda: place(page, '/robot1'))
    drive_until(page, '/robot1', lambda: distance(page, '/robot1', start) > 0.05)
    page.wait(lambda: {each['name'] for each in page.last('layout')['frames']} >= LINKS)
    page.wait(lambda: diagnosed(page, '/robot1') and diagnosed(page, '/'))
    assert not diagnosed(page, '/') & diagnosed(page, '/robot1')
    page.wait(lambda: 'robot1' in simulators(page)[0]['entities'])
    ok, message = ask.spawn('robot1', '/robot1', 2.0)
    assert (ok, 'robot1' in message) == (False, True)
    assert ask.simulator('delete', name='robot1') == (True, "'robot1' has left the world")
    page.wait(lambda: robot(page, '/robot1') is None)
    page.wait(lambda: 'robot1' not in simulators(page)[0]['entities'])
    ok, message = ask.simulator('delete', name='robot1')
    assert (ok, "no entity 'robot1'" in message) == (False, True)


def test_a_page_puts_a_robot_elsewhere_and_back(page, ask, driven):
    ok, message = ask.simulator('place', name='amr', position=[2.0, -1.0, 0.1], yaw=1.0)
    assert (ok, message) == (True, "'amr' stands where it was put")
    page.wait(lambda: distance(page, '/', (2.0, -1.0)) < 0.02)
    ok, message = ask.simulator('place', name='amr', position=[2.0, -1.0, -0.05], yaw=1.0)
    assert (ok, "'amr' was put inside 'ground' of the world" in message) == (True, True)
    ok, message = ask.simulator('reset_entity', name='amr')
    assert (ok, message) == (True, "'amr' stands where it was spawned")
    page.wait(lambda: distance(page, '/', (0.0, 0.5)) < 0.02)
    ok, message = ask.simulator('reset_entity', name='nobody')
    assert (ok, "where 'nobody' was spawned is not known" in message) == (False, True)
    ok, message = ask.simulator('place', name='nobody', position=[0.0, 0.0, 0.0], yaw=0.0)
    assert (ok, "no entity 'nobody'" in message) == (False, True)


def test_a_page_pushes_a_robot_which_rests_when_the_page_falls_silent(page, ask, driven):
    push = {'simulator': SIMULATOR, 'entity': 'amr', 'link': 'base_link', 'torque': [0.0] * 3}
    start = page.wait(lambda: place(page, '/'))

    def is_lifted():
        page.say('push', force=[0.0, 0.0, 300.0], **push)
        return height(page, '/') > 0.3

    page.wait(is_lifted)
    page.wait(lambda: height(page, '/') < 0.05)  # and nobody let it go
    assert distance(page, '/', start) < 0.5
    assert ask.simulator('reset_entity', name='amr')[0]


def test_a_page_spawns_a_description_of_its_own(page, ask, driven):
    crate = (
        '<?xml version="1.0"?>\n<robot name="crate">\n'
        '<link name="box"><inertial><mass value="1"/><inertia ixx="0.01" '
        'iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>'
        '<box size="0.2 0.2 0.2"/></geometry></collision></link></robot>'
    )
    place = {'position': [-2.0, 0.0, 0.3], 'yaw': 0.0}
    new = {'name': 'crate', 'namespace': '/crate', 'like': None, **place}
    assert ask.simulator('spawn', urdf=crate, **new) == (True, "'crate' is in the world")
    model = page.wait(lambda: next((m for m in page.of('model') if m['robot'] == '/crate'), None))
    assert model['root'] == 'box'
    ok, message = ask.simulator('spawn', urdf='<robot', **(new | {'name': 'other'}))
    assert not ok
    ok, message = ask.simulator('spawn', **(new | {'name': 'other'}))
    assert (ok, message) == (False, 'a robot to spawn has a URDF, or is like another one')
    bolted = new | {'name': 'bolted', 'namespace': '/bolted', 'position': [-3.0, 0.0, 1.5]}
    assert not ask.simulator('spawn', urdf='<robot', fixed=True, **bolted)[0]
    assert ask.simulator('spawn', urdf=crate, fixed=True, **bolted)[0]
    model = page.wait(lambda: next((m for m in page.of('model') if m['robot'] == '/bolted'), None))
    assert model['root'] == 'world'  # it does not fall
    for name in ('crate', 'bolted'):
        assert ask.simulator('delete', name=name)[0]


def test_a_page_changes_the_world_around_its_robots(page, ask, driven):
    page.wait(lambda: 'empty' in simulators(page)[0]['worlds'])
    assert simulators(page)[0]['world'] == 'walls'
    before = len(page.of('world'))
    ok, message = ask.simulator('load_world', name='empty')
    assert (ok, message) == (True, "the world is 'empty', with 'amr'")
    page.wait(lambda: len(page.of('world')) > before)
    assert 'east' not in [shape['name'] for shape in page.last('world')['shapes']]
    page.wait(lambda: simulators(page)[0]['world'] == 'empty')
    page.wait(lambda: status(page, 'state') == 'playing')
    page.wait(lambda: states_of(page, '/') == dict.fromkeys(CONTROLLERS, 'active'))
    start = page.wait(lambda: place(page, '/'))
    drive_until(page, '/', lambda: distance(page, '/', start) > 0.05)
    ok, message = ask.simulator('load_world', name='nowhere')
    assert (ok, "there is no world 'nowhere' to load; there are:" in message) == (False, True)


def test_a_page_resets_and_is_told_that_time_went_back(page, ask, driven):
    assert ask.simulator('reset_simulation')[0]
    assert page.wait(lambda: page.last('reset'))['time'] >= 0.0
    page.wait(lambda: place(page, '/') and distance(page, '/', (0.0, 0.5)) < 0.02)


def test_a_deleted_robot_is_only_described(page, ask, driven):
    """Its description is published on; another robot can be made like it."""
    assert robot(page, '/')['present']
    assert ask.simulator('delete', name='amr')[0]
    page.wait(lambda: not robot(page, '/')['present'])
    page.wait(lambda: entities_of(page) == {'/': None})
    drives(page, ask, 'again', '/again')
    assert ask.simulator('delete', name='again')[0]
    page.wait(lambda: robot(page, '/again') is None)
    drives(page, ask, 'amr', '/')  # in the place of the first
    assert ask.simulator('delete', name='amr')[0]
    page.wait(lambda: not robot(page, '/')['present'])


def test_a_robot_is_described_when_who_has_spawned_it_has_ended(page, ask):
    """Of who comes later it has the controllers of the parameter file: he never saw the first."""
    with viewer() as program, Page(url_of(program)) as other:
        other.wait(lambda: other.last('model') and simulators(other))
        drives(other, Asker(other), 'robot3', '/robot3')
        page.wait(lambda: entities_of(page).get('/robot3') == 'robot3')
        assert program.end(signal.SIGINT) == 0
    page.wait(lambda: robot(page, '/robot3') is None)  # who described it has ended
    page.wait(lambda: entities_of(page).get('/robot3') == 'robot3')
    page.wait(lambda: place(page, '/robot3'))
    assert ask.simulator('delete', name='robot3')[0]
    page.wait(lambda: robot(page, '/robot3') is None)


def test_a_world_that_somebody_else_loads_is_told(page):
    assert simulators(page)[0]['world'] == 'empty'
    other = Node('other')
    response = call(
        other, LoadWorld, f'{SIMULATOR}/load_world', LoadWorld.Request(uri='walls'),
        timeout=PATIENCE,
    )  # fmt: skip
    assert response.result.result == Result.RESULT_OK, response.result.error_message
    page.wait(lambda: simulators(page)[0]['world'] == 'walls')
    other.destroy_node()
