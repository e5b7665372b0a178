# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The status of a start: on a terminal a line that is erased, elsewhere periodic lines."""

import io
import re

from fixtures.bringup.running import Bringup, STACKS
import pytest

from amr_description.bringup import exited_cleanly, Node, Stack
from amr_description.bringup.console import Console
from amr_description.bringup.reporter import StartStatus, steps_text
from amr_description.bringup.run_log import LogFolder
from amr_description.bringup.scheduler import Scheduler

ERASED = '\r\x1b[K'
LATE = str(STACKS / 'late.py')


class Watched:
    """A stack of three steps, one after the other, and what is told of it."""

    def __init__(self, folder):
        self.one = Node('one')
        self.two = Node('two', start_when=exited_cleanly(self.one))
        self.three = Node('three', start_when=exited_cleanly(self.two))
        nodes = [self.one, self.two, self.three]
        self.scheduler = Scheduler(Stack(nodes, ready_when=exited_cleanly(self.three)))
        self.now = 100.0
        console = Console(io.StringIO(), LogFolder(folder, 'run'), colour=False)
        self.status = StartStatus(console, lambda node: node.executable, lambda: self.now)

    def at(self, seconds):
        self.now = 100.0 + seconds
        return self.status.text(self.scheduler)


def test_it_names_the_next_wait_and_how_long_it_takes(tmp_path):
    watched = Watched(tmp_path)
    watched.scheduler.on_start(watched.one)
    assert watched.at(0.0) == '0.0 s: two waits until one exited with code 0 (0.0 s)'
    assert watched.at(1.5) == '1.5 s: two waits until one exited with code 0 (1.5 s)'
    watched.scheduler.on_exit(watched.one, 0)
    watched.scheduler.on_start(watched.two)
    watched.at(2.0)
    assert watched.at(2.5) == '2.5 s: three waits until two exited with code 0 (0.5 s)'
    watched.scheduler.on_exit(watched.two, 0)
    watched.scheduler.on_start(watched.three)
    watched.at(3.0)
    assert watched.at(4.0) == '4.0 s: the stack waits until three exited with code 0 (1.0 s)'
    watched.scheduler.on_exit(watched.three, 0)
    assert watched.at(5.0) == ''


def console(folder, **options):
    screen = io.StringIO()
    return screen, Console(screen, LogFolder(folder, 'run'), colour=False, **options)


def test_lines_are_printed_before_the_status_line(tmp_path, monkeypatch):
    monkeypatch.setenv('COLUMNS', '20')
    screen, shown = console(tmp_path, erases=True)
    shown.status('waiting')
    shown.status('waiting')
    shown.output('one-1', 'hello')
    shown.status('')
    shown.output('one-1', 'again')
    assert screen.getvalue() == (
        f'{ERASED}waiting{ERASED}[one-1] hello\nwaiting{ERASED}[one-1] again\n'
    )


def test_the_status_is_as_long_as_the_screen_is_wide(tmp_path, monkeypatch):
    monkeypatch.setenv('COLUMNS', '20')
    screen, shown = console(tmp_path, erases=True)
    shown.status('0123456789' * 4)
    assert screen.getvalue() == f'{ERASED}0123456789012345678'


def test_a_screen_that_cannot_erase_has_no_status(tmp_path):
    screen, shown = console(tmp_path)
    shown.status('waiting')
    assert screen.getvalue() == ''


@pytest.mark.parametrize('term', ['xterm', 'dumb'])
def test_on_a_terminal_it_is_shown_until_the_stack_is_ready(tmp_path, term):
    env = {'NO_COLOR': '1', 'TERM': term, 'COLUMNS': '100'}
    with Bringup(tmp_path, LATE, terminal=True, **env) as bringup:
        waits = r'\d\.\d s: step-2 waits until gate-1 exited with code 0 \(\d\.\d s\)'
        if term == 'xterm':
            bringup.expect(f'\r\x1b\\[K{waits}')
        open_gate(bringup, tmp_path)
        bringup.expect('ready in')
        assert bringup.end(2) == 0
        assert re.search(r'launch\]: steps: gate-1 \d+\.\d s, step-2 \d+\.\d s\r', bringup.output)
        left = [rest_of(line) for line in bringup.output.split('\n')]
        assert [line for line in left if ' waits until ' in line] == []


def open_gate(bringup, folder):
    bringup.expect('gate is shut')
    (folder / 'prefix/gate').write_text('')


def rest_of(line):
    """What stays of a line on the screen."""
    return line.split(ERASED)[-1]


def test_elsewhere_a_line_is_printed_periodically(tmp_path):
    with Bringup(tmp_path, LATE) as bringup:
        bringup.expect(
            r'\[INFO\] \[launch\]: \d+\.\d s: step-2 waits until gate-1 exited with code 0 \(\d'
        )
        open_gate(bringup, tmp_path)
        bringup.expect('ready in')
        assert bringup.end(2) == 0


def test_only_the_longest_of_many_steps_are_named():
    steps = {f's{number}': float(number) for number in range(1, 10)}
    assert steps_text(steps) == (
        'steps: s4 4.0 s, s5 5.0 s, s6 6.0 s, s7 7.0 s, s8 8.0 s, s9 9.0 s and 3 shorter ones'
    )
    assert steps_text({'create-3': 1.26}) == 'steps: create-3 1.3 s'
