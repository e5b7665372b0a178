# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The references of docs/api that are made of the code say what it says."""

import re
import runpy

from support.paths import ROOT

from amr_description.doctor import table
from amr_description.model import checks

PAGES = runpy.run_path(str(ROOT / 'docs' / 'references.py'))['pages']()


def test_the_references_are_those_of_the_code():
    """Where they are not: ``python docs/references.py``."""
    written = {name: (ROOT / 'docs' / 'api' / name).read_text() for name in PAGES}
    assert written == PAGES


def test_each_rule_has_its_place():
    rules = (*checks.RULES, *checks.RULES_OF_THE_WHOLE)
    headings = re.findall(r'^### (.+)$', PAGES['doctor.md'], re.MULTILINE)
    assert headings == [rule.__name__ for rule in table.RULES]
    named = re.findall(r'^\| `(\w+)` \| \S', PAGES['check_urdf.md'], re.MULTILINE)
    assert named == [rule.__name__ for rule in rules]


def test_a_parameter_has_type_default_unit_and_meaning():
    row = '| `wheel_radius` | double | 0.0 | m | Radius of a wheel |'
    assert row in PAGES['parameters.md']
    assert '| `gains.<dof>.p` | double | 0.0 |' in PAGES['parameters.md']


def test_what_a_docstring_refers_to_is_a_link():
    assert '[more](../doctor.md#which-qos-matches)' in PAGES['doctor.md']
    assert ':func:' not in ''.join(PAGES.values())
