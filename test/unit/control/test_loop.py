# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The control loop: what happens in a cycle, in which order, and at exactly which time."""

from itertools import pairwise
import random

import pytest
from support.control_fakes import collect, FakeController, FakeLog, make_manager, MS, output, start

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop
from amr_description.control.resource_manager import ResourceManager
from amr_description.errors import SimulationError


class Outside:
    """All four collaborators of the loop, recording (event, time)."""

    def __init__(self):
        self.diary = []
        self.time = 0
        self.lateness = lambda: 0
        self.queue = []
        self.while_pacing = []
        """What others ask for before the instant is due, one list each time."""
        self.while_paused = []
        """What other threads ask for, one list a wait."""

    def advance(self, period):
        assert period > 0
        self.time += period + self.lateness()
        self.diary.append(('advance', self.time))
        return self.time

    def pace(self, time):
        self.diary.append(('pace', time))
        if not self.while_pacing:
            return True
        self.queue += self.while_pacing.pop(0)
        return False

    def resume(self, time):
        self.diary.append(('resume', time))

    def take(self):
        taken, self.queue = self.queue, []
        return taken

    def wait(self):
        self.diary.append(('wait', self.time))
        assert self.while_paused, 'it would wait for ever'
        self.queue += self.while_paused.pop(0)

    def set_clocks(self, time):
        self.diary.append(('clocks', time))

    def publish(self, time):
        self.diary.append(('publish', time))

    def times(self, what):
        return [time for event, time in self.diary if event == what]


class Ticking(ControllerManager):
    """Records its ticks and resets."""

    def __init__(self, rate, diary, name='tick'):
        self.diary, self.name = diary, name
        super().__init__(ResourceManager(FakeLog()), rate, FakeLog())

    def tick(self, time):
        self.diary.append((self.name, time))
        super().tick(time)

    def reset(self, time):
        self.diary.append(('reset', time))
        super().reset(time)

    def set_clock(self, time):
        self.diary.append(('set_clock', time))
        super().set_clock(time)


@pytest.fixture
def outside():
    return Outside()


@pytest.fixture
def loop(outside):
    loop = Loop(outside, outside, outside, outside, clock_period=10 * MS)
    loop.managers.append(Ticking(100, outside.diary))
    return loop


def turn(loop, count):
    for _ in range(count):
        loop.run_once()


# --- time ----------------------------------------------------------------------------------------


def test_every_manager_ticks_exactly_at_the_multiples_of_its_period(outside, loop):
    """500, 100, 30 and 7 Hz: the latter two divide no second, and still never drift."""
    rates = (500, 30, 7)
    loop.managers += [Ticking(rate, outside.diary, str(rate)) for rate in rates]
    while loop.time < 20 * NANOSECONDS:
        loop.run_once()
    for name, rate in (('tick', 100), *((str(rate), rate) for rate in rates)):
        period = round(NANOSECONDS / rate)
        assert outside.times(name) == list(range(0, 20 * NANOSECONDS, period))
    assert all(type(time) is int for _, time in outside.diary)


def test_the_clock_comes_at_its_own_period_also_without_a_manager(outside):
    loop = Loop(outside, outside, outside, outside, clock_period=4 * MS)
    turn(loop, 5)
    assert outside.times('publish') == [0, 4 * MS, 8 * MS, 12 * MS, 16 * MS]


def test_clock_and_managers_of_different_periods(outside):
    loop = Loop(outside, outside, outside, outside, clock_period=4 * MS)
    loop.managers.append(Ticking(100, outside.diary))
    turn(loop, 8)
    assert outside.times('publish') == [t * MS for t in (0, 4, 8, 10, 12, 16, 20, 24)]
    assert outside.times('tick') == [0, 10 * MS, 20 * MS]


@pytest.mark.parametrize('seed', range(5))
def test_a_world_that_is_late_costs_ticks_but_not_the_grid(outside, loop, seed):
    dice = random.Random(seed)
    outside.lateness = lambda: dice.choice((0, 0, 1, 3 * MS, 25 * MS))
    turn(loop, 500)
    ticks = outside.times('tick')
    assert ticks == outside.times('publish')
    for before, after in pairwise(ticks):
        assert after // (10 * MS) > before // (10 * MS)
    outside.lateness = lambda: 0
    outside.diary.clear()
    turn(loop, 5)
    assert all(time % (10 * MS) == 0 for time in outside.times('tick')[1:])


