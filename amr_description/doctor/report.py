# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Findings as text and as JSON."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
import json

from amr_description.doctor.findings import Finding, Severity
from amr_description.doctor.observations import Observations
from amr_description.text import one_line

PAGE = 'docs/api/doctor.md'


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


def as_json(
    findings: Sequence[Finding], *, checks: int, failed: int, not_observed: str = ''
) -> str:
    """
    Return all findings for programs.

    Args:
        findings: errors first.
        checks: how many rules there are.
        failed: how many of them failed.
        not_observed: why the graph was not; empty: it was.
    """
    text = {
        'passed': not (failed or not_observed),
        'checks': checks,
        'failed': failed,
        'not_observed': not_observed,
        'findings': [as_dict(each) for each in findings],
    }
    return json.dumps(text, indent=2, ensure_ascii=False)


def overview(seen: Observations, unseen: str = '') -> list[str]:
    """
    Return what is there, a line for each part.

    Args:
        seen: what was observed.
        unseen: why the graph was not.
    """
    pairs = [
        ('machine', _machine(seen)),
        ('python', _python(seen)),
        ('discovery', _discovery(seen)),
        ('processes', _processes(seen)),
        ('graph', f'not observed: {unseen}' if unseen else _graph(seen)),
    ]
    width = max(len(name) for name, _ in pairs)
    return [one_line(f'{name:{width}}  {text}') for name, text in pairs if text]


def _machine(seen: Observations) -> str:
    if (machine := seen.machine) is None:
        return ''
    free = f'{machine.free_memory / 1e9:.1f} of {machine.memory / 1e9:.1f} GB memory free'
    disks = ', '.join(f'{each.free / 1e9:.0f} GB for {each.purpose}' for each in machine.disks)
    return (
        f'{machine.system} {machine.architecture}, {machine.c_library or "no glibc"}, '
        f'{machine.processors} processors; {free}; {disks}'
    )


def _python(seen: Observations) -> str:
    if seen.machine is None:
        return ''
    python = seen.machine.python
    rclpy = f'rclpy {python.rclpy_version} in {python.rclpy_folder}'
    return f'{python.version}, {python.executable}; {rclpy if python.rclpy_folder else "no rclpy"}'


def _discovery(seen: Observations) -> str:
    if (environment := seen.environment) is None:
        return ''
    domain = environment.value('ROS_DOMAIN_ID') or '0'
    reach = environment.value('ROS_AUTOMATIC_DISCOVERY_RANGE') or 'SUBNET'
    if environment.value('ROS_LOCALHOST_ONLY') == '1':
        reach = 'LOCALHOST'
    server = environment.value('ROS_DISCOVERY_SERVER')
    peers = environment.value('ROS_STATIC_PEERS')
    rmw = environment.value('RMW_IMPLEMENTATION') or 'rmw_fastrtps_cpp'
    return ', '.join(
        [
            f'ROS domain {domain}',
            f'range {reach}',
            *([f'peers {peers}'] if peers else []),
            *([f'discovery server {server}'] if server else []),
            rmw,
        ]
    )


def _processes(seen: Observations) -> str:
    if seen.processes is None:
        return ''
    here = [each for each in seen.processes.processes if each.domain == seen.processes.domain]
    others = len(seen.processes.processes) - len(here)
    elsewhere = f'; {others} in other domains' if others else ''
    return f'{len(here)} of ROS on this host in this domain{elsewhere}'


def _graph(seen: Observations) -> str:
    if seen.graph is None:
        return 'no other node' if seen.processes and seen.processes.is_alone else ''
    return f'{_count(len(seen.graph.nodes), "node")}, {_count(len(seen.graph.topics), "topic")}'


def _count(number: int, word: str) -> str:
    return f'{number} {word}{"" if number == 1 else "s"}'
