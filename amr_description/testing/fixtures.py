# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Fixtures for pytest.

In your ``conftest.py``::

    pytest_plugins = ['amr_description.testing.fixtures']

A test that fails shows the last lines of the simulator's log; all of it is in a file beside that
of ``--junitxml`` (``failure_logs.py``). With ``--ros-bag=on-failure`` it leaves a bag
(``bags.py``).

They are not registered by an entry point ``pytest11``: that would load them, with their names,
into every pytest of the environment.
"""

from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import ExitStack
from typing import Any, TypeAlias
import warnings

import pytest

from amr_description.errors import SimulationError
from amr_description.simulation.tracebacks import is_for_the_test, without_frames
from amr_description.testing import bags
from amr_description.testing.failure_logs import add_logs, forget_ended
from amr_description.testing.simulation import Simulation

__tracebackhide__ = is_for_the_test

MakeSimulation: TypeAlias = Callable[..., Simulation]


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add ``--ros-bag`` and ``--ros-bag-dir``."""
    bags.add_options(parser)


def pytest_configure(config: pytest.Config) -> None:
    """Read them."""
    bags.configure(config)


def pytest_unconfigure() -> None:
    """Remove recordings that no test has ended."""
    bags.unconfigure()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup() -> None:
    """Forget the simulators of earlier tests."""
    forget_ended()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item,
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add the logs and bags of the simulators to the report of a test that fails."""
    report = yield
    bags.add_bags(item, report)
    if report.failed:
        add_logs(item, report)
    return report


@pytest.fixture(scope='module')
def simulation() -> Iterator[MakeSimulation]:
    """
    A function that returns a simulation at time 0; it takes the arguments of :class:`Simulation`.

    A simulation is started once in a module, reset by every further call with the same arguments,
    and started again if it has ended. All end with the module. The controllers stay as the last
    test has switched them. Programs that are started afterwards are in the ROS domain of the one
    that was returned last.
    """
    running: dict[str, Simulation] = {}

    def make(*args: Any, **options: Any) -> Simulation:
        key = repr((args, sorted(options.items())))
        if key in running:
            sim = running[key]
            if sim.is_alive:
                sim.enter_domain()
                sim.reset()
                bags.begin(sim.recording)
                return sim
            del running[key]
            try:
                _end([sim])
            except SimulationError as error:
                warnings.warn(f'{error}; it is started again', stacklevel=2)
        running[key] = Simulation(*args, **options).__enter__()
        return running[key]

    try:
        yield make
    finally:
        _end(running.values())


@without_frames
def _end(simulations: Iterable[Simulation]) -> None:
    with ExitStack() as stack:
        for sim in simulations:
            stack.push(sim)
