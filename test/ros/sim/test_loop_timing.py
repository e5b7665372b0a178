# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A loop that cannot keep real time warns, and names the slow stage; by a fake clock."""

from fixtures.sim.driving import Lines
import pytest

from amr_description.control.loop import Loop
from amr_description.sim.ros.loop_timing import LoopProfiler

MILLISECOND = 1_000_000
PERIOD = 10 * MILLISECOND


class Machine:
    """A clock, and the ports of a loop whose stages take given numbers of ms."""

    def __init__(self, factor=1.0, physics=1, controllers=1, publishing=1, kept_from=0):
        self.wall = self.processor = self.time = 0
        self.factor = factor
        self.costs = {
            'physics': physics, 'controllers': controllers, 'publishing': publishing,
        }  # fmt: skip
        self.kept_from = kept_from
        self.start = 0, 0
        self.log = Lines()
        profiler = LoopProfiler(
            self.log,
            self,
            self,
            self,
            clock=lambda: self.wall,
            processor=lambda: self.processor,
        )
        self.loop = Loop(profiler, profiler, self, profiler, PERIOD)

    def work(self, stage):
        spent = self.costs[stage] * MILLISECOND
        self.wall += spent + self.kept_from * MILLISECOND
        self.processor += spent

    def advance(self, period):
        self.work('physics')
        self.time += period

    def set_clocks(self, time):
        self.work('controllers')  # what is between the other stages

    def publish(self, time):
        self.work('publishing')

    def take(self):
        return ()

    def resume(self, time):
        self.start = self.wall, time

    def pace(self, time):
        wall, simulated = self.start
        if self.factor:
            self.wall = max(self.wall, wall + round((time - simulated) / self.factor))
        return True

    def run(self, seconds):
        """Run for so many simulated seconds."""
        for _ in range(round(seconds * 100)):
            self.loop.run_once()


def running(**costs):
    machine = Machine(**costs)
    machine.loop._pacer.resume(0)
    return machine


@pytest.mark.parametrize('factor', [0.5, 1.0, 3.0])
def test_a_loop_that_keeps_real_time_logs_nothing(factor):
    machine = running(factor=factor)
    machine.run(20)
    assert machine.log.lines == []


def test_as_fast_as_possible_is_never_too_slow():
    machine = running(factor=0.0, physics=50)
    machine.run(20)
    assert machine.log.lines == []


@pytest.mark.parametrize(
    'stage, remedy',
    [
        ('physics', 'Most goes to physics: fewer robots or contacts'),
        ('controllers', 'Most goes to controllers and hardware: a lower update_rate'),
        ('publishing', 'Most goes to publishing: fewer topics'),
    ],
)
def test_the_stage_that_takes_the_time_is_named_with_a_remedy(stage, remedy):
    machine = running(**{stage: 18})
    machine.run(3)
    line = machine.log.text.splitlines()[0]
    assert line.startswith('WARN real time is not kept: factor 0.5 instead of 1. Of the time')
    assert ' 90%, ' in line
    assert remedy in line


def test_a_loop_that_is_kept_from_the_processor_blames_the_others():
    machine = running(kept_from=6)
    machine.run(3)
    assert 'has the processor for 14% of the time only: other programs' in machine.log.text


def test_a_single_delay_that_is_caught_up_is_not_logged():
    machine = running()
    for _ in range(5):
        machine.run(2)
        machine.wall += 300 * MILLISECOND  # a robot is spawned
    machine.run(2)
    assert machine.log.lines == []


def test_a_pause_and_another_factor_do_not_count():
    machine = running(physics=1)
    for _ in range(10):
        machine.run(0.7)
        machine.loop.pause()
        machine.wall += 5000 * MILLISECOND
        machine.loop.resume()
    assert machine.log.lines == []
    machine.factor = 100.0  # more than it can do: the window in which it changed is left out
    machine.run(1.0)
    assert machine.log.lines == []
    machine.run(300.0)
    assert 'instead of 100' in machine.log.text


def test_a_factor_that_is_set_later_is_kept_watch_over_from_then_on():
    machine = running(factor=0.0, physics=20)
    machine.run(3.0)
    assert machine.log.lines == []
    machine.factor = 1.0
    machine.run(3.0)
    assert 'Most goes to physics' in machine.log.text
