# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A program of the preloaded interpreter is what a started one is: its parts, its end."""

from concurrent.futures import ThreadPoolExecutor
import json
import os
from pathlib import Path
import re
import signal
import subprocess
import sys

from fixtures.bringup.running import Bringup, STACKS
import pytest
from support import preloaded, running_programs
from support.running_programs import PATIENCE, Program

REPORT = """
import json, os, signal, sys
print(json.dumps({
    'argv': sys.argv, 'path': sys.path, 'folder': os.getcwd(), 'environment': dict(os.environ),
    'is_leader': os.getsid(0) == os.getpid(), 'parent': os.getppid(), 'name': __name__,
    'handles': sorted(int(fd) for fd in os.listdir('/proc/self/fd')),
    'signals': [str(signal.getsignal(each)) for each in signal.valid_signals()],
    'streams': [[each.encoding, each.errors, each.line_buffering, each.write_through, each.name]
                for each in (sys.stdin, sys.stdout, sys.stderr)],
    'terminals': [os.isatty(fd) for fd in range(3)],
}))
"""
NODES = 'amr_description.nodes'
WAYS_TO_START = (subprocess.Popen, preloaded.Popen)


def started_twice(command, **options):
    """What a program prints when it is started, and when it is forked."""
    printed = []
    for way in WAYS_TO_START:
        with way(command, stdout=subprocess.PIPE, text=True, **options) as process:
            printed.append(json.loads(process.communicate(timeout=PATIENCE)[0]))
    for each in printed:
        each['environment'].pop('_', None)
    return printed


@pytest.mark.parametrize('kind', ['file', '-c', '-m'])
@pytest.mark.parametrize('new_session', [False, True])
def test_a_forked_program_finds_what_a_started_one_does(tmp_path, kind, new_session):
    (tmp_path / 'report.py').write_text(REPORT)
    words = {
        'file': [str(tmp_path / 'report.py')],
        '-c': ['-c', REPORT],
        '-m': ['-m', 'report'],
    }[kind]
    started, forked = started_twice(
        [sys.executable, *words, 'a', 'b c', 'ä'],
        cwd=tmp_path,
        env=os.environ | {'OF_THE_TEST': '1', 'PYTHONPATH': '/somewhere'},
        stdin=subprocess.DEVNULL,
        start_new_session=new_session,
    )
    assert forked == started
    assert started['parent'] == os.getpid()
    assert started['is_leader'] == new_session


def test_streams_are_unbuffered_where_they_are_asked_to_be():
    env = os.environ | {'PYTHONUNBUFFERED': '1'}
    started, forked = started_twice(
        [sys.executable, '-c', REPORT], env=env, stdin=subprocess.DEVNULL
    )
    assert forked == started


@pytest.mark.parametrize(
    ('code', 'expected'),
    [
        ('pass', 0),
        ('raise SystemExit(3)', 3),
        ('import sys; sys.exit("a reason")', 1),
        ('1 / 0', 1),
        ('raise KeyboardInterrupt', -signal.SIGINT),
        ('import os; os._exit(7)', 7),
        ('import os, signal; os.kill(os.getpid(), signal.SIGKILL)', -signal.SIGKILL),
        ('import atexit; atexit.register(print, "at the end")', 0),
        ('import sys; sys.stdout.close()', 0),
        ('import threading, time; threading.Timer(0.1, print, ["a thread"]).start()', 0),
    ],
)
def test_it_ends_as_a_started_one(code, expected):
    to_the_end = 'from amr_description.forking import run_to_the_end as run'
    said = []
    for way, text in (
        (subprocess.Popen, code),
        (preloaded.Popen, code),
        (preloaded.Popen, f'{to_the_end}\nrun(lambda: exec({code!r}))'),
    ):
        pipes = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, 'text': True}
        with way([sys.executable, '-c', text], **pipes) as process:
            out, err = process.communicate(timeout=PATIENCE)
        said.append((process.returncode, out, err.splitlines()[-1:]))
    assert said[1:] == [said[0]] * 2
    assert said[0][0] == expected


def test_it_has_a_terminal_and_ctrl_c_reaches_it():
    # Blocked until it waits: just before a call that blocks, a signal would be seen after it.
    code = """if True:
        import os, signal
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        print('tty', os.ttyname(0), open('/dev/tty').isatty())
        signal.sigwait([signal.SIGINT])
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
        raise KeyboardInterrupt
    """
    with Program.of(code, terminal=True) as program:
        program.expect(r'tty /dev/pts/\d+ True')
        program.type('\x03')
        assert program.end() == -signal.SIGINT


def test_it_shows_its_own_command_and_environment():
    command = [sys.executable, '-c', 'print(flush=True); input()', 'a word', 'ä']
    pipes = {'stdin': subprocess.PIPE, 'stdout': subprocess.PIPE}
    with preloaded.Popen(command, env=os.environ | {'MARK': 'ü'}, **pipes) as process:
        process.stdout.readline()
        files = Path(f'/proc/{process.pid}')
        assert shown(files / 'cmdline') == command
        variables = shown(files / 'environ')
        assert 'MARK=ü' in variables
        assert not any(each.startswith('ROOM=') for each in variables)
        assert (files / 'comm').read_text() == f'{Path(sys.executable).name}\n'
        process.communicate(b'\n')


