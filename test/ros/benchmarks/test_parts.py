# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The run of the benchmarks, without their parts."""

import pytest

from amr_description.errors import BringupError
from benchmarks import __main__ as bench
from benchmarks.figures import Figures
from benchmarks.goals import GOALS
from benchmarks.options import parser, PARTS


@pytest.fixture
def parts(monkeypatch):
    """Parts that measure nothing; ROS is not started."""
    found = {part: (lambda _: Figures({})) for part in PARTS}
    monkeypatch.setenv('ROS_DOMAIN_ID', '0')
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    monkeypatch.setattr(bench.machine, 'usage_before', bench.machine.usage)
    for part in PARTS:
        monkeypatch.setattr(bench.Bench, part, lambda self, part=part: found[part](self))
    return found


def run(*words):
    return bench.measured(parser().parse_args(words), node=None)


def good_values(part):
    return {goal.key: goal.limit for goal in GOALS if goal.part == part}


def test_each_part_can_be_run():
    assert all(callable(getattr(bench.Bench, part)) for part in PARTS)


def test_all_goals_are_met(parts, capsys):
    for part in PARTS:
        parts[part] = lambda _, part=part: Figures(good_values(part), f'about {part}')
    assert run('--check') == 0
    assert 'about fleet' in capsys.readouterr().out


def test_a_part_that_fails_does_not_keep_the_others(parts, capsys):
    def fail(_):
        raise BringupError('no simulator')

    parts['memory'] = fail
    parts['fleet'] = lambda _: Figures({'fleet': 7.0, 'fleet bare': 1.0})
    assert run('--only', 'memory', 'fleet') == 0
    assert 'not measured: no simulator' in capsys.readouterr().out
    assert run('--only', 'memory', 'fleet', '--check') == 1
    lines = capsys.readouterr().err.splitlines()
    assert 'one simulated hour, memory: not measured: no simulator; ' in '\n'.join(lines)
    assert '20 robots, mj_step alone: 1.00; the goal is ≥ 18' in lines
    assert not any(line.startswith('20 robots, real-time') for line in lines)


def test_what_quick_leaves_out_is_said_and_is_no_goal_met(parts, capsys):
    for part in PARTS:
        parts[part] = lambda _, part=part: Figures(good_values(part))
    assert run('--quick', '--check') == 1
    captured = capsys.readouterr()
    assert 'not measured: --quick leaves it out' in captured.out
    assert all('not measured' in line for line in captured.err.splitlines() if 'goal is' in line)
