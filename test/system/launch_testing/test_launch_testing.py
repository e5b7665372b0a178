# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``launch_test`` and pytest with files of launch_testing and launch_pytest, as they are typed."""

import os
import subprocess
import sys
from xml.etree import ElementTree

import pytest
from support.paths import ROOT
from support.running_programs import PATIENCE

FILES = ROOT / 'test' / 'fixtures' / 'launch_tests'
LAUNCH_TEST = [sys.executable, '-m', 'amr_description.cli', 'launch_test']
PYTEST = [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', '--rootdir', str(FILES)]


@pytest.fixture
def run(tmp_path):
    def run(*words):
        environment = {**os.environ, 'ROS_LOG_DIR': str(tmp_path / 'log')}
        environment.pop('PYTEST_ADDOPTS', None)  # of colcon, for the pytest that runs this
        return subprocess.run(
            [*map(str, words)],
            cwd=tmp_path,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=PATIENCE,
        )

    return run


def counts(path):
    suites = ElementTree.parse(path).getroot()
    return [tuple(suite.get(key) for key in ('name', 'tests', 'failures')) for suite in suites]


def test_a_launch_test_passes_in_each_run_and_writes_a_report(run, tmp_path):
    done = run(*LAUNCH_TEST, FILES / 'talk_launch_test.py', '--junit-xml', tmp_path / 'report.xml')
    assert done.returncode == 0, done.stdout
    assert done.stdout.count('\nOK\n') == 4  # of two runs, beside and after the process
    name = 'talk_launch_test.talk_launch_test.launch_tests'
    assert counts(tmp_path / 'report.xml') == [
        (f'{name}[left]', '3', '0'),
        (f'{name}[right]', '3', '0'),
    ]


def test_a_failure_is_the_exit_code_of_both(run, tmp_path):
    file, report = FILES / 'talk_launch_test.py', tmp_path / 'report.xml'
    done = run(*LAUNCH_TEST, file, 'code:=3', '--junit-xml', report)
    assert done.returncode == 1, done.stdout
    assert counts(report)[0][1:] == ('3', '1')
    done = run(*PYTEST, file, '--launch-args', 'code:=3')
    assert done.returncode == 1, done.stdout
    assert 'FAIL: talk_launch_test.TestAfter.test_it_ended_well[right]' in done.stdout
    assert 'talk-1 exited with code 3' in done.stdout


def test_processes_that_end_before_the_tests_fail_them(run):
    done = run(*LAUNCH_TEST, FILES / 'early_launch_test.py')
    assert done.returncode == 1, done.stdout
    assert 'the processes under test ended before the tests did' in done.stdout
    assert 'sh-1 exited with code 5\ntoo early' in done.stdout


def test_arguments_are_shown_and_what_is_wrong_is_one_line(run, tmp_path):
    done = run(*LAUNCH_TEST, FILES / 'talk_launch_test.py', '--show-args')
    assert "    'code':\n        Of its end.\n        (default: '0')" in done.stdout
    (tmp_path / 'empty.py').touch()
    done = run(*LAUNCH_TEST, 'empty.py')
    assert (done.returncode, done.stdout) == (
        2,
        'launch_test: empty.empty.launch_tests has no function generate_test_description\n',
    )
    done = run(*LAUNCH_TEST, 'nothing.py')
    assert (done.returncode, done.stdout) == (
        2,
        "launch_test: Test file 'nothing.py' does not exist\n",
    )


def test_tests_of_launch_pytest_run_beside_and_after_what_is_launched(run):
    done = run(*PYTEST, '-rs', *FILES.glob('*_launch_pytest.py'))
    assert '1 failed, 14 passed, 1 skipped' in done.stdout, done.stdout
    assert 'the test has yielded twice' in done.stdout
    assert 'pytest.mark.launch takes fixture=' in done.stdout


GENUINE = {
    'launch/__init__.py': "FROM = 'the workspace'",
    'own_hooks.py': (
        'def pytest_addoption(parser):\n'
        "    parser.addoption('--launch-args', help='')\n"
        'def pytest_report_header(config):\n'
        "    return 'the plugin of the workspace'\n"
    ),
    'launch_testing-3.4.0.dist-info/METADATA': 'Metadata-Version: 2.1\nName: launch-testing\n',
    'launch_testing-3.4.0.dist-info/entry_points.txt': '[pytest11]\nlaunch_testing = own_hooks\n',
    'test_it.py': "def test():\n    import launch\n    assert launch.FROM == 'the workspace'\n",
}


def test_what_a_workspace_has_is_used_before_ours(run, tmp_path, monkeypatch):
    for name, text in GENUINE.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.setenv('PYTHONPATH', str(tmp_path))
    done = run(*PYTEST, tmp_path / 'test_it.py')
    assert done.returncode == 0, done.stdout
    assert 'the plugin of the workspace' in done.stdout
