# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The version of a checkout, which several files name, and what the changelog says about it."""

from datetime import date
from pathlib import Path
import re
from typing import NamedTuple
import xml.etree.ElementTree as ElementTree

from releasing import ReleaseError

CHANGELOG = 'CHANGELOG.md'
_VERSION = r'^version *= *"([^"]+)"'
_ELSEWHERE = {
    'pyproject.toml': ('pyproject.toml', _VERSION),
    'the extra [ros] of pyproject.toml': ('pyproject.toml', r'"amr-description-ros *== *([^"]+)"'),
    'interfaces/pyproject.toml': ('interfaces/pyproject.toml', _VERSION),
}
"""Name of a place → its file, and what it says."""
_HEADING = re.compile(r'^## (?P<version>\S+)(?: \((?P<date>[^)]*)\))? *$', re.MULTILINE)


class Section(NamedTuple):
    """What a changelog says about one version."""

    version: str
    date: str
    """As it is written: a date, ``unreleased``, or nothing."""
    text: str


def declared_versions(root: Path) -> dict[str, str]:
    """Return the version that each place names, by its name. Raises ReleaseError: none in one."""
    found = {'package.xml': ElementTree.parse(root / 'package.xml').findtext('version') or ''}
    for name, (file, pattern) in _ELSEWHERE.items():
        match = re.search(pattern, (root / file).read_text(encoding='utf-8'), re.MULTILINE)
        found[name] = match[1] if match else ''
    for name, version in found.items():
        if not version:
            raise ReleaseError(f'{name} names no version')
    return found


def agreed_version(declared: dict[str, str], asked: str | None = None) -> str:
    """
    Return the version that all files name.

    Args:
        declared: of :func:`declared_versions`.
        asked: the version that is to be released; None: whichever it is.

    Raises:
        ReleaseError: they differ, or none is the one that was asked for, or it is no version.
    """
    named = ', '.join(f'{version} in {name}' for name, version in declared.items())
    if len(set(declared.values())) != 1:
        raise ReleaseError(f'the files name different versions: {named}; make them one')
    version = next(iter(declared.values()))
    if asked not in (None, version):
        raise ReleaseError(f'asked for {asked}, found {named}; change them first')
    if not re.fullmatch(r'\d+\.\d+\.\d+', version):
        raise ReleaseError(f'{version} is no version MAJOR.MINOR.PATCH, as package.xml wants')
    return version


def sections(changelog: str) -> list[Section]:
    """Return the sections of a changelog, the newest version first."""
    headings = [*_HEADING.finditer(changelog)]
    ends = [match.start() for match in headings] + [len(changelog)]
    return [
        Section(match['version'], match['date'] or '', changelog[match.end() : end].strip())
        for match, end in zip(headings, ends[1:], strict=True)
    ]


def section_of(version: str, changelog: str) -> Section:
    """Return the section of ``version``, which is the newest. Raises ReleaseError."""
    found = sections(changelog)
    if not found or found[0].version != version:
        newest = f'its newest section is {found[0].version}' if found else 'it has no section'
        raise ReleaseError(f'{CHANGELOG}: want "## {version} (DATE)" on top, but {newest}')
    if not found[0].text:
        raise ReleaseError(f'{CHANGELOG}: the section {version} says nothing')
    return found[0]


def check_date(section: Section, today: date) -> None:
    """Raise ReleaseError unless the section has a date that is not to come."""
    wanted = f'{CHANGELOG}: write "## {section.version} ({today})"'
    try:
        day = date.fromisoformat(section.date)
    except ValueError:
        raise ReleaseError(f'{wanted} in place of ({section.date or "no date"})') from None
    if day > today:
        raise ReleaseError(f'{wanted}: {day} is to come')


def check_readme(version: str, readme: str) -> None:
    """Raise ReleaseError when the front page still says that the version is not released."""
    if f'{version} is not released yet' in readme:
        raise ReleaseError(f'README.md says "{version} is not released yet"; take that away')
