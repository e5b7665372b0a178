# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The log of events, for programs."""

import io
import json

from fixtures.bringup.running import Bringup, install_toys, STACKS

from amr_description.bringup import Node, Stack, started
from amr_description.bringup.command_line import process_specs
from amr_description.bringup.console import Console
from amr_description.bringup.reporter import Reporter
from amr_description.bringup.run_log import EventLog, json_line, LogFolder

IN_ORDER = str(STACKS / 'in_order.py')


def events_of(bringup):
    """The events of the run, and that their times are in order."""
    lines = (bringup.logs / 'latest/events.jsonl').read_text().splitlines()
    events = [json.loads(line) for line in lines]
    since = [event.pop('since_start') for event in events]
    assert since == sorted(since)
    times = [event.pop('time') for event in events]
    assert abs((times[-1] - times[0]) - (since[-1] - since[0])) < 1.0
    return events


def test_a_run_from_its_begin_to_its_end(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        bringup.expect('ready in')
        bringup.expect(r'\[worker-2\] working')
        bringup.expect(r'\[worker-3\] working')
        pids = bringup.pids()
        events = events_of(bringup)
        assert events[0]['event'] == 'begun'
        assert events[0]['pid'] == bringup.process.pid
        assert events[0]['stack'] == 'in_order'
        of_step = [event for event in events if event.get('node') == 'step-4']
        condition = 'step-5 exited with code 0'
        assert of_step == [
            {'event': 'waiting', 'node': 'step-4', 'condition': condition},
            {'event': 'condition_held', 'node': 'step-4', 'condition': condition},
            {'event': 'started', 'node': 'step-4', 'pid': pids['step-4']},
            {'event': 'exited', 'node': 'step-4', 'pid': pids['step-4'], 'exit_code': 0},
        ]
        assert events[-1]['event'] == 'ready'
        assert bringup.end(2) == 0
        rest = events_of(bringup)[len(events) :]
        assert rest[0] == {'event': 'stop_requested', 'signal': 'SIGINT'}
        sent = {'event': 'signal_sent', 'node': 'worker-3', 'signal': 'SIGINT'}
        assert rest[1] == {**sent, 'pid': pids['worker-3']}
        assert rest[-1] == {'event': 'stopped', 'exit_code': 0}


def test_a_failure_and_its_reason(tmp_path):
    with Bringup(tmp_path, IN_ORDER, 'die_of:=9') as bringup:
        assert bringup.end() == 137
        events = events_of(bringup)
        (exited,) = [e for e in events if (e['event'], e.get('node')) == ('exited', 'step-5')]
        assert exited['signal'] == 'SIGKILL'
        assert 'exit_code' not in exited
        *_, failure, stopped = events
        assert failure['event'] == 'failure'
        assert failure['node'] == 'step-5'
        assert failure['reason'].startswith('stopped because step-5 died of SIGKILL')
        assert stopped == {'event': 'stopped', 'exit_code': 137}


def test_every_listener_gets_every_event_in_order():
    first, second = [], []
    log = EventLog(first.append, second.append)
    log.note('started', 'talker-1', pid=5)
    log.note('ready', seconds=1.5)
    assert first == second
    assert [event['event'] for event in first] == ['started', 'ready']
    assert 'node' not in first[1]


def test_an_event_is_one_line_whatever_it_contains():
    line = json_line({'event': 'failure', 'reason': 'one\ntwo \x1b[31m "ä"'})
    assert '\n' not in line
    assert json.loads(line)['reason'] == 'one\ntwo \x1b[31m "ä"'


def test_a_condition_comes_to_hold_once_however_often_its_node_is_started(tmp_path, monkeypatch):
    install_toys(tmp_path)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    worker = Node('worker', package='toys')
    stack = Stack([worker, Node('step', package='toys', start_when=started(worker))])
    console = Console(io.StringIO(), LogFolder(tmp_path, 'run'), colour=False)
    events = []
    reporter = Reporter(stack, process_specs(stack, tmp_path), console, EventLog(events.append))
    _, step = stack.nodes
    reporter.not_started(step, 'was busy')
    reporter.started(step, 5)
    reporter.started(step, 6)
    assert [event['event'] for event in events if event.get('node') == 'step-2'] == [
        'waiting', 'condition_held', 'not_started', 'started', 'started',
    ]  # fmt: skip
