# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 doctor`` observes, and how it prints what was found."""

from argparse import Namespace
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, ExitStack
from dataclasses import dataclass, replace
import importlib
import json
import re
import sys
import time

from amr_description import colors
from amr_description.cli.doctor.reports import print_reports
from amr_description.doctor import report
from amr_description.doctor.findings import Finding, Severity
from amr_description.doctor.host import read_host, Sections
from amr_description.doctor.observations import Observations
from amr_description.doctor.table import examine, family, RULES
from amr_description.errors import AmrError
from amr_description.text import one_line

_COLORS = {Severity.ERROR: colors.RED, Severity.WARNING: colors.YELLOW}
_OBSTACLES = {'c_library', 'python_abi', 'rmw_implementation', 'domain', 'security', 'log_folder'}
_FIGURE = re.compile(r'(?<![\w/.-])-?\d+(?:\.\d+)?(?:e[+-]\d+)?(?![\w/])')
"""A number, and no part of a name, as of ``/robot2``."""


@dataclass(frozen=True)
class Examination:
    """What was observed, and what the rules say of it."""

    seen: Observations
    findings: Sequence[Finding]
    unseen: str = ''
    """Why the graph was not observed; empty: it was."""

    def failed(self, *, with_warnings: bool) -> list[Finding]:
        """Return the findings that make a check fail."""
        wanted = {Severity.ERROR, *([Severity.WARNING] if with_warnings else [])}
        return [finding for finding in self.findings if finding.severity in wanted]

    def exit_code(self, failed: Sequence[Finding]) -> int:
        """Return 1 if a check failed, or could not be made, as the graph was not observed."""
        return int(bool(failed or self.unseen))


def examine_and_print(args: Namespace) -> int:
    """Examine once; return the exit code."""
    with observer() as observe:
        found = observe()
    failed = found.failed(with_warnings=args.include_warnings)
    families = list(dict.fromkeys(family(finding.rule) for finding in failed))
    if args.report:
        print_reports(found.seen, packages=not args.exclude_packages)
        return found.exit_code(failed)
    rules = len({finding.rule for finding in failed})
    if args.json:
        print(
            report.as_json(
                found.findings, checks=len(RULES), failed=rules, not_observed=found.unseen
            )
        )
        return found.exit_code(failed)
    for line in report.overview(found.seen, found.unseen):
        print(line)
    print()
    for finding in found.findings:
        _print_finding(finding)
    if failed:
        print(f'{rules}/{len(RULES)} check(s) failed\n')
        print('Failed modules:', *families)
    elif found.unseen:
        print('The graph was not observed\n')
    else:
        warned = len({finding.rule for finding in found.findings})
        print(f'All {len(RULES)} checks passed{f", {warned} with a warning" if warned else ""}\n')
    if args.report_failed and failed:
        print_reports(found.seen, families, packages=not args.exclude_packages)
    return found.exit_code(failed)


def watch(args: Namespace) -> int:
    """Examine again and again until Ctrl-C; print what is new, and what is gone."""
    known: dict[tuple[str, int], Finding] = {}
    is_first = True
    with observer() as observe:
        while True:
            began = time.monotonic()
            now = keyed(observe().findings)
            new = [finding for key, finding in now.items() if key not in known]
            gone = [finding for key, finding in known.items() if key not in now]
            if new or gone or is_first:
                _print_change(new, gone, as_json=args.json)
            known, is_first = now, False
            time.sleep(max(0.0, args.watch - (time.monotonic() - began)))


def keyed(findings: Sequence[Finding]) -> dict[tuple[str, int], Finding]:
    """Return findings by what identifies each while its figures change."""
    counts: Counter[str] = Counter()
    found = {}
    for finding in findings:
        text = f'{finding.rule} {_FIGURE.sub("", finding.what)}'
        found[text, counts[text]] = finding
        counts[text] += 1
    return found


def _print_change(new: Sequence[Finding], gone: Sequence[Finding], *, as_json: bool) -> None:
    if as_json:
        change = {
            'time': time.time(),
            'new': [report.as_dict(each) for each in new],
            'gone': [report.as_dict(each) for each in gone],
        }
        print(json.dumps(change, ensure_ascii=False), flush=True)
        return
    now = time.strftime('%H:%M:%S')
    if not (new or gone):
        print(f'[{now}] {report.summary(new)}')
    for finding in gone:
        print(f'[{now}] {colors.colored("gone", colors.GREEN)}: {one_line(finding.what)}')
    for finding in new:
        print(f'[{now}] new:')
        _print_finding(finding)
    sys.stdout.flush()


def _print_finding(finding: Finding) -> None:
    first, *rest = report.as_lines(finding)
    print(colors.colored(first, _COLORS[finding.severity]), *rest, sep='\n', end='\n\n')


@contextmanager
def observer() -> Iterator[Callable[[], Examination]]:
    """Yield what observes host and graph; where ROS cannot be used, the host alone."""
    sections = read_host()
    fault = _obstacle(sections)
    if fault:
        yield lambda: _of_host(unseen=fault)
        return
    fault = _rclpy_fault()
    if fault:
        yield lambda: _of_host(unseen=f'rclpy cannot be imported: {fault}', rclpy_fault=fault)
        return
    from amr_description.cli.doctor.graph import observe, sessions

    with ExitStack() as stack:
        try:
            session = stack.enter_context(sessions())
        except AmrError as error:
            fault = one_line(str(error))
            yield lambda: _of_host(unseen=fault)
            return

        newest: list[Sections] = [sections]

        def examined() -> Examination:
            seen = observe(session, **(newest.pop() if newest else read_host()))
            return Examination(seen, examine(seen))

        yield examined


def _obstacle(sections: Sections) -> str:
    """Return by what rclpy would end this process, or fail, as soon as it is used."""
    seen = Observations(**sections)
    return next((each.what for each in examine(seen) if each.rule in _OBSTACLES), '')


def _of_host(*, unseen: str, rclpy_fault: str = '') -> Examination:
    """Return what the host alone shows."""
    sections = read_host()
    machine = sections['machine']
    sections['machine'] = replace(machine, python=replace(machine.python, rclpy_fault=rclpy_fault))
    seen = Observations(**sections)
    return Examination(seen, examine(seen), unseen)


def _rclpy_fault() -> str:
    """Return why rclpy cannot be imported; empty: it can be."""
    try:
        importlib.import_module('rclpy')
    except (ImportError, OSError) as error:
        return one_line(str(error))
    return ''
