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
from support import failures, second_look
from support.forked_workers import ForkedWorkers
from support.repeating import Repeating

failures.FAILURES = pathlib.Path('failures').resolve()
second_look.FLAKY = pathlib.Path('flaky').resolve()
looks = os.environ['LOOKS']
second = second_look.SecondLook(strict=looks == 'strict') if looks else None

def note(*words):
    with open('notes', 'a') as file:
        print(*words, file=file)

def pytest_addoption(parser):
    parser.addoption('--repeat', type=int)

def pytest_configure(config):
    config.addinivalue_line('markers', 'in_order')
    workers = ForkedWorkers(
        2,
        lambda number: note('begin', number, os.getpid()),
        lambda: note('end', os.getpid()),
        lambda items: [item.path for item in items],
        float(os.environ['LONGEST']) if 'LONGEST' in os.environ else None,
        second,
    )
    repeat = config.option.repeat
    config.pluginmanager.register(Repeating(workers, repeat, load=1) if repeat else workers)

@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item):
    report = yield
    if report.failed:
        failures.keep(item.nodeid, report.longreprtext, None)
    return report

def pytest_terminal_summary(terminalreporter):
    for line in second.lines() if second else ():
        terminalreporter.write_line(line)

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


FLAKY = """
import os, pathlib
def test_first():
    here = pathlib.Path(__file__).with_suffix('.failed')
    assert here.exists() or here.touch(), 'at first'
    print('went well')
def test_other(): pass
"""


def run(folder, *arguments, longest=None, looks='', **files):
    """Pytest in a folder with these files, in workers; ``longest``: s, of a test."""
    (folder / 'conftest.py').write_text(CONFTEST)
    for name, text in files.items():
        (folder / f'test_{name}.py').write_text(text)
    options = ('-p', 'no:cacheprovider', '-p', 'no:hypothesispytest', '--junitxml=junit.xml')
    # Not the options of this run, such as those of colcon.
    env = {'PYTEST_ADDOPTS': '', 'LOOKS': looks}
    env |= {} if longest is None else {'LONGEST': str(longest)}
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
import os, signal, warnings
def test_before(): warnings.warn('look out')
def test_between(): pass
def test_dies(): os.kill(os.getpid(), signal.SIGSEGV)
def test_after(): pass
"""
    with run(tmp_path, '-p', 'no:faulthandler', dies=dies, good=GOOD, more=GOOD) as program:
        assert program.end() == pytest.ExitCode.TESTS_FAILED
    # The worker that takes the place of the dead one does not tell of that warning once more.
    assert '1 failed, 7 passed, 1 warning in' in program.output
    text = 'the process that ran test_dies.py::test_dies was killed by SIGSEGV'
    assert text in program.output
    assert len(of('begin', notes(tmp_path))) == 3


def test_a_test_that_waits_for_ever_fails_and_says_where(tmp_path):
    stuck = """
import subprocess, threading
def test_before(): pass
def test_stuck():
    with open('left', 'w') as file:
        print(subprocess.Popen(['sh', '-c', 'sleep 600; true']).pid, file=file)
    wait_for_nothing()
def test_after(): pass
def wait_for_nothing():
    threading.Event().wait()
"""
    with run(tmp_path, longest=5.0, stuck=stuck, good=GOOD) as program:
        assert program.end() == 1
        assert '1 failed, 4 passed' in program.output
        assert 'test_stuck was killed by SIGABRT' in program.output
        assert 'in wait_for_nothing' in program.output
        assert ends(int((tmp_path / 'left').read_text()))


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


def suite_of(folder):
    """What the JUnit file has: counts, and the tests that are said to be flaky."""
    [suite] = ElementTree.parse(folder / 'junit.xml').getroot()
    counted = tuple(int(suite.get(key)) for key in ('tests', 'failures', 'errors'))
    flaky = [
        case.get('classname')
        for case in suite.iter('testcase')
        if case.find('properties/property[@name="flaky"]') is not None
    ]
    return counted, sorted(flaky)


def test_a_test_that_fails_once_is_flaky_and_the_run_is_green(tmp_path):
    with run(tmp_path, '-rA', looks='normal', a=FLAKY, good=GOOD) as program:
        assert program.end() == 0, program.output
    assert '= 4 passed in' in program.output
    assert 'test_a.py::test_first failed; it will run once more, alone' in program.output
    assert 'FLAKY test_a.py::test_first' in program.output
    assert suite_of(tmp_path) == ((4, 0, 0), ['test_a'])
    (kept,) = (tmp_path / 'flaky').iterdir()
    assert 'at first' in (kept / 'first.txt').read_text()
    assert 'at first' in (kept / 'first' / 'failure.txt').read_text()
    assert 'went well' in (kept / 'second.txt').read_text()
    assert list((tmp_path / 'failures').iterdir()) == []
    first, second, *_ = [pid for (pid,) in of('test_a', notes(tmp_path))][::2]
    assert first != second


def test_a_test_that_fails_twice_is_red_and_shows_both(tmp_path):
    bad = """
