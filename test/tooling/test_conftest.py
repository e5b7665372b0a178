# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Each process that runs tests has a ROS domain of its own, and never the shell's."""

import os
from types import SimpleNamespace

import conftest
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


def test_files_known_to_take_long_start_first_where_several_run():
    def item(name):
        return SimpleNamespace(path=SimpleNamespace(stem=name))

    alone = SimpleNamespace()
    worker = SimpleNamespace(workerinput={})
    names = ['test_a', conftest.LONGEST[1], 'test_b', conftest.LONGEST[0]]
    for config, expected in ((alone, names), (worker, [names[3], names[1], 'test_a', 'test_b'])):
        items = list(map(item, names))
        conftest.pytest_collection_modifyitems(config, items)
        assert [each.path.stem for each in items] == expected


def test_files_known_to_take_long_are_there():
    files = {path.stem for path in (conftest.ROOT / 'test').rglob('test_*.py')}
    assert set(conftest.LONGEST) <= files
