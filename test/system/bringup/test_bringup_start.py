# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The orchestrator with real processes: order, output, failures and log files."""

import os
from pathlib import Path
import re
import signal
import subprocess
import sys

from fixtures.bringup.running import Bringup, STACKS
import pytest
from support.running_programs import ENVIRONMENT, PATIENCE

IN_ORDER = str(STACKS / 'in_order.py')
CHATTY = str(STACKS / 'chatty.py')
OPTIONAL = str(STACKS / 'optional.py')


def test_steps_start_one_after_the_other(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        bringup.expect('ready in .* s: stop with Ctrl-C')
        assert re.findall(r'\[(step-\d)\]: process (started|has fin)', bringup.output) == [
            ('step-5', 'started'),
            ('step-5', 'has fin'),
            ('step-4', 'started'),
            ('step-4', 'has fin'),
            ('step-1', 'started'),
            ('step-1', 'has fin'),
        ]


def test_all_output_of_a_process_precedes_its_end(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        bringup.expect('ready in')
        lines = [line for line in bringup.output.splitlines() if '[step-5]' in line]
        pid = bringup.pids()['step-5']
        assert lines == [
            f'[INFO] [step-5]: process started with pid [{pid}]',
            '[step-5] one',
            '[step-5] the reason',
            '[step-5] rest',
            f'[INFO] [step-5]: process has finished cleanly [pid {pid}]',
        ]


def test_an_unfinished_line_is_shown_even_if_another_process_keeps_the_pipe_open(tmp_path):
    arguments = ['text:=one', 'unfinished:=rest', 'leave_child:=true']
    with Bringup(tmp_path, CHATTY, *arguments) as bringup:
        assert bringup.end() == 0
        assert re.search(
            r'\[step-1\] rest\n\[INFO\] \[step-1\]: process has finished', bringup.output
        )
        assert 'ended what was left: pid' in bringup.output
        assert bringup.left() == []


def test_a_node_gets_the_command_line_that_launch_builds(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        words = ['-z', '0.2', '--ros-args', '-r', '__node:=hand', '-r', '__ns:=/left']
        bringup.expect(re.escape(f'arguments {words}\n'))
        path = bringup.expect(r"'--params-file', '([^']+)'")[1]
        assert 'speed: 1.5' in Path(path).read_text()


def test_a_failed_step_stops_the_rest_and_is_reported_with_its_reason(tmp_path):
    with Bringup(tmp_path, IN_ORDER, 'code:=3') as bringup:
        assert bringup.end() == 3
        died = (
            r'\[ERROR\] \[step-5\]: process has died \[pid \d+, exit code 3, '
            r"cmd '\S+/lib/toys/step --code 3 .* --ros-args'\]\.\n"
        )
        assert re.search(died, bringup.output)
        assert sorted(bringup.pids()) == ['step-5', 'worker-2', 'worker-3']
        assert 'ready in' not in bringup.output
        assert 'the last lines of step-5:\n    one\n    the reason\n    rest\n' in bringup.output
        assert bringup.output.splitlines()[-1] == (
            '[ERROR] [launch]: stopped because step-5 ended with exit code 3 '
            '(never started: step-1, step-4): rest'
        )
        assert bringup.left() == []


@pytest.mark.parametrize('number', [signal.SIGKILL, signal.SIGTERM, signal.SIGRTMIN])
def test_death_by_a_signal_gives_128_and_the_signal(tmp_path, number):
    with Bringup(tmp_path, IN_ORDER, f'die_of:={number:d}') as bringup:
        assert bringup.end() == 128 + number
        assert f'exit code {-number}, cmd' in bringup.output


def test_a_required_worker_that_dies_stops_the_stack(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        bringup.expect('ready in')
        os.kill(bringup.pids()['worker-2'], signal.SIGKILL)
        assert bringup.end() == 137
        assert 'stopped because worker-2 died of SIGKILL' in bringup.output


def test_the_stack_continues_without_an_optional_node(tmp_path):
    with Bringup(tmp_path, OPTIONAL) as bringup:
        bringup.expect('working as pid')
        bringup.expect(
            r'\[WARNING\] \[step-2\]: never starts: needs that step-1 exited with code 0\n'
        )
        assert bringup.left() == [bringup.pids()['worker-3']]
        assert bringup.end(signal.SIGINT) == 0


def test_an_optional_node_that_a_required_one_waits_for_stops_the_stack(tmp_path):
    with Bringup(tmp_path, OPTIONAL, 'needed:=true') as bringup:
        assert bringup.end() == 4
        assert '(never started: step-2)' in bringup.output


def test_the_stack_is_over_when_nothing_runs_any_more(tmp_path):
    with Bringup(tmp_path, CHATTY, 'text:=hello') as bringup:
        assert bringup.end() == 0
        assert '[step-1] hello\n' in bringup.output


def test_the_end_of_one_node_may_stop_the_stack(tmp_path):
    with Bringup(tmp_path, str(STACKS / 'ending.py')) as bringup:
        assert bringup.end() == 0
        assert "sending signal 'SIGINT' to process[worker-2]" in bringup.output


def test_a_file_that_cannot_be_executed_is_reported_in_one_line(tmp_path):
    with Bringup(tmp_path, CHATTY, 'text:=x') as bringup:
        bringup.end()
    (tmp_path / 'prefix/lib/toys/step').write_bytes(b'\x7fELF no program')
    with Bringup(tmp_path, CHATTY, 'text:=x') as bringup:
        assert bringup.end() == 126
        assert re.search(
            r'\[step-1\]: process could not be started: .*Exec format error', bringup.output
        )
        last_line = bringup.output.splitlines()[-1]
        assert 'step-1 ended with exit code 126: could not be started: ' in last_line


def test_long_lines_are_cut_and_prefixed(tmp_path):
    text = 'x' * 100_000
    with Bringup(tmp_path, CHATTY, f'text:={text}') as bringup:
        assert bringup.end() == 0
        pieces = [
            line.removeprefix('[step-1] ')
            for line in bringup.output.splitlines()
            if line.startswith('[step-1] ')
        ]
        assert len(pieces) > 1
        assert [piece for piece in pieces if piece.strip('x')] == []
        assert sum(map(len, pieces)) == len(text)


SIGNALLED = """
from pathlib import Path
import os, signal, sys
from amr_description.bringup.console import Console
from amr_description.bringup.run_log import LogFolder

console = Console(sys.stdout, LogFolder(Path(sys.argv[1]), 'run'), colour=False)
signal.signal(signal.SIGALRM, lambda *_: os.write(2, b'signal\\n'))
signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
console.output('step-1', 'x' * 100_000)
signal.setitimer(signal.ITIMER_REAL, 0)
"""


@pytest.mark.parametrize('unbuffered', ['', '1'])
def test_a_signal_while_nobody_reads_costs_no_output(tmp_path, unbuffered):
    command = [sys.executable, '-c', SIGNALLED, str(tmp_path)]
    env = os.environ | ENVIRONMENT | {'PYTHONUNBUFFERED': unbuffered}
    with subprocess.Popen(
        command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        for _ in range(3):
            assert process.stderr.readline() == 'signal\n'
        said, _ = process.communicate(timeout=PATIENCE)
    assert said == f'[step-1] {"x" * 100_000}\n'


def test_log_files_hold_what_the_screen_showed(tmp_path):
    with Bringup(tmp_path, CHATTY, 'text:=hello', 'unfinished:=end') as bringup:
        assert bringup.end() == 0
        latest = bringup.logs / 'latest'
        assert latest.resolve().name == bringup.run_name
        assert (latest / 'step-1.log').read_text() == 'hello\nend\n'
        log = (latest / 'launch.log').read_text()
        assert re.sub(r'(?m)^\d{10}\.\d{7} ', '', log) == bringup.output


def test_without_a_log_folder_the_stack_runs_all_the_same(tmp_path):
    (tmp_path / 'logs').touch()
    with Bringup(tmp_path, IN_ORDER, TMPDIR=str(tmp_path)) as bringup:
        bringup.expect('no log files from here on: .*Not a directory')
        bringup.expect('ready in')
        assert list(tmp_path.glob('bringup-*/worker-3-parameters-1.yaml'))
        assert bringup.end(signal.SIGINT) == 0
        assert not list(tmp_path.glob('bringup-*'))


COLOUR = {'TERM': 'xterm', 'NO_COLOR': '', 'RCUTILS_COLORIZED_OUTPUT': ''}


@pytest.mark.parametrize(
    ('terminal', 'env', 'coloured'),
    [
        (True, {}, True),
        (False, {}, False),
        (True, {'NO_COLOR': '1'}, False),
        (True, {'TERM': 'dumb'}, False),
        (True, {'RCUTILS_COLORIZED_OUTPUT': '0'}, False),
        (False, {'RCUTILS_COLORIZED_OUTPUT': '1', 'NO_COLOR': '1'}, True),
    ],
)
def test_names_are_coloured_on_a_terminal(tmp_path, terminal, env, coloured):
    with Bringup(tmp_path, CHATTY, 'text:=hello', terminal=terminal, **COLOUR | env) as bringup:
        assert bringup.end() == 0
        found = re.search('\x1b\\[\\d+m\\[step-1\\]\x1b\\[0m hello', bringup.output)
        assert bool(found) == coloured
        assert ('\x1b' in bringup.output) == coloured
        assert '\x1b' not in (bringup.logs / 'latest/launch.log').read_text()
