# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page as users get it: built of the sources beside it, whole, and without Node.js."""

import hashlib
import re

import pytest
from support.paths import ROOT

WEB = ROOT / 'web'
STATIC = ROOT / 'amr_description' / 'viewer' / 'static'
BESIDE_SOURCES = ('build.mjs', 'package-lock.json', 'tsconfig.json')
"""What the page is built of besides src/, as in build.mjs."""


def digest_of(web):
    """Return the digest of the sources as build.mjs writes it."""
    below = (path for path in (web / 'src').rglob('*') if path.is_file())
    names = [*BESIDE_SOURCES, *(path.relative_to(web).as_posix() for path in below)]
    lines = (
        f'{hashlib.sha256((web / name).read_bytes()).hexdigest()}  {name}\n'
        for name in sorted(names)
    )
    return hashlib.sha256(''.join(lines).encode()).hexdigest()


@pytest.fixture
def sources(tmp_path):
    """Yield a copy of something like web/."""
    (tmp_path / 'src' / 'drive').mkdir(parents=True)
    for name in (*BESIDE_SOURCES, 'src/main.ts', 'src/drive/keys.ts'):
        (tmp_path / name).write_text(name)
    return tmp_path


def test_the_built_page_is_of_these_sources():
    built = (STATIC / 'sources.sha256').read_text().strip()
    assert built == digest_of(WEB), 'run `npm ci && npm run build` in web/ and commit the page'


@pytest.mark.parametrize('changed', ['src/drive/keys.ts', 'package-lock.json', 'src/new.ts'])
def test_any_change_of_a_source_is_seen(sources, changed):
    before = digest_of(sources)
    assert digest_of(sources) == before
    (sources / changed).write_text('changed')
    assert digest_of(sources) != before


def test_a_source_that_moved_is_seen(sources):
    before = digest_of(sources)
    (sources / 'src' / 'main.ts').rename(sources / 'src' / 'index.ts')
    assert digest_of(sources) != before


def test_the_page_is_whole():
    page = (STATIC / 'index.html').read_text()
    wanted = re.findall(r'(?:src|href)="([^"]+)"', page)
    assert {'main.js', 'style.css', 'icon.svg'} <= set(wanted)
    missing = [name for name in wanted if not (STATIC / name).is_file()]
    assert missing == []


def test_the_page_is_small_on_the_wire():
    texts = [*STATIC.glob('*.js'), *STATIC.glob('*.css')]
    sizes = {path.name: path.with_name(f'{path.name}.br').stat().st_size for path in texts}
    # 4 kB more than before what others draw, a ruler, looks of topics, plots, the last minute.
    assert sum(sizes.values()) <= 276_000, sizes


def test_the_page_asks_nobody_else():
    page = (STATIC / 'index.html').read_text()
    style = (STATIC / 'style.css').read_text()
    assert re.findall(r'(?:src|href)="(?:\w+:|//)', page) == []
    assert re.findall(r'@import|url\((?!#)', style) == []


def test_nothing_of_the_page_stands_inline_where_its_policy_forbids_it():
    page = (STATIC / 'index.html').read_text()
    assert re.findall(r'<script(?![^>]*\bsrc=)|<style|\sstyle=|\son\w+=', page) == []


@pytest.mark.parametrize('package', ['three', 'uplot', 'urdf-loader', 'preact', '@preact/signals'])
def test_the_licence_of_what_is_in_the_page_goes_with_it(package):
    texts = (STATIC / 'licenses.txt').read_text()
    assert re.search(rf'^{package} \d+\.', texts, re.MULTILINE)
    assert 'Permission is hereby granted' in texts
    assert 'Apache License' in texts


def test_users_need_no_node_js():
    files = (path for path in (ROOT / 'scripts').rglob('*') if path.is_file())
    # Others may just be compiling; their files have another name a moment later.
    scripts = [path for path in files if '__pycache__' not in path.parts]
    assert scripts != []
    callers = [
        path.name
        for path in scripts
        if re.search(rb'\b(npm|npx|node_modules)\b', path.read_bytes())
    ]
    assert callers == []
    assert '"viewer/static/**"' in (ROOT / 'pyproject.toml').read_text()
