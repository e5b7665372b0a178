# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Findings as text and as JSON."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
import json

from amr_description.doctor.findings import Finding, Severity
from amr_description.text import one_line

PAGE = 'docs/doctor.md'


def link(finding: Finding) -> str:
    """Return where the documentation tells more of a rule."""
    return f'{PAGE}#{finding.rule}'


def as_lines(finding: Finding) -> list[str]:
    """Return a finding as lines: what, why, what mends it, where to read more."""
    return [
        one_line(f'{finding.severity.upper()}: {finding.what}'),
        one_line(f'  why: {finding.why}'),
        one_line(f'  fix: {finding.fix}'),
        f'  see: {link(finding)}',
    ]


def summary(findings: Sequence[Finding]) -> str:
    """Return how many errors and warnings there are."""
    if not findings:
        return 'nothing found that is wrong'
    counts = Counter(finding.severity for finding in findings)
    numbers = [
        f'{count} {severity}{"s" if count > 1 else ""}'
        for severity in Severity
        if (count := counts[severity])
    ]
    return ', '.join(numbers)


def as_dict(finding: Finding) -> dict[str, str]:
    """Return a finding for programs."""
    return {**asdict(finding), 'link': link(finding)}


def as_json(findings: Sequence[Finding]) -> str:
    """Return all findings for programs."""
    return json.dumps({'findings': [as_dict(each) for each in findings]}, indent=2)
