"""For ``python -m pytest test_robot.py``: ``sim`` is a sound robot at its start."""

from collections.abc import Iterator

import pytest

from amr_description import Simulation


@pytest.fixture(scope='session')
def shared() -> Iterator[Simulation]:
    """One simulation for all tests."""
    with Simulation('package://amr_description/urdf/amr.urdf') as sim:
        yield sim


@pytest.fixture
def sim(shared: Simulation) -> Simulation:
    """The robot, at its start."""
    shared.reset()
    return shared
