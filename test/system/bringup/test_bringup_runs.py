# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The runs of a host: status and stop from another shell, and no two of one name in a domain."""

import json
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import time

from fixtures.bringup.running import Bringup, ends, install_toys, STACKS
import pytest
from support.running_programs import PATIENCE

from amr_description.bringup import Group, Node, run_commands, run_registry, Stack
from amr_description.bringup.command_line import process_specs
from amr_description.bringup.process_usage import ProcessStat, start_time, tree, usages
from amr_description.bringup.run_registry import RunRecord, runs
from amr_description.errors import BringupError

IN_ORDER = str(STACKS / 'in_order.py')
STUBBORN = str(STACKS / 'stubborn.py')


def command(folder, *words):
    """Run ``bringup status`` or ``stop`` as in another shell."""
    return subprocess.run(
        [sys.executable, '-m', 'amr_description.bringup.main', *words],
        env=os.environ | {'ROS_HOME': str(folder / 'ros_home')},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )


def up(bringup):
    bringup.expect('ready in')
    bringup.expect(r'\[worker-2\] working')
    bringup.expect(r'\[worker-3\] working')
    return bringup


def test_status_and_stop_of_a_stack_that_runs(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        pids = up(bringup).pids()
        (run,) = json.loads(command(tmp_path, 'status', '--json').stdout)
        assert (run['pid'], run['stack'], run['phase']) == (
            bringup.process.pid, 'in_order', 'ready',
        )  # fmt: skip
        assert run['domain'] == int(os.environ['ROS_DOMAIN_ID'])
        worker = run['nodes']['worker-2']
        assert (worker['state'], worker['pid']) == ('running', pids['worker-2'])
        assert worker['memory'] > 1_000_000
        assert worker['cpu'] >= 0.0
        assert run['memory'] > worker['memory']
        assert run['nodes']['step-4'] == {
            'state': 'ended', 'pid': None, 'condition': 'step-5 exited with code 0',
            'since': run['nodes']['step-4']['since'], 'exit_code': 0,
        }  # fmt: skip
        told = command(tmp_path, 'status', 'in_order').stdout
        assert told.startswith(f'in_order: ready after {run["ready_after"]:.1f} s, pid ')
        assert [line.split()[:2] for line in told.splitlines()[3:6]] == [
            ['step-1', 'done'], ['worker-2', 'running'], ['worker-3', 'running'],
        ]  # fmt: skip
        stopped = command(tmp_path, 'stop')
        assert stopped.returncode == 0
        assert 'is gone, and all that it started, after' in stopped.stdout
        assert bringup.left() == []
        assert bringup.end() == 0
    for word in ('status', 'stop'):
        nothing = command(tmp_path, word)
        assert (nothing.returncode, nothing.stdout) == (1, '')
        assert nothing.stderr == 'no stack of this user runs on this host\n'
    nothing = command(tmp_path, 'status', '--json')
    assert (nothing.returncode, json.loads(nothing.stdout)) == (1, [])


def test_status_shows_who_waits_and_who_died(tmp_path):
    with Bringup(tmp_path, str(STACKS / 'optional.py')) as bringup:
        bringup.expect('working as pid')
        bringup.expect('never starts')
        told = command(tmp_path, 'status').stdout
        assert 'ended with exit code 4' in told
        assert 'never starts: needs that step-1 exited with code 0' in told


@pytest.mark.parametrize('option', ['--print', '--show-args'])
def test_the_reader_of_a_listing_may_go_away(option):
    reader, writer = os.pipe()
    os.close(reader)  # as `head` does, sooner or later
    done = subprocess.run(
        [sys.executable, '-m', 'amr_description.bringup.main', 'mock', option],
        stdout=writer,
        stderr=subprocess.PIPE,
        text=True,
        timeout=PATIENCE,
    )
    os.close(writer)
    assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, '')


