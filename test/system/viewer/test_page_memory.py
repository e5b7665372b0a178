# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page that is left open over a long drive: its memory ends somewhere."""

from math import cos, inf, sin

from fixtures.sim.driving import AMR
import pytest
from test_viewer_pages import Backend, serving

from amr_description.viewer.description import describe_robot
from amr_description.viewer.protocol import (
    Command,
    FrameInfo,
    Graph,
    Layout,
    RobotInfo,
    RobotLayout,
)
from amr_description.viewer.states import StateFrame

PERIOD = 2.0  # s of simulated time between two states
EVERY = 200
"""A state at rest is sent once in so many periods."""
STAGE = 20  # states that any machine draws within a test's patience
RADIUS = 5.0  # m
SPEED = 0.5  # m/s
MOST_POINTS = 2 * 1024  # of a trail where the processor draws
MOST_SAMPLES = 300 * 60  # of the plots
MOST_GROWTH = 300_000
"""Bytes. Held on to, the bare frames of 1,200 states are 0.5 MB."""
MOST_ROUNDS = 4
"""What a page learns of its own code, compiled, is held on to as well, in steps that end."""


class LongDrive(Backend):
    """
    A robot that goes in circles which wander off: no two are the same.

    It drives until ``end``, s of simulated time, and then rests.
    """

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
        robot = RobotInfo('/', described.name, True, command, *topics, None, None)
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

    def show(self, page, count):
        """
        Go on until the page has had so many more states, and leave it at rest there.

        One that is slow is not sent all: what is between two of its states is then more.
        """
        begin = page.evaluate('amr.now.states')
        self.end = inf
        for shown in range(STAGE, count + STAGE, STAGE):
            page.wait_until(f'amr.now.states >= {begin + min(shown, count)}')
        self.end = self.time
        page.wait_until(f'amr.now.time > {self.end} - {PERIOD} / 2')


@pytest.fixture
def drive():
    return LongDrive()


def bytes_of(page):
    """What the page's script holds on to, its buffers too: one look finds 0.1 MB more or less."""

    def look():
        page.call('HeapProfiler.collectGarbage')
        usage = page.call('Runtime.getHeapUsage')
        return usage['usedSize'] + usage['backingStorageSize']

    return min(look() for _ in range(5))


@pytest.mark.long  # the benchmark of the page watches its heap too
@pytest.mark.parametrize('half', [1200, 14400])
def test_the_memory_of_a_page_ends_somewhere(browser, drive, half):
    """What it holds on to after so many states is what it holds on to after as many more."""
    growth = []
    with serving(drive, rate=2000.0) as server:
        page = browser.open(server.url, width=800, height=320)
        page.wait_until("amr.now.link === 'open' && amr.now.scene.frames > 0")
        drive.show(page, half)
        held, kept = bytes_of(page), page.evaluate('amr.now')
        while not growth or growth[-1] >= MOST_GROWTH and len(growth) < MOST_ROUNDS:
            drive.show(page, half)
            before, held = held, bytes_of(page)
            growth.append(held - before)
        now = page.evaluate('amr.now')
        page.close()
    assert now['states'] >= kept['states'] + half * len(growth)
    assert kept['samples'] <= now['samples'] <= MOST_SAMPLES
    for points in (*kept['scene']['trails']['/'], *now['scene']['trails']['/']):
        assert MOST_POINTS / 2 < points <= MOST_POINTS
    assert growth[-1] < MOST_GROWTH, growth
    assert now['notices'] == 0
    assert page.errors == []
