# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults at each step of a start, and unruly children: real process trees."""

import contextlib
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import time

from fixtures.bringup.running import Bringup, ends, install_toys, STACKS
import pytest
from support import machines
from support.running_programs import ENVIRONMENT, PATIENCE

from amr_description.bringup.guardian import processes

GATED = str(STACKS / 'gated.py')
UNRULY = str(STACKS / 'unruly.py')
WORKERS = ['worker-1', 'worker-2']
STEPS = ['turnstile-3', 'turnstile-4', 'turnstile-5']
UP = len(STEPS)


@contextlib.contextmanager
def started(folder, until, **options):
    """A start that has come to the step ``until``, and no further; UP: to its end."""
    for number in range(len(STEPS)):
        os.mkfifo(folder / str(number))
    with Bringup(folder, GATED, f'gates:={folder}', **options) as bringup:
        for worker in WORKERS:
            bringup.expect(rf'\[{worker}\] working')
        for number, step in enumerate(STEPS[: until + 1]):
            bringup.expect(rf'\[{step}\] at the turnstile')
            if number < until:
                (folder / str(number)).write_text('')  # which waits for the reader
        if until == UP:
            bringup.expect('ready in')
        yield bringup


VICTIMS = [
    (until, victim) for until in range(UP + 1) for victim in WORKERS + STEPS[until : until + 1]
]


@pytest.mark.parametrize(('until', 'victim'), VICTIMS)
def test_any_child_killed_at_any_step_stops_the_stack_and_is_named(tmp_path, until, victim):
    with started(tmp_path, until) as bringup:
        os.kill(bringup.pids()[victim], signal.SIGKILL)
        assert bringup.end() == 128 + signal.SIGKILL
        last_line = bringup.output.splitlines()[-1]
        assert f'[launch]: stopped because {victim} died of SIGKILL' in last_line
        assert sorted(bringup.pids()) == sorted(WORKERS + STEPS[: until + 1]), 'no later step'
        assert ('ready in' in bringup.output) == (until == UP)
        assert 'failed to terminate' not in bringup.output, 'nobody is waited for'
        assert bringup.left() == []


@pytest.mark.parametrize('until', [0, 1])
@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_start_that_is_stopped_starts_nothing_more(tmp_path, until, number):
    with started(tmp_path, until) as bringup:
        assert bringup.end(number) == 0
        assert sorted(bringup.pids()) == sorted(WORKERS + STEPS[: until + 1])
        assert 'stopped because' not in bringup.output
        assert bringup.left() == []


@pytest.mark.parametrize('until', [0, UP])
def test_the_orchestrator_killed_at_any_step_leaves_nothing(tmp_path, until):
    with started(tmp_path, until) as bringup:
        pids = bringup.left()
        assert len(pids) == (3 if until == 0 else 2)
        bringup.signal(signal.SIGKILL)
        bringup.end()
        assert all(ends(pid) for pid in pids)


def test_a_suspended_orchestrator_continues(tmp_path):
    with started(tmp_path, 0) as bringup:
        victim = bringup.pids()['worker-2']
        bringup.signal(signal.SIGSTOP)
        os.waitid(os.P_PID, bringup.process.pid, os.WSTOPPED | os.WNOWAIT)
        os.kill(victim, signal.SIGKILL)
        bringup.signal(signal.SIGCONT)
        assert bringup.end() == 128 + signal.SIGKILL
        assert 'stopped because worker-2 died of SIGKILL' in bringup.output
        assert bringup.left() == []


def test_a_suspended_orchestrator_can_be_killed(tmp_path):
    with started(tmp_path, UP) as bringup:
        pids = bringup.left()
        bringup.signal(signal.SIGSTOP)
        bringup.signal(signal.SIGKILL)
        assert all(ends(pid) for pid in pids)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_while_xacro_runs_ends_xacro_too(tmp_path, number):
    bomb = tmp_path / 'bomb.xacro'
    endless = '[0 for a in range(10**9) for b in range(10**9)]'
    bomb.write_text(f'<robot name="${{{endless}}}" xmlns:xacro="http://ros.org/wiki/xacro"/>')
    path = os.environ['AMENT_PREFIX_PATH']
    with Bringup(tmp_path, 'simulation', f'urdf:={bomb}', AMENT_PREFIX_PATH=path) as bringup:
        deadline = time.monotonic() + PATIENCE
        while not (xacro := children_of(bringup.process.pid)):
            assert time.monotonic() < deadline
            os.sched_yield()
        assert bringup.end(number) == 128 + number
        assert bringup.output == ''
        assert all(ends(pid) for pid in xacro)


def children_of(parent):
    return [process.pid for process in processes('') if process.parent == parent]


MANNERS = {
    'hold_the_pipe': r'holder pid (\d+)',
    'fork_twice': r'daemon pid (\d+)',
    'forget_the_environment': r'stranger pid (\d+)',
    'close_the_output': None,
}


@pytest.mark.parametrize(('manners', 'pattern'), MANNERS.items())
def test_unruly_children_leave_nothing_behind(tmp_path, manners, pattern):
    with Bringup(tmp_path, UNRULY, f'manners:={manners}') as bringup:
        bringup.expect('unruly is up')
        bringup.expect(r'\[worker-1\] working')
        pids = [int(bringup.expect(pattern)[1])] if pattern else []
        assert bringup.end(signal.SIGINT) == 0
        assert 'process has finished cleanly' in bringup.output
        assert not any(Path(f'/proc/{pid}').exists() for pid in pids), 'ended before it returned'
        assert bringup.left() == []


