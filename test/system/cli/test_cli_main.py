# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Ways out of a command: exit codes, and what stands on which stream."""

import shlex
import signal
import sys
from types import SimpleNamespace

from fixtures.cli.commands import python
import pytest

from amr_description.cli import main
from amr_description.errors import AmrError, UsageError
from amr_description.ros.signals import StopRequested

# A stand-in for a command; the program under test is what surrounds it.
RUN = """\
import sys, types
from amr_description import streams
from amr_description.cli import main
def command(argv):
    {body}
sys.modules['command'] = types.SimpleNamespace(main=command)
main.PROGRAMS['command'] = 'command'
sys.exit(main.main('command', []))
"""


def run(body):
    return python('-c', RUN.format(body=body))


@pytest.fixture
def command(monkeypatch):
    """Install a function as the command ``command``."""

    def install(function):
        monkeypatch.setitem(sys.modules, 'command', SimpleNamespace(main=function))
        monkeypatch.setitem(main.PROGRAMS, 'command', 'command')

    return install


@pytest.mark.parametrize(
    ('error', 'code'),
    [
        (AmrError('no such topic'), 1),
        (UsageError('no such flag'), 2),
        (KeyboardInterrupt(), 2),
        (StopRequested(signal.SIGTERM), 15),
    ],
)
def test_errors_become_exit_codes(command, capsys, error, code):
    def fail(_argv):
        raise error

    command(fail)
    assert main.main('command', []) == code
    said = capsys.readouterr()
    assert said.out == ''
    assert said.err == (f'{error}\n' if isinstance(error, AmrError) else '')


def test_a_bug_is_not_hidden(command):
    def fail(_argv):
        raise ZeroDivisionError('a bug')

    command(fail)
    with pytest.raises(ZeroDivisionError, match='a bug'):
        main.main('command', [])


def test_each_line_is_written_at_once():
    assert run('print("seen"); import os; os._exit(0)').stdout == 'seen\n'


def test_a_reader_who_leaves_is_not_complained_about():
    reader_leaves = (
        'import os; r, w = os.pipe(); os.close(r); os.dup2(w, 1); print("unread"); return 0'
    )
    result = run(reader_leaves)
    assert (result.returncode, result.stderr) == (128 + signal.SIGPIPE, '')


def test_a_full_disk_is_named():
    full = 'import os; os.dup2(os.open("/dev/full", os.O_WRONLY), 1); print("lost"); return 0'
    result = run(full)
    assert result.returncode == 1
    assert result.stderr == 'the output cannot be written: No space left on device\n'


@pytest.mark.parametrize('closed', ['<&-', '>&-', '2>&-'])
def test_a_closed_stream_is_an_empty_one(closed):
    program = RUN.format(body='print(repr(sys.stdin.read()), file=sys.stderr); return 0')
    line = f'exec {shlex.quote(sys.executable)} -c {shlex.quote(program)} {closed}'
    result = python('-c', f'import os; os.execv("/bin/sh", ["sh", "-c", {line!r}])')
    assert (result.returncode, result.stdout) == (0, '')
    assert result.stderr == ('' if closed == '2>&-' else "''\n")


def test_what_cannot_be_encoded_is_escaped():
    result = run('print("\\udcff"); return 0')
    assert (result.returncode, result.stdout) == (0, '\\udcff\n')


def test_libraries_that_write_to_stdout_end_up_on_stderr():
    result = run(
        'import os; streams.keep_libraries_off_stdout(); os.write(1, b"noise"); '
        'print("result"); return 0'
    )
    assert (result.stdout, result.stderr) == ('result\n', 'noise')


def test_the_module_runs_either_command():
    result = python('-m', 'amr_description.cli')
    assert result.returncode == 2
    assert (
        result.stderr == 'usage: python -m amr_description.cli {ros2,check_urdf,launch_test} ...\n'
    )
    assert python('-m', 'amr_description.cli', 'check_urdf', '--help').returncode == 0
