# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 param`` beyond the recordings: other nodes, other types, refusals, silence, hostility."""

import re
import signal

from fixtures.cli.commands import python, ros2, running_node, shell, started
import pytest

ARM = '/left/arm'
HAND = '/left/hand'
RENAMED = '--ros-args -r __node:={}'
BIG = 100_000

# The program with its patience cut short, but long enough for those who do answer.
IMPATIENT = """\
import sys
from amr_description.cli.main import main
from amr_description.cli.param import requests
requests._RESPONSE_TIMEOUT = 3.0
sys.exit(main('ros2', sys.argv[1:]))
"""


@pytest.fixture(scope='module')
def arm():
    with running_node('parameter_node.py') as node:
        yield node


@pytest.fixture
def hand():
    """A node like ``arm``, for one test alone."""
    with running_node('parameter_node.py', *RENAMED.format('hand').split()) as node:
        yield node


@pytest.fixture
def silent():
    with running_node('silent_node.py') as node:
        yield node


def param(*args, **env):
    """Return (exit code, stdout, stderr)."""
    result = ros2('param', *args, **env)
    return result.returncode, result.stdout, result.stderr


def test_the_names_of_a_node_can_be_narrowed_down(arm):
    def names(*args):
        return ''.join(param('list', ARM, *args)[1]).split()

    assert names('--param-prefixes', 'gains') == ['gains.limits.max', 'gains.p']
    assert names('--param-prefixes', 'gains.limits', 'title') == ['gains.limits.max', 'title']
    assert names('--filter', '.*a[gx]') == ['flags', 'gains.limits.max']
    assert names('--filter', 'nothing') == []


def test_types_that_the_recordings_lack(arm):
    listed = param('list', ARM, '--param-type')[1]
    assert re.findall(r'(bytes|flags|free) \(type: (.*)\)', listed) == [
        ('bytes', 'byte array'),
        ('flags', 'boolean array'),
        ('free', 'not set'),
    ]
    assert param('get', ARM, 'bytes') == (0, "Byte values are: [b'a', b'\\xff']\n", '')
    assert param('get', ARM, 'flags') == (0, 'Boolean values are: [True, False]\n', '')
    assert param('get', ARM, 'title') == (0, 'String value is: 5\n', '')


def test_a_parameter_without_a_type_is_set_and_deleted(hand):
    assert param('get', HAND, 'free') == (0, 'Parameter not set.\n', '')
    assert 'free: null\n' in param('dump', HAND)[1]
    assert param('set', HAND, 'free', '5') == (0, 'Set parameter successful\n', '')
    assert param('get', HAND, 'free', '--hide-type') == (0, '5\n', '')
    assert param('delete', HAND, 'free') == (0, 'Deleted parameter successfully\n', '')
    code, text, said = param('get', HAND, 'free')
    assert (code, text) == (1, '')
    assert said == "Parameter not set: /left/hand has no parameter 'free'\n"


def test_an_empty_array_keeps_the_type_of_its_parameter(hand):
    assert param('set', HAND, 'bytes', '[]')[0] == 0
    assert param('get', HAND, 'bytes') == (0, 'Byte values are: []\n', '')


def test_hidden_nodes_are_left_out_unless_asked_for():
    with running_node('parameter_node.py', *RENAMED.format('_hidden').split()):
        assert '/left/_hidden:' not in param('list')[1]
        assert '/left/_hidden:\n  bytes\n' in param('list', '--include-hidden-nodes')[1]
        assert param('get', '/left/_hidden', 'gains.p')[0] == 0


