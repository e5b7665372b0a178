# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The table of the doctor's rules, and the page about them."""

from dataclasses import fields
import re

from support.paths import ROOT

from amr_description.doctor import table
from amr_description.doctor.findings import error, warning
from amr_description.doctor.observations import Observations

HEADING = re.compile('^### (.+)$', re.MULTILINE)


def test_every_rule_has_its_section_in_the_order_of_the_table():
    headings = HEADING.findall((ROOT / 'docs/doctor.md').read_text())
    assert headings == [rule.__name__ for rule in table.RULES]


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
