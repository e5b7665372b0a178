# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 bag play`` and ``burst`` as a user runs them."""

import re
import signal
import sys

from fixtures.cli.commands import ros2, started
import pytest
from support.paths import ROOT
from support.running_programs import Program
from support.small_bags import LATCHED, topic, write_bag

TOPICS = [topic('/description', LATCHED), topic('/chatter'), topic('/other')]
TEXTS = [
    (0, '/description', 'robot'),
    *((10 * n, '/chatter', f'number {n}.') for n in range(5)),
    (45, '/other', 'other.'),
]

LISTENING = ('--qos-reliability', 'reliable', '--qos-depth', '50')
PLAYER = ROOT / 'test/fixtures/cli/player_signalled_while_it_starts.py'


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    return str(write_bag(tmp_path_factory.mktemp('bags') / 'bag', TOPICS, TEXTS))


def test_whoever_subscribes_before_gets_all(bag):
    with started('topic', 'echo', '/heard', 'std_msgs/msg/String', *LISTENING) as echo:
        # The player finds it before it begins.
        with started(
            'topic', 'pub', '-r', '50', '/heard', 'std_msgs/msg/String', 'data: x'
        ) as pub:
            echo.expect('data: x')
            pub.end(signal.SIGINT)
        seen = len(echo.output)
        rules = ('--remap', '/chatter:=/heard', '/other:=/heard')
        played = ros2('bag', 'play', bag, *rules, '--log-level', 'warn')
        assert played.returncode == 0, played.stderr
        assert 'Set rate' not in played.stderr
        echo.expect('other.', seen)
        heard = re.findall(r'data: (number \d\.|other\.)', echo.output)
    assert heard == [*(f'number {n}.' for n in range(5)), 'other.']


def test_keys_pause_and_play_the_next(bag):
    with started('bag', 'play', bag, '--rate', '0.001', '--start-paused', terminal=True) as player:
        player.expect('Press CURSOR_DOWN for Decrease Rate 10%')
        player.type(' ')
        player.expect('Resuming play.')
        player.type(' ')
        player.expect('Pausing play.')
        player.type('\x1b[A')
        player.expect('Set rate to 0.101')
        player.type('\x1b[B\x1b[B')
        player.expect('Failed to set rate to invalid value -0.099')
        player.type('\x1b[C' * 20)
        player.type(' ')  # nothing is left
        assert player.end() == 0


def test_ctrl_c_ends_it(bag):
    with started('bag', 'play', bag, '--loop', '--rate', '0.01', '--clock') as player:
        player.expect('Set rate to 0.01')
        assert player.end(signal.SIGINT) == 2
        assert 'Traceback' not in player.output


def test_ctrl_c_while_its_thread_begins_waits_for_that(bag):
    """Else it would find closed what it plays to, and print so while the process ends."""
    with Program(sys.executable, PLAYER, bag) as player:
        assert player.end() == 2
        assert player.lines[-1] == 'played'
        assert 'Traceback' not in player.output


def test_a_second_clock_is_refused(bag, tmp_path):
    recorded = write_bag(
        tmp_path / 'bag', [topic('/clock', kind='rosgraph_msgs/msg/Clock'), topic('/a')], TEXTS[:0]
    )
    words = ('topic', 'pub', '-r', '10', '/clock', 'rosgraph_msgs/msg/Clock', '-n', 'simulator')
    with started(*words) as owner:
        owner.expect('publishing #2')
        for line in ([bag, '--clock'], [bag, '--clock-topics-all'], [str(recorded)]):
            refused = ros2('bag', 'play', *line)
            assert refused.returncode == 1
            assert refused.stderr.splitlines()[-1] == (
                '/clock is published by /simulator already, and with two clocks the time of every '
                'node jumps back and forth: play without --clock and with --exclude-topics '
                '/clock, or end /simulator'
            )
        for flags in (['--exclude-topics', '/clock'], ['--remap', '/clock:=/old_clock']):
            assert ros2('bag', 'play', str(recorded), *flags).returncode == 0


def test_a_burst_ends_with_the_bag_or_pauses(bag):
    all_of_it = ros2('bag', 'burst', bag)
    assert all_of_it.returncode == 0
    assert 'Burst 7 messages.' in all_of_it.stderr
    with started('bag', 'burst', bag, '-n', '2', '--topics', '/chatter') as program:
        program.expect(r'Burst 2 messages\.')
        assert program.end(signal.SIGINT) == 2


@pytest.mark.parametrize(
    ('flags', 'code', 'line'),
    [
        (['absent'], 2, "argument bag_path: Bag path 'absent' does not exist!"),
        ([], 1, '[ERROR] [ros2bag]: Must specify bag_path or --input'),
        (['-i', 'absent'], 1, "[ERROR] [ros2bag]: Bag path 'absent' does not exist!"),
        (['BAG', '-r', '0'], 2, 'argument -r/--rate: 0 is not in the valid range (> 0.0)'),
        (['BAG', '--clock', '0'], 2, "argument --clock: invalid positive_float value: '0'"),
        (['BAG', '--start-offset', '-1'], 2, 'argument --start-offset: Value -1 is less than'),
        (['BAG', '-x', '('], 2, '--exclude-regex: "(" is no regular expression: '),
    ],
)
def test_what_is_wrong_is_one_line(bag, flags, code, line):
    result = ros2('bag', 'play', *[bag if flag == 'BAG' else flag for flag in flags])
    assert result.returncode == code
    assert line in result.stderr.splitlines()[-1]
