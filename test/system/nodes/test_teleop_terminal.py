# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
teleop_twist_keyboard in particular terminals: with the kitty keyboard protocol, and in tmux.

The test plays the terminal: it answers what a terminal is asked, and sends its reports.
"""

import os
import re
import select
import shutil
import subprocess
import termios
import tty

import pytest
from support.running_programs import ENVIRONMENT, PATIENCE, Program
from support.teleop_host import COMMAND, driving, robot_node, XTERM

from amr_description.nodes.teleop_twist_keyboard.keyboard import (
    ASK,
    BEGIN_REPORTS,
    END_REPORTS,
    Keyboard,
)
from amr_description.terminal import KeyEvent

IDENTITY = '\x1b[?62;4c'
KNOWS_THE_PROTOCOL = f'\x1b[?0u{IDENTITY}'
PRESS_I, REPEAT_I, RELEASE_I = '\x1b[105;;105u', '\x1b[105;1:2;105u', '\x1b[105;1:3u'
PRESS_CTRL_C, RELEASE_CTRL_C = '\x1b[99;5u', '\x1b[99;5:3u'
PRESS_CTRL_Z = '\x1b[122;5u'
ONLY_A_RELEASE_STOPS = ('-p', 'key_timeout:=60.0')
REST, FORWARD = (0.0, 0.0), (0.5, 0.0)


@pytest.fixture
def robot():
    with robot_node() as node:
        yield node


def agree(program):
    """Answer that the terminal knows the protocol."""
    asked = program.expect(re.escape(ASK))
    program.type(KNOWS_THE_PROTOCOL)
    return program.expect(re.escape(BEGIN_REPORTS), since=asked.end())


def let_go(program, rest=''):
    """Wait for the end of the reports; answer, after ``rest`` that was on its way."""
    asked = program.expect(re.escape(END_REPORTS))
    program.type(rest + IDENTITY)
    return asked


def unread(terminal):
    """Return what a shell would find in the terminal."""
    tty.setraw(terminal, termios.TCSANOW)  # by default it drops what is there
    return os.read(terminal, 1024) if select.select([terminal], [], [], 0.0)[0] else b''


def test_a_release_that_the_terminal_tells_stops_the_robot(robot):
    with driving(robot, *ONLY_A_RELEASE_STOPS) as program:
        agree(program)
        program.type(PRESS_I)
        robot.until(lambda: len(robot.messages) > 4)
        assert {*robot.commands} == {FORWARD}
        program.type(REPEAT_I + RELEASE_I)
        robot.until(lambda: robot.commands[-1] == REST)
        program.type(PRESS_I)
        robot.until(lambda: robot.commands[-1] == FORWARD)
        assert robot.commands.count(REST) == 1


def test_the_protocol_is_left_and_nothing_of_it_reaches_the_shell(robot):
    with driving(robot, *ONLY_A_RELEASE_STOPS) as program:
        agree(program)
        program.type(PRESS_I)
        robot.until(lambda: FORWARD in robot.commands)
        program.type(PRESS_CTRL_C)
        let_go(program, rest=RELEASE_I + RELEASE_CTRL_C)
        assert program.end() == 0
        robot.until(lambda: robot.commands[-1] == REST)
        assert termios.tcgetattr(program.terminal) == program.before
        assert unread(program.terminal) == b''


def test_a_terminal_without_the_protocol_is_left_alone(robot):
    with driving(robot) as program:
        program.expect(re.escape(ASK))
        program.type(f'{IDENTITY}i')
        robot.until(lambda: robot.commands[-2:] == [FORWARD, REST])
        program.type('\x03')
        assert program.end() == 0
        assert BEGIN_REPORTS not in program.output
        assert END_REPORTS not in program.output
        assert REST not in robot.commands[: robot.commands.index(FORWARD)]  # by the answer


@pytest.mark.parametrize(
    ('words', 'env'),
    [(['--latch'], XTERM), ([], {'TERM': 'dumb'}), ([], {'TERM': 'linux'})],
    ids=['latch', 'dumb', 'linux'],
)
def test_it_is_not_asked_where_the_answer_is_no_use(words, env):
    words = [*words, '--ros-args', '-p', 'stamped:=false']  # looks for nobody
    with Program.module('teleop_twist_keyboard', *words, terminal=True, env=env) as program:
        program.expect('currently:')
        program.type('\x03')
        assert program.end() == 0
        assert '\x1b' not in program.output


@pytest.fixture
def pty(monkeypatch):
    """Return both ends of a pseudo-terminal: that of the user, that of the program."""
    monkeypatch.setenv('TERM', 'xterm')
    ends = os.openpty()
    yield ends
    for end in ends:
        os.close(end)


def test_an_answer_still_due_at_the_end_does_not_reach_the_shell(pty):
    user, terminal = pty
    with Keyboard(terminal, alternative='', releases=True):
        assert os.read(user, 1024).decode() == ASK
        os.write(user, f'i{KNOWS_THE_PROTOCOL}'.encode())
    assert unread(terminal) == b''
    assert not select.select([user], [], [], 0.0)[0]  # nothing begun, nothing to end


def test_a_sequence_in_two_pieces_is_one_key(pty):
    user, terminal = pty
    with Keyboard(terminal, alternative='', releases=True) as keyboard:
        os.write(user, KNOWS_THE_PROTOCOL.encode())
        assert keyboard.read(PATIENCE) == []
        os.write(user, RELEASE_I[:-2].encode())
        assert keyboard.read(PATIENCE) == []
        os.write(user, RELEASE_I[-2:].encode())  # "3u"; u drives
        assert keyboard.read(PATIENCE) == [KeyEvent('i', 'i', is_release=True)]
        os.write(user, IDENTITY.encode())  # to the end of the reports


def test_the_key_escape_is_told_although_nothing_follows(pty):
    user, terminal = pty
    with Keyboard(terminal, alternative='', releases=False) as keyboard:
        os.write(user, b'\x1b')
        assert keyboard.read(None) == []
        assert keyboard.read(None) == [KeyEvent('\x1b', '\x1b')]


def test_ctrl_z_leaves_the_protocol_and_fg_takes_it_up_again(robot):
    robot.listen()
    bash = ['bash', '--norc', '--noediting', '-i']
    with Program(*bash, terminal=True, env={'PS1': 'prompt> ', **XTERM}) as shell:
        shell.expect('prompt> ')
        shell.type(f'{COMMAND} --ros-args -p key_timeout:=60.0\n')
        agree(shell)
        robot.until(lambda: shell.type(PRESS_I) or FORWARD in robot.commands)
        shell.type(PRESS_CTRL_Z)
        asked = let_go(shell)
        stopped = shell.expect(r'Stopped[^\n]*\nprompt> ', since=asked.end())
        robot.until(lambda: robot.commands[-1] == REST)
        shell.type('fg\n')
        resumed = shell.expect(re.escape(BEGIN_REPORTS), since=stopped.end())
        shell.type(PRESS_I)
        robot.until(lambda: robot.commands[-1] == FORWARD)
        shell.type(PRESS_CTRL_C)
        asked = shell.expect(re.escape(END_REPORTS), since=resumed.end())
        shell.type(IDENTITY)
        shell.expect('prompt> ', since=asked.end())
        robot.until(lambda: robot.commands[-1] == REST)
        shell.type('echo it ended with $?\n')
        shell.expect('it ended with 0')


# A supervisor, which gives its child a session of its own, and the terminal as it is.
SUPERVISOR = """
import signal, subprocess, sys
command = [sys.executable, '-m', 'amr_description.nodes.teleop_twist_keyboard']
child = subprocess.Popen(command, start_new_session=True)
signal.signal(signal.SIGINT, lambda *_: child.send_signal(signal.SIGINT))
print('child left with', child.wait())
"""


@pytest.mark.parametrize('has_protocol', [True, False], ids=['protocol', 'plain'])
def test_with_the_terminal_of_a_supervisor(robot, has_protocol):
    robot.listen()
    with Program.of(SUPERVISOR, terminal=True, env=XTERM) as program:
        before = termios.tcgetattr(program.terminal)
        if has_protocol:
            agree(program)
        program.expect('currently:')
        robot.until(lambda: program.type('i') or FORWARD in robot.commands)
        program.type(PRESS_CTRL_C if has_protocol else '\x03')
        if has_protocol:
            let_go(program)
        program.expect('child left with 0')
        assert program.end() == 0
        robot.until(lambda: robot.commands[-1] == REST)
        assert termios.tcgetattr(program.terminal) == before


class Tmux:
    """A tmux server of its own, with one session that runs a shell."""

    def __init__(self, folder):
        self._socket = str(folder / 'tmux')
        self('-f', '/dev/null', 'new-session', '-d', '-x', '150', '-y', '60', 'sh')

    def __enter__(self):
        return self

    def __exit__(self, *_error):
        self('kill-server')

    def __call__(self, *words):
        environment = os.environ | ENVIRONMENT
        environment.pop('TMUX', None)
        return subprocess.run(
            ['tmux', '-S', self._socket, *words],
            env=environment, check=True, capture_output=True, text=True, timeout=20.0,
        ).stdout  # fmt: skip

    def type(self, keys):
        self('send-keys', '-l', keys)

    @property
    def screen(self):
        return self('capture-pane', '-p', '-J', '-S', '-')


@pytest.mark.skipif(not shutil.which('tmux'), reason='tmux is not installed: a pty only')
def test_in_tmux(robot, tmp_path):
    robot.listen()
    with Tmux(tmp_path) as tmux:
        robot.until(lambda: tmux.screen.strip())  # a prompt
        tmux.type(f'echo before $(stty -g); {COMMAND}; echo left with $?, after $(stty -g)\n')
        robot.until(lambda: 'currently:' in tmux.screen)
        robot.until(lambda: tmux.type('i') or FORWARD in robot.commands)
        robot.until(lambda: robot.commands[-1] == REST)  # released
        robot.until(lambda: tmux.type('i') or robot.commands[-1] == FORWARD)
        tmux('send-keys', 'C-c')
        robot.until(lambda: re.search(r'^left with \d', tmux.screen, re.MULTILINE))
        robot.until(lambda: robot.commands[-1] == REST)
        before = re.search(r'^before (\S+)', tmux.screen, re.MULTILINE)[1]
        assert f'left with 0, after {before}' in tmux.screen
        assert '62' not in tmux.screen.partition('left with 0')[2].replace(before, '')
