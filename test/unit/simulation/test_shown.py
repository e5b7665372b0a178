# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page of a simulation in this process, by a client of its WebSocket."""

import math
from urllib.parse import urlsplit

import pytest
from support.paths import ROOT
from support.shown_page import play, request, run, ShownPage

from amr_description import Simulation
from amr_description.controllers.drives.diff_drive_controller import DiffDriveController
from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.simulation.page_backend import IDLE, SIMULATOR

URDF = ROOT / 'urdf' / 'amr.urdf'


@pytest.fixture(scope='module')
def shared():
    with Simulation(URDF) as simulation:
        yield simulation, simulation.show(port=0)


@pytest.fixture
def sim(shared):
    shared[0].reset()
    shared[0].show()
    return shared[0]


@pytest.fixture
def page(shared, sim):
    with ShownPage(shared[1].url) as client:
        client.newest('layout')
        yield client


def test_a_page_sees_robot_world_and_where_it_drives(sim, page):
    assert page.newest('graph')['robots'][0]['command']['topic'] == sim.robot.command_topic
    assert [each['name'] for each in page.newest('world')['shapes']] == ['ground']
    assert page.newest('model')['root'] == 'base_footprint'
    sim.drive(0.5, 0.3, seconds=1)
    expected = sim.truth.pose.translation
    page.wait(lambda: page.truth() == pytest.approx(expected, abs=1e-6))
    assert page.newest('layout')['frames'][0] == {'name': 'base_footprint', 'parent': 'odom'}


def test_a_page_that_is_opened_later_sees_the_robot_where_it_is(shared, sim):
    sim.drive(0.5, 0.0, seconds=1)
    sim.show()
    with ShownPage(shared[1].url) as page:
        page.wait(lambda: page.truth() == pytest.approx(sim.truth.pose.translation, abs=1e-6))


def test_pages_only_watch_while_the_program_lets_time_pass(sim, page):
    page.say('drive', robot='/', linear=0.5, angular=0.0)
    assert page.newest('notice')['text'] == IDLE
    assert page.asked('reset_simulation', simulator=SIMULATOR) == (False, IDLE)
    sim.run(1)
    assert sim.truth.x == pytest.approx(0.0, abs=1e-3)


def test_who_watches_changes_no_bit(sim, page):
    sim.drive(0.4, 0.4, seconds=1)
    page.newest('layout')
    watched = sim.world.state()
    with Simulation(URDF) as alone:
        alone.drive(0.4, 0.4, seconds=1)
        assert alone.world.state() == watched


def test_a_page_drives_while_the_program_plays(sim, page):
    def drive():
        def arrives():
            page.say('drive', robot='/', linear=0.5, angular=0.0)
            return page.truth()[0] > 0.2

        page.wait(arrives)

    play(sim, page, drive)
    assert sim.truth.x > 0.2
    assert page.of('driver')[0]['client'].startswith('page ')
    page.wait(lambda: page.of('simulation')[-1]['state'] == 'paused')


def test_a_page_pauses_steps_and_resets(sim, page):
    def act():
        answers = [
            page.asked('step', simulator=SIMULATOR, steps=3),
            page.asked('pause', simulator=SIMULATOR),
        ]
        before = sim.time
        answers.append(page.asked('step', simulator=SIMULATOR, steps=3))
        passed = sim.time - before
        answers += [
            page.asked('set_factor', simulator=SIMULATOR, factor=0.5),
            page.asked('set_factor', simulator=SIMULATOR, factor=-1.0),
            page.asked('reset_simulation', simulator=SIMULATOR),
        ]
        page.asked('set_factor', simulator=SIMULATOR, factor=1.0)
        return passed, answers

    sim.run(0.5)
    passed, answers = play(sim, page, act)
    assert passed == pytest.approx(3 * sim.timestep)
    assert answers == [
        (False, 'time is running; it is stepped while it is paused'),
        (True, 'paused'),
        (True, '3 steps made'),
        (True, 'the real-time factor is 0.5'),
        (
            False,
            'a real-time factor is 0, as fast as possible, to 1000, not -1',
        ),
        (True, 'reset'),
    ]
    assert sim.time == 0.0
    page.newest('reset')


def test_what_cannot_be_done_says_so_in_one_line(page):
    place = {'position': [0, 0, 0], 'yaw': 0}
    for kind, fields, words in (
        ('switch', {'robot': '/', 'activate': [], 'deactivate': []}, "'switch' needs ROS"),
        ('delete', {'simulator': SIMULATOR, 'name': 'amr'}, 'sim.spawn, sim.remove'),
        ('place', {'simulator': SIMULATOR, 'name': 'amr', **place}, 'by the program'),
        ('start_recording', {'topics': []}, 'sim.record'),
        ('parameters', {'node': '/x'}, '`bringup simulation` starts one over ROS'),
    ):
        is_done, line = page.asked(kind, **fields)
        assert not is_done
        assert words in line
        assert '\n' not in line
    page.say('set_joints', robot='/', positions={'a': 0.0})
    assert 'to move joints needs ROS' in page.newest('notice')['text']


def test_stop_holds_the_robot_whoever_drives_it(sim, page):
    page.say('press_stop', robot='/')
    page.wait(lambda: any(each['robots'] for each in page.of('emergency_stop')))
    sim.drive(0.5, 0.0, seconds=0.5, stop=False)
    assert sim.truth.x == pytest.approx(0.0, abs=0.01)
    assert page.newest('emergency_stop')['robots'][0]['is_locked']
    page.say('release', robot='/')
    page.wait(lambda: not page.of('emergency_stop')[-1]['robots'])
    sim.run(0.05)
    sim.drive(0.5, 0.0, seconds=0.5)
    assert sim.truth.x == pytest.approx(0.25, abs=0.03)


