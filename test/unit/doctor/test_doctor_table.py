# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The table of the doctor's rules, and the page about them."""

from dataclasses import fields

from amr_description.doctor import table
from amr_description.doctor.findings import error, warning
from amr_description.doctor.observations import Observations


def test_every_rule_says_what_it_demands():
    assert [rule.__name__ for rule in table.RULES if not rule.__doc__] == []


def test_nothing_is_found_where_nothing_was_observed():
    assert table.examine(Observations()) == []


def test_sections_are_optional():
    assert {field.default for field in fields(Observations)} == {None}


def test_errors_stand_first_then_the_order_of_the_table(monkeypatch):
    def first(_seen):
        yield warning('first', 'a', 'b', 'c')
        yield error('first', 'd', 'e', 'f')

    def second(_seen):
        return [error('second', 'g', 'h', 'i'), warning('second', 'j', 'k', 'l')]

    monkeypatch.setattr(table, 'RULES', (first, second))
    found = [finding.what for finding in table.examine(Observations())]
    assert found == ['d', 'g', 'a', 'j']


def test_a_rule_that_raises_takes_no_other_with_it(monkeypatch):
    def broken(_seen):
        yield error('broken', 'seen before it broke', 'b', 'c')
        raise ZeroDivisionError('of a hostile\x1b message')

    def sound(_seen):
        return [warning('sound', 'seen', 'b', 'c')]

    monkeypatch.setattr(table, 'RULES', (broken, sound))
    found = {finding.rule: finding.what for finding in table.examine(Observations())}
    assert [*found] == ['broken', 'sound', 'unexamined']
    assert found['unexamined'] == (
        'the rule broken could not be examined: ZeroDivisionError: of a hostile\\x1b message'
    )


def test_what_could_not_be_observed_is_said():
    (finding,) = table.examine(Observations(faults={'sensors': 'ValueError: x'}))
    assert (finding.rule, finding.severity) == ('unexamined', 'warning')
    assert finding.what == 'sensors could not be examined: ValueError: x'