def shown(file):
    """The words that a file of /proc shows; the room behind them is full of zeros."""
    return [os.fsdecode(word) for word in file.read_bytes().split(b'\0') if word.strip()]


def test_it_has_files_that_it_is_given_under_the_same_numbers():
    reader, writer = os.pipe()
    high = os.dup(reader)
    code = f'import os; print(os.read({high}, 9), os.path.exists("/proc/self/fd/{writer}"))'
    os.write(writer, b'given')
    with preloaded.Popen(
        [sys.executable, '-c', code], pass_fds=(high,), stdout=subprocess.PIPE
    ) as process:
        assert process.communicate(timeout=PATIENCE)[0] == b"b'given' False\n"
    for fd in (reader, writer, high):
        os.close(fd)


def family(pid):
    """The names and commands of a process and its children, and which lead a session."""

    def described(pid):
        words = ' '.join(shown(Path(f'/proc/{pid}/cmdline')))
        # A run's name and pids differ, and from where this package is imported.
        told = re.sub(r"'/\S*'|/\S*/|[\d-]+", '', words)
        return Path(f'/proc/{pid}/comm').read_text(), told, os.getsid(int(pid)) == int(pid)

    children = Path(f'/proc/{pid}/task/{pid}/children').read_text().split()
    return described(pid), sorted(map(described, children))


def test_a_bring_up_has_the_processes_that_it_always_has(tmp_path, monkeypatch):
    families = []
    stack = str(STACKS / 'waiting.py'), f'path:={tmp_path}/no'
    prefixes = f'{tmp_path}/prefix:{os.environ["AMENT_PREFIX_PATH"]}'
    for way in WAYS_TO_START:
        monkeypatch.setattr(running_programs, 'Popen', way)
        with Bringup(tmp_path, *stack, AMENT_PREFIX_PATH=prefixes) as bringup:
            bringup.expect(r'\[step-4\]: process has finished cleanly')
            families.append(family(bringup.process.pid))
            assert bringup.end(signal.SIGINT) == 0
            assert bringup.left() == []
    started, forked = families
    assert forked == started
    # The guardian, what watches the graph, and two programs of the fork server, which has ended.
    assert len(started[1]) == 4


def test_it_dies_with_nobody_but_is_reaped_by_the_test():
    process = preloaded.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)
    assert process.poll() is None
    assert Path(f'/proc/{process.pid}/stat').read_text().split()[3] == str(os.getpid())
    process.terminate()
    assert process.wait(PATIENCE) == -signal.SIGTERM
    process.stdin.close()
    assert not Path(f'/proc/{process.pid}').exists()


def test_programs_of_both_servers_that_threads_start_at_once_are_children():
    def started(number):
        of_ros = ['-m', f'{NODES}.talker', '--ros-args', '-r', 'bad']
        words = ['-c', 'raise SystemExit(3)'] if number % 2 else of_ros
        with preloaded.Popen([sys.executable, *words], stderr=subprocess.DEVNULL) as process:
            return process.wait(PATIENCE)

    with ThreadPoolExecutor(8) as threads:
        assert list(threads.map(started, range(40))) == [1, 3] * 20  # of others it would be 0


@pytest.mark.parametrize(
    ('command', 'env', 'expected'),
    [
        ([sys.executable, '-c', 'import sys; print("rclpy" in sys.modules)'], {}, 'True'),
        ([sys.executable, '-I', '-c', 'import sys; print("rclpy" in sys.modules)'], {}, 'False'),
        (
            [sys.executable, '-c', 'import sys; print(sys.flags.utf8_mode)'],
            {'PYTHONUTF8': '1'},
            '1',
        ),
        (['echo', 'another program'], {}, 'another program'),
    ],
)
def test_what_cannot_be_forked_is_started(command, env, expected):
    assert (
        preloaded.run(command, env=os.environ | env, timeout=PATIENCE).stdout.strip() == expected
    )


NESTED = """
import os, sys
from amr_description.testing import program
code = 'import os, sys; print(os.getppid(), "mujoco" in sys.modules, sys.argv[1:])'
started = program.subprocess.Popen([sys.executable, '-c', code + '#amr_description.testing', 'a'])
print(os.getpid(), started.wait(), flush=True)
"""


def test_what_a_test_of_robots_starts_is_forked_too_and_is_its_child():
    done = preloaded.run([sys.executable, '-c', NESTED], timeout=PATIENCE)
    child, parent = done.stdout.split('\n')[:2]
    pid, code = parent.split()
    assert (child, code) == (f"{pid} True ['a']", '0'), done
    assert done.stderr == ''


def test_a_program_that_does_not_end_in_time_says_where_it_stands():
    code = 'import threading\ndef stand():\n    threading.Event().wait()\nstand()'
    with pytest.raises(subprocess.TimeoutExpired) as caught:
        preloaded.run([sys.executable, '-c', code], timeout=0.5)
    assert re.search(r'line 3 in stand\b', caught.value.stderr)
