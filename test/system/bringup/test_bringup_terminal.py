# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One process of a stack with the terminal: as if a shell had started it."""

import os
import shlex
import signal
import sys
import termios
import time

from fixtures.bringup.running import Bringup, install_toys, STACKS
import pytest
from support.running_programs import PATIENCE, Program

from amr_description.bringup.console import Console
from amr_description.bringup.run_log import LogFolder

STACK = str(STACKS / 'with_terminal.py')
COMMAND = shlex.join([sys.executable, '-m', 'amr_description.bringup.main', STACK])


class Keys(Bringup):
    """The stack on a terminal, whose settings are known from before."""

    def __init__(self, folder, *arguments, **env):
        env = {'NO_COLOR': '1', 'TERM': 'xterm'} | env  # without TERM no line is ever erased
        super().__init__(folder, STACK, *arguments, terminal=True, **env)
        self.before = termios.tcgetattr(self.terminal)

    def up(self):
        """Wait until keys are read, in the foreground."""
        self.expect('keys in True')
        self.expect('complainer-1')
        assert termios.tcgetattr(self.terminal) != self.before
        return self

    def over(self, signum=None):
        """Return the exit code; the terminal is as it was, and nothing is left."""
        if signum is not None:
            self.signal(signum)
        code = self.process.wait(PATIENCE)
        assert termios.tcgetattr(self.terminal) == self.before
        assert self.left() == []
        self.end()
        return code


def shell(folder):
    """A shell with job control, in which COMMAND starts the stack."""
    install_toys(folder / 'prefix')
    env = {'AMENT_PREFIX_PATH': str(folder / 'prefix'), 'ROS_LOG_DIR': str(folder / 'logs')}
    env |= {'NO_COLOR': '1', 'PS1': 'shell> ', 'TERM': 'xterm'}
    words = ['bash', '--norc', '--noprofile', '--noediting', '-i']
    return Program(*words, terminal=True, env=env)


def until(condition):
    """Wait for what no descriptor tells."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, 'waited in vain'
        os.sched_yield()


def test_it_reads_keys_and_its_end_stops_the_stack(tmp_path):
    with Keys(tmp_path, 'late:=true') as bringup:
        bringup.expect('has the terminal; what the others say goes to .*/launch.log, their')
        bringup.up().type('a')
        bringup.expect("key 'a'")
        bringup.type('q')
        assert bringup.over() == 0
        assert bringup.output.index('ready in') < bringup.output.index('has the terminal')


@pytest.mark.parametrize(
    ('key', 'code', 'told'),
    [
        ('\x03', 0, 'process has finished cleanly'),  # raw mode: a key like any other
        ('i', 0, 'user interrupted with ctrl-c'),
        ('x', 3, 'keys-2 ended with exit code 3: what it said stands above'),
        ('!', 137, 'keys-2 died of SIGKILL: what it said stands above'),
    ],
)
def test_the_terminal_is_restored_in_every_way_out_of_the_process(tmp_path, key, code, told):
    with Keys(tmp_path) as bringup:
        bringup.up().type(key)
        assert bringup.over() == code
        assert told in bringup.output


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_the_terminal_is_restored_in_every_way_out_of_the_orchestrator(tmp_path, number):
    with Keys(tmp_path) as bringup:
        assert bringup.up().over(number) == 0


def test_it_ends_with_a_killed_orchestrator(tmp_path):
    with Keys(tmp_path) as bringup:
        bringup.up().signal(signal.SIGKILL)
        bringup.process.wait(PATIENCE)
        os.close(bringup._slave)
        bringup._slave = None
        until(lambda: not bringup.left())


def test_the_output_of_others_does_not_garble_the_screen(tmp_path):
    with Keys(tmp_path) as bringup:
        bringup.up()
        log = bringup.logs / 'latest/complainer-1.log'
        until(lambda: log.exists() and 'all is well' in log.read_text())
        os.kill(bringup.pids()['complainer-1'], signal.SIGUSR1)
        bringup.expect(r'\r\x1b\[K\[complainer-1\] \[WARN\] \[1.0\] \[complainer\]: look here\r\n')
        assert 'a detail' not in bringup.output
        bringup.type('q')
        assert bringup.over() == 0
        log = (bringup.logs / 'latest/launch.log').read_text()
        assert '[complainer-1] [INFO] [1.0] [complainer]: a detail\n' in log


def test_ctrl_z_and_fg_as_in_a_shell(tmp_path):
    with shell(tmp_path) as program:
        program.expect('shell> ')
        before = termios.tcgetattr(program.terminal)
        program.type(f'{COMMAND}\n')
        program.expect('keys in True')
        for _ in range(2):
            since = len(program.output)
            program.type('\x1a')
            program.expect(r'Stopped .*\n.*shell> ', since)
            assert termios.tcgetattr(program.terminal) == before
            program.type('echo "in the $((40 + 2)) shell"; fg\n')
            program.expect('in the 42 shell', since)
            program.expect('keys in True', since)
            program.type('b')
            program.expect("key 'b'", since)
        since = len(program.output)
        program.type('q')
        program.expect('shell> ', since)
        program.type('echo "code $?."; exit\n')
        program.expect(r'code 0\.', since)
        assert termios.tcgetattr(program.terminal) == before


def test_started_in_the_background_it_waits_for_the_terminal(tmp_path):
    with shell(tmp_path) as program:
        program.type(f'{COMMAND} &\n')
        program.expect('keys-2.: process started')
        program.type('echo "the $((40 + 2)) shell"\n')
        program.expect('the 42 shell')
        program.type('fg\n')
        program.expect('keys in True')
        program.type('q')
        program.expect('process has finished cleanly')


def test_without_a_terminal_one_line_says_what_to_do_instead(tmp_path):
    with Bringup(tmp_path, STACK) as bringup:
        assert bringup.end() == 2
        assert bringup.lines == [
            'bringup: standard input is not a terminal, and keys reads keys from it: run this in '
            'a terminal (over ssh: ssh -t), or bring up a stack without it and, in a terminal of '
            'its own, ros2 run toys keys'
        ]
        assert not bringup.logs.exists()


def test_with_its_output_in_a_pipe_it_still_gets_the_keys(tmp_path):
    piped = ['sh', '-c', '"$@" | cat', 'sh']  # as `bringup … | tee log`
    with Bringup(tmp_path, STACK, launcher=piped, terminal=True) as bringup:
        bringup.expect('keys in True')
        bringup.type('q')
        bringup.expect('process has finished cleanly')


def test_a_lent_screen_without_erasing(tmp_path):
    with (tmp_path / 'screen').open('w+') as screen:
        console = Console(screen, LogFolder(tmp_path, 'run'), colour=False)
        console.set_lent(True)
        console.log('INFO', 'a', 'unseen')
        console.log('WARNING', 'a', 'seen')
        console.set_lent(False)
        console.status('no status here')
        console.log('INFO', 'a', 'seen again')
        screen.seek(0)
        assert screen.read() == '[WARNING] [a]: seen\n[INFO] [a]: seen again\n'
