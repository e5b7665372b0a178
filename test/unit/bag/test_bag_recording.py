# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bags as one recording; keys of a terminal."""

import os
from pathlib import Path
import pty
import select
import sys
import termios
from threading import Event

import pytest
from support.running_programs import PATIENCE
from support.small_bags import BEGIN, LATCHED, MS, text_of, topic, write_bag, write_runs

from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader, runs_of
from amr_description.bag.recording import BagRecording, latched_depth, offer_of, SplitWatch
from amr_description.bag.ros.keyboard import DOWN, keys, names_of, RIGHT, SPACE, UP
from amr_description.bag.storage import FileExtent
from amr_description.errors import BagError
from amr_description.terminal import KeyParser


@pytest.fixture
def recording(tmp_path):
    topics = [topic('/static', LATCHED, LATCHED), topic('/map', LATCHED), topic('/chatter')]
    texts = [
        (0, '/map', 'm0'),
        (1, '/static', 's1'),
        (2, '/static', 's2'),
        (3, '/chatter', 'c'),
        (4, '/map', 'm4'),
        (5, '/static', 's5'),
        (6, '/chatter', 'c'),
    ]
    with BagReader(write_bag(tmp_path / 'bag', topics, texts)) as reader:
        yield BagRecording([reader])


@pytest.mark.parametrize(
    ('after', 'latched'),
    [
        (0, []),
        (2, ['m0', 's1']),
        (4, ['m0', 's1', 's2']),
        (6, ['s2', 'm4', 's5']),
    ],
)
def test_each_publisher_has_latched_what_it_keeps(recording, after, latched):
    found = recording.latched_before(BEGIN + after * MS)
    assert [text_of(message.data) for message in found] == latched


def test_static_transforms_of_one_node_do_not_push_out_those_of_another(tmp_path):
    static = topic('/tf_static', LATCHED, LATCHED, kind='tf2_msgs/msg/TFMessage')
    texts = [(0, '/tf_static', 'of b'), (1, '/tf_static', 'of a'), (2, '/tf_static', 'of a, too')]
    with BagReader(write_bag(tmp_path / 'bag', [static], texts)) as reader:
        found = BagRecording([reader]).latched_before(BEGIN + 3 * MS)
    assert [text_of(message.data) for message in found] == ['of b', 'of a', 'of a, too']


def test_begin_and_end_are_those_of_the_messages(recording):
    assert (recording.start, recording.end) == (BEGIN, BEGIN + 6 * MS)


def test_a_topic_of_two_types_is_refused(tmp_path):
    kinds = ['std_msgs/msg/String', 'std_msgs/msg/Int32']
    bags = [
        write_bag(tmp_path / f'bag{n}', [topic('/chatter', kind=kind)], [])
        for n, kind in enumerate(kinds)
    ]
    readers = [BagReader(bag) for bag in bags]
    with pytest.raises(BagError, match='^/chatter has the type std_msgs/msg/Int32 in .*bag1, but'):
        BagRecording(readers)
    for reader in readers:
        reader.close()


def test_publishers_that_differ_but_in_depth_are_offered_as_they_were():
    best = QosProfile(reliability='best_effort')
    assert offer_of([QosProfile(depth=1, reliability='best_effort'), best]) == best
    assert offer_of([best, QosProfile()]) == QosProfile()
    assert offer_of([]) == QosProfile()
    assert offer_of([LATCHED] * 12).depth == 12
    assert offer_of([QosProfile(history='keep_all')]) == QosProfile()
    assert latched_depth([LATCHED, QosProfile()]) == 1
    assert latched_depth([QosProfile(depth=2**64, durability='transient_local')]) == 100_000


def test_files_follow_each_other_by_their_begins():
    watch = SplitWatch([[(0, 'a'), (10, 'b'), (20, 'c')], [(0, 'alone')]])
    assert watch.pass_time(9) == []
    assert watch.pass_time(10) == [('a', 'b')]
    assert watch.pass_time(11) == []
    assert watch.pass_time(0) == []  # sought
    assert watch.pass_time(25) == [('a', 'b'), ('b', 'c')]


TOPICS = [topic('/map', LATCHED), topic('/chatter')]
DRIVE = ([(5, '/map', 'm'), (7, '/chatter', 'a')], [(2, '/chatter', 'b'), (8, '/chatter', 'c')])


@pytest.fixture
def runs(tmp_path):
    with BagReader(write_runs(tmp_path / 'drive', TOPICS, *DRIVE)) as reader:
        yield BagRecording([reader])


def texts_of(messages):
    return [text_of(each.data) for each in messages]


@pytest.mark.parametrize(
    ('start', 'texts', 'latched'),
    [(5, 'mabc', ''), (6, 'abc', 'm'), (8, 'c', 'm'), (9, '', 'm')],
)
def test_runs_are_played_one_after_the_other(runs, start, texts, latched):
    assert (runs.start, runs.end) == (BEGIN + 5 * MS, BEGIN + 8 * MS)
    start = BEGIN + start * MS
    assert texts_of(runs.messages(start)) == [*texts]
    assert texts_of(runs.latched_before(start)) == [*latched]


