# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 doctor`` as a user types it, where nothing runs, and where it cannot look."""

import json
import signal

from fixtures.cli.commands import ros2, started
import pytest
from support.doc_pages import Page
from support.page_lines import typed

from amr_description.cli.doctor import examination, graph
from amr_description.cli.main import main
from amr_description.doctor.table import RULES
from amr_description.errors import AmrError
from amr_description.testing.program import own_domain

PAGE = Page('doctor.md')


def test_where_nothing_runs_it_says_what_is_there():
    with own_domain() as domain:  # a node of the test before may not have gone yet
        said = typed(PAGE, 'ros2 doctor')
    heads = [line.split()[0] for line in said.splitlines()[:5]]
    assert heads == ['machine', 'python', 'discovery', 'processes', 'graph']
    assert f'ROS domain {domain}' in said
    assert 'no other node' in said
    warned = said.count('\nWARNING: ')  # as on a machine that is busy
    warnings = f', {warned} with a warning' if warned else ''
    assert said.endswith(f'\nAll {len(RULES)} checks passed{warnings}\n\n')


def test_a_middleware_that_is_missing_ends_no_doctor(monkeypatch, capsys):
    monkeypatch.setenv('RMW_IMPLEMENTATION', 'rmw_connextdds')  # import rclpy would end a process
    assert main('ros2', ['wtf', '--report-failed']) == 1
    said = capsys.readouterr().out
    assert 'not observed: RMW_IMPLEMENTATION is "rmw_connextdds"' in said
    assert f'\n1/{len(RULES)} check(s) failed\n\nFailed modules: environment\n' in said
    assert 'see: docs/api/doctor.md#rmw_implementation\n' in said
    assert '\n   RMW MIDDLEWARE\nmiddleware name    : rmw_connextdds\n' in said
    assert 'PACKAGE VERSIONS' not in said


def test_an_rclpy_that_cannot_be_imported_is_named_first(monkeypatch, capsys):
    fault = 'libfastrtps.so.2.14: cannot open shared object file'
    monkeypatch.setattr(examination, '_rclpy_fault', lambda: fault)
    assert main('ros2', ['doctor']) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[4].split(maxsplit=1)[1] == f'not observed: rclpy cannot be imported: {fault}'
    assert lines[6].startswith('ERROR: rclpy cannot be imported by ')
    assert 'Failed modules: machine' in lines


@pytest.mark.parametrize('option', ['--json', '--report', '--include-warnings'])
def test_a_graph_that_cannot_be_observed_passes_no_check(monkeypatch, capsys, option):
    def none():
        raise AmrError('no node can be made: no memory')

    monkeypatch.setattr(graph, 'sessions', none)
    monkeypatch.setattr(examination, 'examine', lambda _seen: [])
    assert main('ros2', ['doctor', option, '--exclude-packages']) == 1
    said = capsys.readouterr().out
    assert ' checks passed' not in said
    if option == '--json':
        found = json.loads(said)
        assert (found['passed'], found['failed']) == (False, 0)
        assert found['not_observed'] == 'no node can be made: no memory'


def test_warnings_fail_only_where_they_are_included():
    deprecated = {'ROS_LOCALHOST_ONLY': '1', 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    result = ros2('doctor', '--include-warnings', '--json', **deprecated)
    found = json.loads(result.stdout)
    assert (result.returncode, found['passed']) == (1, False)
    assert 'localhost_only' in {finding['rule'] for finding in found['findings']}
    assert {finding['severity'] for finding in found['findings']} == {'warning'}


def test_reports_have_the_names_of_the_original(monkeypatch, capsys):
    monkeypatch.setenv('ROS_DOMAIN_ID', '-1')
    main('ros2', ['doctor', '-r', '-ep'])
    lines = capsys.readouterr().out.splitlines()
    titles = [line.strip() for line in lines if line.startswith('   ')]
    wanted = ['NETWORK CONFIGURATION', 'PLATFORM INFORMATION', 'RMW MIDDLEWARE', 'TOPIC LIST']
    assert [title for title in titles if title in wanted] == wanted
    assert 'PACKAGE VERSIONS' not in titles


def test_hello_counts_what_it_sends():
    result = ros2('doctor', 'hello', '--once', '-ep', '0.01', '-t', '/hi')
    assert result.returncode == 0, result.stderr
    first, topic, *_, last = result.stdout.splitlines()
    assert first == 'MULTIMACHINE COMMUNICATION SUMMARY'
    assert topic.startswith('Topic: /hi, Published Msg Count: ')
    assert last == '-' * 60


def test_a_watch_says_what_is_there_until_it_is_ended():
    program = started('doctor', '--watch', '0.1', '--json', ROS_DOMAIN_ID='-1')
    program.expect('"rule": "domain"')
    assert program.end(signal.SIGINT) == signal.SIGINT
