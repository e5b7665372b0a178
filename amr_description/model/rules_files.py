# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on the files that a description names."""

from collections.abc import Iterator
from dataclasses import dataclass
import re

from amr_description.errors import AmrError
from amr_description.model.element_reader import line_of
from amr_description.model.findings import Finding, quote
from amr_description.model.subject import IsThere, Subject

_SHARE = re.compile(r'/share/[^/]+/')
_ABSOLUTE = re.compile(r'(?:file://)?/|file:/|~|[A-Za-z]:[\\/]')


@dataclass(frozen=True, slots=True)
class _NamedFile:
    """A file that the description names; ``what`` says of what."""

    path: str
    what: str
    line: int
    touches: bool
    takes_package: bool = True


def files_are_there(subject: Subject) -> Iterator[Finding]:
    """Meshes and textures exist; without that of a collision no simulator takes the robot."""
    is_there = subject.surroundings.is_there
    for file in _meshes_and_textures(subject) if is_there is not None else ():
        if not file.path or _ABSOLUTE.match(file.path):
            continue
        try:
            if is_there(file.path):
                continue
        except (AmrError, ValueError) as error:
            yield subject.warning(
                file.line,
                f'{file.what} cannot be looked up',
                found=quote(file.path),
                fix=str(error),
            )
            continue
        judge = subject.error if file.touches else subject.warning
        yield judge(
            file.line,
            f'{file.what} is not there',
            found=quote(file.path),
            expected='package://<package>/<path>, or a path from the folder of this file',
        )


def paths_hold_everywhere(subject: Subject) -> Iterator[Finding]:
    """
    No path is that of one machine.

    What xacro's ``$(find package)`` has become is left alone: the file is there, in the package's
    share folder.
    """
    is_there = subject.surroundings.is_there
    for file in _named_files(subject) if is_there is not None else ():
        if _ABSOLUTE.match(file.path) and not _is_of_a_package(file.path, is_there):
            yield subject.warning(
                file.line,
                f'{file.what} has a path of this machine only',
                found=quote(file.path),
                fix='write package://<package>/<path below its share folder>'
                if file.takes_package
                else 'let xacro find the file: $(find <package>)/config/<file>.yaml',
            )


def _is_of_a_package(path: str, is_there: IsThere) -> bool:
    try:
        return _SHARE.search(path) is not None and is_there(path)
    except (AmrError, ValueError):
        return False


def _named_files(subject: Subject) -> Iterator[_NamedFile]:
    """Yield the files of which a description may give the path of this machine."""
    yield from _meshes_and_textures(subject)
    for element in subject.xml.iterfind('gazebo/plugin/parameters'):
        plugin = element.getparent().get('name', '')
        yield _NamedFile(
            path=(element.text or '').strip(),
            what=f'gazebo plugin {quote(plugin)}: <parameters>',
            line=line_of(element),
            touches=False,
            takes_package=False,
        )


def _meshes_and_textures(subject: Subject) -> Iterator[_NamedFile]:
    for element in subject.xml.iter('mesh', 'texture'):
        part = next(element.iterancestors('visual', 'collision', 'link'), None)
        above = next(element.iterancestors('link', 'robot'), None)
        if above is None or (element.tag == 'mesh' and part is None):
            continue
        owner = '' if above.tag == 'robot' else f' of link {quote(above.get("name", ""))}'
        kind = f'the {element.tag}{owner}'
        touches = part is not None and part.tag == 'collision'
        path = element.get('filename', '').strip()
        yield _NamedFile(path, kind, line_of(element), touches)
