# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 service`` beyond the recordings: what waits, what never answers, what is not served."""

import signal

from fixtures.cli.commands import ros2, running_node, shell, started
import pytest

from amr_description.cli.graph import explain_absent_service
from amr_description.errors import AmrError
from amr_description.ros.message_types import action_type, message_type, service_type, type_name

PLAN = 'nav_msgs/srv/GetPlan'
TRIGGER = 'std_srvs/srv/Trigger'
SET_BOOL = 'std_srvs/srv/SetBool'


@pytest.fixture(scope='module')
def fixture_node():
    with running_node('fixture_node.py') as node:
        yield node


@pytest.fixture(scope='module')
def silent_node():
    with running_node('silent_node.py') as node:
        yield node


def test_calls_repeat_until_ctrl_c(fixture_node):
    with started('service', 'call', '-r', '20', '/trig', TRIGGER, terminal=True) as program:
        program.expect(r"(?s)(requester: making request: .*?message='ok'\)\s+){3}")
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert 'Traceback' not in program.output


def test_a_service_that_comes_later_is_waited_for():
    with started('service', 'call', '/later/trig', TRIGGER) as program:
        program.expect('waiting for service to become available...')
        with running_node('fixture_node.py', '--ros-args', '-r', '__ns:=/later'):
            program.expect("response:\nstd_srvs.srv.Trigger_Response\\(success=True, message='ok'")
            assert program.end() == 0


def test_waiting_ends_with_ctrl_c():
    with started('service', 'call', '/nope', TRIGGER, terminal=True) as program:
        program.expect('waiting for service to become available...')
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert program.output.partition('^C')[2].strip() == ''


def test_a_service_of_another_type_is_told(fixture_node):
    why = f'you call /set_it as {TRIGGER}, but it is {SET_BOOL}; use that'
    with started('service', 'call', '/set_it', TRIGGER) as program:
        program.expect(f'WARNING: {why}')
        assert program.end(signal.SIGINT) == signal.SIGINT
    result = ros2('service', 'call', '--timeout', '1', '/set_it', TRIGGER)
    assert result.returncode == 1
    assert result.stderr.endswith(f'within 1 s: {why}\n')


def test_a_service_that_does_not_answer_is_given_up(silent_node):
    result = ros2('service', 'call', '--timeout', '1.5', '/plan', PLAN, '{start: {header: auto}}')
    assert result.returncode == 1
    assert result.stderr.endswith('No response from /plan within 1.5 s\n')
    start, goal = result.stdout.partition('goal=')[::2]
    assert 'sec=0,' not in start
    assert 'sec=0, nanosec=0' in goal


def test_hidden_services_are_shown_on_demand(silent_node):
    assert '/_hidden' not in ros2('service', 'list').stdout
    for words in (
        ('list', '--include-hidden-services'),
        ('find', 'std_srvs/srv/Empty', '--include-hidden-services'),
    ):
        assert '/_hidden' in ros2('service', *words).stdout.splitlines()
    assert '/_hidden' in ros2('service', '--include-hidden-services', 'list').stdout
    assert ros2('service', 'type', '/_hidden').stdout == 'std_srvs/srv/Empty\n'


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        (('type', 'a name'), "'a name' is not a service: name must not contain characters"),
        (('call', 'a\nname', TRIGGER), "'a\\nname' is not a service: name must not contain"),
        (('info', b'/\xff'), "'/\\udcff' is not a service: 'utf-8' codec"),
        (('info', ''), "'' is not a service: name must not be empty string"),
        (('call', '/x', 'Trigger'), "'Trigger' is not written as package/srv/Name"),
        (('call', '/x', 'nope/srv/Nope'), "there is no package 'nope' with services; if it is in"),
        (('call', '/x', 'std_srv/srv/Trigger'), 'with services; did you mean std_srvs?'),
        (('call', '/x', 'std_srvs/srv/Triger'), 'did you mean Trigger?'),
        (('call', '/x', 'tf2_msgs/action/LookupTransform'), 'is written as an action'),
        (('call', '/x', SET_BOOL, '{data: ' + 'x' * 100_000 + '}'), 'is neither true nor false'),
        (('call', '/x', SET_BOOL, '{' * 100_000), 'it is nested too deeply'),
        (('call', '/x', SET_BOOL, b'{data: "\xff"}'), 'character 9 is U+DCFF'),
        (('call', '/x', SET_BOOL, ''), "Value 'None' is expected to be a dictionary"),
    ],
)
def test_hostile_input_gets_one_line(words, said):
    result = ros2('service', *words)
    assert (result.returncode, result.stdout) == (1, '')
    assert said in result.stderr
    assert result.stderr.count('\n') == 1
    assert len(result.stderr) < 400


