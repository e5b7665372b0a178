# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a failed test leaves behind."""

import pytest
from support import chromium, failures


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(failures, 'FAILURES', tmp_path / 'failures')
    return tmp_path / 'failures' / 'unit_test_a.py_test_b_x-1_'


class Page:
    def screenshot(self, path):
        path.write_bytes(b'png')


class ClosedPage:
    def screenshot(self, path):
        raise chromium.BrowserError(path)


def test_it_leaves_its_words_logs_and_pages(tmp_path, folder, monkeypatch):
    pages = {Page(), ClosedPage()}
    monkeypatch.setattr(chromium, 'OPEN_PAGES', pages)
    own = tmp_path / 'own'
    (own / 'logs').mkdir(parents=True)
    (own / 'logs' / 'node.log').write_text('said')
    (own / 'logs' / 'huge.log').write_bytes(bytes(failures.MOST + 1))
    (own / 'robot.urdf').touch()
    for _ in range(2):
        failures.keep('test/unit/test_a.py::test_b[x-1]', 'E  assert \udcff', own)
    kept = {path.relative_to(folder).as_posix() for path in folder.rglob('*') if path.is_file()}
    assert len(kept) == 3
    assert {'failure.txt', 'logs/node.log'} < kept
    assert kept & {'page0.png', 'page1.png'}
    assert (folder / 'failure.txt').read_text() == 'E  assert ?'


def test_what_cannot_be_kept_fails_nothing(tmp_path):
    (tmp_path / 'failures').touch()
    failures.keep('test/unit/test_a.py::test_b[x-1]', 'E  assert', None)
