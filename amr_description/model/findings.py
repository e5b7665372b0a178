# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is wrong with a description, where, and what would do: the currency of the readers and of the
checker.

The readers of this package hand every fault to a ``report`` function. :func:`raise_error` makes
them stop at the first one (:func:`amr_description.model.urdf.parse`); ``list.append`` makes them
go on and collect all (:func:`amr_description.model.checks.examine`). So there is one reader, and
both ways say the same.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from amr_description.errors import DescriptionError

# A name or value from the file is shown up to this many characters; a line stays a line.
_SHOWN_CHARACTERS = 80


class Severity(StrEnum):
    """An error cannot be used; a warning can, but will not do what its author means."""

    ERROR = 'error'
    WARNING = 'warning'


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """
    One fault of a description.

    ``what`` names the thing and the fault, ``found`` and ``expected`` are optional, ``fix`` tells
    what to do. ``urdfdom`` holds the words of urdfdom when that library refuses the file for this
    fault; it is empty for what urdfdom lets pass.
    """

    severity: Severity
    source: str
    line: int
    what: str
    found: str = ''
    expected: str = ''
    fix: str = ''
    urdfdom: str = ''

    @classmethod
    def error(cls, source: str, line: int, what: str, **details: str) -> 'Finding':
        """Return an error; ``details`` are found, expected, fix, urdfdom."""
        return cls(severity=Severity.ERROR, source=source, line=line, what=what, **details)

    @classmethod
    def warning(cls, source: str, line: int, what: str, **details: str) -> 'Finding':
        """Return a warning; ``details`` are found, expected, fix."""
        return cls(severity=Severity.WARNING, source=source, line=line, what=what, **details)

    @property
    def text(self) -> str:
        """``file:line: what: found …, expected …; fix``, in one line."""
        parts = [f'found {self.found}'] if self.found else []
        parts += [f'expected {self.expected}'] if self.expected else []
        details = f': {", ".join(parts)}' if parts else ''
        fix = f'; {self.fix}' if self.fix else ''
        return one_line(f'{self.source}:{self.line}: {self.what}{details}{fix}')

    def __str__(self) -> str:
        return f'{self.severity}: {self.text}'


type Report = Callable[[Finding], None]


def raise_error(finding: Finding) -> None:
    """Raise DescriptionError for an error; let a warning pass."""
    if finding.severity is Severity.ERROR:
        raise DescriptionError(finding.text)


def one_line(text: str) -> str:
    """Return ``text`` with control characters escaped: no file may paint on the terminal."""
    return ''.join(c if c.isprintable() else c.encode('unicode_escape').decode() for c in text)


def quote(text: str) -> str:
    """Return a name or value of the file in double quotes, shortened when it is very long."""
    if len(text) > _SHOWN_CHARACTERS:
        text = f'{text[:_SHOWN_CHARACTERS]}…'
    return f'"{text}"'


def quote_all(texts: list[str], limit: int = 10) -> str:
    """Return names in quotes, the first ``limit`` of them; ``none`` for an empty list."""
    if not texts:
        return 'none'
    more = f' and {len(texts) - limit} more' if len(texts) > limit else ''
    return ', '.join(quote(text) for text in texts[:limit]) + more