@pytest.mark.parametrize(
    ('args', 'said'),
    [
        (('get', '/left/arn', 'x'), 'Node not found; did you mean /left/arm?'),
        (('get', '/hand', 'x'), 'Node not found; there are /left/arm'),
        (('get', 'two words', 'x'), "'/two words' is not a node: name must not contain"),
        (('get', '\udcff', 'x'), "'/\\udcff' is not a node: "),
        (('get', 'n' * BIG, 'x'), "'/nnn"),
        (('get', ARM, 'gain.p'), "Parameter not set: {} has no parameter 'gain.p'; did you mean"),
        (('get', ARM, 'x' * BIG), "Parameter not set: {} has no parameter 'xxx"),
        (('delete', ARM, 'titel'), 'Deleting parameter failed: '),
        (('set', ARM, 'gains.p', '@x'), 'The passed value is not YAML: line 1, column 1: '),
        (('set', ARM, 'gains.p', '{' * BIG), 'The passed value is not usable: it is nested too'),
        (('set', ARM, 'gains.p', '\udcff'), 'The passed value is not YAML: character 1 is U+DCFF'),
        (('set', ARM, 'gains.p', '9' * 30), '9' * 30 + ' does not fit into the 64 bits'),
        (('load', ARM, '/'), "parameter file '/': Is a directory"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(arm, args, said):
    code, text, error = param(*args)
    assert (code, text, error.count('\n')) == (1, '', 1), error
    assert error.startswith(said.format(ARM))
    assert len(error) < 500


def test_the_end_of_the_line_helps(arm):
    assert param('set', ARM, 'gains.p', '1')[2].endswith('; it is a double: write 1.0\n')
    assert param('set', ARM, 'title', '5')[2].endswith('; it is a string: write \'"5"\'\n')
    assert param('set', ARM, 'titel', 'x')[2].endswith("'titel'; did you mean title?\n")


@pytest.mark.parametrize(
    'args',
    [
        ('list', '--filter', '['),
        ('get', ARM, '\udcff'),
        ('get', ARM, 'gains.p', '--timeout', 'soon'),
        ('get', ARM),
        ('set', ARM, 'gains.p', '1.0', '2.0'),
    ],
)
def test_what_cannot_be_meant_is_an_error_of_usage(args):
    code, text, error = param(*args)
    assert (code, text) == (2, '')
    assert error.startswith('usage: ros2 ')
    assert re.fullmatch(r'ros2.*: error: .*', error.splitlines()[-1])


def test_much_is_set_and_read_again(hand):
    text = ' '.join(['word'] * (BIG // 5))
    assert param('set', HAND, 'title', text) == (0, 'Set parameter successful\n', '')
    assert param('get', HAND, 'title', '--hide-type') == (0, f'{text}\n', '')


def test_a_file_of_100_kb_is_loaded(hand, tmp_path):
    flags = ', '.join(['true', 'off'] * (BIG // 11))
    path = tmp_path / 'large.yaml'
    path.write_text(f'/**:\n  ros__parameters: {{flags: [{flags}], gains: {{p: 2.0}}}}\n')
    code, text, error = param('load', HAND, str(path))
    assert (code, error) == (0, '')
    assert text == 'Set parameter flags successful\nSet parameter gains.p successful\n'
    assert param('get', HAND, 'gains.p') == (0, 'Double value is: 2.0\n', '')


def test_what_dump_wrote_can_be_loaded(hand, tmp_path):
    path = tmp_path / 'hand.yaml'
    path.write_text(param('dump', HAND)[1])
    code, text, error = param('load', HAND, str(path))
    refused = 'Set parameter start_type_description_service failed: Trying to set a read-only'
    assert code == 0
    assert 'Set parameter bytes successful\n' in text
    assert (error.startswith(refused), error.count('\n')) == (True, 1)
    path.write_text(path.read_text().replace('_service: true', '_service: false'))
    code, _, error = param('load', HAND, str(path))
    assert code == 1
    assert error.startswith(refused)


def test_a_node_that_does_not_answer_is_told(arm, silent):
    def impatient(*args):
        return python('-c', IMPATIENT, 'param', *args)

    said = 'Wait for service timed out waiting for parameter services for node /silent'
    one = impatient('get', '/silent', 'x')
    assert (one.returncode, one.stdout) == (1, '')
    assert one.stderr.startswith(said)
    assert one.stderr.count('\n') == 1
    everyone = impatient('list')
    assert everyone.returncode == 0
    assert everyone.stdout.startswith('/left/arm:\n  bytes\n')
    assert everyone.stderr.startswith(said)
    assert impatient('list', '/silent').returncode == 1


def test_ctrl_c_ends_without_a_word(hand):
    with started('param', 'set', HAND, 'stuck', 'true', terminal=True) as program:
        hand.expect('asked')
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert program.output.strip() in ('', '^C')


def test_a_pipe_shows_lines_at_once_and_may_be_closed(arm, tmp_path):
    result = shell(f'ros2 param list {ARM} | grep -m1 gains', tmp_path)
    assert (result.stdout, result.stderr) == ('  gains.limits.max\n', '')
