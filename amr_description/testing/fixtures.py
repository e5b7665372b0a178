# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Fixtures for pytest.

In your ``conftest.py``::

    pytest_plugins = ['amr_description.testing.fixtures']

They are no plugin of every pytest in this environment (an entry point ``pytest11`` would be): who
does not ask for them pays nothing, and no name of theirs gets in anybody's way.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any
import warnings

import pytest

from amr_description.errors import SimulationError
from amr_description.testing.simulation import Simulation

type MakeSimulation = Callable[..., Simulation]


@pytest.fixture(scope='module')
def simulation() -> Iterator[MakeSimulation]:
    """
    A function that gives a robot at time 0; it takes what :class:`Simulation` takes.

    Started once in a module and reset at every further call with the same arguments; started
    again if it has ended meanwhile. All end with the module. The controllers stay as a test has
    switched them.
    """
    running: dict[str, tuple[Simulation, ExitStack]] = {}

    def make(*args: Any, **options: Any) -> Simulation:
        key = repr((args, sorted(options.items())))
        if key in running:
            sim, own = running[key]
            if sim.is_alive:
                sim.reset()
                return sim
            del running[key]
            try:
                own.close()
            except SimulationError as error:
                warnings.warn(f'{error}; it is started again', stacklevel=2)
        own = ExitStack()
        sim = own.enter_context(Simulation(*args, **options))
        running[key] = (sim, own)
        return sim

    with ExitStack() as stack:
        try:
            yield make
        finally:
            for _, own in running.values():
                stack.push(own)
