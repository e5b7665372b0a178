# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What readers and the checker report about a description: the fault, its line, and how to fix it.

The readers of this package pass every fault to a ``report`` function. :func:`raise_error` makes
them stop at the first one (:func:`amr_description.model.urdf.parse`); ``list.append`` makes them
go on and collect all (:func:`amr_description.model.checks.examine`). So there is one reader, and
both report the same.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import NamedTuple, TypeAlias

from amr_description.errors import DescriptionError
from amr_description.text import one_line

NO_SHAPE = 'no shape is taken'
"""What the simulator makes of a visual or a collision without one, or one without a volume."""


class SourceLocation(NamedTuple):
    """A line of a file."""

    source: str
    line: int


class Severity(StrEnum):
    """An error makes a description unusable; with a warning it behaves as nobody intends."""

    ERROR = 'error'
    WARNING = 'warning'


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """
    One fault of a description.

    ``what`` names the part and its fault, ``found`` and ``expected`` are optional, ``fix`` says
    what to do. ``urdfdom`` is the message of urdfdom if that library refuses the file for this
    fault, and empty otherwise. ``context`` is what more there is to say of the
    place, such as the macro that it is in. ``taken`` is what the simulator makes of a fault that
    it can live with, such as ``it is left out``; a strict one refuses it, whether it is an error
    for others or a warning.
    """

    severity: Severity
    source: str
    line: int
    what: str
    found: str = ''
    expected: str = ''
    fix: str = ''
    urdfdom: str = ''
    context: str = ''
    taken: str = ''

    @classmethod
    def error(cls, source: str, line: int, what: str, **details: str) -> 'Finding':
        """Return an error; ``details`` are found, expected, fix, urdfdom, taken."""
        return cls(severity=Severity.ERROR, source=source, line=line, what=what, **details)

    @classmethod
    def warning(cls, source: str, line: int, what: str, **details: str) -> 'Finding':
        """Return a warning; ``details`` are found, expected, taken, fix."""
        return cls(severity=Severity.WARNING, source=source, line=line, what=what, **details)

    @property
    def text(self) -> str:
        """
        ``file:line: what: found …, expected …; taken; fix (context)``, in one line.

        What the simulator makes of an error is left out: :meth:`as_taken` says it.
        """
        parts = [f'found {self.found}'] if self.found else []
        parts += [f'expected {self.expected}'] if self.expected else []
        details = f': {", ".join(parts)}' if parts else ''
        is_taken = self.taken and self.severity is Severity.WARNING
        fix = f'; {self.taken}' if is_taken else ''
        fix += f'; {self.fix}' if self.fix else ''
        context = f' ({self.context})' if self.context else ''
        return one_line(f'{self.source}:{self.line}: {self.what}{details}{fix}{context}')

    def is_refused(self, *, strict: bool) -> bool:
        """Return whether the simulator refuses a description for it."""
        if self.taken:
            return strict
        return self.severity is Severity.ERROR

    def as_taken(self) -> 'Finding':
        """Return the warning that says what the simulator makes of this error."""
        return replace(self, severity=Severity.WARNING, fix='')

    def __str__(self) -> str:
        return f'{self.severity}: {self.text}'


Report: TypeAlias = Callable[[Finding], None]


def raise_error(finding: Finding) -> None:
    """Raise DescriptionError for an error; let a warning pass."""
    if finding.severity is Severity.ERROR:
        raise DescriptionError(finding.text)
