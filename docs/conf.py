# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How Sphinx makes the site of the documentation: ``scripts/docs``.

The pages are the Markdown files as they lie in the repository, front page and change log too, so
that a link works in both places. The navigation is the list of pages in ``docs/README.md``.
"""

from __future__ import annotations

from pathlib import Path
import pkgutil
import re
import shutil
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from docutils import nodes
    from sphinx.application import Sphinx
    from sphinx.environment import BuildEnvironment

ROOT = Path(__file__).resolve().parent.parent
FRONT, INDEX = 'README', 'docs/README'

project = 'amr_description'
author = 'The amr_description authors'
project_copyright = f'2026 {author}'
root_doc = FRONT
include_patterns = ['*.md', 'benchmarks/*.md', 'docs/*.md', 'docs/api/*.md', 'docs/api/*.rst']
exclude_patterns = ['.*', 'amr_description', 'build', 'install', 'log', 'test', 'web']

extensions = ['myst_parser', 'sphinx.ext.autodoc', 'sphinx.ext.napoleon']
myst_heading_anchors = 4  # anchors as GitHub makes them
nitpicky = True
highlight_language = 'none'  # a block without a language is not guessed at

autodoc_member_order = 'bysource'
autodoc_typehints = 'signature'
autodoc_default_options = {'members': True}
autoclass_content = 'both'
maximum_signature_line_length = 80
napoleon_numpy_docstring = False

html_theme = 'furo'
html_title = 'amr_description'
html_copy_source = False
html_show_sphinx = False
html_static_path = ['site.css']
html_css_files = ['site.css']


def navigation(index: str) -> dict[str, list[str]]:
    """Return the pages that the lists of ``docs/README.md`` name, by the headings above them."""
    pages: dict[str, list[str]] = {}
    for line in index.splitlines():
        if line.startswith('## '):
            heading = line.removeprefix('## ')
        elif link := re.match(r'- \[[^]]*\]\(([^)#:]+)\.(?:md|rst)\)', line):
            page = (ROOT / 'docs' / link[1]).resolve().relative_to(ROOT)
            pages.setdefault(heading, []).append(page.as_posix())
    return pages


def add_navigation(app: Sphinx, page: str, source: list[str]) -> None:
    """Put the navigation below the front page, where a theme looks for it."""
    if page == FRONT:
        index = (ROOT / f'{INDEX}.md').read_text(encoding='utf-8')
        for heading, pages in {**navigation(index), 'Index': [INDEX]}.items():
            trees = '\n'.join(pages)
            source[0] += f'\n```{{toctree}}\n:hidden:\n:caption: {heading}\n\n{trees}\n```\n'


def copy_front_page(app: Sphinx, error: Exception | None) -> None:
    """Let the front page be ``index.html``, too, where a server and a person look for it."""
    if error is None:
        shutil.copy(app.outdir / f'{FRONT}.html', app.outdir / 'index.html')


def resolve_elsewhere(
    app: Sphinx, environment: BuildEnvironment, reference: nodes.Element, text: nodes.Element
) -> nodes.Element | None:
    """Leave as text what a docstring refers to and no page documents, if Python can find it."""
    if 'refwarn' not in reference:  # a type annotation, which Python has read
        return text
    target = reference.get('reftarget', '')
    around = [reference.get('py:module'), reference.get('py:class')]
    for depth in range(3):
        try:
            pkgutil.resolve_name('.'.join([*filter(None, around[:depth]), target]))
        except (ImportError, AttributeError, ValueError):
            continue
        return text
    return None


class UnitsOfAttributes:
    """
    Keep napoleon from taking the text before a colon for a type.

    The docstring of an attribute begins with its unit: ``m; inf: no limit``.
    """

    def __init__(self, app: Sphinx) -> None:
        """Connect before and after napoleon, whose priority is 500."""
        self._lines: list[str] = []
        app.connect('autodoc-process-docstring', self.keep, priority=400)
        app.connect('autodoc-process-docstring', self.restore, priority=600)

    def keep(
        self, app: Sphinx, kind: str, name: str, it: object, options: object, lines: list[str]
    ) -> None:
        """Remember the docstring as it is written."""
        self._lines = lines[:]

    def restore(
        self, app: Sphinx, kind: str, name: str, it: object, options: object, lines: list[str]
    ) -> None:
        """Put it back."""
        if kind in ('attribute', 'data', 'property'):
            lines[:] = self._lines


def setup(app: Sphinx) -> None:
    """Connect what is above; Sphinx calls it."""
    app.connect('source-read', add_navigation)
    app.connect('missing-reference', resolve_elsewhere)
    app.connect('build-finished', copy_front_page)
    UnitsOfAttributes(app)