def test_a_manager_that_joins_later_ticks_at_once_and_then_on_its_grid(outside, loop):
    turn(loop, 3)
    outside.queue.append(lambda: loop.managers.append(Ticking(40, outside.diary, 'late')))
    turn(loop, 5)
    assert outside.times('late') == [30 * MS, 50 * MS]
    assert outside.times('tick') == [t * MS for t in range(0, 80, 10)]


def test_a_manager_that_leaves_is_not_ticked_again(outside, loop):
    turn(loop, 2)
    outside.queue.append(loop.managers.clear)
    turn(loop, 3)
    assert outside.times('tick') == [0, 10 * MS]
    assert outside.times('publish') == [0, 10 * MS, 20 * MS, 30 * MS, 40 * MS]


# --- the order within a turn ---------------------------------------------------------------------


def test_a_cycle(outside, loop):
    outside.queue.append(lambda: outside.diary.append(('command', loop.time)))
    loop.run_once()
    assert outside.diary == [
        ('command', 0),
        ('clocks', 0),
        ('tick', 0),
        ('publish', 0),
        ('advance', 10 * MS),
        ('pace', 10 * MS),
    ]


def test_samples_are_published_in_the_same_cycle_after_the_clock(outside):
    loop = Loop(outside, outside, outside, outside, clock_period=10 * MS)
    manager, controller, port = make_manager(), FakeController(), output()
    controller.update = lambda time, period: port.send(('sent', time))
    port.sink = outside.diary.append
    start(manager, controller)
    loop.managers.append(manager)
    loop.run_once()
    assert [what for what, _ in outside.diary[:3]] == ['clocks', 'sent', 'publish']


def test_an_output_without_a_node_drops_samples():
    port = output()
    port.send(1)
    sent = collect(port)
    port.send(2)
    assert sent == [2]


def test_all_managers_of_an_instant_tick_before_anything_is_published(outside, loop):
    loop.managers.append(Ticking(100, outside.diary, 'other'))
    loop.run_once()
    assert [what for what, _ in outside.diary[:4]] == ['clocks', 'tick', 'other', 'publish']


def test_calls_run_oldest_first_and_a_switch_counts_in_the_same_cycle(outside):
    loop = Loop(outside, outside, outside, outside, clock_period=10 * MS)
    manager, controller = make_manager(), FakeController()
    outside.queue += [lambda: loop.managers.append(manager), lambda: start(manager, controller)]
    loop.run_once()
    assert controller.updates == [(0, 10 * MS)]


# --- run, stop -----------------------------------------------------------------------------------


def test_run_resumes_the_pacer_and_runs_until_it_is_stopped(outside, loop):
    tick = Ticking.tick

    def stop_at_30(manager, time):
        tick(manager, time)
        if time == 30 * MS:
            outside.queue.append(loop.stop)

    loop.managers[0].tick = lambda time: stop_at_30(loop.managers[0], time)
    loop.run()
    assert outside.diary[0] == ('resume', 0)
    assert outside.times('tick') == [0, 10 * MS, 20 * MS, 30 * MS]
    assert loop.time == 40 * MS


def test_stop_before_the_first_cycle(outside, loop):
    outside.queue.append(loop.stop)
    loop.run()
    assert outside.diary == [('resume', 0)]


def test_stop_while_paused(outside, loop):
    outside.queue.append(loop.pause)
    outside.while_paused = [[], [loop.stop]]
    loop.run()
    assert outside.times('tick') == []
    assert outside.times('wait') == [0, 0]


def test_calls_after_a_stop_are_still_made(outside, loop):
    """Somebody waits for the answer."""
    made = []
    outside.queue += [loop.stop, lambda: made.append(1)]
    loop.run()
    assert made == [1]


def test_a_call_that_is_queued_while_pacing_runs_at_once_and_the_pace_goes_on(outside, loop):
    outside.while_pacing = [[lambda: outside.diary.append(('command', loop.time))]]
    turn(loop, 1)
    at = 10 * MS
    assert outside.diary[-3:] == [('pace', at), ('command', at), ('pace', at)]


