# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where the lines of a description come from: the file, and of a xacro file its line and macro.

What xacro expands has other lines than the files that a person edits, and nobody has that text as
a file. The origins of its elements travel with the text, as a comment behind its end, so that who
gets it from a topic can name the file, too::

    <!-- from: r.urdf.xacro parts.xacro | wheel | 8:0:3::: 9:1:12:0:0:20 … -->

Files and macros are numbered from 0; then stand, for each element, its line in the text, the file,
the line there, and if it stands in a macro, this and file and line of the call. Without numbers
the lines are those of the file.
"""

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
import re
from urllib.parse import quote, unquote

from amr_description.model.findings import Finding, raise_error, Report

_COMMENT = re.compile(r'<!-- from: ([^|]*)\|([^|]*)\|([\d: ]*)-->\s*\Z')
# Where a finding names a second line.
_ON_LINE = re.compile(r'\bon line (\d+)$')


@dataclass(frozen=True, slots=True)
class Origin:
    """
    A line of a file.

    ``macro`` is that of xacro which it is in, or ''; ``called`` is where that was called, if it is
    known: file and line.
    """

    file: str
    line: int
    macro: str = ''
    called: tuple[str, int] | None = None

    @property
    def context(self) -> str:
        """``in macro "wheel", called at r.urdf.xacro:20``; '' outside of macros."""
        call = '' if self.called is None else f', called at {self.called[0]}:{self.called[1]}'
        return f'in macro "{self.macro}"{call}' if self.macro else ''


def with_file(text: str, file: str) -> str:
    """Return a description that stands in a file as it is, and says so; a torn one does not."""
    if '</robot>' not in text:
        return text
    return f'{_without_comment(text)}<!-- from: {_word(file)} | | -->\n'


def with_origins(text: str, origins: Mapping[int, Origin]) -> str:
    """Return an expanded description with the origins of its lines, as far as they are known."""
    files = list(dict.fromkeys(file for each in origins.values() for file in _files_of(each)))
    macros = list(dict.fromkeys(origin.macro for origin in origins.values() if origin.macro))
    rows = ' '.join(
        f'{line}:{files.index(origin.file)}:{origin.line}:'
        f'{macros.index(origin.macro) if origin.macro else ""}:'
        f'{"" if origin.called is None else files.index(origin.called[0])}:'
        f'{"" if origin.called is None else origin.called[1]}'
        for line, origin in sorted(origins.items())
    )
    names = [' '.join(map(_word, words)) for words in (files, macros)]
    return f'{_without_comment(text)}<!-- from: {names[0]} | {names[1]} | {rows} -->\n'


def origin_of(text: str, line: int) -> Origin | None:
    """Return where a line of a description comes from; None: the text does not say."""
    files, lines, origins = _table(text)
    if files and not lines:
        return Origin(files[0], line)
    return origins[max(bisect_right(lines, line) - 1, 0)] if lines else None


def line_from(text: str, file: str, line: int) -> int | None:
    """Return the first line of a description that comes from a line of a file; None: none does."""
    files, lines, origins = _table(text)
    if file in files and not lines:
        return line
    found = (
        at
        for at, each in zip(lines, origins, strict=True)
        if (each.file, each.line) == (file, line)
    )
    return next(found, None)


def files_in(text: str) -> list[str]:
    """Return the files that a description is of, as far as the text says so."""
    return _table(text)[0]


@lru_cache(maxsize=4)
def _table(text: str) -> tuple[list[str], list[int], list[Origin]]:
    """Return the files, and the lines of which the origins are known, with these."""
    match = _COMMENT.search(text)
    if match is None:
        return [], [], []
    files, macros = ([unquote(word) for word in match[i].split()] for i in (1, 2))
    lines, origins = [], []
    try:
        for row in match[3].split():
            line, file, found, macro, caller, call = row.split(':')
            lines.append(int(line))
            name = macros[int(macro)] if macro else ''
            called = (files[int(caller)], int(call)) if caller else None
            origins.append(Origin(files[int(file)], int(found), name, called))
    except (IndexError, ValueError):  # somebody has written such a comment by hand
        return [], [], []
    return files, lines, origins


def relocated(finding: Finding, text: str) -> Finding:
    """Return the finding at the place that its line of the text comes from, if that is known."""
    origin = origin_of(text, finding.line)
    if origin is None:
        return finding

    def place(match: re.Match[str]) -> str:
        other = origin_of(text, int(match[1]))
        if other is None:
            return match[0]
        file, line = other.called or (other.file, other.line)
        return f'at {file}:{line}'

    return replace(
        finding,
        source=origin.file,
        line=origin.line,
        found=_ON_LINE.sub(place, finding.found),
        context=origin.context,
    )


def place_in(text: str, source: str, line: int) -> str:
    """Return ``file:line`` of a line of the text that messages call ``source``."""
    origin = origin_of(text, line) or Origin(source, line)
    return f'{origin.file}:{origin.line}'


def raise_error_of(text: str, strict: bool = True) -> Report:
    """
    Return :func:`raise_error` for findings in a text, which names where they come from.

    ``strict``: raise errors too that the simulator can live with (``Finding.taken``).
    """

    def report(finding: Finding) -> None:
        if strict or not finding.taken:
            raise_error(relocated(finding, text))

    return report


def _files_of(origin: Origin) -> list[str]:
    return [origin.file, *(origin.called[:1] if origin.called is not None else ())]


def _without_comment(text: str) -> str:
    """Return a text as it was, with an end of line."""
    text = _COMMENT.sub('', text)
    return text if text.endswith('\n') else f'{text}\n'


def _word(name: str) -> str:
    """Return a name as one word that may stand in a comment, which must not hold ``--``."""
    return quote(name).replace('-', '%2D')
