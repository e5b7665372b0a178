# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Fixtures for pytest.

In your ``conftest.py``::

    pytest_plugins = ['amr_description.testing.fixtures']

They are not registered by an entry point ``pytest11``: that would load them, with their names,
into every pytest of the environment.
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
    A function that returns a simulation at time 0; it takes the arguments of :class:`Simulation`.

    A simulation is started once in a module, reset by every further call with the same arguments,
    and started again if it has ended. All end with the module. The controllers stay as the last
    test has switched them.
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
