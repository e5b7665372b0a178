# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Sensors on the page in a real browser: where they are drawn, and when they are wanted at all."""

from dataclasses import replace
from math import pi
import threading

import numpy as np
import pytest
import simplejpeg
from support.running_programs import PATIENCE
from test_page_memory import LongDrive
from test_viewer_pages import serving

from amr_description.viewer.protocol import (
    Contacts,
    Distance,
    Origin,
    Picture,
    Scan,
    SensorInfo,
)
from amr_description.viewer.samples import encode_sample, Sample

SENSORS = (
    SensorInfo('/camera/image', '/', 'picture', 'sensor_msgs/msg/Image'),
    SensorInfo('/bumper', '/', 'contacts', 'ros_gz_interfaces/msg/Contacts'),
    SensorInfo('/scan', '/', 'scan', 'sensor_msgs/msg/LaserScan'),
    SensorInfo('/sonar', '/', 'range', 'sensor_msgs/msg/Range'),
)
FRAME = 'base_footprint'


def origin(topic, time):
    return Origin(topic, FRAME, time, 10.0)


def scan(time, ranges):
    head = Scan(origin('/scan', time), -pi, pi / 2, 0.1, 8.0, len(ranges))
    return Sample('/scan', encode_sample(head, [np.array(ranges, '<f4')]))


def picture(time, data=None):
    head = Picture(origin('/camera/image', time), 'image/jpeg', 'rgb8', 64, 48, None, None)
    file = simplejpeg.encode_jpeg(np.full((48, 64, 3), 200, 'u1')) if data is None else data
    return Sample('/camera/image', encode_sample(head, [file]))


class Sensors(LongDrive):
    """A robot that drives, and what it measures: the samples in ``made`` for the time of one."""

    def __init__(self):
        super().__init__()
        graph, *rest = self.known
        self.known = (replace(graph, sensors=SENSORS), *rest)
        self.made = ()
        self._shown = frozenset()
        self._changed = threading.Condition()

    def watch(self, watched):
        with self._changed:
            self._shown = watched.sensors
            self._changed.notify_all()

    def wait_shown(self, *topics):
        """Wait until pages show these sensors, and no others."""
        with self._changed:
            assert self._changed.wait_for(lambda: self._shown == {*topics}, PATIENCE), self._shown

    def take_samples(self, wanted):
        return [sample for each in self.made for sample in [each(self.time)]
                if ('sensor', sample.topic) in wanted]  # fmt: skip


@pytest.fixture(scope='module')
def served(browser):
    """A robot with sensors, after some seconds of driving, and its page."""
    robot = Sensors()
    with serving(robot, rate=20.0) as server:
        page = browser.open(server.url, width=1000, height=320)
        page.wait_until("amr.now.link === 'open' && amr.now.scene.frames > 0")
        robot.show(page, 15)
        yield robot, page
        assert page.errors == []
        page.close()
        assert server.logged.empty()


@pytest.fixture
def robot(served):
    served[0].made = ()
    return served[0]


@pytest.fixture
def page(served):
    """The page; of its sensors the scan is shown, and nothing in a panel."""
    page = served[1]
    page.click('#tab-model')
    served[0].wait_shown('/scan')
    return page


def flip(page, *topics):
    for topic in topics:
        page.evaluate(f"""document.querySelector('[aria-label="Show {topic}"]').click()""")


def test_a_scan_is_drawn_where_its_frame_was(page, robot):
    """Rays along -x, -y, x and y of a robot that goes in circles, seen in the world."""
    robot.made = (lambda time: scan(time, [1.0, 2.0, 3.0, 4.0, np.inf, np.nan, 99.0, 0.01]),)
    page.wait_until("amr.now.scene.sensors['/scan']?.points === 4")
    extent = np.array(page.evaluate("amr.now.scene.sensors['/scan'].extent"))
    x, y, _, *turn = robot.frame.robots[0].truth[:7]
    yaw = 2 * np.arctan2(turn[2], turn[3])
    angles = yaw + np.array([-pi, -pi / 2, 0, pi / 2])
    points = np.array([x, y]) + ([1, 2, 3, 4] * np.array([np.cos(angles), np.sin(angles)])).T
    assert extent[[0, 1]] == pytest.approx(points.min(axis=0), abs=1e-3)
    assert extent[[3, 4]] == pytest.approx(points.max(axis=0), abs=1e-3)


def test_pictures_are_wanted_while_their_panel_is_seen(page, robot):
    robot.made = (picture,)
    page.click('#tab-sensors')
    flip(page, '/camera/image')
    robot.wait_shown('/camera/image', '/scan')
    page.wait_until("amr.now.pictures['/camera/image'] > 1")
    robot.made = (lambda time: picture(time, b'no picture'),)
    sensed = page.evaluate('amr.now.sensed')
    page.wait_until(f'amr.now.sensed > {sensed} + 3')
    robot.made = (picture,)
    drawn = page.evaluate("amr.now.pictures['/camera/image']")
    page.wait_until(f"amr.now.pictures['/camera/image'] > {drawn}")
    page.click('#tab-model')
    robot.wait_shown('/scan')
    flip(page, '/camera/image')


def test_what_is_measured_is_said(page, robot):
    page.click('#tab-sensors')
    flip(page, '/sonar', '/bumper')
    robot.wait_shown('/scan', '/sonar', '/bumper')
    sonar = Distance(origin('/sonar', 0.0), 0.5, 0.1, 4.0)
    places = np.array([[1, 0, 0, 0, 0, 1]], '<f4')
    robot.made = (
        lambda _: Sample('/sonar', encode_sample(sonar, [np.array([1.25], '<f4')])),
        lambda time: Sample(
            '/bumper', encode_sample(Contacts(origin('/bumper', time), ()), [places])
        ),
        lambda time: scan(time, [1.0, np.inf]),
    )
    text = "document.querySelector('#panel-sensors').innerText"
    for words in ('1.250 m', 'touches nothing', '2 rays · nearest 1.00 m', '10 Hz'):
        page.wait_until(f'{text}.includes({words!r})')
    flip(page, '/sonar', '/bumper')


def test_a_page_behind_other_tabs_wants_nothing(browser, page, robot):
    other = browser.open('about:blank')
    robot.wait_shown()
    other.close()
    robot.wait_shown('/scan')


def test_a_sensor_that_goes_is_drawn_no_more(page, robot):
    robot.made = (lambda time: scan(time, [1.0]),)
    page.wait_until("amr.now.scene.sensors['/scan']?.points === 1")
    graph = robot.known[0]
    robot.new = (replace(graph, sensors=SENSORS[:2]),)
    page.wait_until("!('/scan' in amr.now.scene.sensors)")
    robot.wait_shown()
    robot.new = (graph,)
    robot.wait_shown('/scan')
