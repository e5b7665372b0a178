# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The entry point of the executables: quiet on Ctrl-C, even during an import."""

import gc
import os
import pwd
import signal
import subprocess
import sys

from fixtures.entry import slow
import pytest
from support.running_programs import Program

from amr_description.entry import LazyEntryPoint as Executable, nodes, run

START = 'import sys; from amr_description.entry import LazyEntryPoint; sys.exit({}())'
SLOW = START.format("LazyEntryPoint('fixtures.entry.slow').main")
"""A program whose module imports for ever, which it says; that Python would tell of."""


def test_ctrl_c_during_an_import_ends_it_quietly():
    with Program.of(SLOW, 'import') as program:
        program.expect('importing\n')
        assert program.end(signal.SIGINT) == 130
        assert program.lines == ['importing']


def test_a_blocked_ctrl_c_stays_pending_and_ends_it_quietly():
    early = 'import os, signal; signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]); '
    with Program.of(f'{early}os.kill(os.getpid(), signal.SIGINT); {SLOW}', 'import') as program:
        assert program.end() == 130
        assert program.output == ''


def test_an_unhandled_ctrl_c_ends_the_program_quietly_after_its_clean_up():
    with Program.of(SLOW, 'main') as program:
        program.expect('in main\n')
        assert program.end(signal.SIGINT) == 130
        assert program.lines == ['in main', 'cleaned up']


def test_an_ignored_ctrl_c_stays_ignored():
    ignoring = f'import signal; signal.signal(signal.SIGINT, signal.SIG_IGN); {SLOW}'
    with Program.of(ignoring, 'end') as program:
        assert program.end() == 7
        assert program.lines == ['handler SIG_IGN']


def test_the_program_has_the_handler_of_python_and_its_exit_code_counts():
    with Program.of(SLOW, 'end') as program:
        assert program.end() == 7
        assert program.lines == ['handler default_int_handler']


def test_a_name_stands_for_what_is_imported_when_called():
    assert nodes.talker.main.path == 'amr_description.nodes.talker.main'
    assert Executable('fixtures.entry.slow').main.find() is slow.main
    assert Executable('fixtures.entry.slow').seven() == 7


def test_the_collector_keeps_off_imports_and_is_on_in_the_program():
    seen = []

    def find():
        seen.append(gc.isenabled())
        return lambda: seen.append(gc.isenabled())

    frozen = gc.get_freeze_count()
    try:
        run(find)
        assert seen == [False, True]
        assert gc.get_freeze_count() > frozen
        gc.disable()
        run(find)
        assert seen[2:] == [False, False]
    finally:
        gc.enable()
        gc.unfreeze()


def test_a_missing_function_is_an_error():
    with pytest.raises(AttributeError, match='nothing'):
        Executable('fixtures.entry.slow').nothing()


def test_the_exit_code_after_ctrl_c_can_be_another():
    def main():
        signal.raise_signal(signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        assert run(lambda: main, interrupted=2) == 2
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize('command', ['ros2', 'check_urdf'])
def test_the_commands_go_the_same_way(command):
    words = (sys.executable, '-m', 'amr_description.cli', command, '--help')
    with Program(*words) as program:
        assert program.end() == 0
        assert f'usage: {command}' in program.output


@pytest.mark.parametrize(('wished', 'threads'), [({}, 1), ({'OPENBLAS_NUM_THREADS': '2'}, 2)])
def test_numpy_starts_no_threads_unless_the_user_wants_them(wished, threads):
    # In a started interpreter: that of support.preloaded has loaded numpy already.
    code = START.format("LazyEntryPoint('fixtures.entry.numerical').main")
    variables = {name: os.environ[name] for name in os.environ if name != 'OPENBLAS_NUM_THREADS'}
    said = subprocess.run(
        [sys.executable, '-c', code],
        env={**variables, 'PYTHONPATH': os.pathsep.join(sys.path), **wished},
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert said == f'threads {threads} variable {wished.get("OPENBLAS_NUM_THREADS")}\n'


@pytest.mark.parametrize('given', [{}, {'HOME': ''}, {'HOME': '/else'}, {'ROS_LOG_DIR': '/logs'}])
def test_a_program_without_a_home_has_that_of_its_user(given):
    """As in cron, systemd, and ``env -i``: ROS writes its logs there."""
    code = (
        'import os; from amr_description.entry import run;'
        'run(lambda: lambda: print(os.environ.get("HOME")))'
    )
    done = subprocess.run(
        [sys.executable, '-c', code],
        env={'PYTHONPATH': os.pathsep.join(sys.path), **given},
        capture_output=True,
        text=True,
    )
    expected = pwd.getpwuid(os.getuid()).pw_dir
    if 'ROS_LOG_DIR' in given:
        expected = 'None'
    assert done.stdout.strip() == (given.get('HOME') or expected), done.stderr
