# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A hundred broken and odd descriptions, one fault each, judged as their table says."""

import json
from pathlib import Path
import re
from typing import NamedTuple

import pytest
from support.paths import TESTS

from amr_description.cli import check_urdf

FOLDER = TESTS / 'fixtures/urdf_broken'
HERE = '<!-- here -->'
# Faults of the whole file are told on its first line.
ON_LINE_1 = {'empty', 'doctype', 'entity_bomb', 'entity_external'}


class Case(NamedTuple):
    """A row of the table."""

    name: str
    urdfdom: str
    ours: str
    severity: str
    finding: str
    words: str


def table():
    rows = [line.split('|')[1:-1] for line in (FOLDER / 'README.md').read_text().splitlines()]
    cells = ([cell.strip() for cell in row] for row in rows if len(row) == len(Case._fields))
    return [Case(*row) for row in cells if row[1] in ('0', '255', 'endless')]


CASES = table()


def expected_line(path):
    """The line that the finding has to name."""
    lines = path.read_text().splitlines()
    marked = [number for number, line in enumerate(lines, 1) if HERE in line]
    if path.stem in ON_LINE_1:
        return 1
    return marked[0] if marked else len(lines)


def test_every_file_is_in_the_table():
    assert [case.name for case in CASES] == sorted(path.stem for path in FOLDER.glob('*.urdf'))
    assert len(CASES) >= 60


@pytest.mark.parametrize('case', CASES, ids=[case.name for case in CASES])
def test_each_has_the_findings_of_the_table(case, capsys, monkeypatch):
    monkeypatch.chdir(FOLDER)
    file = f'{case.name}.urdf'
    assert check_urdf.main([file]) == int(case.ours)
    out, err = capsys.readouterr()
    findings = [line for line in err.splitlines() if re.match('(error|warning): ', line)]
    place = f'{case.severity}: {file}:{expected_line(Path(file))}: '
    assert findings[0].startswith(place + case.finding)
    # A link without a name cannot be joined to the tree, which is another fault.
    assert len(findings) == (2 if case.name == 'link_unnamed' else 1), findings
    # What urdfdom refuses is refused in its words, and nothing else is.
    assert (case.urdfdom == '255') == (case.ours == '255')
    if case.urdfdom == '255':
        assert out == ''
        assert case.words in err
        assert err.splitlines()[-1 - len(findings)] == 'ERROR: Model Parsing the xml failed'
    else:
        assert out.startswith('robot name is: cart\n---------- Successfully Parsed XML ------')
        assert 'ERROR' not in err
    assert check_urdf.main([file, '--strict']) == (int(case.ours) or 1)


@pytest.mark.parametrize('case', CASES, ids=[case.name for case in CASES])
def test_json_has_the_same_findings(case, capsys, monkeypatch):
    monkeypatch.chdir(FOLDER)
    file = f'{case.name}.urdf'
    assert check_urdf.main([file, '--json']) == int(case.ours)
    told = json.loads(capsys.readouterr().out)
    assert told['exit_code'] == int(case.ours)
    assert told['urdfdom']['accepts'] == (case.urdfdom != '255')
    assert case.words in ' '.join(told['urdfdom']['errors'])
    assert (told['robot'] is None) == (case.urdfdom == '255')
    first = told['findings'][0]
    assert (first['severity'], first['file']) == (case.severity, file)
    assert first['line'] == expected_line(Path(file))
    assert first['what'].startswith(case.finding.partition(': found')[0])
