# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a rule finds."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

from amr_description.doctor.observations import Observations


class Severity(StrEnum):
    """How much it hurts."""

    ERROR = 'error'
    """Something does not work."""
    WARNING = 'warning'
    """Something works worse than it could, or will cease to work."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """A fault, and what mends it. The texts have no full stop at their end."""

    severity: Severity
    rule: str
    """The name of the function that found it, and of its section in docs/api/doctor.md."""
    what: str
    """What was seen, with names and figures; one line."""
    why: str
    """Why it matters; one line."""
    fix: str
    """The command or the line that mends it; one line."""


Rule: TypeAlias = Callable[[Observations], Iterable[Finding]]
"""Its name is the name of the rule; its docstring says what it demands."""


def error(rule: str, what: str, why: str, fix: str) -> Finding:
    """Return that something does not work."""
    return Finding(severity=Severity.ERROR, rule=rule, what=what, why=why, fix=fix)


def warning(rule: str, what: str, why: str, fix: str) -> Finding:
    """Return that something could be better."""
    return Finding(severity=Severity.WARNING, rule=rule, what=what, why=why, fix=fix)
