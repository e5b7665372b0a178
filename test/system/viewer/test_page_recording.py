# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bags and the page, in a real browser: one that is shown, one that is recorded, one played."""

from bisect import bisect_right
from contextlib import contextmanager
from math import atan2, dist
from pathlib import Path
import signal

from ament_index_python.packages import get_package_prefix
from fixtures.cli.commands import ros2, started
import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from support.drive_bag import LENGTH, pose_at, write_drive
from support.page import Page
from support.paths import ROOT
from support.running_programs import Program
from support.waiting import until

from amr_description.bag.playback import PlaybackOptions
from amr_description.bag.reader import BagReader
from amr_description.bag.recording import BagRecording
from amr_description.bag.ros.player import Player, PlayerOptions
from amr_description.ros.readers import ODOMETRY
from amr_description.testing.program import own_domain

AUDIT = (ROOT / 'test' / 'support' / 'page_audit.js').read_text()
DRAWN = 'new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))'
BRINGUP = Path(get_package_prefix('amr_description'), 'lib', 'amr_description', 'bringup')
SMALL = {'width': 640, 'height': 480}
"""A scene that is drawn by the processor costs as much as it has pixels."""
PART = (2.0, 5.0)
"""s of the drive: where the part begins that is played, and how long it is."""
OTHERS = 20
"""More messages than come in some seconds by other topics than the one that is published."""
HEARD = {'/tf', '/tf_static', '/odom', '/robot_description', '/joint_states'}
"""Topics of a bag of which each page shows something."""


@pytest.fixture(scope='module')
def drive(tmp_path_factory):
    return write_drive(tmp_path_factory.mktemp('bags') / 'drive')


@contextmanager
def viewer(*words, **parameters):
    given = [f'{name}:={value}' for name, value in {'port': 0, **parameters}.items()]
    flags = [word for each in given for word in ('-p', each)]
    with Program.module('viewer', *words, '--ros-args', *flags) as program:
        yield program.expect(r'The page is at (http://\S+)')[1]
        assert program.end(signal.SIGINT) == 0
        assert 'Traceback' not in program.output


@pytest.fixture(scope='module')
def bags(tmp_path_factory):
    """Where the viewer of the graph records."""
    return tmp_path_factory.mktemp('recorded')


@pytest.fixture(scope='module')
def graph_viewer(bags):
    with own_domain(), viewer(bag_folder=bags) as url:
        yield url


def shown(page):
    """Where the page shows the robot, m and rad; None: nowhere."""
    pose = page.evaluate('amr.now.scene.pose')
    return pose and (pose['x'], pose['y'], pose['yaw'])


def await_at(page, x, y, within=1e-3):
    """Wait until the page shows the robot there, m."""
    page.wait_until(
        f'Math.hypot(amr.now.scene.pose.x - {x}, amr.now.scene.pose.y - {y}) < {within}'
    )


def is_at(page, seconds):
    x, y, turn = pose_at(seconds)
    await_at(page, x, y)
    return shown(page)[2] == pytest.approx(turn, abs=1e-3)


def test_a_bag_is_scrubbed_forwards_and_backwards(browser, drive):
    with viewer('--bag', drive) as url:
        page = browser.open(url, **SMALL)
        page.wait_until('amr.now.samples > 500')  # all of it is plotted at once
        assert page.evaluate('amr.now.recording') == 'drive'
        assert is_at(page, 0.0)
        page.evaluate("document.querySelector('canvas.scene').focus()")  # as after a click into it
        press(page, 'ArrowRight')
        assert is_at(page, 1.0)
        press(page, 'Home')
        assert is_at(page, 0.0)
        press(page, 'End')
        assert is_at(page, LENGTH)
        press(page, 'ArrowLeft')
        assert is_at(page, LENGTH - 1)
        slide(page, 3.5)
        assert is_at(page, 3.5)
        assert trails(page) == trails(page, after='Home')
        press(page, 'Space', ' ')
        page.wait_until('amr.now.place > 0.5')
        assert not page.evaluate("document.querySelector('.stop').checkVisibility()")
        page.evaluate(f'{AUDIT};0')
        for width, height in ((1280, 760), (390, 780), (780, 390)):
            page.look_like(width, height, phone=width < 1000)
            page.evaluate(DRAWN)
            faults = page.evaluate('auditPage.faults()')
            assert [each for each in faults if 'STOP' not in each] == []
        assert page.errors == []
        page.close()


def press(page, code, key=None):
    page.key_down(code, key or code)
    page.key_up(code, key or code)


def slide(page, seconds):
    page.evaluate(
        f"""(() => {{
          const slider = document.querySelector('.time-line input');
          slider.value = {seconds};
          slider.dispatchEvent(new Event('input', {{ bubbles: true }}));
        }})()"""
    )


def trails(page, after=None):
    """The points of the trails; those of a recording stay as they are."""
    if after is not None:
        press(page, after)
        assert is_at(page, 0.0)
    return page.evaluate('JSON.stringify(amr.now.scene.trails)')


