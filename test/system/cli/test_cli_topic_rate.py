# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 topic hz``, ``bw`` and ``delay``: as the genuine ones, and what they measure."""

import re
import shlex
import signal

from fixtures.cli.commands import ros2, running_node, shell, started
import pytest
from test_cli_golden import recordings

ALL = [pytest.param(r, id=r.line) for r in recordings('topic_rate')]
STAMPED = 'geometry_msgs/msg/TwistStamped'


@pytest.fixture(scope='module', autouse=True)
def fixture_node():
    with running_node('fixture_node.py') as node:
        yield node


def pattern(text):
    """Return what matches a text whatever its numbers are."""
    return re.sub(r'\d+\\\.\d+|\d+', r'[\\d.]+', re.escape(text))


@pytest.mark.parametrize('recording', ALL)
def test_a_command_prints_what_the_genuine_one_does(recording):
    line_by_line = [pattern(line) for line in (recording.stdout + recording.stderr).splitlines()]
    with started(*shlex.split(recording.line)[1:], terminal=True) as program:
        found = program.expect(r'\r\n'.join(line_by_line))
        shown = found.string[: found.end()].splitlines()  # the next line may have come in part
        if recording.code == signal.SIGINT:
            program.type('\x03')
        assert program.end() == recording.code
        others = [line for line in shown if not any(re.match(each, line) for each in line_by_line)]
        assert others == []
        assert 'Traceback' not in program.output


def test_delay_is_the_age_of_the_stamps():
    stamp = '{header: {stamp: {sec: 1}}}'
    with (
        started('topic', 'pub', '-r', '20', '/old', STAMPED, stamp),
        started('topic', 'delay', '-w', '3', '/old') as program,
    ):
        found = program.expect(r'average delay: (\d+)\.\d+\n.*window: 3\n')
        assert int(found[1]) > 1_700_000_000  # since 1970
        program.expect("are not by this computer's clock: for simulation time use --use-sim-time")


def test_delay_says_when_nothing_new_came(fixture_node):
    with started('topic', 'delay', '/brief') as program:
        with started('topic', 'pub', '-r', '20', '/brief', STAMPED, '{header: auto}'):
            program.expect('average delay: 0')
        program.expect('no new messages\n')
        assert program.end(signal.SIGINT) == signal.SIGINT


def test_bandwidth_is_rate_times_size():
    values = '{data: ' + 'x' * 991 + '}'  # 1000 bytes: 4 of encapsulation, 4 of length, a 0
    with (
        started('topic', 'pub', '-r', '50', '-p', '0', '/long', 'std_msgs/msg/String', values),
        started('topic', 'bw', '/long') as program,
    ):
        found = program.expect(
            r'([\d.]+) KB/s from (\d+) messages\n'
            r'\tMessage size mean: 1.00 KB min: 1.00 KB max: 1.00 KB'
        )
        assert float(found[1]) == pytest.approx(50.0, rel=0.5)
        assert int(found[2]) <= 100


@pytest.mark.parametrize('verb', ['hz', 'bw', 'delay'])
def test_hostile_input_gets_one_line(verb):
    result = ros2('topic', verb, 'a name')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.startswith("'a name' is not a topic: ")
    assert result.stderr.count('\n') == 1
    assert ros2('topic', verb, '/odom', '--window', '0').returncode == 2


def test_a_pipe_shows_lines_at_once_and_may_be_closed(tmp_path):
    line = 'ros2 topic bw /odom | grep --line-buffered messages | head -1; echo ${PIPESTATUS[0]}'
    result = shell(line, tmp_path)
    report, status = result.stdout.splitlines()
    assert re.fullmatch(r'[\d.]+ KB/s from \d+ messages', report)
    assert (int(status), result.stderr) == (128 + signal.SIGPIPE, '')
    result = shell('ros2 topic hz /odom | head -1; echo ${PIPESTATUS[0]}', tmp_path)
    report, status = result.stdout.splitlines()
    assert report.startswith('average rate: ')
    assert (int(status), result.stderr) == (128 + signal.SIGPIPE, '')
