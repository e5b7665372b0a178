# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Give each test process a ROS of its own: a free domain, this host only, its own log folder.

So several can run side by side: of several checkouts, or of one (``scripts/test``).
"""

import gc
import math
import os
from pathlib import Path
import secrets
import signal
import sys
import tempfile

from hypothesis import settings
import pytest
from support import failures, ordering, preloaded

from amr_description.testing import program
from amr_description.testing.program import take_domain, WAYS_TO_OTHERS

ROOT = Path(__file__).resolve().parents[1]
UNIT = ROOT / 'test' / 'unit'
# The parts of these are tested too, and benchmarks/ is imported from the checkout.
sys.path[:0] = [str(ROOT / 'scripts'), str(ROOT / 'interfaces'), str(ROOT)]

pytest_plugins = ['support.stderr_file']
preloaded.start_for(program)  # the simulators of tests that are written as users write theirs
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
    if is_worker(config):
        config.option.random_order = config.workerinput['seed']
    elif config.option.random_order == '':
        config.option.random_order = secrets.token_hex(4)
    if has_workers(config) or not is_worker(config):
        KEPT['durations'] = ordering.read_durations(ordering.OWN_TABLE, ordering.SEED_TABLE)
        config.pluginmanager.register(Recording(config))
    # A background job starts with Ctrl-C ignored, which every child would inherit.
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if has_workers(config):
        return  # it starts no test; each worker finds the shell's domain forbidden, and takes one
    domain, KEPT['lock'] = take_domain()
    KEPT['logs'] = tempfile.TemporaryDirectory(prefix='amr-test-logs-')
    prefixes = [str(ROOT / 'install' / 'amr_description'), sys.prefix]
    known = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    for variable in WAYS_TO_OTHERS:
        os.environ.pop(variable, None)
    os.environ |= {
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'ROS_LOG_DIR': KEPT['logs'].name,
        'AMENT_PREFIX_PATH': os.pathsep.join(
            dict.fromkeys(prefix for prefix in (*prefixes, *known) if prefix)
        ),
    }


def has_workers(config):
    """Whether this process only hands tests out to others, those of pytest-xdist (``-n``)."""
    return bool(config.getoption('numprocesses', None))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config):
    """
    How many processes ``-n auto`` is: five for two cores, as they wait for others half of the
    time. What is in ``test/unit`` waits for nobody: one for each core, each more would only
    collect all of it once more.
    """
    paths = [(config.invocation_params.dir / arg.split('::')[0]) for arg in config.args]
    is_waiting = not all(path.resolve().is_relative_to(UNIT) for path in paths)
    return round(len(os.sched_getaffinity(0)) * (2.5 if is_waiting else 1))


def is_worker(config):
    """Whether this process is one of several that run tests."""
    return hasattr(config, 'workerinput')


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node):
    """Tell a worker the seed, and how long files take: all must have the same order of tests."""
    node.workerinput['seed'] = node.config.option.random_order
    node.workerinput['durations'] = KEPT['durations']


@pytest.hookimpl(tryfirst=True)  # pytest then brings together what shares a costly parameter
def pytest_collection_modifyitems(config, items):
    if not config.option.long:
        long = [item for item in items if item.get_closest_marker('long')]
        if long:
            config.hook.pytest_deselected(items=long)
            items[:] = [item for item in items if item not in long]
    if seed := config.option.random_order:
        items.sort(key=lambda item: ordering.random_place(item, seed))
    elif is_worker(config):
        table = config.workerinput['durations']
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
    gc.collect()
    gc.freeze()
    # Seldom: that takes 4 % of the processor time of test/unit, where Hypothesis hears of each.
    gc.set_threshold(10_000)
    gc.enable()


def pytest_report_header(config):
    domain = 'of each worker' if has_workers(config) else os.environ['ROS_DOMAIN_ID']
    return [f'ROS_DOMAIN_ID={domain}, LOCALHOST', *order_notes(config)]


def pytest_terminal_summary(terminalreporter, config):
    for note in order_notes(config):
        terminalreporter.write_line(note)


def order_notes(config):
    if seed := config.option.random_order:
        return [f'random order; the same again: --random-order={seed}']
    return []


def pytest_unconfigure(config):
    if not has_workers(config):
        KEPT['logs'].cleanup()
        os.close(KEPT['lock'])
