# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A marker for pytest: a test that is run with many seeds, and passes if enough of them do.

In your ``conftest.py``, where ROS need not be::

    pytest_plugins = ['amr_description.testing.trials_marker']

and a test::

    @pytest.mark.trials(200, at_least=0.95)
    def test_it_docks(simulate, rng):
        ...

It is a trial, as of :mod:`amr_description.trials`: it takes ``simulate``, ``rng`` and what
``vary`` names, and is run in other processes. A test without the marker that takes ``simulate``
and ``rng`` is run once, here.
"""

from collections.abc import Iterator
import math
from pathlib import Path
import re

import numpy as np
import pytest

from amr_description.errors import TrialsError
from amr_description.simulation.tracebacks import is_for_the_test
from amr_description.trials.command import shard_of, write
from amr_description.trials.function import varied_of
from amr_description.trials.one_run import Simulations
from amr_description.trials.report import TrialsReport
from amr_description.trials.runner import TIMEOUT, trials

__tracebackhide__ = is_for_the_test

_MARKER = 'trials'
_SUMMARIES = pytest.StashKey[list[str]]()
_SIMULATIONS = pytest.StashKey[Simulations]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options."""
    group = parser.getgroup('trials', 'tests that are run with many seeds')
    group.addoption(
        '--trials-seed', type=int, default=0, metavar='SEED', help='the first seed (0)'
    )
    group.addoption(
        '--shard', type=shard_of, default=(1, 1), metavar='I/N', help='every Nth run of each test'
    )
    group.addoption(
        '--trials-dir', type=Path, metavar='FOLDER', help='leave reports, plots and bags here'
    )


def pytest_configure(config: pytest.Config) -> None:
    """Make the marker known."""
    config.addinivalue_line(
        'markers',
        f'trials(count, at_least=1.0, timeout={TIMEOUT:g}): run it with so many seeds; such a '
        'share has to pass, each within so many seconds',
    )
    config.stash[_SUMMARIES] = []
    config.stash[_SIMULATIONS] = Simulations()


def pytest_unconfigure(config: pytest.Config) -> None:
    """End the simulations of this process."""
    config.stash[_SIMULATIONS].close()


@pytest.fixture
def rng(request: pytest.FixtureRequest) -> np.random.Generator:
    """The random numbers of the first seed."""
    return np.random.default_rng(request.config.getoption('--trials-seed'))


@pytest.fixture
def simulate(request: pytest.FixtureRequest) -> Iterator[Simulations]:
    """Takes the arguments of Simulation, and returns one at time 0 without ROS."""
    simulations = request.config.stash[_SIMULATIONS]
    seed = request.config.getoption('--trials-seed')
    simulations.begin(seed, fresh=False, bag='')
    yield simulations
    simulations.end()


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Stand in for the parameters of ``vary``, which each run has values of its own of."""
    if metafunc.definition.get_closest_marker(_MARKER):
        hidden = getattr(pytest, 'HIDDEN_PARAM', _MARKER)  # pytest 8.4
        for name in varied_of(metafunc.function):
            metafunc.parametrize(name, [None], ids=[hidden])


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a test that is marked, with all its seeds."""
    marker = pyfuncitem.get_closest_marker(_MARKER)
    if marker is None:
        return None
    count, at_least, timeout = _arguments(*marker.args, **marker.kwargs)
    config = pyfuncitem.config
    first, shard = config.getoption('--trials-seed'), config.getoption('--shard')
    folder = config.getoption('--trials-dir')
    if folder is not None:
        folder /= re.sub(r'[^\w-]+', '.', pyfuncitem.nodeid).strip('.')
    report = trials(
        pyfuncitem.obj,
        range(first, first + count),
        timeout=timeout,
        shard=shard,
        bags=None if folder is None else folder / 'bags',
    )
    where = '' if folder is None else f'\n  {write(report, folder)}'
    config.stash[_SUMMARIES].append(f'{pyfuncitem.nodeid}: {report.summary}')
    if report.was_interrupted:
        raise KeyboardInterrupt
    if reason := _why_it_fails(report, at_least, shard[1]):
        pytest.fail(f'{reason}\n{report}{where}', pytrace=False)
    return True


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """Say how often each test has passed."""
    for line in config.stash[_SUMMARIES]:
        terminalreporter.write_line(line)


def _arguments(
    count: int, at_least: float = 1.0, timeout: float = TIMEOUT
) -> tuple[int, float, float]:
    if not (isinstance(count, int) and count > 0 and 0.0 <= at_least <= 1.0):
        raise TrialsError(
            f'trials({count!r}, at_least={at_least!r}); a number of seeds above 0, and a share '
            'between 0 and 1 will do'
        )
    return count, at_least, timeout


def _why_it_fails(report: TrialsReport, at_least: float, shards: int) -> str:
    """
    Return why a test fails; empty: it passes.

    A shard fails once it has more runs that did not pass than all together may have; the others
    are judged by ``--merge``, with the share of the whole.
    """
    if not report.is_sound:
        return 'a run has no result that counts, or another one when it is repeated'
    most = math.floor((1.0 - at_least) * report.total * shards + 1e-9)
    if shards > 1 and len(report.bad) > most:
        return f'more than {most} runs did not pass, of all that the {shards} shards have'
    if shards == 1 and report.share < at_least:
        return f'{100 * report.share:.1f} % passed, and {100 * at_least:g} % have to'
    return ''
