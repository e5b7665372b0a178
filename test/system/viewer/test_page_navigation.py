# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The page in a real browser, and somebody who navigates: maps and paths, goals and initial poses.

What is given is heard by the test itself, as a navigator hears it.
"""

from math import pi
import signal

import pytest
from support.navigated_robot import (
    cells,
    grid,
    IN_MAP,
    Navigating,
    NavigationServer,
    path,
)
from support.waiting import until
from test_page_in_browser import serving, url_of

from amr_description.model.frames import yaw_of
from amr_description.testing.program import own_domain

DRAWN = 'amr.now.scene.navigation'
BAR = "document.querySelector('.navigation')"
PRESSED = "document.querySelector('.navigation [aria-pressed=true]')"
FEEDBACK = '/navigate_to_pose/_action/feedback'
STOPPED = "document.querySelector('.stop-row.held')"


@pytest.fixture(scope='module')
def graph():
    """The robot, and the address of its page."""
    with own_domain(), Navigating() as robot, serving() as program:
        yield robot, url_of(program)
        assert program.end(signal.SIGINT) == 0
        assert 'Traceback' not in program.output


@pytest.fixture
def robot(graph):
    robot, _ = graph
    robot.goals.clear()
    robot.poses.clear()
    return robot


@pytest.fixture(scope='module')
def tab(browser):
    """A tab for all tests: to load the page again in it costs half as much as in another."""
    page = browser.open('about:blank')
    yield page
    assert page.errors == []
    page.close()


@pytest.fixture
def page(tab, graph):
    """The page as it is when it has been loaded, in which the camera looks at the robot."""
    page = tab
    page.look_like()
    page.go(graph[1])
    page.wait_until(f"{BAR} && {DRAWN}.maps['/map'] && {DRAWN}.paths['/plan'] > 1")
    page.wait_until('Number.isFinite(amr.now.scene.extent[0])')
    frames = page.evaluate('amr.now.scene.frames')
    page.click('.view-tools .button')  # Reset view: the camera looks at the robot, and is drawn
    page.wait_until(f'amr.now.scene.frames > {frames} + 1')
    yield page
    page.let_go()
    assert page.errors == []


def middle(page):
    """Where the middle of the view is: the camera looks at the robot from behind, CSS px."""
    return page.centre_of('.scene')


def drag(page, to):
    """Press in the middle of the view, drag by so many CSS px, and let go."""
    x, y = middle(page)
    page.mouse('mousePressed', x, y)
    page.mouse('mouseMoved', x + to[0] / 2, y + to[1] / 2)
    page.mouse('mouseMoved', x + to[0], y + to[1])
    page.wait_until(f'{DRAWN}.arrows === 1')
    page.mouse('mouseReleased', x + to[0], y + to[1])


def is_at_the_robot(pose):
    """Whether a pose of a message is where the middle of the view meets the ground of the map."""
    x, y = pose.position.x, pose.position.y
    return abs(x - IN_MAP[0]) < 0.05 and 0.0 < y - IN_MAP[1] < 0.8


def heading(pose):
    turn = pose.orientation
    return yaw_of((turn.x, turn.y, turn.z, turn.w))


def test_a_map_and_a_path_are_drawn_and_drawn_anew_when_they_change(page, robot):
    assert page.evaluate(f"{DRAWN}.maps['/map']") == cells().size
    robot.plan.publish(path([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]))
    page.wait_until(f"{DRAWN}.paths['/plan'] === 3")
    smaller = grid()
    smaller.info.height //= 2
    smaller.data = smaller.data[: smaller.info.height * smaller.info.width]
    robot.map.publish(smaller)
    page.wait_until(f"{DRAWN}.maps['/map'] === {cells().size // 2}")
    robot.map.publish(grid())
    robot.plan.publish(path([(0.0, 0.0)] * 60))
    page.wait_until(f"{DRAWN}.maps['/map'] === {cells().size}")
    page.wait_until(f"{DRAWN}.paths['/plan'] === 60")


def test_what_is_not_shown_is_not_subscribed(page, robot):
    until(lambda: robot.count_subscribers('/map'))
    for name, topic in (('Maps', '/map'), ('Paths', '/plan')):
        page.click(f'.view-tools [title^="{name}"]')
        until(lambda topic=topic: robot.count_subscribers(topic) == 0)
        page.click(f'.view-tools [title^="{name}"]')
        until(lambda topic=topic: robot.count_subscribers(topic))


@pytest.mark.long
def test_a_map_that_is_too_large_is_refused_in_one_line(page, robot):
    page.click('#tab-sensors')
    huge = grid()
    huge.info.width, huge.info.height = 5000, 1
    huge.data = [0] * 5000
    robot.map.publish(huge)
    page.wait_until(
        "document.querySelector('#panel-sensors').innerText.match("
        "'a map of 5000 × 1 cells: the page draws 1 to 4096 a side')"
    )
    robot.map.publish(grid())
    page.wait_until(
        "document.querySelector('#panel-sensors').innerText.match('160 × 120 cells of 0.050 m')"
    )
    page.click('#tab-model')


def test_a_goal_is_pressed_where_it_is_and_dragged_to_where_it_looks(page, robot):
    page.click('.navigation [aria-keyshortcuts=G]')
    drag(page, (0, -80))  # away from the camera: as the robot looks
    goal = until(lambda: robot.goals)[0]
    assert goal.header.frame_id == 'map'
    assert is_at_the_robot(goal.pose), goal.pose
    assert abs(heading(goal.pose) - IN_MAP[2]) < 0.05
    page.wait_until("document.querySelector('.goal-words').textContent.match('Goal published')")
    assert page.evaluate(f'{PRESSED} === null'), 'a tool gives one goal'
    page.wait_until(f'{DRAWN}.arrows === 1')  # where the goal is


@pytest.mark.long
def test_a_drag_to_the_side_turns_the_goal(page, robot):
    page.key_down('KeyG')
    page.key_up('KeyG')
    drag(page, (-120, 0))
    (goal,) = until(lambda: robot.goals)
    assert is_at_the_robot(goal.pose)
    turned = abs(heading(goal.pose))
    assert abs(turned - pi) < 0.1, 'to the left of the robot, which looks along y'


def test_a_goal_that_is_only_clicked_looks_the_way_the_robot_comes(page, robot):
    page.key_down('KeyG')
    page.key_up('KeyG')
    x, y = middle(page)
    page.mouse('mousePressed', x, y - 60)
    page.mouse('mouseReleased', x, y - 60)
    (goal,) = until(lambda: robot.goals)
    assert goal.pose.position.y > IN_MAP[1] + 0.2
    assert abs(heading(goal.pose) - pi / 2) < 0.05


def test_an_initial_pose_has_the_covariance_of_rviz(page, robot):
    page.key_down('KeyP')
    page.key_up('KeyP')
    drag(page, (0, -80))
    (pose,) = until(lambda: robot.poses)
    assert pose.header.frame_id == 'map'
    assert is_at_the_robot(pose.pose.pose)
    assert abs(heading(pose.pose.pose) - IN_MAP[2]) < 0.05
    covariance = {at: each for at, each in enumerate(pose.pose.covariance) if each}
    assert covariance == {0: 0.25, 7: 0.25, 35: pytest.approx(0.0685, abs=1e-4)}
    assert robot.goals == []


def test_escape_leaves_the_tool_and_is_no_stop(page, robot):
    page.key_down('KeyG')
    page.key_up('KeyG')
    page.wait_until(PRESSED)
    x, y = middle(page)
    page.mouse('mousePressed', x, y)
    page.wait_until(f'{DRAWN}.arrows > 0')
    page.key_down('Escape')
    page.key_up('Escape')
    page.wait_until(f'{PRESSED} === null')
    page.mouse('mouseReleased', x, y)
    assert page.evaluate(f'{STOPPED} === null')
    page.key_down('Escape')  # without a tool it is STOP, as ever
    page.key_up('Escape')
    page.wait_until(STOPPED)
    page.key_down('KeyG')
    page.key_up('KeyG')
    drag(page, (0, -80))
    page.wait_until("document.body.innerText.match('it takes no goal until it is released')")
    page.click('.release')
    page.wait_until(f'{STOPPED} === null')
    assert robot.goals == []


@pytest.mark.long
def test_on_a_phone_a_finger_gives_the_goal(page, robot):
    page.look_like(390, 844, phone=True)
    page.click('.navigation [aria-keyshortcuts=G]')
    x, y = middle(page)
    points = [[{'x': x, 'y': y - up}] for up in (0, 40, 80)]
    for kind, at in zip(('touchStart', 'touchMove', 'touchMove'), points, strict=True):
        page.call('Input.dispatchTouchEvent', {'type': kind, 'touchPoints': at})
    page.call('Input.dispatchTouchEvent', {'type': 'touchEnd', 'touchPoints': []})
    (goal,) = until(lambda: robot.goals)
    assert is_at_the_robot(goal.pose)
    assert abs(heading(goal.pose) - IN_MAP[2]) < 0.05
    page.look_like()


@pytest.fixture
def server(robot):
    """Who serves the action, beside who hears the topic."""
    server = NavigationServer(robot, '/navigate_to_pose')
    yield server
    server.ends.set()
    server.destroy()
    # Until the page's server knows, it gives goals of the next test by the action.
    until(lambda: not robot.count_subscribers(FEEDBACK))


def words(page, text):
    """Wait until the page says this of the goal."""
    page.wait_until(f"document.querySelector('.goal-words').textContent === '{text}'")


def test_a_goal_by_the_action_is_followed_cancelled_and_stopped(page, robot, server):
    def give():
        known = len(server.goals)
        page.key_down('KeyG')
        page.key_up('KeyG')
        drag(page, (0, -80))
        handle = until(lambda: server.goals[known:] and server.goals[known])
        words(page, '3.2 m to go, 8 s, 2 recoveries')
        return handle

    # The page's server has found it, and has a client: until then goals go by the topic.
    until(lambda: robot.count_subscribers(FEEDBACK))
    handle = give()
    assert handle.request.pose.header.frame_id == 'map'
    assert is_at_the_robot(handle.request.pose.pose)
    server.ends.set()
    words(page, 'Goal reached')
    page.wait_until(f'{DRAWN}.arrows === 0')

    handle = give()
    page.click('.navigation .button')
    until(lambda: handle.is_cancel_requested)
    server.ends.set()
    words(page, 'Goal cancelled')

    handle = give()
    page.key_down('Escape')
    page.key_up('Escape')
    until(lambda: handle.is_cancel_requested)
    server.ends.set()
    words(page, 'Goal cancelled: STOP was pressed')
    page.click('.release')
    page.wait_until(f'{STOPPED} === null')
    assert robot.goals == []


def test_the_tools_are_there_while_somebody_hears_them(page, robot):
    robot.go_deaf()
    page.wait_until(f'{BAR} === null')
    robot.hear()
    page.wait_until(BAR)