def test_a_page_pushes_a_robot_and_lets_it_go(sim, page):
    def act():
        def moves():
            push = {'simulator': SIMULATOR, 'entity': 'amr', 'link': 'base_link'}
            page.say('push', **push, force=[0.0, 600.0, 0.0], torque=[0.0, 0.0, 0.0])
            return page.truth()[1] > 0.02

        page.wait(moves)

    play(sim, page, act)
    assert sim.truth.y > 0.02


def test_robots_come_and_go():
    with Simulation(URDF, robots={'a': Transform()}) as sim:
        sim.run(0.1)
        with ShownPage(sim.show(port=0).url) as page:
            page.wait(lambda: math.isfinite(page.truth('/a')[0]))
            sim.spawn('b', Transform((0.0, 2.0, 0.0)))
            sim.run(0.1)
            page.wait(lambda: page.truth('/b')[1] == pytest.approx(2.0, abs=0.01))
            frames = [each['name'] for each in page.newest('layout')['frames']]
            assert 'b/base_link' in frames
            sim.remove('a')
            sim.step()
            page.wait(lambda: [e['id'] for e in page.of('graph')[-1]['robots']] == ['/b'])


def test_a_page_shows_what_sensors_see():
    with (
        Simulation(ROOT / 'urdf' / 'amr_sensors.urdf.xacro', world='walls') as sim,
        ShownPage(sim.show(port=0).url) as page,
    ):
        sim.step()
        sensors = {each['topic']: each['kind'] for each in page.newest('graph')['sensors']}
        page.say('watch', parts=[], topics=[*sensors])

        def shown():
            sim.step()
            return {head['type'] for head, _ in page.samples} == {'scan', 'picture'}

        page.wait(shown)
        scan = next(each for each in page.samples if each[0]['type'] == 'scan')
        assert scan[0]['count'] == len(sim.scan.ranges)
        assert len(scan[1]) == 4 * scan[0]['count']
        picture = next(each for each in page.samples if each[0]['type'] == 'picture')
        assert picture[1].startswith(b'\x89PNG')


def test_a_notebook_on_this_host_shows_it_as_a_frame(shared):
    _, page = shared
    assert f'<iframe src="{page.url}"' in page._repr_html_()
    policy = request(page.url).headers['Content-Security-Policy']
    assert policy.endswith('frame-ancestors http://localhost:* http://127.0.0.1:*')
    assert urlsplit(page.url).hostname == '127.0.0.1'
    assert request(page.url, Host='evil.example').status == 421


def test_a_token_is_asked_for_where_there_is_one():
    with Simulation(URDF) as sim:
        url = sim.show(port=0, token=True).url
        assert '?token=' in url
        assert request(url.partition('?')[0]).status == 403


def test_the_page_ends_with_the_simulation():
    with Simulation(URDF) as sim:
        page = sim.show(port=0)
        assert sim.show() is page
    with pytest.raises(ConnectionRefusedError):
        request(page.url)
    with pytest.raises(SimulationError, match='inside its block'):
        sim.show()


def test_play_ends_by_itself_after_some_time(sim):
    sim.play(0.1)
    assert 0.02 < sim.time < 0.2
    with pytest.raises(SimulationError, match='a time not below 0'):
        sim.play(-1.0)


def test_who_shows_nothing_imports_nothing_of_it():
    found = run(f"""
import sys
from amr_description import Simulation
from amr_description.controllers.drives.diff_drive_controller import DiffDriveController
with Simulation({str(URDF)!r}) as sim:
    sim.drive(0.1, 0.0, seconds=0.1)
print([name for name in sys.modules if name.startswith(('websockets', 'asyncio.base_events',
    'amr_description.viewer', 'amr_description.simulation.shown'))])
""")
    assert found == '[]\n'


def test_without_websockets_one_line_says_what_to_install():
    found = run(f"""
import sys
sys.modules['websockets'] = None
from amr_description import Simulation
from amr_description.controllers.drives.diff_drive_controller import DiffDriveController
from amr_description.errors import SimulationError
with Simulation({str(URDF)!r}) as sim:
    try:
        sim.show()
    except SimulationError as error:
        print(error)
""")
    assert (
        found == 'show() serves a page, and needs websockets: python -m pip install websockets\n'
    )


class OwnDiffDriveController(DiffDriveController):
    """One that knows nothing of ``emergency_stop``."""

    def inputs(self):
        return tuple(each for each in super().inputs() if 'emergency' not in each.port.name)


def test_stop_commands_a_robot_to_stand_that_has_no_lock(tmp_path):
    text = (ROOT / 'config' / 'controllers.yaml').read_text()
    own = f'type: {__name__}/OwnDiffDriveController'
    controllers = tmp_path / 'controllers.yaml'
    controllers.write_text(text.replace('type: diff_drive_controller/DiffDriveController', own))
    with Simulation(URDF, controllers) as sim, ShownPage(sim.show(port=0).url) as page:
        page.newest('layout')
        sim.drive(0.5, 0.0, seconds=0.5, stop=False)
        page.say('press_stop', robot='/')
        page.wait(lambda: any(each['robots'] for each in page.of('emergency_stop')))
        assert not page.newest('emergency_stop')['robots'][0]['is_locked']
        before = sim.truth.x
        sim.run(0.4)  # without a command it would drive on for 0.5 s
        assert before > 0.2
        assert sim.truth.x == pytest.approx(before, abs=0.1)


def test_what_a_page_asked_too_late_does_not_act_when_it_plays_again(sim, shared):
    acted = []
    shared[1]._backend.calls.put(lambda: acted.append(sim._playing.is_on))
    sim.run(0.1)
    sim.play(0.05)
    assert acted == [False]