@pytest.mark.parametrize('request_', ['stop', 'pause'])
def test_a_stop_and_a_pause_end_the_pacing(outside, loop, request_):
    outside.while_pacing = [[getattr(loop, request_)]]
    turn(loop, 1)
    assert outside.diary[-1] == ('pace', 10 * MS)
    assert outside.times('pace') == [10 * MS]


# --- pause, resume -------------------------------------------------------------------------------


def test_while_paused_time_stands_still_and_is_published(outside, loop):
    turn(loop, 3)
    outside.queue.append(loop.pause)
    outside.while_paused = [[], [], []]
    outside.diary.clear()
    turn(loop, 3)
    assert not loop.is_running
    at = 30 * MS
    assert outside.diary == [('clocks', at), ('publish', at), ('wait', at)] * 3


def test_a_call_that_is_queued_while_paused_runs_at_once(outside, loop):
    outside.queue.append(loop.pause)
    outside.while_paused = [[lambda: outside.diary.append(('command', loop.time))], []]
    turn(loop, 2)
    what = [event for event, _ in outside.diary]
    assert what[what.index('wait') + 1] == 'command'
    assert outside.times('tick') == outside.times('advance') == []


def test_a_switch_works_while_paused_and_counts_from_the_first_tick(outside, loop):
    controller = FakeController()
    outside.queue.append(loop.pause)
    outside.while_paused = [[lambda: start(loop.managers[0], controller)], [loop.resume]]
    turn(loop, 4)
    assert controller.updates == [(0, 10 * MS), (10 * MS, 10 * MS)]


def test_after_resume_no_tick_is_lost_or_repeated_and_the_pacer_resumes(outside, loop):
    turn(loop, 3)
    outside.queue.append(loop.pause)
    outside.while_paused = [[], [loop.resume]]
    turn(loop, 5)
    assert loop.is_running
    assert outside.times('tick') == [t * MS for t in (0, 10, 20, 30, 40, 50)]
    assert outside.times('resume') == [30 * MS]
    resumed = outside.diary.index(('resume', 30 * MS))
    assert outside.diary[resumed + 1 : resumed + 3] == [('clocks', 30 * MS), ('tick', 30 * MS)]


def test_resume_while_running_does_not_disturb_the_pace(outside, loop):
    outside.queue.append(loop.resume)
    turn(loop, 2)
    assert outside.times('resume') == []


def test_pause_and_resume_in_one_go_lose_nothing(outside, loop):
    turn(loop, 2)
    outside.queue += [loop.pause, loop.resume]
    turn(loop, 2)
    assert outside.times('wait') == []
    assert outside.times('tick') == [0, 10 * MS, 20 * MS, 30 * MS]


# --- step ----------------------------------------------------------------------------------------


def paused(outside, loop, *while_paused):
    """Return a loop that starts paused, and gets one of ``while_paused`` at each wait."""
    outside.queue.append(loop.pause)
    outside.while_paused = [[command] for command in while_paused]


@pytest.mark.parametrize('period', [1, 2, 9, 10, 11, 25, 60])
def test_a_step_is_as_long_as_asked_ticks_what_is_due_and_is_not_paced(outside, loop, period):
    missing = []
    paused(outside, loop, lambda: loop.step(period * MS, missing.append), lambda: None)
    while not missing:
        loop.run_once()
    assert (missing, loop.time) == ([0], period * MS)
    assert outside.times('tick') == list(range(0, period * MS, 10 * MS))
    assert outside.times('pace') == []
    assert not loop.is_running
    assert outside.diary[-1] == ('publish', period * MS)  # published before the end is reported


@pytest.mark.parametrize('seed', range(10))
def test_many_steps_tick_at_the_same_times_as_a_running_loop(outside, loop, seed):
    dice = random.Random(seed)
    loop.managers.append(Ticking(30, outside.diary, '30'))
    paused(outside, loop)
    outside.while_paused = [[] for _ in range(200)]
    loop.run_once()
    end = 0
    while end < 500:
        length = dice.randint(1, 40)
        end += length
        loop.step(length * MS, lambda missing: None)
        while loop.is_stepping:
            loop.run_once()
    assert loop.time == end * MS
    for name, rate in (('tick', 100), ('30', 30)):
        assert outside.times(name) == list(range(0, end * MS, round(NANOSECONDS / rate)))


