# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Each process that runs tests has a ROS domain of its own, and never the shell's."""

import os

import pytest

from amr_description.errors import SimulationError
from amr_description.testing import program


@pytest.fixture
def taken():
    found = [program.take_domain() for _ in range(5)]
    yield [domain for domain, _ in found]
    for _, lock in found:
        os.close(lock)


def test_no_domain_is_taken_twice(taken):
    assert len({int(os.environ['ROS_DOMAIN_ID']), *taken}) == 6


def test_a_domain_given_back_can_be_taken_but_not_by_whose_shell_has_it(taken, monkeypatch):
    monkeypatch.setattr(program, 'DOMAINS', taken[:1])
    with pytest.raises(SimulationError, match='all ROS domains from'):
        program.take_domain()
    monkeypatch.setattr(program, 'DOMAINS', [free := max(taken) + 1_000])
    domain, lock = program.take_domain()
    os.close(lock)
    (program.LOCKS / f'ros_domain_{free}.lock').unlink()
    assert domain == free
    monkeypatch.setenv('ROS_DOMAIN_ID', str(free))
    with pytest.raises(SimulationError, match='all ROS domains from'):
        program.take_domain()
