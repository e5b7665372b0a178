# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The marker of pytest for trials, in a project of a user's that has nothing of ROS."""

import os
import re
import subprocess
import sys

import pytest

CONFTEST = """
import sys
pytest_plugins = ['amr_description.testing.trials_marker']
def pytest_sessionfinish():
    assert not any(name.split('.')[0] == 'rclpy' for name in sys.modules)
"""
TESTS = """
import os
import signal
import pytest
from amr_description.trials.variations import uniform, vary

@pytest.mark.trials(40, at_least=0.5)
@vary(limit=uniform(0.6, 0.8))
def test_often(simulate, rng, limit):
    assert rng.random() < limit

@pytest.mark.trials(40, at_least=0.95)
def test_seldom(simulate, rng):
    assert rng.random() < 0.7

@pytest.mark.trials(2, at_least=0.0)
def test_it_dies(simulate, rng):
    os.kill(os.getpid(), signal.SIGKILL)

@pytest.mark.trials(2)
def test_a_fixture(simulate, rng, tmp_path):
    pass

@pytest.mark.trials(0)
def test_none(simulate, rng):
    pass

def test_once(simulate, rng):
    sim = simulate('package://amr_description/urdf/amr.urdf')
    sim.drive(rng.random(), 0.0, seconds=0.5)
    assert sim.truth.x > 0.0
"""


@pytest.fixture
def run(tmp_path):
    (tmp_path / 'conftest.py').write_text(CONFTEST)
    (tmp_path / 'test_it.py').write_text(TESTS)

    def run(*words):
        command = [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', *words]
        return subprocess.run(
            command,
            cwd=tmp_path,
            env=os.environ | {'PYTEST_ADDOPTS': ''},  # those of the run that this test is of
            text=True,
            capture_output=True,
            timeout=240,
        )

    return run


def test_a_test_passes_if_enough_of_its_runs_do(run, tmp_path):
    done = run('-q', '--trials-dir', 'out')
    said = done.stdout
    assert done.returncode == 1, said + done.stderr
    assert '4 failed, 2 passed' in said
    assert re.search(r'test_often: \d+ of 40 passed: ', said), said
    assert re.search(r'\n[\d.]+ % passed, and 95 % have to\n', said)
    assert re.search(r'failed \d+: test_it.py:14: assert rng.random\(\) < 0.7', said)
    assert 'python -m amr_description.trials test_it.py:test_seldom --only' in said
    assert 'a run has no result that counts' in said
    assert 'died 0: its process ended by SIGKILL' in said
    assert 'takes "tmp_path", which nobody gives it' in said
    assert 'trials(0, at_least=1.0); a number of seeds above 0' in said
    assert (tmp_path / 'out' / 'test_it.py.test_seldom' / 'report.html').exists()


def test_shards_are_parts_and_another_seed_begins_elsewhere(run, tmp_path):
    for number in (1, 2):
        done = run('-q', '-k', 'often', '--shard', f'{number}/2', '--trials-dir', f'out{number}')
        assert done.returncode == 0, done.stdout
        assert re.search(r'test_often: \d+ of 20 passed', done.stdout)
    reports = [f'out{number}/test_it.py.test_often/report.json' for number in (1, 2)]
    merge = [sys.executable, '-m', 'amr_description.trials', '--merge', *reports]
    merged = subprocess.run(
        [*merge, '--at-least', '0.5'], cwd=tmp_path, text=True, capture_output=True, timeout=240
    )
    assert merged.returncode == 0
    whole = run('-q', '-k', 'often').stdout
    (passed,) = re.findall(r'(\d+ of 40 passed)', whole)
    assert passed in merged.stdout
    other = run('-q', '-k', 'seldom', '--trials-seed', '1000').stdout
    assert re.search(r'--only 10\d\d\n', other)
    assert 'more than 2 runs did not pass' in run('-q', '-k', 'seldom', '--shard', '1/2').stdout
