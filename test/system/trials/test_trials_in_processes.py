# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Trials in processes of this machine, some of which hang and die; and their command."""

from concurrent.futures import ThreadPoolExecutor
import json
import multiprocessing
import os
from pathlib import Path
import re
import shlex
import signal
import subprocess
import sys

import pytest
from support.paths import ROOT
from support.running_programs import Program
from support.waiting import until

from amr_description.trials import command as trials_command, runner
from amr_description.trials.function import TrialFunction
from amr_description.trials.one_run import Ending
from amr_description.trials.report import TrialsReport
from amr_description.trials.runner import trials

FILE = ROOT / 'test' / 'fixtures' / 'trials' / 'drives.py'
COMMAND = [sys.executable, '-m', 'amr_description.trials']
TIMEOUT = 240


def named(name):
    return TrialFunction.named(f'{FILE}:{name}')


def command(*words, cwd=FILE.parent, **options):
    return subprocess.run(
        [*COMMAND, *map(str, words)],
        cwd=cwd,
        text=True,
        capture_output=True,
        timeout=TIMEOUT,
        **options,
    )


def is_there(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_each_end_is_named_in_one_line_and_the_others_go_on():
    report = trials(named('ends'), 1, timeout=8.0, workers=2)
    assert [run.name for run in report.runs] == [f'0.{cell}' for cell in range(9)]
    assert {run.parameters['how']: run.kind for run in report.runs} == {
        'well': Ending.PASSED,
        'raise': Ending.RAISED,
        'fail': Ending.FAILED,
        'nan': Ending.INVALID,
        'object': Ending.INVALID,
        'sleep': Ending.HUNG,
        'loop': Ending.HUNG,
        'kill': Ending.DIED,
        'exit': Ending.DIED,
    }
    messages = {run.parameters['how']: run.message for run in report.runs}
    assert messages['raise'] == 'drives.py:47: ValueError: no way'
    assert messages['fail'] == 'drives.py:49: assert sim.truth.x > 1.0'
    assert messages['nan'] == "it returned NaN as 'error'; a finite number will do"
    assert messages['sleep'] == messages['loop'] == 'not done after 8 s'
    assert messages['kill'] == 'its process ended by SIGKILL'
    assert messages['exit'] == 'its process ended with exit code 3'
    assert all('\n' not in message for message in messages.values())
    assert multiprocessing.active_children() == []


def test_the_report_is_the_same_in_processes_and_in_a_thread():
    with ThreadPoolExecutor(1) as here:
        alone = trials(named('slippery'), 4, executor=here)
    several = trials(named('slippery'), 4, workers=3)
    assert several.digest == alone.digest
    assert [run.bits for run in several.runs] == [run.bits for run in alone.runs]


def test_the_first_failures_are_recorded_and_have_to_repeat(tmp_path, monkeypatch):
    monkeypatch.setattr(runner, 'MOST_BAGS', 2)
    report = trials(named('slippery'), 4, bags=tmp_path / 'bags')
    assert [*report.bags] == [run.name for run in report.bad][:2]
    assert report.unlike == ()
    assert all((path / 'metadata.yaml').exists() for path in report.bags.values())
    once = trials(named('counted'), 4, workers=1, bags=tmp_path / 'none')
    assert [run.name for run in once.bad] == ['1', '3']
    assert '1' in once.unlike
    assert 'it depends on more than its seed' in str(once)


@pytest.mark.long
def test_the_printed_line_fails_in_the_same_step_with_the_same_bits(tmp_path):
    done = command('drives:slippery', '--seeds', 3, '-o', tmp_path / 'out')
    assert done.returncode == 1, done.stderr
    assert done.stdout.startswith('drives:slippery: ')
    report = TrialsReport.from_json((tmp_path / 'out/report.json').read_text(), 'it')
    failed = report.bad[0]
    assert (tmp_path / 'out' / 'bags' / failed.name / 'metadata.yaml').exists()
    line = next(each for each in done.stdout.splitlines() if each.endswith(f'only {failed.name}'))
    program, *words = shlex.split(line)
    assert (program, words[:2]) == ('python', ['-m', 'amr_description.trials'])
    again = command(*words[2:], '-o', tmp_path / 'again')
    assert again.returncode == 1
    (run,) = TrialsReport.from_json((tmp_path / 'again/report.json').read_text(), 'it').runs
    assert run.is_as(failed)
    assert run.step > 0
    for name in ('report.xml', 'report.html'):
        assert failed.message.split(':')[0] in (tmp_path / 'out' / name).read_text()


@pytest.mark.long
def test_shards_are_judged_together(tmp_path, capsys):
    whole = command('drives:slippery', '--seeds', 3, '--at-least', 0.0, '-o', tmp_path / 'whole')
    for number in (1, 2):
        command(
            'drives:slippery', '--seeds', 3, '--shard', f'{number}/2', '-o', tmp_path / f'{number}'
        )
    files = [str(tmp_path / f'{number}' / 'report.json') for number in (1, 2)]
    assert trials_command.main(['--merge', *files, '--at-least', '0.0']) == 0
    merged = capsys.readouterr().out
    assert whole.returncode == 0
    assert re.findall('digest .*', merged) == re.findall('digest .*', whole.stdout) != []
    assert trials_command.main(['--merge', *files, '--at-least', '0.99']) == 1


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        ([f'{FILE}:nothing'], 'there is no function of that name'),
        ([], 'name a trial, as my_module:drive'),
        ([f'{FILE}:quick', '--shard', '9/8'], "'9/8' is no shard"),
        ([f'{FILE}:quick', '--only', 'x'], '--only x names no run'),
        (['--merge', 'none.json'], 'none.json cannot be read: No such file'),
        ([f'{FILE}:quick', '--dask', 'tcp://127.0.0.1:1'], '--dask needs Dask'),
    ],
)
def test_what_cannot_be_run_is_one_line_and_two(words, said, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, 'distributed', None)  # no Dask
    monkeypatch.setitem(sys.modules, FILE.stem, None)  # as it is now, after this test
    del sys.modules[FILE.stem]
    try:
        code = trials_command.main(words)
    except SystemExit as end:
        code = end.code
    assert code == 2
    assert said in capsys.readouterr().err.splitlines()[-1]