def test_files_follow_each_other_in_each_run(runs):
    watch = SplitWatch(runs.splits())
    assert watch.pass_time(BEGIN + 7 * MS) == []
    [(closed, opened)] = watch.pass_time(BEGIN + 2 * MS, 1)
    assert (closed.name, opened.name) == ('drive_0.mcap', 'drive_1.mcap')


def test_runs_of_several_bags_are_merged_run_by_run(tmp_path, runs):
    other = write_runs(tmp_path / 'other', TOPICS, [(6, '/chatter', 'x')], [(0, '/chatter', 'y')])
    with BagReader(tmp_path / 'drive') as first, BagReader(other) as second:
        assert texts_of(BagRecording([first, second]).messages(0)) == [*'mxaybc']


def extent(begin, end, *topics):
    return FileExtent(begin * MS, end * MS, set(topics))


@pytest.mark.parametrize(
    ('extents', 'runs'),
    [
        ([extent(0, 900, 'a'), extent(900, 2000, 'a')], [[0, 1]]),
        ([extent(0, 900, 'a'), extent(850, 2000, 'a')], [[0, 1]]),  # came late to the recorder
        ([extent(0, 900, 'a'), extent(1, 2000, 'a')], [[0], [1]]),
        ([extent(10, 20, 'a'), extent(10, 30, 'a')], [[0], [1]]),
        ([extent(10, 20, 'a'), extent(10, 30, 'b')], [[0, 1]]),  # of two recorders
        ([extent(0, 900, 'a'), None, extent(0, 10, 'a'), extent(10, 20, 'a')], [[0, 1], [2, 3]]),
        ([extent(5, 5, 'a'), extent(5, 5, 'a')], [[0, 1]]),
        ([None], [[0]]),
    ],
)
def test_a_run_begins_where_times_of_a_topic_do_so_again(extents, runs):
    assert [files for *_, files in runs_of(extents)] == runs


@pytest.mark.parametrize(
    ('text', 'names'),
    [
        (' ', [SPACE]),
        ('\x1b[A\x1bOB\x1b[C', [UP, DOWN, RIGHT]),
        ('\x1b[1;2Aq A\x1b[D', [SPACE]),
        ('\x1b', []),
    ],
)
def test_keys_are_found_in_what_a_terminal_sends(text, names):
    assert names_of(text) == names


def test_without_a_terminal_there_are_no_keys(monkeypatch, capsys):
    with Path(os.devnull).open() as stdin:
        monkeypatch.setattr(sys, 'stdin', stdin)
        with keys({}) as are_there:
            assert not are_there
        assert capsys.readouterr().err == ''
        with keys({SPACE: print}) as are_there:
            assert not are_there
    line = 'stdin is not a terminal device. Keyboard handling disabled.\n'
    assert capsys.readouterr().err == line


def test_a_key_comes_at_once_after_a_shell_had_the_terminal(monkeypatch):
    """With Ctrl-Z, `bg` and `fg`, of which the reader need not see anything."""
    master, slave = pty.openpty()
    has_come = Event()
    with open(master, 'wb', buffering=0) as terminal, open(slave) as stdin:
        monkeypatch.setattr(sys, 'stdin', stdin)
        lines = termios.tcgetattr(slave)
        with keys({SPACE: has_come.set}):
            termios.tcsetattr(slave, termios.TCSANOW, lines)
            terminal.write(b' ')
            assert has_come.wait(PATIENCE)
        assert termios.tcgetattr(slave) == lines


def test_a_key_comes_after_a_line_that_the_shell_has_read(monkeypatch):
    """It wakes the reader, too."""
    master, slave = pty.openpty()
    has_come, has_read = Event(), Event()
    wait = select.select

    def woken(sources, *rest):
        ready = wait(sources, *rest)
        if slave in ready[0] and not has_read.is_set():
            termios.tcsetattr(slave, termios.TCSANOW, lines)
            os.read(slave, 9)
            has_read.set()
        return ready

    monkeypatch.setattr(select, 'select', woken)
    with open(master, 'wb', buffering=0) as terminal, open(slave) as stdin:
        monkeypatch.setattr(sys, 'stdin', stdin)
        lines = termios.tcgetattr(slave)
        with keys({SPACE: has_come.set}):
            terminal.write(b'fg\n')
            assert has_read.wait(PATIENCE)
            terminal.write(b' ')
            came = has_come.wait(PATIENCE)
            terminal.write(b'\n')  # for a reader that waits for a line
        assert came


def test_a_key_that_comes_in_two_pieces():
    parser = KeyParser()
    assert names_of('\x1b', parser) == []
    assert names_of('[A', parser) == [UP]