def test_what_arrives_between_two_steps_counts_in_the_second(outside, loop):
    controller = FakeController()
    paused(
        outside,
        loop,
        lambda: loop.step(10 * MS, lambda missing: None),
        lambda: start(loop.managers[0], controller),
        lambda: loop.step(10 * MS, lambda missing: None),
    )
    turn(loop, 5)
    assert controller.updates == [(10 * MS, 10 * MS)]


@pytest.mark.parametrize('request_', ['stop', 'pause', 'resume', 'reset', 'set_clock'])
def test_an_interrupted_step_ends_with_the_missing_time(outside, loop, request_):
    missing = []
    paused(outside, loop, lambda: loop.step(50 * MS, missing.append))
    turn(loop, 3)
    assert loop.time == 20 * MS
    outside.queue.append(getattr(loop, request_))
    outside.while_paused = [[]]
    turn(loop, 1)
    assert missing == [30 * MS]
    assert not loop.is_stepping
    assert loop.is_running is (request_ == 'resume')


def test_no_step_while_time_runs_or_another_step_is_made(outside, loop):
    with pytest.raises(SimulationError, match='time is running; it is stepped while it is paused'):
        loop.step(10 * MS, print)
    loop.pause()
    loop.step(10 * MS, lambda missing: None)
    with pytest.raises(SimulationError, match='10000000 ns of another step'):
        loop.step(10 * MS, print)


def test_a_step_of_nothing_is_done_at_once(loop):
    missing = []
    loop.pause()
    loop.step(0, missing.append)
    assert (missing, loop.is_stepping) == ([0], False)


# --- reset ---------------------------------------------------------------------------------------


def test_after_a_reset_managers_start_over_at_once(outside, loop):
    controller = start(loop.managers[0], FakeController())
    turn(loop, 5)

    def reset():
        outside.time = 0
        loop.reset()

    outside.queue.append(reset)
    outside.diary.clear()
    turn(loop, 3)
    assert outside.diary[:4] == [('clocks', 0), ('reset', 0), ('resume', 0), ('clocks', 0)]
    assert outside.times('tick') == [0, 10 * MS, 20 * MS]
    assert [time for time, _ in controller.updates[5:]] == [0, 10 * MS, 20 * MS]
    assert {period for _, period in controller.updates} == {10 * MS}


def test_a_jump_of_the_clock_is_passed_on_in_the_same_order(outside, loop):
    turn(loop, 2)
    outside.queue.append(lambda: (setattr(outside, 'time', 50_000 * MS), loop.set_clock()))
    outside.diary.clear()
    turn(loop, 2)
    assert outside.diary[:3] == [
        ('clocks', 50_000 * MS), ('set_clock', 50_000 * MS), ('resume', 50_000 * MS)
    ]  # fmt: skip
    assert outside.times('tick') == [50_000 * MS, 50_010 * MS]


def test_a_reset_while_paused_stays_paused_and_the_clock_goes_back(outside, loop):
    def reset():
        outside.time = 0
        loop.reset()

    turn(loop, 3)
    outside.queue.append(loop.pause)
    outside.while_paused = [[reset], []]
    turn(loop, 2)
    assert not loop.is_running
    assert outside.times('publish')[-1] == 0
    assert outside.times('tick') == [0, 10 * MS, 20 * MS]


def standing():
    """A loop that stands, and its outside."""
    outside = Outside()
    loop = Loop(outside, outside, outside, outside, clock_period=10 * MS)
    loop.managers.append(Ticking(100, outside.diary))
    loop.pause()
    return outside, loop


@pytest.mark.parametrize('period', [0, 1, 7, 10, 25])
def test_a_period_is_stepped_through_as_cycle_by_cycle(period):
    """In one call, for who is on the control thread himself."""
    (one, at_once), (other, by_cycles) = standing(), standing()
    missing = []
    by_cycles.step(period * MS, missing.append)
    while by_cycles.is_stepping:
        by_cycles.run_once()
    assert at_once.step_through(period * MS) == missing[0] == 0
    assert one.diary == other.diary


def test_a_call_may_end_a_period_that_is_stepped_through():
    outside, loop = standing()
    outside.queue.append(lambda: outside.queue.append(loop.pause))
    assert loop.step_through(25 * MS) == 15 * MS
    assert not loop.is_stepping
