# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Tests in forked workers: each file in one process, and told of as if there were only one."""

import re
import signal
import sys
import time
import xml.etree.ElementTree as ElementTree

from fixtures.bringup.running import ends
import pytest
from support.forked_workers import together
from support.running_programs import PATIENCE, Program

CONFTEST = """
import os, pathlib, pytest
from support.forked_workers import ForkedWorkers

def note(*words):
    with open('notes', 'a') as file:
        print(*words, file=file)

def pytest_configure(config):
    config.pluginmanager.register(ForkedWorkers(
        2,
        lambda number: note('begin', number, os.getpid()),
        lambda: note('end', os.getpid()),
        lambda items: [item.path for item in items],
        float(os.environ['LONGEST']) if 'LONGEST' in os.environ else None,
    ))

note('collects', os.getpid())

@pytest.fixture(scope='session', autouse=True)
def of_the_session():
    yield
    note('torn_down', os.getpid())

@pytest.fixture(autouse=True)
def noted(request):
    note(request.path.stem, os.getpid())
"""
GOOD = """
def test_one(): pass
def test_two(): pass
"""


def run(folder, *arguments, longest=None, **files):
    """Pytest in a folder with these files, in workers; ``longest``: s, of a test."""
    (folder / 'conftest.py').write_text(CONFTEST)
    for name, text in files.items():
        (folder / f'test_{name}.py').write_text(text)
    options = ('-p', 'no:cacheprovider', '-p', 'no:hypothesispytest', '--junitxml=junit.xml')
    # Not the options of this run, such as those of colcon.
    env = {'PYTEST_ADDOPTS': ''} | ({} if longest is None else {'LONGEST': str(longest)})
    return Program(sys.executable, '-m', 'pytest', *options, *arguments, cwd=folder, env=env)


def notes(folder):
    """What was noted: the words of each line."""
    return [line.split() for line in (folder / 'notes').read_text().splitlines()]


def of(kind, found):
    return [words[1:] for words in found if words[0] == kind]


def test_groups_come_in_their_order_each_whole():
    assert together('bacab') == [[0, 4], [1, 3], [2]]


def test_each_file_runs_in_one_worker_and_all_is_told(tmp_path):
    bad = """
import warnings, pytest
def test_bad():
    print('printed by it')
    warnings.warn('look out', DeprecationWarning)
    one = 1
    assert one == 2
def test_skipped(): pytest.skip('not today')
@pytest.mark.xfail
def test_expected(): assert 0
@pytest.fixture
def broken(): raise ValueError('broken fixture')
def test_error(broken): pass
"""
    with run(tmp_path, '-rs', bad=bad, good=GOOD, more=GOOD) as program:
        assert program.end() == pytest.ExitCode.TESTS_FAILED, program.output
    said = program.output
    assert re.search('1 failed, 4 passed, 1 skipped, 1 xfailed, 1 warning, 1 error', said), said
    for words in ('printed by it', 'assert 1 == 2', 'broken fixture', 'not today', 'look out'):
        assert words in said
    assert '[100%]' in said
    found = notes(tmp_path)
    assert len(of('collects', found)) == 1
    workers = {pid for _, pid in of('begin', found)}
    assert len(workers) == 2
    assert workers == {pid for (pid,) in of('torn_down', found)}
    assert workers == {pid for (pid,) in of('end', found)}
    by_file = {name: {pid for (pid,) in of(f'test_{name}', found)} for name in ('good', 'more')}
    assert all(len(pids) == 1 and pids <= workers for pids in by_file.values())
    [suite] = ElementTree.parse(tmp_path / 'junit.xml').getroot()
    counted = {key: suite.get(key) for key in ('tests', 'failures', 'errors', 'skipped')}
    assert counted == {'tests': '8', 'failures': '1', 'errors': '1', 'skipped': '2'}


def test_a_worker_that_dies_fails_its_test_alone(tmp_path):
    dies = """
import os, signal
def test_before(): pass
def test_dies(): os.kill(os.getpid(), signal.SIGSEGV)
def test_after(): pass
"""
    with run(tmp_path, '-p', 'no:faulthandler', dies=dies, good=GOOD, more=GOOD) as program:
        assert program.end() == pytest.ExitCode.TESTS_FAILED
    assert '1 failed, 6 passed' in program.output
    text = 'the process that ran test_dies.py::test_dies was killed by SIGSEGV'
    assert text in program.output
    assert len(of('begin', notes(tmp_path))) == 3


def test_a_test_that_waits_for_ever_fails_and_says_where(tmp_path):
    stuck = """
import threading
def test_before(): pass
def test_stuck(): wait_for_nothing()
def test_after(): pass
def wait_for_nothing():
    threading.Event().wait()
"""
    with run(tmp_path, longest=5.0, stuck=stuck, good=GOOD) as program:
        assert program.end() == 1
        assert '1 failed, 4 passed' in program.output
        assert 'test_stuck was killed by SIGABRT' in program.output
        assert 'in wait_for_nothing' in program.output


def test_an_interrupted_run_tears_down_and_leaves_nobody(tmp_path):
    waits = """
import time
def test_waits():
    with open('waits', 'w'): pass
    while True:  # a signal in the moment before a sleep begins does not end it
        time.sleep(0.05)
"""
    with run(tmp_path, waits=waits, good=GOOD) as program:
        wait_for(tmp_path / 'waits', program)
        assert program.end(signal.SIGINT) == pytest.ExitCode.INTERRUPTED, program.output
    found = notes(tmp_path)
    assert [pid for (pid,) in of('test_waits', found)] in of('torn_down', found)
    assert all(ends(int(pid), 0.0) for _, pid in of('begin', found))


def test_workers_end_with_the_run_that_is_killed(tmp_path):
    waits = """
import os, time
def test_waits():
    parent = os.getppid()
    with open('waits', 'w'): pass
    while os.getppid() == parent: time.sleep(0.01)
def test_not(): pass
"""
    with run(tmp_path, waits=waits, good=GOOD) as program:
        wait_for(tmp_path / 'waits', program)
        program.signal(signal.SIGKILL)
        program.process.wait()
        assert all(ends(int(pid)) for _, pid in of('begin', notes(tmp_path)))
    found = notes(tmp_path)
    assert [pid for (pid,) in of('test_waits', found)] in of('torn_down', found)


def wait_for(file, program):
    """Wait until a program has written a file."""
    deadline = time.monotonic() + PATIENCE
    while not file.exists():
        assert program.process.poll() is None, program.output
        assert time.monotonic() < deadline, program.output
        time.sleep(0.01)
