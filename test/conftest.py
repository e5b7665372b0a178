# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Give each test file a ROS of its own: a free domain, this host only; and each process a log folder.

So several can run side by side: of several checkouts, or of one (``scripts/test``).
"""

import contextlib
import gc
import math
import os
from pathlib import Path
import secrets
import shutil
import signal
import sys
import tempfile

from hypothesis import settings
import pytest
from support import (
    failures,
    forked_workers,
    leftovers,
    ordering,
    preloaded,
    repeating,
    second_look,
    udp_contexts,
)

from amr_description.errors import SimulationError
from amr_description.testing import program
from amr_description.testing.program import take_domain, WAYS_TO_OTHERS

ROOT = Path(__file__).resolve().parents[1]
UNIT = ROOT / 'test' / 'unit'
# The parts of these are tested too, and benchmarks/ is imported from the checkout.
sys.path[:0] = [str(ROOT / 'scripts'), str(ROOT)]

pytest_plugins = ['support.open_path', 'support.stderr_file']
preloaded.start_for(program)  # the simulators of tests that are written as users write theirs
LONGEST_TEST = 300.0
"""s; the longest takes 15 s by itself, and a minute on a busy machine."""
LONGEST_ID = 80
"""Characters that are shown of a parameter."""
KEPT = {}  # what has to last as long as the run

# Everywhere the same numbers, no deadline on a busy machine, and half as many examples as
# Hypothesis tries by itself: whoever is writing waits for them.
settings.register_profile('normal', settings.get_profile('ci'), max_examples=50)
# Numbers that nobody has tried yet, and many of them (support/examples.py).
settings.register_profile(
    'long', settings.get_profile('ci'), max_examples=2_000, derandomize=False
)
settings.load_profile('normal')


def pytest_addoption(parser):
    parser.addoption(
        '--random-order',
        metavar='SEED',
        nargs='?',
        const='',
        help='files, and the tests in each, in random order; without a seed a new one, printed',
    )
    parser.addoption(
        '--workers',
        metavar='N',
        type=lambda text: text if text == 'auto' else int(text),
        default=0,
        help='run whole files in N processes, the longest first; auto: as many as are of use',
    )
    parser.addoption(
        '--no-flaky',
        action='store_true',
        help='with --workers: a test that fails, and passes when it is run once more alone, fails',
    )
    parser.addoption(
        '--repeat', metavar='N', type=int, default=0, help='run the tests N times, one by one'
    )
    parser.addoption(
        '--load', metavar='N', type=int, default=0, help='with --repeat: beside N busy processes'
    )
    parser.addoption(
        '--long', action='store_true', help='also what is worth an hour: tests marked long'
    )


def pytest_configure(config):
    config.addinivalue_line(
        'markers',
        'in_order(reason): the tests of this file build on each other, and stay in order',
    )
    config.addinivalue_line('markers', 'long: takes minutes, and runs with --long only')
    if config.option.long:
        settings.load_profile('long')
    if config.option.random_order == '':
        config.option.random_order = secrets.token_hex(4)
    if config.option.workers == 'auto':
        config.option.workers = suitable_workers(config)
    if config.option.repeat:
        workers = forked_workers_of(config, 1)
        config.pluginmanager.register(
            repeating.Repeating(workers, config.option.repeat, config.option.load)
        )
    elif config.option.workers:
        if not config.option.maxfail:
            strict = config.option.no_flaky or config.option.long
            KEPT['second_look'] = second_look.SecondLook(strict=strict)
        config.pluginmanager.register(forked_workers_of(config, config.option.workers))
    KEPT['durations'] = ordering.read_durations(ordering.OWN_TABLE, ordering.SEED_TABLE)
    config.pluginmanager.register(Recording(config))
    # A background job starts with Ctrl-C ignored, which every child would inherit.
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    # Under nohup, what the tests start is to end when its terminal is closed; the tests are not.
    if signal.getsignal(signal.SIGHUP) == signal.SIG_IGN:
        signal.signal(signal.SIGHUP, lambda *_: None)
    take_ros_of_its_own()
    prefixes = [str(ROOT / 'install' / 'amr_description'), sys.prefix]
    known = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    for variable in WAYS_TO_OTHERS:
        os.environ.pop(variable, None)
    os.environ |= {
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'AMENT_PREFIX_PATH': os.pathsep.join(
            dict.fromkeys(prefix for prefix in (*prefixes, *known) if prefix)
        ),
    }


def forked_workers_of(config, count):
    """What runs tests in that many processes."""
    second_look.begin()
    return forked_workers.ForkedWorkers(
        count,
        lambda number: begin_worker(config, number),
        give_back,
        lambda items: ordering.groups(items, KEPT['durations']),
        None if config.option.long else LONGEST_TEST,
        KEPT.get('second_look'),
    )


def take_ros_of_its_own():
    """Give this process a domain in which nobody is, and a folder of logs."""
    domain, KEPT['lock'] = take_domain()
    KEPT['logs'] = tempfile.mkdtemp(prefix='amr-test-logs-')
    os.environ |= {'ROS_DOMAIN_ID': str(domain), 'ROS_LOG_DIR': KEPT['logs']}


def change_domain():
    """
    Go to another domain, for the next file.

    Whoever is still on the way out of this one, or was killed and stays in the graph for 20 s, is
    not seen by its tests.
    """
    with contextlib.suppress(SimulationError):  # all are taken: that is no fault of the tests
        domain, lock = take_domain()
        os.close(KEPT['lock'])
        KEPT['lock'] = lock
        os.environ[program.DOMAIN] = str(domain)


def give_back():
    """Remove the logs, and leave the domain to others."""
    shutil.rmtree(KEPT['logs'])
    os.close(KEPT['lock'])


def begin_worker(config, number):
    """Give a worker what it may not share with others."""
    # In a folder with those of all tests, pytest would look through thousands for each.
    factory = config._tmp_path_factory
    factory._basetemp = factory.getbasetemp() / f'worker-{number}'
    factory._basetemp.mkdir(mode=0o700, exist_ok=True)
    os.close(KEPT['lock'])  # the parent still has it, and its logs
    take_ros_of_its_own()


def suitable_workers(config):
    """
    How many processes ``--workers=auto`` is: five for two cores, as they wait for others half of
    the time. What is in ``test/unit`` waits for nobody: one for each core.
    """
    paths = [(config.invocation_params.dir / arg.split('::')[0]) for arg in config.args]
    is_waiting = not all(path.resolve().is_relative_to(UNIT) for path in paths)
    return len(os.sched_getaffinity(0)) * (5 if is_waiting else 2) // 2


def pytest_make_parametrize_id(val):
    """Cut the ids of long texts: one of 40 MB is in each message and report of a run."""
    if isinstance(val, str | bytes) and len(val) > LONGEST_ID:
        begin = val[:LONGEST_ID]
        text = begin.decode('latin-1') if isinstance(begin, bytes) else begin
        return f'{text.encode("unicode_escape").decode()}... {len(val)} in all'
    return None


@pytest.hookimpl(tryfirst=True)  # pytest then brings together what shares a costly parameter
def pytest_collection_modifyitems(config, items):
    if not config.option.long:
        long = [item for item in items if item.get_closest_marker('long')]
        if long:
            config.hook.pytest_deselected(items=long)
            items[:] = [item for item in items if item not in long]
    if seed := config.option.random_order:
        items.sort(key=lambda item: ordering.random_place(item, seed))
    elif config.option.workers:
        table = KEPT['durations']
        durations = {path: ordering.duration_of(path, table) for path in {i.path for i in items}}
        for item in items:  # here only with --long
            if item.get_closest_marker('long'):
                durations[item.path] = math.inf
        items.sort(key=lambda item: -durations[item.path])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item):
    report = yield
    if report.failed and not hasattr(report, 'wasxfail'):
        said = '\n'.join(f'--- {title}\n{text}' for title, text in report.sections)
        temporary = getattr(item, 'funcargs', {}).get('tmp_path')
        failures.keep(item.nodeid, f'{report.longreprtext}\n{said}', temporary)
    return report


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item, nextitem):
    try:
        return (yield)
    finally:
        leftovers.collect_participants()
        if nextitem is not None and nextitem.path != item.path:
            change_domain()


class Recording:
    """Writes down how long each file takes, where whole files run."""

    def __init__(self, config):
        self.durations = ordering.DurationRecorder(config.rootpath)
        selecting = (
            *('keyword', 'markexpr', 'deselect', 'lf', 'stepwise', 'maxfail', 'collectonly'),
            'long',  # more than usual
        )
        self.is_whole = not any(config.getoption(name, None) for name in selecting) and not any(
            '::' in argument for argument in config.args
        )

    def pytest_runtest_logreport(self, report):
        self.durations.add(report.nodeid, report.duration)

    def pytest_sessionfinish(self, exitstatus):
        if self.is_whole and exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
            self.durations.write(ordering.OWN_TABLE, ordering.test_files())


def pytest_sessionstart():
    gc.disable()  # thousands of tests come, and stay: no garbage collection need look at them


@pytest.hookimpl(trylast=True)
def pytest_collection_finish():
    udp_contexts.use_udp_only()
    gc.freeze()  # also what is garbage already: a search for it takes longer than it is worth
    # Seldom: that takes 4 % of the processor time of test/unit, where Hypothesis hears of each.
    gc.set_threshold(10_000)
    gc.enable()


def pytest_report_header(config):
    domain = 'of each file' if config.option.workers else os.environ['ROS_DOMAIN_ID']
    return [f'ROS_DOMAIN_ID={domain}, LOCALHOST', *order_notes(config)]


def pytest_terminal_summary(terminalreporter, config):
    flaky = KEPT['second_look'].lines() if 'second_look' in KEPT else []
    for note in (*order_notes(config), *flaky):
        terminalreporter.write_line(note)


def order_notes(config):
    if seed := config.option.random_order:
        return [f'random order; the same again: --random-order={seed}']
    return []


def pytest_unconfigure():
    give_back()
