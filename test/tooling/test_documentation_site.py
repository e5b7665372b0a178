# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The settings of the documentation's site: strict, navigated by the index, without a network."""

import os
import re
import shutil
import subprocess
import sys

import pytest
from support.needs import need
from support.paths import ROOT

SPHINX = ROOT / '.venv-docs'
INDEX = '# Index\n\n## Learn\n\n- [A](a.md): first\n- [The `b`](b.md)\n'


@pytest.fixture
def pages(tmp_path):
    """A project with a front page, an index and two pages."""
    need((SPHINX / 'installed.lock').exists(), 'no Sphinx in .venv-docs; run scripts/docs')
    docs = tmp_path / 'docs'
    docs.mkdir()
    for name in ('conf.py', 'site.css'):
        shutil.copy(ROOT / 'docs' / name, docs)
    (tmp_path / 'README.md').write_text('# Front\n\n[All pages](docs/README.md)\n')
    (docs / 'README.md').write_text(INDEX)
    (docs / 'a.md').write_text('# First\n\n[Second](b.md#part-two)\n')
    (docs / 'b.md').write_text('# Second\n\n## Part two\n\nA word: lidar.\n')
    return docs


def build(pages):
    """What scripts/docs runs, over these pages; the result and the folder of the site."""
    done = subprocess.run(
        [sys.executable, '-m', 'sphinx', '-q', '-W', '-b', 'html', '-c', 'docs', '.', 'site'],
        cwd=pages.parent,
        env=os.environ | {'PYTHONPATH': str(SPHINX)},
        capture_output=True,
        text=True,
        check=False,
    )
    return done, pages.parent / 'site'


def test_the_site(pages):
    done, site = build(pages)
    assert (done.returncode, done.stderr) == (0, '')
    front = (site / 'index.html').read_text()
    navigation = re.findall(r'<a class="reference internal" href="(docs/\w+\.html)"', front)
    assert navigation[:2] == ['docs/a.html', 'docs/b.html']
    assert 'lidar' in (site / 'searchindex.js').read_text()
    # Nothing is loaded from elsewhere: the site works without a network.
    loaded = re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="(\w+:)?//', front)
    assert loaded == []


def test_what_leads_nowhere_is_an_error(pages):
    (pages / 'a.md').write_text('# First\n\n[Gone](gone.md)\n\n[No part](b.md#part-nine)\n')
    (pages / 'lost.md').write_text('# Lost\n')
    done, _ = build(pages)
    assert done.returncode != 0
    where = {line.split(': ')[0].rpartition('/')[2] for line in done.stderr.splitlines()}
    assert {'a.md:3', 'a.md:5', 'lost.md'} <= where, done.stderr
