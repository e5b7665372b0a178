# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Findings as lines of text, and as JSON."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
import json

from amr_description.navigation.contract.findings import CheckVerdict, Finding
from amr_description.navigation.contract.observations import ContractObservations
from amr_description.text import one_line

_VERDICT_WIDTH = max(len(verdict) for verdict in CheckVerdict)


def as_line(finding: Finding, width: int = 0) -> str:
    """
    Return a finding as one line: verdict, demand, what was asked and found, what would do.

    Args:
        finding: one.
        width: of the column of names.
    """
    verdict = finding.verdict
    shown = verdict.upper() if verdict is CheckVerdict.FAILED else verdict
    text = f'{shown:{_VERDICT_WIDTH}}  {finding.name:{width}}  {finding.asked}: {finding.found}'
    return one_line(text + (f'; {finding.advice}' if finding.advice else ''))


def as_text(findings: Sequence[Finding], seen: ContractObservations) -> str:
    """Return all findings, a line each, and what they amount to."""
    width = max(len(finding.name) for finding in findings)
    return '\n'.join([*(as_line(finding, width) for finding in findings), summary(findings, seen)])


def summary(findings: Sequence[Finding], seen: ContractObservations) -> str:
    """Return how many demands hold, in how long that was found, and what never came."""
    counts = Counter(finding.verdict for finding in findings)
    silent = silent_topics(seen)
    never = f'; nothing came on {", ".join(silent)}' if silent else ''
    return (
        f'{len(findings)} demands in {seen.seconds:.1f} s: {counts[CheckVerdict.PASSED]} passed, '
        f'{counts[CheckVerdict.FAILED]} failed, '
        f'{counts[CheckVerdict.NOT_CHECKED]} not checked{never}'
    )


def silent_topics(seen: ContractObservations) -> list[str]:
    """Return the topics on which messages were waited for in vain."""
    counts = (
        (seen.clock.name, seen.ticks or not seen.is_simulated),
        (seen.tf.name, seen.transforms),
        (seen.odom.name, seen.odometry),
        (seen.scan.name, seen.scans),
    )
    return [name for name, messages in counts if not messages]


def as_json(findings: Sequence[Finding], seen: ContractObservations) -> str:
    """Return the same for programs."""
    counts = Counter(finding.verdict for finding in findings)
    return json.dumps(
        {
            'holds': not counts[CheckVerdict.FAILED],
            'counts': {verdict.value: counts[verdict] for verdict in CheckVerdict},
            'seconds': round(seen.seconds, 3),
            'silent_topics': silent_topics(seen),
            'findings': [asdict(finding) for finding in findings],
        },
        indent=2,
        ensure_ascii=False,
    )
