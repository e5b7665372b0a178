# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 action``, against rclpy's own action servers."""

import re
import signal

from fixtures.cli.commands import ros2, running_node, shell, started
import pytest

STEPS = 'simulation_interfaces/action/SimulateSteps'
LONG = '{steps: 100000}'


@pytest.fixture(scope='module', autouse=True)
def server():
    with running_node('action_node.py') as node:
        yield node


def action(*words):
    """Return the exit code and what was said on either stream."""
    result = ros2('action', *words)
    return result.returncode, result.stdout, result.stderr


def test_actions_are_listed():
    assert action('list') == (0, '/steps\n/stubborn\n', '')
    assert action('list', '-t') == (0, f'/steps [{STEPS}]\n/stubborn [{STEPS}]\n', '')
    assert action('list', '-c') == (0, '2\n', '')
    assert '_action' not in ros2('service', 'list').stdout


def test_the_type_of_an_action():
    assert action('type', '/steps') == action('type', 'steps') == (0, f'{STEPS}\n', '')
    assert action('type', '/nope') == (1, '', '')


def test_who_serves_and_who_calls():
    head = 'Action: /steps\nAction clients: 0\nAction servers: 1\n'
    assert action('info', '/steps') == (0, f'{head}    /runner\n', '')
    assert action('info', '/steps', '-t') == (0, f'{head}    /runner [{STEPS}]\n', '')
    assert action('info', '/steps', '-c') == (0, head, '')
    nobody = 'Action: /nope\nAction clients: 0\nAction servers: 0\n'
    assert action('info', '/nope') == (0, nobody, '')


def test_a_goal_that_succeeds():
    code, output, error = action('send_goal', '/steps', STEPS, '{steps: 2}')
    assert (code, error) == (0, '')
    assert re.sub('ID: [0-9a-f]{32}', 'ID: N', output) == (
        'Waiting for an action server to become available...\n'
        'Sending goal:\n     steps: 2\n\n'
        'Goal accepted with ID: N\n\n'
        'Result:\n    result:\n  result: 0\n  error_message: 2 steps\n\n'
        'Goal finished with status: SUCCEEDED\n'
    )


def test_feedback_is_shown_on_demand(tmp_path):
    line = f'echo "steps: 3" | ros2 action send_goal -f steps {STEPS} --stdin'
    output = shell(line, tmp_path).stdout
    feedback = re.findall(r'Feedback:\n    completed_steps: (\d)\nremaining_steps: (\d)\n', output)
    assert feedback == [('1', '2'), ('2', '1'), ('3', '0')]


def test_a_goal_whose_output_nobody_reads_is_canceled(server, tmp_path):
    seen = len(server.output)
    line = f'ros2 action send_goal -f /steps {STEPS} "{LONG}" | grep -m 1 "_steps: 3"'
    result = shell(f'{line}; echo ${{PIPESTATUS[0]}}', tmp_path)
    shown, status = result.stdout.splitlines()
    assert (int(status), result.stderr) == (128 + signal.SIGPIPE, '')
    assert shown == '    completed_steps: 3'
    server.expect('canceled', seen)


@pytest.mark.parametrize(
    ('goal', 'end'),
    [
        ('{}', 'Goal was rejected.\n'),
        ('{steps: 13}', 'Goal finished with status: ABORTED\n'),
    ],
)
def test_a_goal_that_fails_is_an_error(goal, end):
    code, output, _ = action('send_goal', '/steps', STEPS, goal)
    assert code == 1
    assert output.endswith(end)


def test_ctrl_c_cancels_the_goal(server):
    seen = len(server.output)
    with started('action', 'send_goal', '/steps', STEPS, LONG, terminal=True) as program:
        program.expect('Goal accepted with ID')
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert program.output.endswith('Canceling goal...\r\nGoal canceled.\r\n')
    server.expect('canceled', seen)


def test_a_goal_without_result_in_time_is_canceled(server):
    seen = len(server.output)
    code, output, error = action('send_goal', '/steps', STEPS, LONG, '--timeout', '0.5')
    assert (code, error) == (1, 'No result within 0.5 s: the goal was canceled\n')
    assert output.endswith('Canceling goal...\nGoal canceled.\n')
    server.expect('canceled', seen)


def test_a_goal_that_cannot_be_canceled_is_told():
    code, output, error = action('send_goal', '/stubborn', STEPS, '{steps: 20}', '-t', '0.5')
    assert (code, error) == (1, 'Failed to cancel goal: the server refuses\n')
    assert output.endswith('Canceling goal...\n')


def test_a_missing_server_is_waited_for():
    line = 'Waiting for an action server to become available...'
    assert action('send_goal', '/step', STEPS, '-t', '0.5') == (
        1,
        f'{line}\n',
        'Action server is not available after waiting 0.5 seconds. '
        'There is no action /step; did you mean /steps?\n',
    )
    with started('action', 'send_goal', '/nope', STEPS, terminal=True) as program:
        program.expect(line)
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert program.output.partition('^C')[2].strip() == ''


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        (('info', 'a name'), "'a name' is not an action: name must not contain"),
        (('type', b'\xff'), "is not an action: 'utf-8' codec"),
        (('send_goal', '/x', 'SimulateSteps'), 'is not written as package/action/Name'),
        (('send_goal', '/x', 'std_srvs/srv/Trigger'), 'The passed action type is invalid'),
        (('send_goal', '/x', STEPS, '{step: 1}'), "no attribute 'step'; it has steps"),
        (('send_goal', '/x', STEPS, '{steps: -1}'), "The 'steps' field must be an unsigned"),
        (('send_goal', '/x', STEPS, '{steps: [}'), 'line 1, column 10: '),
        (('send_goal', '/x', STEPS, '{' * 100_000), 'it is nested too deeply'),
        (('send_goal', '/x', STEPS, 'x' * 100_000), 'is expected to be a dictionary'),
    ],
)
def test_hostile_input_gets_one_line(words, said):
    code, output, error = action(*words)
    assert (code, output) == (1, '')
    assert said in error
    assert error.count('\n') == 1
    assert len(error) < 400
