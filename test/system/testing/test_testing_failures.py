# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a user sees of a test that fails: one line at the line of the test, and the log."""

from pathlib import Path
import re
import sys

import pytest
from support.paths import ROOT
from support.running_programs import Program

from amr_description.bag.reader import BagReader

TESTS = f"""
from amr_description.testing.simulation import Simulation

URDF = {str(ROOT / 'urdf' / 'amr.urdf')!r}

def test_that_passes(simulation):
    simulation(URDF).run(0.1)

def test_number(simulation):
    with Simulation(URDF, activate=[], record='own') as sim:
        sim.run(0.1)
        assert simulation(URDF).time == 1.0

def test_a_fault_of_ours(simulation):
    simulation(URDF).send('/topic', None)

def test_end(simulation):
    sim = simulation(URDF)
    sim._simulator.process.kill()
    sim._simulator.process.wait()
    sim.step()

def test_no_start():
    Simulation(URDF, world='nowhere').__enter__()
"""
BAGS = {
    'test_number': ('test_number',),
    'test_a_fault_of_ours': ('test_a_fault_of_ours',),
    'test_end': ('test_end',),
}
"""Of the simulations of each test that fails, if they have begun and it does not record itself."""
LOADED = 'Loaded hardware .AmrSystem.'


@pytest.fixture(scope='module')
def report(tmp_path_factory):
    """What pytest prints, by test, and the folder of its JUnit report."""
    folder = tmp_path_factory.mktemp('my_package')
    plugin = "pytest_plugins = ['amr_description.testing.fixtures']"
    (folder / 'conftest.py').write_text(plugin)
    (folder / 'test_my_robot.py').write_text(TESTS)
    # Without the options of the run that this is part of, and plugins that take 2 s to load.
    only_its_own = {'PYTEST_ADDOPTS': '', 'PYTEST_DISABLE_PLUGIN_AUTOLOAD': '1'}
    options = ('-p', 'no:cacheprovider', '--junitxml=results/report.xml', '--ros-bag=on-failure')
    command = (sys.executable, '-m', 'pytest', *options, str(folder))
    with Program(*command, cwd=folder, env=only_its_own) as run:
        assert run.end() == 1, run.output
    assert '4 failed, 1 passed' in run.output
    parts = re.split(r'\n_{3,} (\w+) _{3,}\n', run.output)
    return dict(zip(parts[1::2], parts[2::2], strict=True)), folder / 'results'


@pytest.mark.parametrize(
    ('test', 'line', 'error'),
    [
        ('test_end', 'sim.step()', 'SimulationError: the simulator was killed by SIGKILL'),
        ('test_no_start', "Simulation(URDF, world='nowhere').__enter__()", 'SimulationError: '),
    ],
)
def test_an_error_is_shown_at_the_line_of_the_test(report, test, line, error):
    printed = report[0][test]
    assert re.search(rf'\n> +{re.escape(line)}\nE +[\w.]*{error}', printed)
    assert set(re.findall(r'^(\S+\.py):\d+:', printed, re.MULTILINE)) == {'test_my_robot.py'}


def test_a_fault_of_ours_is_shown_with_all_frames(report):
    assert 'testing/lock_step.py' in report[0]['test_a_fault_of_ours']


def test_the_log_is_in_the_report_and_beside_it(report):
    by_test, results = report
    assert {each.name for each in results.iterdir()} == {
        'report.xml',
        *(f'report.test_my_robot.{test}.log' for test in by_test),
        *(f'report.test_my_robot.{bag}.mcap' for bags in BAGS.values() for bag in bags),
    }
    for test, printed in by_test.items():
        path = f'results/report.test_my_robot.{test}.log'
        assert f'- Simulator log, all of it in {path} -' in printed
        log = (results.parent / path).read_text()
        assert log.splitlines()[-1] in printed
    number = (results / 'report.test_my_robot.test_number.log').read_text()
    assert len(re.findall(LOADED, number)) == 2  # of the test before, and its own that has ended
    assert "'nowhere'" in (results / 'report.test_my_robot.test_no_start.log').read_text()


def test_the_bags_are_beside_it_and_their_paths_in_the_report(report):
    by_test, results = report
    for test, printed in by_test.items():
        shown = re.findall(r'^(\S+\.mcap)\n +to look at it: +ros2 run .* \1\n', printed, re.M)
        names = [f'report.test_my_robot.{bag}.mcap' for bag in BAGS.get(test, ())]
        assert [Path(each).name for each in shown] == names
    with BagReader(results / 'report.test_my_robot.test_number.mcap') as reader:
        assert '/mujoco_sim/run' in reader.topics


def test_what_a_test_records_by_itself_is_whole(report):
    by_test, results = report
    assert '\nthe test itself records to own\n' in by_test['test_number']
    with BagReader(results.parent / 'own') as reader:
        times = [each.log_time for each in reader.messages(['/clock'])]
    assert times == [10**7 * n for n in range(len(times))]
    assert len(times) >= 10
    assert (results.parent / 'own' / 'metadata.yaml').exists()


def test_two_simulations_of_a_process_do_not_disturb_each_other(report):
    assert 'Publisher already registered' not in report[0]['test_number']