import os
def test_bad(): assert os.getpid() == 0
"""
    with run(tmp_path, looks='normal', bad=bad, a=FLAKY) as program:
        assert program.end() == pytest.ExitCode.TESTS_FAILED, program.output
    assert '= 1 failed, 2 passed in' in program.output
    assert program.output.count('assert os.getpid() == 0') == 2
    assert 'how it failed the first time' in program.output
    assert suite_of(tmp_path) == ((3, 1, 0), ['test_a'])


@pytest.mark.parametrize(('looks', 'files', 'failed'), [('normal', 4, 4), ('strict', 1, 1)])
def test_many_files_with_flaky_tests_are_red_and_where_none_may_be_one_is(
    tmp_path, looks, files, failed
):
    names = 'abcd'[:files]
    with run(tmp_path, looks=looks, good=GOOD, **dict.fromkeys(names, FLAKY)) as program:
        assert program.end() == pytest.ExitCode.TESTS_FAILED, program.output
    assert f'= {failed} failed, {files + 2} passed in' in program.output
    assert suite_of(tmp_path) == ((2 + 2 * files, failed, 0), [f'test_{each}' for each in names])


def test_three_files_may_have_flaky_tests(tmp_path):
    with run(tmp_path, looks='normal', **dict.fromkeys('abc', FLAKY)) as program:
        assert program.end() == 0, program.output
    assert '= 6 passed in' in program.output
    assert '3 flaky: ' in program.output


def test_a_fixture_and_a_worker_that_fall_once_are_looked_at_again(tmp_path):
    falls = """
import os, pathlib, pytest
def once(name):
    is_first = not os.path.exists(name)
    pathlib.Path(name).touch()
    return is_first
@pytest.fixture
def late():
    yield
    assert not once('torn')
def test_torn(late): pass
def test_dies():
    if once('dies'): os._exit(3)
"""
    with run(tmp_path, looks='normal', falls=falls, good=GOOD) as program:
        assert program.end() == 0, program.output
    assert '= 4 passed in' in program.output
    assert suite_of(tmp_path) == ((4, 0, 0), ['test_falls', 'test_falls'])


def test_what_is_in_order_is_looked_at_with_what_it_builds_on(tmp_path):
    ordered = """
import pathlib, pytest
pytestmark = pytest.mark.in_order('')
made = []
def test_makes(): made.append(1)
def test_takes():
    here = pathlib.Path('taken')
    assert made == [1] and (here.exists() or here.touch())
"""
    with run(tmp_path, looks='normal', ordered=ordered) as program:
        assert program.end() == 0, program.output
    assert '= 2 passed in' in program.output


def test_repeating_counts_falls_and_says_where(tmp_path):
    every_third = """
import pathlib
def test_it():
    count = len(list(pathlib.Path().glob('run*')))
    pathlib.Path(f'run{count}').touch()
    assert count % 3 != 1, 'again'
"""
    with run(tmp_path, '--repeat', '7', it=every_third) as program:
        assert program.end() == pytest.ExitCode.TESTS_FAILED, program.output
    assert '= 2 failed, 5 passed in' in program.output
    said = program.output.replace('\r', '')
    assert 'test_it: fell 2 of 7 times\n    2 × test_it.py:6: AssertionError: again' in said
    (kept,) = (tmp_path / 'flaky').iterdir()
    assert {each.name for each in kept.iterdir()} == {'run-2', 'run-5'}
    assert len({pid for (pid,) in of('test_it', notes(tmp_path))}) == 7


def wait_for(file, program):
    """Wait until a program has written a file."""
    deadline = time.monotonic() + PATIENCE
    while not file.exists():
        assert program.process.poll() is None, program.output
        assert time.monotonic() < deadline, program.output
        time.sleep(0.01)
