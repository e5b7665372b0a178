# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When the messages of a recording are due, with a clock that the test sets."""

from bisect import bisect_left

import pytest

from amr_description.bag.playback import BagPlayback, PlaybackOptions
from amr_description.bag.storage import BagMessage

MS = 10**6
BEGIN = 1_700_000_000 * 10**9


def message(after, topic='/a'):
    return BagMessage(topic, b'', BEGIN + after * MS, BEGIN + after * MS)


class Recording:
    """Messages at these times, in ms; those of ``latched`` before a time are latched."""

    def __init__(self, *times, latched=()):
        self.all = [message(each) for each in times]
        self.latched = [message(each, '/latched') for each in latched]
        self.start = BEGIN
        self.read = 0

    def messages(self, start):
        for each in self.all[bisect_left([m.log_time for m in self.all], start) :]:
            self.read += 1
            yield each

    def latched_before(self, time):
        return [each for each in self.latched if each.log_time < time]


class Player:
    """Plays with a clock that goes on only while nothing is due."""

    def __init__(self, recording, **options):
        self.time = 0
        self.playback = BagPlayback(recording, PlaybackOptions(**options), lambda: self.time)

    def due(self):
        """Return after how many ms each message of now was recorded."""
        taken = []
        while (found := self.playback.poll()) is not None:
            taken.append((found.log_time - BEGIN) // MS)
        return taken

    def play(self, for_ms=10_000):
        """Return (ms of the steady clock, ms of the recording) of all that is played."""
        end = self.time + for_ms * MS
        played = []
        while True:
            played += [(self.time // MS, each) for each in self.due()]
            wait = self.playback.wait_time()
            if wait is None or self.time + wait > end:
                self.time = end if wait is not None else self.time
                return played
            self.time += wait


@pytest.mark.parametrize(
    ('rate', 'times'), [(1.0, (0, 100, 300)), (2.0, (0, 50, 150)), (0.1, (0, 1000, 3000))]
)
def test_messages_are_due_at_the_times_of_the_recording_by_the_rate(rate, times):
    player = Player(Recording(0, 100, 300), rate=rate)
    assert player.play() == list(zip(times, (0, 100, 300), strict=True))
    assert player.playback.finished


class Runs(Recording):
    """In which times begin again."""

    def messages(self, start):
        yield from self.all[[m.log_time for m in self.all].index(start) :]


def test_the_next_run_is_played_with_its_own_times():
    player = Player(Runs(0, 300, 100, 200))
    assert player.play() == [(0, 0), (300, 300), (300, 100), (400, 200)]
    assert (player.playback.resets, player.playback.begin) == (1, BEGIN + 100 * MS)
    assert player.playback.finished


def test_what_is_late_does_not_delay_what_follows():
    player = Player(Recording(0, 100, 300))
    assert player.due() == [0]
    player.time = 250 * MS
    assert player.due() == [100]
    assert player.playback.wait_time() == 50 * MS


def test_a_change_of_rate_takes_effect_between_two_messages():
    player = Player(Recording(0, 100))
    player.due()
    player.time = 50 * MS
    assert player.playback.clock.set_rate(10.0)
    assert player.playback.wait_time() == 5 * MS
    for wrong in (0.0, -1.0, float('nan'), float('inf')):
        assert not player.playback.clock.set_rate(wrong)
    assert player.playback.clock.rate == 10.0


@pytest.mark.parametrize(('rate', 'is_due'), [(1e308, True), (1e-308, False)])
def test_the_fastest_and_the_slowest_rate(rate, is_due):
    player = Player(Recording(0, 100_000), rate=rate)
    player.due()
    assert player.playback.wait_time() >= 0
    player.time = 10**12 * MS
    assert bool(player.due()) == is_due


def test_a_delay_comes_once():
    player = Player(Recording(0, 100), delay=500 * MS, loop=True)
    assert player.play(for_ms=650) == [(500, 0), (600, 100), (600, 0)]
    assert player.playback.loops == 1


def test_time_stands_at_the_begin_until_it_is_played():
    player = Player(Recording(0, 100), delay=50 * MS)
    player.time = 40 * MS
    assert player.playback.now() == BEGIN
    player.play(for_ms=20)
    assert player.playback.now() == BEGIN + 10 * MS


def test_a_loop_of_nothing_ends():
    player = Player(Recording(0, 100), loop=True, until=BEGIN - 1)
    assert player.play() == []
    assert player.playback.finished


def test_time_stands_while_paused():
    player = Player(Recording(0, 100, 200))
    player.due()
    player.time = 40 * MS
    player.playback.clock.pause()
    player.time = 5000 * MS
    assert player.due() == []
    assert player.playback.wait_time() is None
    assert player.playback.clock.now() == BEGIN + 40 * MS
    player.playback.clock.resume()
    assert player.play() == [(5060, 100), (5160, 200)]


def test_the_end_waits_for_a_pause():
    player = Player(Recording(0), start_paused=True)
    assert player.playback.play_next() is not None
    assert player.playback.play_next() is None
    assert player.due() == []
    assert not player.playback.finished
    player.playback.clock.resume()
    player.due()
    assert player.playback.finished


def test_next_plays_one_message_and_takes_time_along():
    player = Player(Recording(0, 100, 200), start_paused=True, delay=10 * MS)
    assert player.playback.play_next() == message(0)
    assert player.playback.play_next() == message(100)
    assert player.playback.clock.now() == BEGIN + 100 * MS
    player.playback.clock.resume()
    assert player.playback.play_next() is None
    assert player.play() == [(100, 200)]


@pytest.mark.parametrize(
    ('options', 'played'),
    [
        ({'start_offset': 100 * MS}, [100, 200, 300]),
        ({'start_offset': 150 * MS}, [200, 300]),
        ({'duration': 200 * MS}, [0, 100, 200]),
        ({'duration': 100 * MS, 'start_offset': 100 * MS}, [100, 200]),
        ({'duration': 0}, []),
        ({'until': BEGIN + 150 * MS}, [0, 100]),
        ({'until': 0}, []),
        ({'until': BEGIN + 250 * MS, 'duration': 100 * MS}, [0, 100, 200]),
        ({'until': BEGIN + 50 * MS, 'duration': 100 * MS}, [0, 100]),
    ],
)
def test_begin_and_end(options, played):
    player = Player(Recording(0, 100, 200, 300), **options)
    assert [each for _, each in player.play()] == played
    assert player.playback.finished


def test_an_offset_is_not_waited_for():
    assert Player(Recording(0, 100), start_offset=60 * MS).play() == [(40, 100)]


def test_seeking_goes_there_and_back():
    player = Player(Recording(0, 100, 200))
    player.due()
    player.playback.seek(BEGIN + 150 * MS)
    assert player.play(for_ms=40) == []
    assert player.due() == []
    player.playback.seek(0)  # before the begin
    assert player.play() == [(40, 0), (140, 100), (240, 200)]
    player.playback.seek(BEGIN)
    assert player.playback.finished


def test_seeking_beyond_the_end_ends_it():
    player = Player(Recording(0, 100))
    player.playback.seek(BEGIN + 101 * MS)
    assert player.play() == []
    assert player.playback.finished


def test_what_was_latched_before_is_played_at_once_though_paused():
    player = Player(Recording(0, 100, latched=(10, 90)), start_offset=50 * MS, start_paused=True)
    assert player.due() == [10]
    player.playback.seek(BEGIN + 95 * MS)
    assert player.due() == [10, 90]
    player.playback.clock.resume()
    assert player.play() == [(5, 100)]


def test_no_more_is_read_ahead_than_asked_for():
    recording = Recording(*range(0, 1000, 100))
    player = Player(recording, read_ahead=3)
    player.due()
    while player.playback.read_ahead():
        pass
    assert recording.read == 4
    assert [each for _, each in player.play()] == [*range(100, 1000, 100)]
    assert not player.playback.read_ahead()


def test_it_is_played_again_after_its_end_only():
    player = Player(Recording(0, 100))
    again = PlaybackOptions(start_offset=50 * MS)
    assert not player.playback.play(again)
    player.play()
    assert player.playback.play(again)
    assert player.play() == [(150, 100)]


def test_stopping_ends_it_at_once():
    player = Player(Recording(0, 100))
    player.playback.stop()
    assert player.due() == []
    assert player.playback.wait_time() is None
    assert player.playback.play_next() is None
