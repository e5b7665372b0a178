# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The end of a bring-up: nothing is left, however it is ended."""

import contextlib
import os
from pathlib import Path
import re
import signal
import sys
import time

from fixtures.bringup.running import Bringup, ends, install_toys, STACKS
import pytest
from support.running_programs import PATIENCE

from amr_description.bringup.guardian import processes

IN_ORDER = str(STACKS / 'in_order.py')
CHATTY = str(STACKS / 'chatty.py')
STUBBORN = str(STACKS / 'stubborn.py')


def up(bringup):
    """Wait until both workers of the stack can be interrupted."""
    bringup.expect(r'ready in')
    bringup.expect(r'\[worker-2\] working')
    bringup.expect(r'\[worker-3\] working')


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_every_signal_stops_the_stack_alike(tmp_path, number):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        up(bringup)
        assert bringup.end(number) == 0
        told = bringup.output[bringup.output.index('[WARNING] [launch]') :].splitlines()
        assert told[1:3] == [
            f"[INFO] [worker-{n}]: sending signal 'SIGINT' to process[worker-{n}]" for n in (3, 2)
        ]
        assert bringup.output.count('ended on <Signals.SIGINT: 2>') == 2
        assert bringup.output.count('[pid ') == len(bringup.pids())
        assert bringup.left() == []


@pytest.mark.parametrize(
    ('code', 'told'),
    [
        (0, r'\[INFO\] \[plain-1\]: process has ended on SIGINT \[pid \d+\]'),
        (130, r'\[INFO\] \[plain-1\]: process has ended on SIGINT \[pid \d+\]'),
        (7, r'\[ERROR\] \[plain-1\]: process has died \[pid \d+, exit code 7, cmd'),
    ],
)
def test_ending_on_a_signal_is_no_error(tmp_path, code, told):
    with Bringup(tmp_path, str(STACKS / 'plain.py'), f'code:={code}') as bringup:
        bringup.expect('plain is up')
        assert bringup.end(signal.SIGTERM) == 0
        assert re.search(told, bringup.output)


def test_children_get_sigint_even_if_the_orchestrator_was_started_with_it_ignored(tmp_path):
    ignoring = [sys.executable, '-c', IGNORE_SIGINT]
    with Bringup(tmp_path, IN_ORDER, launcher=ignoring) as bringup:
        up(bringup)
        assert 'ignored [],' in bringup.output
        assert bringup.end(signal.SIGINT) == 0


IGNORE_SIGINT = (
    'import os, signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); '
    'os.execv(sys.argv[1], sys.argv[1:])'
)


def test_nohup_is_respected(tmp_path):
    with Bringup(tmp_path, IN_ORDER, launcher=['nohup']) as bringup:
        up(bringup)
        bringup.signal(signal.SIGHUP)
        assert bringup.end(signal.SIGTERM) == 0
        assert '[launch]: SIGHUP' not in bringup.output
        assert '[launch]: SIGTERM' in bringup.output


def test_ctrl_c_in_a_terminal_reaches_the_orchestrator_alone(tmp_path):
    with Bringup(tmp_path, IN_ORDER, terminal=True, NO_COLOR='1') as bringup:
        up(bringup)
        assert all(os.getsid(pid) == pid for pid in bringup.left())
        bringup.type('\x03')
        assert bringup.end() == 0
        assert bringup.output.count('user interrupted with ctrl-c (SIGINT)') == 1
        assert bringup.output.count("sending signal 'SIGINT'") == 2


def test_a_closed_terminal_ends_the_stack(tmp_path):
    with Bringup(tmp_path, IN_ORDER, terminal=True, NO_COLOR='1') as bringup:
        up(bringup)
        bringup.hang_up()
        assert bringup.process.wait(PATIENCE) in (0, 128 + signal.SIGPIPE)
        assert bringup.left() == []


def hurry(bringup):
    """Ask three times, each time once the one before was heard; return the exit code."""
    bringup.signal(signal.SIGINT)
    bringup.expect("sending signal 'SIGINT' to process.stubborn-2")
    bringup.signal(signal.SIGINT)
    bringup.expect("after receiving 'SIGINT', escalating to 'SIGTERM'")
    return bringup.end(signal.SIGINT)


def test_a_second_and_a_third_request_escalate(tmp_path):
    with Bringup(tmp_path, STUBBORN, 'role:=alone') as bringup:
        bringup.expect(r'\] stubborn pid')
        assert hurry(bringup) == 0
        waited = re.findall(r"failed to terminate '([\d.]+)' seconds", bringup.output)
        assert all(float(seconds) < 5 for seconds in waited)  # which it takes unhurried
        assert "after receiving 'SIGTERM', escalating to 'SIGKILL'" in bringup.output
        assert 'exit code -9' in bringup.output


def test_a_process_that_left_the_session_is_ended_too(tmp_path):
    with Bringup(tmp_path, STUBBORN) as bringup:
        grandchild = int(bringup.expect(r'grandchild pid (\d+)')[1])
        bringup.expect(f'stubborn pid {grandchild}')
        assert hurry(bringup) == 0
        assert bringup.left() == []
        assert f'ended what was left: pid {grandchild}' in bringup.output


@pytest.mark.parametrize('stack', [IN_ORDER, STUBBORN])
def test_nothing_outlives_a_killed_orchestrator(tmp_path, stack):
    with Bringup(tmp_path, stack) as bringup:
        bringup.expect('ready in')
        bringup.expect(r'working' if stack == IN_ORDER else r'grandchild pid (\d+)')
        pids = bringup.left()
        assert len(pids) >= 2
        bringup.signal(signal.SIGKILL)
        bringup.end()
        assert all(ends(pid) for pid in pids)
        assert bringup.left() == []