def test_the_exit_code_says_what_happened():
    done = command('drives:ends', '--only', '0.7', '--at-least', 0)
    assert 'died 0.7 (how=kill): its process ended by SIGKILL' in done.stdout
    assert done.returncode == 3
    assert command('drives:quick', '--seeds', 3).returncode == 0


@pytest.mark.parametrize(
    ('send', 'sent', 'code'),
    [
        (os.killpg, signal.SIGINT, 130),  # in a terminal it reaches all processes of the group
        (os.kill, signal.SIGTERM, 143),  # as a CI ends a job
    ],
    ids=['ctrl_c', 'sigterm'],
)
def test_an_end_before_time_keeps_what_is_done(tmp_path, send, sent, code):
    out = tmp_path / 'out'
    words = [*COMMAND, 'drives:slow', '--seeds', '500', '--workers', '2', '-o', str(out)]
    with Program(*words, cwd=FILE.parent, terminal=True) as program:
        program.expect('[1-9][0-9]*/500, 0 not passed, [0-9]+ s')
        children = workers_of(program.process.pid)
        send(program.process.pid, sent)
        assert program.end() == code
    assert len(children) == 2
    data = json.loads((out / 'report.json').read_text())
    assert data['was_interrupted']
    assert 0 < len(data['runs']) < data['total'] == 500
    assert f'interrupted: {len(data["runs"])} of 500 runs are done' in program.output
    assert 'Traceback' not in program.output
    until(lambda: not any(map(is_there, children)))


def test_ctrl_c_while_failures_are_recorded_is_said(tmp_path, monkeypatch):
    gather = runner._gathered
    calls = []

    def interrupted(results, total, progress):
        calls.append(total)
        return gather(results, total, progress) if len(calls) == 1 else ({}, True)

    monkeypatch.setattr(runner, '_gathered', interrupted)
    report = trials(named('slippery'), 2, workers=1, bags=tmp_path / 'bags')
    assert report.was_interrupted
    assert len(report.runs) == report.total == 4


def test_processes_end_with_who_started_them():
    words = [*COMMAND, 'drives:slow', '--seeds', '500', '--workers', '2']
    with subprocess.Popen(words, cwd=FILE.parent, stdout=subprocess.DEVNULL) as process:
        children = until(lambda: len(found := workers_of(process.pid)) == 2 and found)
        process.kill()
    until(lambda: not any(map(is_there, children)))


def test_a_script_need_not_ask_whether_it_is_the_main_one(tmp_path):
    """Other processes run it up to where it calls trials()."""
    script = tmp_path / 'script.py'
    script.write_text(
        'from amr_description.trials.runner import trials\n'
        'def draw(simulate, rng):\n    return rng.random()\n'
        "print(trials(draw, seeds=3, workers=2).passed)\nprint('once')\n"
    )
    done = subprocess.run(
        [sys.executable, script], text=True, capture_output=True, timeout=TIMEOUT, check=True
    )
    assert (done.stdout, done.stderr) == ('3\nonce\n', '')


def children_of(pid):
    return [int(each) for each in Path(f'/proc/{pid}/task/{pid}/children').read_text().split()]


def workers_of(pid):
    """The processes that run trials: children of the server that forks them."""
    return [each for child in children_of(pid) for each in children_of(child)]


@pytest.fixture(autouse=True)
def no_process_is_left():
    yield
    assert multiprocessing.active_children() == []
