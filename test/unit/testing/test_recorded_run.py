# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which bags can be run again, and what of them differs."""

from contextlib import contextmanager
from dataclasses import replace
from types import SimpleNamespace

import pytest
from support.small_bags import string

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.run_description import RunDescription, RunRobot, TOPIC, TYPE
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError
from amr_description.testing import replay
from amr_description.testing.recorded_run import (
    Delay,
    delays,
    Difference,
    differences,
    digest,
    read_run,
)

MS = 10**6
ROBOT = RunRobot('amr', '/', (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), '<robot name="amr"/>')
RUN = RunDescription(robots=(ROBOT,), commands=('/say',)).to_text()
BEGIN = [(0, TOPIC, RUN), (0, '/clock', ''), (10, '/clock', '')]


def bag(folder, *parts):
    """Write a bag of (ms, topic, text), a file for each part; its topics are all of String."""
    with BagWriter(folder) as writer:
        for name in {each[1]: None for part in parts for each in part}:
            writer.add_topic(TopicMetadata(name, TYPE))
        for number, part in enumerate(parts):
            if number:
                writer.split()
            for time, name, text in part:
                writer.write(BagMessage(name, string(text), time * MS, time * MS))
    return folder


def test_the_last_part_is_run_and_stops_where_it_is_commanded(tmp_path):
    part = [*BEGIN, (10, '/say', 'a'), (10, '/say', 'b'), (20, '/clock', ''), (20, '/heard', 'c')]
    run = read_run(bag(tmp_path / 'bag', [(0, '/heard', 'before')], part))
    assert [(each.time, [m.data for _, m in each.commands]) for each in run.instants] == [
        (10 * MS, ['a', 'b']),
        (20 * MS, []),
    ]
    assert (run.seconds, run.commands) == (0.02, 2)
    assert run.messages['/heard'] == [(20 * MS, digest(string('c')))]
    assert TOPIC not in run.messages


