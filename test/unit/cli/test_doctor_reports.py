# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 doctor`` prints of what it has seen and found."""

from dataclasses import replace
import json

import pytest
from support.doctor_hosts import host, SIMULATOR

from amr_description.cli.doctor.examination import keyed
from amr_description.cli.doctor.greeting import count, Summary
from amr_description.cli.doctor.reports import print_reports
from amr_description.doctor import report
from amr_description.doctor.findings import error, warning
from amr_description.doctor.observations.graph import (
    GraphNode,
    ObservedEndpoint,
    ObservedGraph,
    ObservedQos,
    ObservedTopic,
)
from amr_description.text import one_line

STRING = 'std_msgs/msg/String'
TALKER = ObservedEndpoint(node='/talker', type_name=STRING, qos=ObservedQos(is_reliable=False))
LISTENER = ObservedEndpoint(node='/listener', type_name=STRING)
SEEN = replace(
    host(processes=[SIMULATOR]),
    graph=ObservedGraph(
        topics=(ObservedTopic(name='/topic', publishers=(TALKER,), subscriptions=(LISTENER,)),),
        nodes=(GraphNode(name='/talker'), GraphNode(name='/listener')),
    ),
)


def titles(text):
    return [line.strip() for line in text.splitlines() if line.startswith('   ')]


@pytest.mark.parametrize(
    ('families', 'expected'),
    [
        (['qos'], ['QOS COMPATIBILITY LIST']),
        (['types'], ['TOPIC LIST']),
        (['processes'], ['PROCESSES', 'RMW MIDDLEWARE']),
    ],
)
def test_reports_are_those_of_what_failed(families, expected, capsys):
    print_reports(SEEN, families, packages=True)
    assert titles(capsys.readouterr().out) == expected


def test_reports_have_columns(capsys):
    print_reports(SEEN, ['qos', 'types'], packages=False)
    lines = capsys.readouterr().out.splitlines()
    assert f'topic [type]            : /topic [{STRING}]' in lines
    assert 'subscriber node         : /listener' in lines
    assert 'publisher count     : 1' in lines
    status = 'compatibility status    : '
    assert f'{status}ERROR: reliability: BEST_EFFORT is offered, RELIABLE requested' in lines


def test_a_finding_is_four_lines_and_names_its_section():
    lines = report.as_lines(error('domain', 'a\nb', 'why', 'fix'))
    assert lines == [
        'ERROR: ' + one_line('a\nb'),
        '  why: why',
        '  fix: fix',
        '  see: docs/api/doctor.md#domain',
    ]


def test_json_says_whether_it_passed():
    found = [warning('domain', 'what', 'why', 'fix')]
    text = json.loads(report.as_json(found, checks=80, failed=0))
    assert (text['passed'], text['checks'], text['failed']) == (True, 80, 0)
    assert text['findings'] == [
        {
            'severity': 'warning',
            'rule': 'domain',
            'what': 'what',
            'why': 'why',
            'fix': 'fix',
            'link': 'docs/api/doctor.md#domain',
        }
    ]


def test_the_overview_says_what_is_there_or_why_not():
    *_, processes, graph = report.overview(SEEN)
    assert processes.split(maxsplit=1) == [
        'processes',
        '1 of ROS on this host in this domain',
    ]
    assert graph.split(maxsplit=1) == ['graph', '2 nodes, 1 topic']
    assert report.overview(SEEN, 'no rclpy')[-1].endswith('not observed: no rclpy')


def test_greetings_of_other_hosts_count():
    summary = Summary('/canyouhearme', 1.0)
    for text in ("hello, it's me robot", "hello, it's me robot", "hello, it's me here", ''):
        count(text, 'here', summary.heard)
    lines = summary.table().splitlines()
    assert lines[1] == 'Topic: /canyouhearme, Published Msg Count: 0'
    row = ['robot', '2']
    assert [line.split() for line in lines if line.split() == row] == [row]


def test_a_watch_knows_a_finding_again_by_its_names_not_by_its_figures():
    def scan(robot, age):
        return warning(
            'sensor_stamp', f'the stamps on /robot{robot}/scan are {age} s old', 'b', 'c'
        )

    first = keyed([scan(1, 2.5), scan(2, 2.5)])
    assert len(first) == 2
    assert keyed([scan(1, '1.8e+09'), scan(2, 7)]).keys() == first.keys()
    assert len(keyed([scan(1, 1), scan(1, 2)])) == 2