@pytest.mark.parametrize('flag', ['--timeout=0', '--timeout=x', '--rate=x'])
def test_a_flag_out_of_range_is_a_usage_error(flag):
    result = ros2('service', 'call', '/x', TRIGGER, flag)
    assert (result.returncode, result.stdout) == (2, '')
    assert 'ros2 service call: error: argument' in result.stderr


def test_a_pipe_may_be_closed(fixture_node, tmp_path):
    line = f'ros2 service call -r 20 /trig {TRIGGER} | head -2; echo ${{PIPESTATUS[0]}}'
    result = shell(line, tmp_path)
    assert int(result.stdout.splitlines()[-1]) == 128 + signal.SIGPIPE
    assert result.stderr == ''


def test_why_nobody_answers():
    known = [('/set_it', ['a/srv/A', 'a/srv/Ours']), ('/trig', ['a/srv/B'])]
    assert explain_absent_service('/set_it', 'a/srv/Ours', known) == (
        'you call /set_it as a/srv/Ours, but it is a/srv/A; use that'
    )
    assert explain_absent_service('/trg', 'a/srv/B', known) == (
        'there is no service /trg; did you mean /trig?'
    )
    assert explain_absent_service('/else', 'a/srv/B', [*known, ('/else', ['a/srv/B'])]) == ''


@pytest.mark.parametrize(
    ('find', 'name'),
    [
        (message_type, 'std_msgs/msg/String'),
        (service_type, 'std_srvs/srv/SetBool'),
        (action_type, 'tf2_msgs/action/LookupTransform'),
    ],
)
def test_types_are_found_by_either_form_of_their_names(find, name):
    package, kind, last = name.split('/')
    assert type_name(find(name)) == type_name(find(f'{package}/{last}')) == name
    with pytest.raises(AmrError, match=f'did you mean {last}'):
        find(f'{package}/{kind}/{last}s')
    for wrong in (last, f'{package}/{kind}', f'{package}/other/{last}', '', '/'):
        with pytest.raises(AmrError, match='is not written as|has no'):
            find(wrong)


def test_requests_and_responses_of_a_service_are_echoed():
    with running_node('introspected_node.py'), started('service', 'echo', '/seen') as echo:
        with started('service', 'call', '-r', '5', '/seen', SET_BOOL, '{data: true}'):
            echo.expect(r'(?s)event_type: 1\n.*?request:\n- data: true\nresponse: \[\]\n---')
            echo.expect(r'(?s)event_type: 2\n.*?response:\n- success: true\n  message: seen\n---')
        assert echo.end(signal.SIGINT) == signal.SIGINT
        assert 'Traceback' not in echo.output


def test_a_service_that_shows_nothing_or_is_not_there_is_told():
    with running_node('introspected_node.py'):
        with started('service', 'echo', '/unseen', '--csv') as echo:
            echo.expect("WARNING: nobody publishes on '/unseen/_service_event' yet")
            assert echo.end(signal.SIGINT) == signal.SIGINT
        result = ros2('service', 'echo', '/unsee')
        assert result.returncode == 1
        assert "Could not load the type for the passed service '/unsee'" in result.stderr
        assert 'did you mean' in result.stderr
