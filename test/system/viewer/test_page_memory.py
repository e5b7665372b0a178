# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page that is left open over a long drive: its memory ends somewhere."""

from math import cos, sin

from fixtures.sim.driving import AMR
import pytest
from test_viewer_pages import Backend, serving

from amr_description.viewer.protocol import (
    Command,
    FrameInfo,
    Graph,
    Layout,
    RobotInfo,
    RobotLayout,
)
from amr_description.viewer.ros.description import describe_robot
from amr_description.viewer.states import StateFrame

HOUR = 3600.0  # s
PERIOD = 1.0  # s of simulated time between two states
EVERY = 200
"""A state at rest is sent once in so many periods."""
STAGE = 600.0  # s of simulated time that any machine sends within a test's patience
RADIUS = 5.0  # m
SPEED = 0.5  # m/s
MOST_POINTS = 2 * 1024  # of a trail where the processor draws
MOST_SAMPLES = 300 * 60  # of the plots
MOST_GROWTH = 1_000_000
"""Bytes. Held on to, the bare frames of an hour are 1.5 MB."""
LEAST_SHARE = 0.35
"""Of the states, that the page takes: one that is slow is not sent all."""


class LongDrive(Backend):
    """A robot that goes in circles which wander off: no two are the same."""

    def __init__(self):
        super().__init__()
        self.time = 0.0
        self.end = 0.0
        described = describe_robot('/', AMR)
        joints = tuple(joint.name for joint in described.message.joints)
        layout = Layout(
            1,
            (FrameInfo('base_footprint', 'odom'),),
            (RobotLayout('/', joints, joints),),
        )
        self.frame = StateFrame(layout)
        command = Command('/cmd_vel', 'geometry_msgs/msg/TwistStamped')
        topics = ('/odom', '/ground_truth/odom', '/ground_truth/wheels', '/joint_states')
        robot = RobotInfo('/', described.name, command, *topics, None, None)
        self.known = (Graph((robot,), (), None), described.message, layout)
        self.count = 0

    def open(self):
        self.new = self.known

    def take_state(self):
        new, self.new = self.new, ()
        self.count += 1
        if self.time < self.end:
            self.time += PERIOD
            self.drive_on()
        elif self.count % EVERY:  # else its memory were full of states that the page has not read
            return new, None
        return new, self.frame.encode(self.count, self.time)

    def drive_on(self):
        angle = SPEED / RADIUS * self.time
        x = RADIUS * sin(angle) + 0.01 * self.time
        y = RADIUS * (1 - cos(angle))
        (robot,) = self.frame.robots
        turn = (0.0, 0.0, sin(angle / 2), cos(angle / 2))
        self.frame.poses[0] = (x, y, 0.0, *turn)
        robot.odometry[:] = (x, y, 0.0, *turn, SPEED, SPEED / RADIUS, 0.0)
        robot.truth[:] = (0.99 * x, y, 0.0, *turn, SPEED, SPEED / RADIUS, 0.0)
        for each in (robot.positions, robot.velocities, robot.commanded):
            each[:] = angle
        robot.command[:] = (SPEED, SPEED / RADIUS, 0.0)
        robot.wheels[:] = (1.0, 17.0, 0.0, 0.01 * sin(self.time))

    def until(self, page, end):
        """Go on until a simulated time, and leave the page at rest there."""
        while self.end < end:
            self.end = min(self.end + STAGE, end)
            page.wait_until(f'amr.now.time > {self.end} - {PERIOD} / 2')


@pytest.fixture
def drive():
    return LongDrive()


def bytes_of(page):
    """What the page's script holds on to, its buffers too."""
    for _ in range(2):  # what the first one lets go may have held others
        page.call('HeapProfiler.collectGarbage')
    usage = page.call('Runtime.getHeapUsage')
    return usage['usedSize'] + usage['backingStorageSize']


@pytest.mark.parametrize('hours', [1, pytest.param(4, marks=pytest.mark.long)])
def test_the_memory_of_a_page_ends_somewhere(browser, drive, hours):
    """What it holds on to after that time is what it holds on to after twice the time."""
    half = hours * HOUR
    with serving(drive, rate=2000.0) as server:
        page = browser.open(server.url, width=800, height=320)
        page.wait_until("amr.now.link === 'open' && amr.now.scene.frames > 0")
        drive.until(page, half)
        bytes_before, kept = bytes_of(page), page.evaluate('amr.now')
        drive.until(page, 2 * half)
        bytes_after, now = bytes_of(page), page.evaluate('amr.now')
        page.close()
    assert now['states'] > kept['states'] + LEAST_SHARE * half / PERIOD
    assert kept['samples'] <= now['samples'] <= MOST_SAMPLES
    for points in (*kept['scene']['trails']['/'], *now['scene']['trails']['/']):
        assert MOST_POINTS / 2 < points <= MOST_POINTS
    assert bytes_after - bytes_before < MOST_GROWTH
    assert now['notices'] == 0
    assert page.errors == []
