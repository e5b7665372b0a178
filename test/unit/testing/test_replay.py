# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the executable ``replay`` says."""

from contextlib import contextmanager
from dataclasses import replace
from types import SimpleNamespace

import pytest
from support.small_bags import string

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.run_description import RunDescription, RunRobot, TOPIC, TYPE
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.simulation.recorded_run import read_run
from amr_description.testing import replay

MS = 10**6
ROBOT = RunRobot('amr', '/', (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), '<robot name="amr"/>')


def bag(folder, heard):
    """Write a run of 10 ms, in which a message is heard at ``heard``, ms."""
    run = RunDescription(robots=(ROBOT,)).to_text()
    told = [(0, TOPIC, run), (0, '/clock', ''), (heard, '/heard', 'a'), (10, '/clock', '')]
    with BagWriter(folder) as writer:
        for name in (TOPIC, '/clock', '/heard'):
            writer.add_topic(TopicMetadata(name, TYPE))
        for time, name, text in told:
            writer.write(BagMessage(name, string(text), time * MS, time * MS))
    return folder


def test_a_line_says_why_a_bag_is_not_run(tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        replay.main(['--help'])
    assert end.value.code == 0
    assert capsys.readouterr().out.startswith('usage: replay [-h]')
    assert replay.main([str(tmp_path / 'none')]) == 1
    assert capsys.readouterr().err.startswith('replay: ')
    taken = bag(tmp_path / 'bag', 10)
    assert replay.main([str(taken), '-o', str(taken)]) == 1
    assert capsys.readouterr().err == (
        f'replay: --output {taken}: it is there already; another name will do\n'
    )


def test_a_bag_is_read_once_and_what_was_delayed_is_said(tmp_path, monkeypatch, capsys):
    taken, read = bag(tmp_path / 'bag', 10), []

    @contextmanager
    def simulated(_, run, folder, rtf, record):
        bag(record, 5)
        yield SimpleNamespace(replay=lambda given: read.append(given is run))

    def read_and_note(path, _=None):
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
