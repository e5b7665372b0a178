# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The outcome of a rule."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from amr_description.navigation.contract.observations import ContractObservations


class CheckVerdict(StrEnum):
    """Whether a demand holds."""

    PASSED = 'passed'
    FAILED = 'failed'
    NOT_CHECKED = 'not checked'


@dataclass(frozen=True, slots=True)
class CheckOutcome:
    """What a rule says of a robot."""

    verdict: CheckVerdict
    found: str
    """Figures, and names of nodes; of what is not checked, why."""
    advice: str = ''
    """What would do; empty where nothing has to be done."""


@dataclass(frozen=True, slots=True)
class Rule:
    """One demand."""

    name: str
    asked: str
    source: str
    """Whose demand it is."""
    check: Callable[[ContractObservations], CheckOutcome]


@dataclass(frozen=True, slots=True)
class Finding:
    """One demand and its outcome."""

    name: str
    verdict: CheckVerdict
    asked: str
    found: str
    advice: str
    source: str


def passed(found: str, advice: str = '') -> CheckOutcome:
    """Return that a demand holds."""
    return CheckOutcome(CheckVerdict.PASSED, found, advice)


def failed(found: str, advice: str) -> CheckOutcome:
    """Return that a demand does not hold."""
    return CheckOutcome(CheckVerdict.FAILED, found, advice)


def not_checked(found: str, advice: str = '') -> CheckOutcome:
    """Return that it is not known whether a demand holds, and why."""
    return CheckOutcome(CheckVerdict.NOT_CHECKED, found, advice)


def outcome(holds: bool, found: str, advice: str) -> CheckOutcome:
    """Return whether a demand holds; ``advice`` is for the case that it does not."""
    return passed(found) if holds else failed(found, advice)