def test_it_stops_where_a_step_has_ended_between_two_cycles(tmp_path):
    times = [0, 4, 8, 12, 13, 16, 20, 24]
    part = [BEGIN[0], *((time, '/clock', '') for time in times)]
    run = read_run(bag(tmp_path / 'bag', part))
    assert [each.time // MS for each in run.instants] == [13, 24]


@pytest.mark.parametrize(
    ('part', 'why'),
    [
        (BEGIN[1:], '/mujoco_sim/run is not in it; record by the parameter'),
        (BEGIN[:1], 'no time has passed in it'),
        ([BEGIN[0], BEGIN[2]], r'begins at 0\.01 s .* reset the simulation while it records'),
        ([*BEGIN, (20, TOPIC, RUN)], r'at 0\.02 s robots were spawned or controllers switched'),
        ([(0, TOPIC, RunDescription().to_text()), *BEGIN[1:]], 'there is no robot in it'),
    ],
)
def test_what_cannot_be_run_again_is_refused_with_the_reason(tmp_path, part, why):
    with pytest.raises(BagError, match=why):
        read_run(bag(tmp_path / 'bag', part))


@pytest.mark.parametrize('name', [TOPIC, '/say', '/amr/controller_manager/activity'])
def test_a_broken_message_is_refused_with_its_place(tmp_path, name):
    types = dict.fromkeys((TOPIC, '/clock', '/say'), TYPE)
    types['/amr/controller_manager/activity'] = (
        'controller_manager_msgs/msg/ControllerManagerActivity'
    )
    with BagWriter(tmp_path / 'bag') as writer:
        for each, kind in types.items():
            writer.add_topic(TopicMetadata(each, kind))
        for _, each, text in BEGIN:
            writer.write(BagMessage(each, string(text), 0, 0))
        writer.write(BagMessage(name, b'\0\1\0\0\xff\xff\0\0', 0, 0))
    with pytest.raises(BagError, match=f'bag_0.mcap: the message of {name} at 0 s is broken'):
        read_run(tmp_path / 'bag')


def test_a_line_says_why_a_bag_is_not_run(tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        replay.main(['--help'])
    assert end.value.code == 0
    assert capsys.readouterr().out.startswith('usage: replay [-h]')
    assert replay.main([str(tmp_path / 'none')]) == 1
    assert capsys.readouterr().err.startswith('replay: ')
    taken = bag(tmp_path / 'bag', BEGIN)
    assert replay.main([str(taken), '-o', str(taken)]) == 1
    assert capsys.readouterr().err == (
        f'replay: --output {taken}: it is there already; another name will do\n'
    )


def test_the_first_difference_of_each_topic_is_found(tmp_path):
    run = read_run(bag(tmp_path / 'bag', [*BEGIN, (10, '/heard', 'a'), (20, '/heard', 'b')]))
    assert differences(run, run) == []
    heard = [(10 * MS, digest(string('a'))), (20 * MS, digest(string('c')))]
    other = replace(run, messages={'/heard': heard, '/clock': []})
    assert differences(run, other) == [
        Difference('/clock', 0, 2, 2),
        Difference('/heard', 20 * MS, 1, 2),
    ]
    assert delays(run, other) == []


def test_pictures_that_were_only_late_or_left_out_in_real_time_are_no_difference(tmp_path):
    run = read_run(bag(tmp_path / 'bag', [*BEGIN, (12, '/heard', 'a'), (30, '/heard', 'c')]))
    waited = [
        (time * MS, digest(string(text))) for time, text in ((10, 'a'), (20, 'b'), (30, 'c'))
    ]
    again = replace(run, messages={**run.messages, '/heard': waited})
    # What no thread measures has no reason to be late.
    assert run.delayed == frozenset()
    assert differences(run, again) == [Difference('/heard', 10 * MS, 3, 3)]
    assert delays(run, again) == []
    run, again = (replace(each, delayed=frozenset({'/heard', '/none'})) for each in (run, again))
    assert differences(run, again) == []
    assert delays(run, again) == [Delay('/heard', late=1, left_out=1)]
    # The other way round it is one: time has waited, and there is less.
    assert differences(again, run) == [Difference('/heard', 10 * MS, 3, 3)]
    assert delays(again, run) == []


def test_topics_of_cameras_and_lidars_may_be_delayed(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        for name, kind in (('/image', 'Image'), ('/scan', 'LaserScan'), ('/imu', 'Imu')):
            writer.add_topic(TopicMetadata(name, f'sensor_msgs/msg/{kind}'))
        for time, name, text in BEGIN:
            writer.add_topic(TopicMetadata(name, TYPE))
            writer.write(BagMessage(name, string(text), time * MS, time * MS))
        writer.write(BagMessage('/image', b'x' * 10**6, 0, 0))
    run = read_run(tmp_path / 'bag')
    assert run.delayed == {'/image', '/scan'}
    ((_, kept),) = run.messages['/image']
    assert len(kept) == 16, 'a bag of pictures may be larger than memory'


def test_a_bag_is_read_once_and_what_was_delayed_is_said(tmp_path, monkeypatch, capsys):
    taken, read = bag(tmp_path / 'bag', [*BEGIN, (10, '/heard', 'a')]), []

    @contextmanager
    def simulated(run, folder, rtf, record):
        bag(record, [*BEGIN, (5, '/heard', 'a')])
        yield SimpleNamespace(replay=lambda given: read.append(given is run))

    def read_and_note(path):
        read.append(path)
        return replace(read_run(path), delayed=frozenset({'/heard'}))

    monkeypatch.setattr(replay, 'read_run', read_and_note)
    monkeypatch.setattr(replay, 'simulation_of', simulated)
    assert replay.main([str(taken), '-o', str(tmp_path / 'again')]) == 0
    assert read == [taken, True, tmp_path / 'again']
    assert capsys.readouterr().out.splitlines()[1:] == [
        '/heard: 1 messages were later in real time, 0 left out',
        'equal, byte for byte but for these: 3 messages',
    ]
