# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The figures of the benchmarks and their goals."""

import dataclasses

import pytest

from benchmarks.goals import Direction, Goal, GOALS, missed, report, rounded
from benchmarks.options import chosen_parts, parser, PARTS, why_left_out

FAST = Goal('fast', 'speed of it', '', Direction.AT_LEAST, 0.5, 'one')
SHORT = Goal('short', 'time of it', 's', Direction.AT_MOST, 2.0, 'two')
BOTH = (FAST, SHORT)


@pytest.mark.parametrize(
    'fast, short, names',
    [
        (0.5, 2.0, []),
        (0.499, 2.0, ['speed of it']),
        (0.6, 2.01, ['time of it']),
        (0.1, 3.0, ['speed of it', 'time of it']),
    ],
)
def test_a_goal_has_a_direction(fast, short, names):
    lines = missed({'fast': fast, 'short': short}, {}, BOTH)
    assert [line.split(':')[0] for line in lines] == names


def test_one_line_says_figure_goal_and_unit():
    assert missed({'fast': 0.25, 'short': 3.0}, {}, BOTH) == [
        'speed of it: 0.250; the goal is ≥ 0.5',
        'time of it: 3.00 s; the goal is ≤ 2 s',
    ]


def test_what_could_not_be_measured_is_missed_unless_nobody_asked():
    values, left_out = {'fast': 1.0}, {'short': 'it did not start'}
    line = 'time of it: not measured: it did not start; the goal is ≤ 2 s'
    assert missed(values, left_out, BOTH) == [line]
    assert missed(values, left_out, BOTH, parts=['two']) == [line]
    assert missed(values, left_out, BOTH, parts=['one']) == []


def test_table():
    lines = report({'fast': 0.25, 'short': 1.0}, {}, BOTH).splitlines()
    assert lines[0].split() == ['figure', 'value', 'goal']
    assert lines[1].split() == ['speed', 'of', 'it', '0.250', '≥', '0.5', 'missed']
    assert lines[2].split() == ['time', 'of', 'it', '1.00', 's', '≤', '2']
    (line,) = report({}, {'fast': 'no robot'}, [FAST]).splitlines()[1:]
    assert line.endswith('≥ 0.5  not measured: no robot')


def test_rows_that_need_a_quiet_machine_say_that_it_was_none():
    steady = dataclasses.replace(SHORT, needs_quiet=False)
    lines = report({'fast': 0.25, 'short': 1.0}, {}, (FAST, SHORT, steady), is_quiet=False)
    notes = [line.split('  ')[-1].strip() for line in lines.splitlines()[1:]]
    assert notes == ['missed, on a busy machine', 'met, on a busy machine', '≤ 2']


@pytest.mark.parametrize(
    'value, text',
    [(0.0, '0'), (0.12345, '0.123'), (12.34, '12.3'), (1234.5, '1234'), (2.0, '2.00')],
)
def test_three_digits(value, text):
    assert rounded(value) == text


def test_each_figure_has_a_key_of_its_own_and_a_part_that_measures_it():
    assert len({goal.key for goal in GOALS}) == len(GOALS)
    assert {goal.part for goal in GOALS} <= set(PARTS)


# --- the command line ------------------------------------------------------------------------


def parts_of(*words):
    return chosen_parts(parser().parse_args(words))


def test_parts():
    assert set(parts_of()) == set(PARTS) - {'cold', 'profile'}
    assert set(parts_of('--check')) == set(PARTS) - {'profile'}
    assert set(parts_of('--quick')) < set(parts_of())
    assert parts_of('--profile') == ('profile',)
    assert parts_of('--only', 'fleet', 'memory', '--check') == ('fleet', 'memory')


def test_each_figure_is_measured_or_has_a_reason():
    for words in ((), ('--quick',), ('--only', 'memory'), ('--check',)):
        parts = parts_of(*words)
        reasons = why_left_out(parts, quick='--quick' in words)
        measured = {goal.key for goal in GOALS if goal.part in parts}
        assert set(reasons) | measured == {goal.key for goal in GOALS}
        assert not set(reasons) & measured
        assert all(reasons.values())
    assert '--quick' in why_left_out(parts_of('--quick'), quick=True)['memory']
    assert 'minutes' in why_left_out(parts_of('--quick'), quick=True)['cold']
