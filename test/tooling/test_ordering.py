# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The order of the tests, and the table of times that it is made from."""

from dataclasses import dataclass
import json
import os
from pathlib import Path
from types import SimpleNamespace

import pytest
from support import ordering
from support.paths import ROOT, TESTS

CONFTEST = []


@pytest.fixture(scope='module', autouse=True)
def conftest_of_all_tests(pytestconfig):
    """``import conftest`` may find that of a folder."""
    CONFTEST[:] = [pytestconfig.pluginmanager.get_plugin(str(TESTS / 'conftest.py'))]


@dataclass(frozen=True)
class Item:
    file: str
    name: str = 'test'
    marks: tuple[str, ...] = ()
    fixturenames: tuple[str, ...] = ()

    @property
    def path(self):
        return TESTS / self.file

    @property
    def nodeid(self):
        return f'{self.file}::{self.name}'

    def get_closest_marker(self, name):
        return name if name in self.marks else None


def in_order(items, seed=None, long=False, workers=0):
    """The items as a run has them."""
    items, deselected = list(items), []
    config = SimpleNamespace(
        option=SimpleNamespace(random_order=seed, long=long, workers=workers),
        hook=SimpleNamespace(pytest_deselected=lambda items: deselected.extend(items)),
    )
    CONFTEST[0].pytest_collection_modifyitems(config, items)
    assert all('long' in item.marks and not long for item in deselected)
    return items


FILES = [Item(f'unit/test_{letter}.py', f'test_{n}') for letter in 'abcdef' for n in range(6)]


def test_files_stay_as_they_are_in_one_process():
    assert in_order(FILES) == FILES


def test_the_longest_files_start_first_where_several_processes_run(monkeypatch):
    durations = {'unit/test_c.py': 2.0, 'unit/test_e.py': 30, 'moved/test_b.py': 1.5}
    monkeypatch.setitem(CONFTEST[0].KEPT, 'durations', durations)
    items = in_order(FILES, workers=2)
    assert [item.file[-4] for item in items[::6]] == list('ecbadf')
    assert sorted(map(str, items)) == sorted(map(str, FILES))
    assert [item.name for item in items[:6]] == [item.name for item in FILES[:6]]


@pytest.mark.parametrize('workers', [0, 5])
def test_a_seed_gives_the_same_order_in_every_process_and_another_seed_another(workers):
    order = in_order(FILES, 'a', workers=workers)
    assert order == in_order(reversed(FILES), 'a')
    assert order != in_order(FILES, 'b') != FILES
    files = [item.file for item in order]
    assert sum(a != b for a, b in zip(files, files[1:], strict=False)) == 5  # each in one piece
    assert len({tuple(i.name for i in order[at : at + 6]) for at in range(0, 36, 6)}) > 1


def test_a_file_alone_runs_in_the_order_that_it_had_among_others():
    alone = in_order(FILES[6:12], 'a')
    assert alone == [item for item in in_order(FILES, 'a') if item.file == alone[0].file]


def test_a_file_whose_tests_build_on_each_other_stays_in_order():
    items = [Item(item.file, item.name, ('in_order',)) for item in FILES]
    order = in_order(items, 'a')
    assert order != items
    assert [item.name for item in order] == [item.name for item in items]


def test_files_that_share_a_browser_run_in_one_process_unless_they_take_long():
    page, other = (Item(f'system/test_{name}.py', fixturenames=('browser',)) for name in 'po')
    items = [page, FILES[0], Item(page.file, 'without_it'), other, FILES[1], FILES[6]]
    first, second = 'browser 1', 'browser 2'
    most = ordering.MOST_SHARED
    for long, expected in ((0.0, first), (most / 2, first), (most, second)):
        durations = {page.file: most / 2, other.file: long}
        assert ordering.groups(items, durations) == [
            first, FILES[0].path, first, expected, FILES[0].path, FILES[6].path
        ]  # fmt: skip


def test_what_takes_long_runs_only_if_asked_for_and_then_first(monkeypatch):
    items = [*FILES, slow := Item('unit/test_f.py', 'test_slow', ('long',))]
    assert in_order(items) == FILES
    assert in_order(items, long=True) == items
    monkeypatch.setitem(CONFTEST[0].KEPT, 'durations', {'unit/test_e.py': 9.0})
    assert [item.file[-4] for item in in_order(items, workers=2)[::6]] == list('eabcdf')
    order = in_order(items, long=True, workers=2)
    assert [item.file[-4] for item in order[::7][:2]] == list('fe')
    assert slow in order


@pytest.mark.parametrize(
    'text', ['', '{"unit/a.py": 1', '[]', '3', 'null', '"a"', '[' * 99_999, '{"a": "b"}', '\0']
)
def test_a_torn_table_counts_for_nothing(tmp_path, text):
    torn, seed = tmp_path / 'torn', tmp_path / 'seed'
    torn.write_text(text)
    seed.write_text('{"unit/a.py": 2}')
    assert ordering.read_durations(torn, seed) == {'unit/a.py': 2}
    assert ordering.read_durations(tmp_path / 'none') == {}


def test_of_a_table_that_is_wrong_in_parts_the_rest_counts(tmp_path):
    own, seed = tmp_path / 'own', tmp_path / 'seed'
    own.write_text('{"a": -1, "b": NaN, "c": null, "d": 4, "e": 1e999}')
    seed.write_text('{"a": 1, "d": 2}')
    assert ordering.read_durations(own, seed) == {'a': 1, 'd': 4}


def test_times_of_a_run_take_the_place_of_older_ones(tmp_path):
    table = tmp_path / 'build' / 'durations.json'
    files = ['unit/test_a.py', 'unit/test_b.py', 'unit/test_c.py']

    def run(**seconds):
        recorder = ordering.DurationRecorder(TESTS)
        for letter, value in seconds.items():
            recorder.add(f'unit/test_{letter}.py::test_x[::]', value / 2)
            recorder.add(f'unit/test_{letter}.py::test_y', value / 2)
        recorder.write(table, files)

    run(a=1.0, b=2.0, gone=3.0)
    run(b=4.0, c=0.123456)
    assert ordering.read_durations(table) == dict(zip(files, (1.0, 4.0, 0.12), strict=True))
    assert os.listdir(table.parent) == [table.name]


def test_a_folder_that_cannot_be_written_to_fails_no_run(tmp_path):
    (tmp_path / 'file').touch()
    ordering.DurationRecorder(TESTS).write(tmp_path / 'file' / 'durations.json', ())


@pytest.mark.parametrize(
    ('options', 'arguments', 'whole'),
    [
        ({}, ['test/unit'], True),
        ({'keyword': 'odometry'}, [], False),
        ({'maxfail': 1}, [], False),
        ({'long': True}, [], False),
        ({}, ['test/unit/a.py::test_b'], False),
    ],
)
def test_only_runs_of_whole_files_count(options, arguments, whole):
    config = SimpleNamespace(
        rootpath=ROOT, args=arguments, getoption=lambda name, default: options.get(name, default)
    )
    assert CONFTEST[0].Recording(config).is_whole == whole


def test_the_committed_table_names_files_that_are_there():
    table = json.loads(ordering.SEED_TABLE.read_text())
    assert table.keys() <= ordering.test_files()
    assert ordering.read_durations(ordering.SEED_TABLE) == table
    assert all(Path(name).parts[0] in ('unit', 'ros', 'system', 'tooling') for name in table)
