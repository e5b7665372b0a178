# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 lifecycle``, against rclpy's own nodes with a lifecycle."""

import re
import signal

from fixtures.cli.commands import ros2, running_node, started
from lifecycle_msgs.msg import Transition
import pytest

from amr_description.cli.lifecycle.managed import explain_no_lifecycle
from amr_description.cli.lifecycle.verbs import chosen
from amr_description.errors import AmrError

WALK = (  # what is set, and the state that follows
    ('configure', 'inactive [2]'),
    ('3', 'active [3]'),
    ('shutdown', 'finalized [4]'),
)


@pytest.fixture(scope='module', autouse=True)
def nodes():
    hidden = ('--ros-args', '-r', '__node:=_hidden')
    with running_node('lifecycle_node.py'), running_node('lifecycle_node.py', *hidden):
        yield


def lifecycle(*words):
    """Return the exit code and what was said on either stream."""
    result = ros2('lifecycle', *words)
    return result.returncode, result.stdout, result.stderr


def test_nodes_with_a_lifecycle_are_listed():
    with running_node('fixture_node.py'):
        assert lifecycle('nodes') == (0, '/managed\n', '')
    assert lifecycle('nodes', '-a') == (0, '/_hidden\n/managed\n', '')
    assert lifecycle('nodes', '-c') == (0, '1\n', '')


def test_the_state_of_one_or_all():
    assert lifecycle('get', '/managed') == (0, 'unconfigured [1]\n', '')
    assert lifecycle('get') == (0, '/managed: unconfigured [1]\n', '')
    assert lifecycle('get', '--include-hidden-nodes') == (
        0,
        '/_hidden: unconfigured [1]\n/managed: unconfigured [1]\n',
        '',
    )


def test_available_transitions():
    assert lifecycle('list', 'managed') == (
        0,
        '- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n'
        '- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n',
        '',
    )


def test_all_transitions():
    code, output, _ = lifecycle('list', '-a', '/managed')
    assert code == 0
    entries = re.findall(r'- (\w+) \[(\d+)\]\n\tStart: (\w+)\n\tGoal: (\w+)\n', output)
    assert len(entries) == output.count('\n') / 3 == 25
    assert entries[0] == ('configure', '1', 'unconfigured', 'configuring')
    assert entries[-1] == ('transition_error', '62', 'errorprocessing', 'finalized')


def test_a_transition_that_fails_is_an_error():
    hidden = ('--include-hidden-nodes', '_broken')
    words = ('--ros-args', '-r', '__node:=_broken', '-p', 'broken:=true')
    with running_node('lifecycle_node.py', *words):
        assert lifecycle('set', *hidden, 'configure') == (0, 'Transitioning successful\n', '')
        assert lifecycle('set', *hidden, 'activate') == (1, '', 'Transitioning failed\n')
        assert lifecycle('get', *hidden) == (0, 'inactive [2]\n', '')


def test_an_unknown_transition_is_told_what_there_is():
    assert lifecycle('set', '/managed', 'noop') == (
        1,
        '',
        'Unknown transition requested, available ones are:\n- configure [1]\n- shutdown [5]\n',
    )


@pytest.mark.parametrize('words', [('get',), ('list',), ('set', 'configure')])
def test_an_unknown_node_gets_one_line(words):
    code, output, error = lifecycle(words[0], '/nope', *words[1:])
    assert (code, output) == (1, '')
    assert error == ("Node not found: '/nope' is not there; those with a lifecycle are /managed\n")


def test_why_a_node_is_not_found():
    nodes = {'/a': False, '/_b': True}
    assert explain_no_lifecycle('/a', nodes, []) == (
        "Node not found: '/a' has no lifecycle; no node has one"
    )
    assert '--include-hidden-nodes would consider it' in explain_no_lifecycle('/_b', nodes, ['/c'])


def test_a_label_goes_before_a_number():
    known = [Transition(id=2, label='one'), Transition(id=1, label='2')]
    assert chosen('2', known).id == 1
    assert chosen('1', known).id == 1
    with pytest.raises(AmrError, match='available ones are: none$'):
        chosen('one', [])


def test_a_node_that_does_not_answer_is_told():
    with running_node('silent_node.py'):
        code, output, error = lifecycle('get', '--timeout', '1')
        silent = "Exception while calling service of node '/silent': no response within 1 s\n"
        assert (code, output, error) == (1, '/managed: unconfigured [1]\n', silent)
        assert lifecycle('list', '/silent', '--timeout', '1') == (1, '', silent)


def test_ctrl_c_ends_a_wait_without_a_word():
    with (
        running_node('silent_node.py'),
        started('lifecycle', 'get', 'silent', '--timeout', '600', terminal=True) as program,
    ):
        asked = ('service', 'info', '/silent/get_state')
        assert any('Clients count: 1' in ros2(*asked).stdout for _ in range(20))
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert program.output.strip() in ('', '^C')


def test_a_node_goes_through_its_life():
    # A node of its own: the others find theirs at the beginning of its life.
    with running_node('lifecycle_node.py', '--ros-args', '-r', '__node:=mortal'):
        for transition, state in WALK:
            assert lifecycle('set', '/mortal', transition)[:2] == (
                0,
                'Transitioning successful\n',
            )
            assert lifecycle('get', '/mortal') == (0, f'{state}\n', '')
        refused = lifecycle('set', '/mortal', 'configure')[2]
        assert refused.endswith('available ones are: none\n')