def test_a_page_records_and_another_one_stops(browser, graph_viewer, bags):
    with started('topic', 'pub', '-r', '50', '/chatter', 'std_msgs/msg/String', 'data: hello'):
        page = browser.open(graph_viewer, webgl=False, **SMALL)
        page.wait_until("amr.now.link === 'open'")
        page.click('.recorder button')
        page.wait_until('amr.now.writing')
        with Page(graph_viewer) as other:
            assert other.wait(lambda: other.last('bag_writing'))['active']
            page.close()
            other.wait(lambda: other.last('bag_writing')['messages'] > 20 + OTHERS)
            refused = other.ask('start_recording', 1, topics=[])
            assert not refused['ok']
            assert 'is recorded already' in refused['message']
            stopped = other.ask('stop_recording', 2)
            assert stopped['ok'], stopped['message']
            assert not other.last('bag_writing')['active']
    (folder,) = bags.iterdir()
    assert str(folder) in stopped['message']
    with BagReader(folder) as reader:
        assert not reader.is_rebuilt  # it was completed
        assert sum(1 for _ in reader.messages(['/chatter'])) > 20


@pytest.mark.long
def test_a_drive_that_is_trimmed_and_played_is_seen(browser, graph_viewer, drive, tmp_path):
    begin, length = PART
    part = tmp_path / 'part'
    options = ('--start-offset', str(begin), '--duration', str(length))
    assert ros2('bag', 'trim', str(drive), '-o', str(part), *options).returncode == 0
    page = browser.open(graph_viewer, **SMALL)
    page.wait_until("amr.now.link === 'open'")
    with played(part) as play_until:
        for each in range(1, 11):
            place = length * each / 10
            play_until(place)
            assert is_at(page, begin + place)
    assert page.errors == []
    page.close()


@contextmanager
def played(bag):
    """
    Play a bag beside the page: a call plays it up to a time after its begin, s, and waits there.

    Messages come at once, as of `ros2 bag burst`, so that nothing depends on how fast a page is.
    """
    options = PlayerOptions(PlaybackOptions(start_paused=True))
    with BagReader(bag) as reader, in_context() as node:
        times = [each.log_time for each in reader.messages()]
        player = Player(node, BagRecording([reader]), options)
        try:
            for each in node.publishers:
                if each.topic_name in HEARD:
                    until(each.get_subscription_count)
            player.start()
            count = 0

            def play_until(place):
                nonlocal count
                before, count = count, bisect_right(times, times[0] + round(place * 1e9))
                assert player.burst(count - before) == count - before

            yield play_until
        finally:
            player.end()


@contextmanager
def in_context():
    """A node in the domain of the environment."""
    context = Context()
    rclpy.init(args=[], context=context)
    node = Node('rosbag2_player', context=context)
    try:
        yield node
    finally:
        node.destroy_node()
        context.try_shutdown()


@pytest.mark.long
def test_a_drive_in_the_simulator_is_what_the_page_shows_of_its_bag(browser, tmp_path):
    """Recorded on the page, trimmed to 5 s, then played beside it, and scrubbed without ROS."""
    with own_domain(), Program(BRINGUP, 'simulation', 'viewer:=false') as stack:
        stack.expect('ready in')
        with viewer(bag_folder=tmp_path) as url:
            record_drive(browser, url)
        assert stack.end(signal.SIGINT) == 0
    (bag,) = tmp_path.iterdir()
    part = tmp_path / 'part'
    assert ros2('bag', 'trim', str(bag), '-o', str(part), '--duration', '5').returncode == 0
    begin, times, truths = truths_of(part)
    assert dist(truths[0][:2], truths[-1][:2]) > 0.5

    def truth_at(place):
        return truths[bisect_right(times, begin + round(place * 1e9)) - 1]

    with own_domain(), viewer() as url:
        page = browser.open(url, width=1280, height=760)
        page.wait_until("amr.now.link === 'open'")
        with played(part) as play_until:
            for each in range(1, 11):
                play_until(each * 0.45)
                await_at(page, *truth_at(each * 0.45)[:2])
        page.close()
    with viewer('--bag', part) as url:
        page = browser.open(url, width=1280, height=760)
        page.wait_until('amr.now.samples > 100')
        for place in (4.5, 1.0, 3.25):
            slide(page, place)
            page.wait_until(f'Math.abs(amr.now.place - {place}) < 1e-3')
            await_at(page, *truth_at(place)[:2], within=1e-2)
        page.close()


def record_drive(browser, url):
    page = browser.open(url, width=1280, height=760)
    page.wait_until("amr.now.link === 'open' && amr.now.robot && amr.now.states > 5")
    page.click('.recorder button')
    page.wait_until('amr.now.writing')
    begin = shown(page)
    page.key_down('KeyW')
    page.key_down('KeyA')
    page.wait_until(
        f'Math.hypot(amr.now.scene.pose.x - {begin[0]}, amr.now.scene.pose.y - {begin[1]}) > 1.0'
    )
    page.key_up('KeyA')
    page.wait_until(f'amr.now.time > {page.evaluate("amr.now.time") + 3}')
    page.key_up('KeyW')
    page.click('.recorder button')
    page.wait_until('amr.now.writing === null')
    assert page.errors == []
    page.close()


def truths_of(bag):
    """The begin of the bag, ns; when, ns, and where the robot truly was, m and rad."""
    times, truths = [], []
    with BagReader(bag) as reader:
        for message in reader.messages(['/ground_truth/odom']):
            x, y, *_, z, w = ODOMETRY.read(message.data)[:7]
            times.append(message.log_time)
            truths.append((x, y, 2 * atan2(z, w)))
        return reader.metadata.starting_time, times, truths