def test_a_stopped_job_can_be_ended(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        up(bringup).signal(signal.SIGSTOP)  # as Ctrl-Z does
        assert command(tmp_path, 'stop').returncode == 0
        assert bringup.end() == 0


def test_a_second_stack_of_the_same_names_is_refused(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as first:
        up(first)
        with Bringup(tmp_path, IN_ORDER) as second:
            assert second.end() == 1
            (line,) = second.lines
            assert "/left/hand would be there twice: the stack 'in_order' (pid " in line
            end = f'ros2 run amr_description bringup stop {first.process.pid}'
            assert f"end it with '{end}'" in line
            assert '(--force)' in line
        with Bringup(tmp_path, IN_ORDER, '--domain=99') as elsewhere:
            up(elsewhere)
            several = command(tmp_path, 'stop')
            assert several.returncode == 2
            assert 'several stacks run; name one by its pid, or --all:' in several.stderr
            assert f'{first.process.pid}' in several.stderr
            assert command(tmp_path, 'stop', str(elsewhere.process.pid)).returncode == 0
        with Bringup(tmp_path, IN_ORDER, '--force') as nevertheless:
            up(nevertheless)
        with Bringup(tmp_path, STUBBORN, 'role:=alone') as other:
            other.expect('stubborn pid')
        assert command(tmp_path, 'stop', 'nobody').stderr.startswith(
            "bringup: no run, stack or pid 'nobody'; there are: "
        )


def test_the_file_of_a_killed_run_is_removed(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        pids = up(bringup).left()
        bringup.signal(signal.SIGKILL)
        bringup.process.wait(PATIENCE)
        assert list((tmp_path / 'ros_home/runs').glob('*.json'))
        assert command(tmp_path, 'status').returncode == 1
        assert not list((tmp_path / 'ros_home/runs').glob('*.json'))
        assert all(ends(pid) for pid in pids)
    with Bringup(tmp_path, IN_ORDER) as again:
        up(again)


def record(folder, name, **about):
    run = RunRecord(folder, name)
    run.register({'stack': name, 'domain': 0} | about, names=['/a'])
    return run


def test_the_files_are_for_the_owner_only(tmp_path):
    folder = tmp_path / 'runs'
    record(folder, 'run')
    assert folder.stat().st_mode & 0o777 == 0o700
    assert (folder / 'run.json').stat().st_mode & 0o777 == 0o600


def test_only_the_same_name_in_the_same_domain_clashes(tmp_path):
    first = record(tmp_path, 'first')
    record(tmp_path, 'second', domain=1)
    with pytest.raises(BringupError, match="/a would be there twice: the stack 'first'"):
        record(tmp_path, 'third')
    first.remove()
    record(tmp_path, 'third')
    assert {state['run'] for state in runs(tmp_path)} == {'second', 'third'}


@pytest.mark.parametrize('text', ['', '[]', '{"pid": 1}', 'null', '\x80'])
def test_a_broken_file_is_no_run(tmp_path, text):
    (tmp_path / 'x.json').write_text(text, encoding='latin-1')
    assert runs(tmp_path) == []


def test_a_state_that_is_being_written_is_no_second_run(tmp_path, monkeypatch):
    run = record(tmp_path, 'run')
    with monkeypatch.context() as disk:
        disk.setattr(Path, 'replace', lambda *_: (_ for _ in ()).throw(OSError('full')))
        run.update({'event': 'ready', 'seconds': 1.0})
    assert len(list(tmp_path.iterdir())) == 3  # with the lock
    (state,) = runs(tmp_path)
    assert state['phase'] == 'starting'
    run.remove()
    assert [path.name for path in tmp_path.iterdir()] == ['.lock']


@pytest.mark.parametrize('other', [{'start_time': 1}, {'boot': 'another'}])
def test_a_reused_pid_is_another_process(tmp_path, other):
    record(tmp_path, 'run')
    path = tmp_path / 'run.json'
    path.write_text(json.dumps(json.loads(path.read_text()) | other))
    assert runs(tmp_path) == []
    assert not path.exists()


def test_a_registry_that_cannot_be_written_costs_the_status_only(tmp_path):
    (tmp_path / 'file').touch()
    run = record(tmp_path / 'file/runs', 'run')
    run.update({'event': 'ready', 'seconds': 1.0})
    run.remove()


def rows(folder):
    """The lines of ``status`` but the first ones and the last, of the run that there is."""
    (state,) = runs(folder)
    return run_commands.table(state, {})


def test_status_shows_a_node_between_two_starts(tmp_path):
    run = record(tmp_path, 'run')
    ended = {'event': 'exited', 'node': 'a-1', 'pid': 5, 'time': 1.0}
    run.update({'event': 'begun', 'log_folder': '/logs'})
    run.update({'event': 'waiting', 'node': 'a-1', 'condition': None, 'time': 0.0})
    for end, told in (({'signal': 'SIGKILL'}, 'died of SIGKILL'), ({'exit_code': 0}, 'done')):
        run.update({'event': 'started', 'node': 'a-1', 'pid': 5, 'time': 0.0})
        (state,) = runs(tmp_path)
        assert state['nodes']['a-1'] == {
            'state': 'running', 'condition': None, 'pid': 5, 'since': 0.0,
        }  # fmt: skip
        run.update(ended | end)
        assert re.search(rf'^a-1 +{told}$', '\n'.join(rows(tmp_path)), re.MULTILINE)
        run.update({'event': 'respawn', 'node': 'a-1', 'seconds': 2.0, 'restarts': 1, 'time': 1.0})
        again = rf'^a-1 +{told}, starts again at 1970-01-01 \d\d:\d\d$'
        assert re.search(again, '\n'.join(rows(tmp_path)), re.MULTILINE)


def test_a_run_that_never_gets_ready_says_so_until_it_stops(tmp_path):
    run = record(tmp_path, 'run')
    run.update({'event': 'begun', 'log_folder': '/logs'})
    assert rows(tmp_path)[0].startswith('run: starting, pid')
    run.update({'event': 'never_ready', 'condition': 'a-1 failed'})
    assert rows(tmp_path)[0].startswith('run: never gets ready (needs that a-1 failed), pid')
    run.update({'event': 'shutdown', 'reason': 'enough'})
    assert rows(tmp_path)[0].startswith('run: stopping, pid')


def test_names_that_must_be_unique(tmp_path, monkeypatch):
    install_toys(tmp_path)
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path}:{os.environ["AMENT_PREFIX_PATH"]}')
    named = Node('worker', package='toys', name='left', namespace='arm')
    nodes = [Node('mujoco_sim'), named, Node('worker', package='toys'), Node('spawner')]
    robot = Group([Node('ros2_control_node'), Node('robot_state_publisher')], namespace='r1')
    assert run_registry.unique_names(process_specs(Stack([*nodes, robot]), tmp_path)) == {
        '/mujoco_sim', '/controller_manager', '/arm/left',
        '/r1/controller_manager', '/r1/robot_state_publisher',
    }  # fmt: skip


def test_a_tree_is_a_process_its_session_and_all_their_descendants():
    def process(pid, parent, session):
        return ProcessStat(pid, parent, session, 0.0, 0)

    table = [
        process(1, 0, 1), process(10, 1, 10), process(11, 10, 10), process(12, 11, 12),
        process(13, 1, 10), process(14, 13, 14), process(20, 1, 20),
    ]  # fmt: skip
    assert tree(table, 10) == {10, 11, 12, 13, 14}
    assert tree(table, 20) == {20}
    assert tree(table, 99) == set()


def test_a_busy_process_uses_the_processor():
    busy, idle = (
        subprocess.Popen(
            [sys.executable, '-c', f'print(flush=True)\n{code}'],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        for code in ('while True: pass', 'input()')
    )
    try:
        for each in (busy, idle):  # to start takes processor time, too
            assert each.stdout.readline() == b'\n'
        deadline = time.monotonic() + PATIENCE
        while not (used := usages([busy.pid, idle.pid], 0.3))[busy.pid].cpu:
            assert time.monotonic() < deadline  # however many share it
        assert used[idle.pid].cpu < used[busy.pid].cpu
        assert used[busy.pid].memory > 1_000_000
    finally:
        for process in (busy, idle):
            process.kill()
            process.communicate()
    assert start_time(busy.pid) is None