def test_a_killed_guardian_is_replaced(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        up(bringup)
        (guardian,) = guardians_of(bringup.process.pid)
        os.kill(guardian, signal.SIGKILL)
        bringup.expect('somebody ended the guardian; started it anew')
        deadline = time.monotonic() + PATIENCE
        while not guardians_of(bringup.process.pid):  # it is forked before it has its name
            assert time.monotonic() < deadline
        pids = bringup.left()
        bringup.signal(signal.SIGKILL)
        assert all(ends(pid) for pid in pids)


def guardians_of(orchestrator):
    children = [process.pid for process in processes('') if process.parent == orchestrator]
    return [pid for pid in children if 'guardian.py' in command_of(pid)]


def command_of(pid):
    """The command line of a process, which has none for a moment when it has just been started."""
    deadline = time.monotonic() + PATIENCE
    while not (command := Path(f'/proc/{pid}/cmdline').read_text()):
        assert time.monotonic() < deadline, f'{pid} has no command line'
    return command


def test_a_reader_that_goes_away_ends_the_stack(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        bringup.expect(r'process started')
        run = bringup.run_name
        bringup.process.stdout.close()
        assert bringup.process.wait(PATIENCE) == 128 + signal.SIGPIPE
        assert bringup.left() == []
        log = (bringup.logs / run / 'launch.log').read_text()
        assert "sending signal 'SIGINT' to process[worker-2]" in log


def test_a_reader_that_never_was_there_ends_the_stack(tmp_path):
    piped = ['bash', '-o', 'pipefail', '-c', '"$@" | true', 'bash']
    with Bringup(tmp_path, IN_ORDER, launcher=piped) as bringup:
        assert bringup.end() == 128 + signal.SIGPIPE
        assert bringup.left() == []


@pytest.mark.parametrize('streams', ['>&-', '2>&- >&- <&-', '>/dev/full', '2>/dev/full >&2'])
def test_a_closed_screen_stops_only_the_output(tmp_path, streams):
    closing = ['sh', '-c', f'exec "$@" {streams}', 'sh']
    with Bringup(tmp_path, CHATTY, 'text:=hello', 'code:=3', launcher=closing) as bringup:
        assert bringup.end() == 3
        assert 'Traceback' not in bringup.output
        assert (bringup.logs / 'latest/step-1.log').read_text() == 'hello\n'


def test_orphans_are_adopted_and_reaped(tmp_path):
    with Bringup(tmp_path, STUBBORN, 'required:=false') as bringup:
        grandchild = int(bringup.expect(r'grandchild pid (\d+)')[1])
        os.kill(bringup.pids()['stubborn-2'], signal.SIGKILL)
        bringup.expect(r'\[stubborn-2\]: process has died')
        adopted = [p.pid for p in processes('') if p.parent == bringup.process.pid]
        assert grandchild in adopted
        os.kill(grandchild, signal.SIGKILL)
        deadline = time.monotonic() + PATIENCE
        while Path(f'/proc/{grandchild}').exists():
            assert time.monotonic() < deadline, 'the zombie stays'
            os.sched_yield()
        assert bringup.end(signal.SIGTERM) == 0


def test_a_program_that_has_just_started_ends_quietly(tmp_path):
    (tmp_path / 'early.py').write_text(
        'from amr_description.bringup import Node, Stack\n'
        'def early():\n'
        "    return Stack([Node('talker'), Node('step', package='toys')])\n"
    )
    install_toys(tmp_path / 'prefix')
    step = tmp_path / 'prefix/lib/toys/step'
    step.write_text('#!/nowhere/python3\n')
    path = os.pathsep.join([str(tmp_path / 'prefix'), os.environ['AMENT_PREFIX_PATH']])
    with Bringup(tmp_path, str(tmp_path / 'early.py'), AMENT_PREFIX_PATH=path) as bringup:
        assert bringup.end() == 126
        assert 'Traceback' not in bringup.output
        said = [line for line in bringup.lines if line.startswith('[talker-1] ')]
        assert [line for line in said if 'Publishing: ' not in line] == []
        assert 'ready in' not in bringup.output
        reason = f'could not be started: {step} begins with #!/nowhere/python3, which is not there'
        assert bringup.lines[-1].endswith(f'step-2 ended with exit code 126: {reason}')


def test_a_guardian_that_was_stopped_does_not_keep_it(tmp_path):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        up(bringup)
        pids = filter(str.isdecimal, os.listdir('/proc'))
        (guardian,) = (int(pid) for pid in pids if is_guardian(pid, bringup))
        os.kill(guardian, signal.SIGSTOP)
        begin = time.monotonic()
        assert bringup.end(signal.SIGINT) == 0
        assert time.monotonic() - begin < 5.0
        assert ends(guardian)
        assert bringup.left() == []


def is_guardian(pid, bringup):
    try:
        words = Path(f'/proc/{pid}/cmdline').read_bytes().split(b'\0')
    except OSError:
        return False
    return str(bringup.process.pid).encode() in words and any(b'guardian.py' in w for w in words)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_children_that_were_stopped_end_at_once(tmp_path, number):
    with Bringup(tmp_path, IN_ORDER) as bringup:
        up(bringup)
        for pid in bringup.pids().values():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGSTOP)
        begin = time.monotonic()
        assert bringup.end(number) == 0
        assert time.monotonic() - begin < 5.0
        assert bringup.left() == []