@pytest.mark.parametrize('manners', [manners for manners, pattern in MANNERS.items() if pattern])
def test_unruly_children_do_not_outlive_a_killed_orchestrator(tmp_path, manners):
    with Bringup(tmp_path, UNRULY, f'manners:={manners}') as bringup:
        pid = int(bringup.expect(MANNERS[manners])[1])
        bringup.signal(signal.SIGKILL)
        assert ends(pid)


def test_a_flood_of_output_blocks_nothing(tmp_path):
    """The output goes to a file: reading it here would be slower than writing."""
    install_toys(tmp_path / 'prefix')
    command = [sys.executable, '-m', 'amr_description.bringup.main', UNRULY, 'manners:=flood']
    env = {'AMENT_PREFIX_PATH': f'{tmp_path}/prefix', 'ROS_LOG_DIR': f'{tmp_path}/logs'}
    reader, writer = os.pipe()
    with (
        open(reader, 'rb') as output,
        subprocess.Popen(
            command, env=os.environ | ENVIRONMENT | env, stdout=writer, start_new_session=True
        ) as process,
    ):
        os.close(writer)
        head = output.read(5_000_000)
        assert b'[worker-1] working' in head
        process.send_signal(signal.SIGINT)
        rest = output.read()
        assert process.wait(PATIENCE) == 0
    assert b'[INFO] [unruly-2]: process has finished cleanly' in rest
    assert b'[INFO] [worker-1]: process has finished cleanly' in rest
    run = re.search(rb'found below \S*?([^/\s]+)\n', head)[1].decode()
    assert not any(p.marked for p in processes(run))


CHATTY = str(STACKS / 'chatty.py')


def test_a_limit_that_logs_reach_costs_the_logs_only(tmp_path):
    small = ['bash', '-c', 'ulimit -f 64; exec "$@"', 'small']  # KiB a file
    text = 'x' * 100_000
    with Bringup(tmp_path, CHATTY, f'text:={text}', 'unfinished:=end', launcher=small) as bringup:
        assert bringup.end() == 0
        assert re.search(r'no log files from here on: .*File too large', bringup.output)
        assert bringup.output.count('x') >= len(text)
        assert '[step-1] end\n' in bringup.output


def test_a_full_disk_costs_the_logs_only(tmp_path):
    if refused := machines.refusal():
        pytest.skip(refused)
    fill = f'mount -t tmpfs -o size=4k tmpfs {tmp_path}/logs && echo full >{tmp_path}/logs/full'
    full_disk = ['unshare', '--map-root-user', '--mount', 'sh', '-ec', f'{fill}; exec "$@"', 'sh']
    (tmp_path / 'logs').mkdir()
    (tmp_path / 'tmp').mkdir()
    stack = str(STACKS / 'in_order.py')  # which has parameters to write
    with Bringup(tmp_path, stack, launcher=full_disk, TMPDIR=f'{tmp_path}/tmp') as bringup:
        bringup.expect('no log files from here on: .*No space left on device')
        bringup.expect('ready in')
        bringup.expect(r'\[worker-3\] working')
        assert bringup.end(signal.SIGINT) == 0
        assert list((tmp_path / 'tmp').iterdir()) == []


SEVERAL = """
import os, sys, threading
from amr_description.bringup.main import main

def handles():
    return sorted(os.listdir('/proc/self/fd')), threading.active_count()

main(sys.argv[2:])  # the first opens what stays: the modules' own
before = handles()
codes = {main(sys.argv[2:]) for _ in range(int(sys.argv[1]) - 1)}
print('exit codes', codes, 'handles', 'same' if handles() == before else (before, handles()))
"""


@pytest.mark.parametrize('count', [10, pytest.param(30, marks=pytest.mark.long)])
def test_stacks_in_a_row_leave_no_handle_thread_process_or_file(tmp_path, count):
    install_toys(tmp_path / 'prefix')
    (tmp_path / 'tmp').mkdir()
    (tmp_path / 'home').mkdir()
    env = {
        'AMENT_PREFIX_PATH': f'{tmp_path}/prefix',
        'ROS_LOG_DIR': f'{tmp_path}/logs',
        'TMPDIR': f'{tmp_path}/tmp',
        'HOME': f'{tmp_path}/home',
    }
    command = [sys.executable, '-c', SEVERAL, str(count), str(STACKS / 'ending.py')]
    ended = subprocess.run(
        command,
        env=os.environ | ENVIRONMENT | env,
        capture_output=True,
        text=True,
        timeout=4 * PATIENCE,
        check=True,
    )
    assert ended.stdout.splitlines()[-1] == 'exit codes {0} handles same'
    runs = re.findall(r'found below \S*?([^/\s]+)\n', ended.stdout)
    assert len(set(runs)) == count
    assert not any(p.marked for run in runs for p in processes(run))
    assert sorted(path.name for path in (tmp_path / 'logs').iterdir()) == [*sorted(runs), 'latest']
    left = [path for folder in ('tmp', 'home') for path in (tmp_path / folder).rglob('*')]
    assert [path.name for path in left if path.is_file()] == ['.lock'], 'of the list of all runs'
