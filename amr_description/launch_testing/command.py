# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``launch_test FILE``: the tests of a file with ``generate_test_description``."""

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
import sys
from typing import Any
import unittest
from xml.etree import ElementTree

from amr_description.bringup.arguments import parse
from amr_description.errors import AmrError
from amr_description.launch_api.descriptions import declared_arguments, show_arguments
from amr_description.launch_testing.loading import each_test, LaunchTestError, load, runs
from amr_description.launch_testing.runner import run_tests, RunResult


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='launch_test', description='Launch integration testing tool.'
    )
    parser.add_argument('launch_test_file', help='Path to the launch test.')
    parser.add_argument(
        '--package-name', help='Name of the package the test is in, for the report.'
    )
    parser.add_argument('-v', '--verbose', action='store_true', help='Run with verbose output')
    parser.add_argument(
        '-s', '--show-args', '--show-arguments', action='store_true',
        help='Show arguments that may be given to the launch test.',
    )  # fmt: skip
    parser.add_argument(
        'launch_arguments', nargs='*',
        help="Arguments in '<name>:=<value>' format (for duplicates, last one wins).",
    )  # fmt: skip
    parser.add_argument('--junit-xml', dest='xmlpath', help='Write an xUnit report to this path.')
    return parser


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the command.

    Args:
        args: Its arguments; None: those of the process.

    Returns:
        The exit code: 1: a test has failed; 2: it could not be run.
    """
    parser = _parser()
    options = parser.parse_intermixed_args(args)
    try:
        return _run(options)
    except (AmrError, LaunchTestError) as error:
        print(f'launch_test: {error}', file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


def _run(options: argparse.Namespace) -> int:
    path = Path(options.launch_test_file).absolute()
    if not path.is_file():
        raise LaunchTestError(f"Test file '{options.launch_test_file}' does not exist")
    package = options.package_name or path.stem
    name = f'{package}.{path.stem}.launch_tests'
    found = runs(load(path, path.stem), name)
    if options.show_args:
        description = found[0].describe(lambda: None)
        print(show_arguments(declared_arguments(description.launch)))
        return 0
    arguments = parse(options.launch_arguments)
    results = []
    for run in found:
        if len(found) > 1:
            print(f'\nStarting test run {run.name}', flush=True)
        results.append(run_tests(run, arguments))
        if results[-1].failure:
            print(f'{run.name}: {results[-1].failure}', file=sys.stderr)
            break
    if options.xmlpath:
        tree = ElementTree.ElementTree(report(results, f'{package}.{path.stem}'))
        tree.write(options.xmlpath, encoding='utf-8', xml_declaration=True)
    return 0 if all(each.is_successful for each in results) else 1


def report(results: Sequence[RunResult], name: str) -> ElementTree.Element:
    """Return an xUnit report, as CI servers read it."""
    suites = [_suite(each) for each in results]
    counts = {
        key: str(sum(int(each.get(key, '0')) for each in suites))
        for key in ('tests', 'failures', 'errors', 'skipped')
    }
    root = ElementTree.Element('testsuites', {'name': name, **counts})
    root.extend(suites)
    return root


def _suite(result: RunResult) -> ElementTree.Element:
    failed = {
        kind: {test.id(): text for each in result.results for test, text in getattr(each, kind)}
        for kind in ('failures', 'errors', 'skipped')
    }
    suite = ElementTree.Element('testsuite', {'name': result.run.name})
    count = 0
    for test in (*each_test(result.run.beside), *each_test(result.run.after)):
        count += 1
        module, _, method = test.id().rpartition('.')
        case = ElementTree.SubElement(suite, 'testcase', {'classname': module, 'name': method})
        _add(case, test, failed, result.skipped)
    if result.failure:
        count += 1
        case = ElementTree.SubElement(suite, 'testcase', {'name': 'launch'})
        ElementTree.SubElement(case, 'failure', {'message': result.failure.strip()})
    counts: dict[str, int] = {kind: len(tests) for kind, tests in failed.items()}
    counts['failures'] += bool(result.failure)
    if result.skipped:
        counts['skipped'] = count
    suite.attrib |= {'tests': str(count), **{k: str(v) for k, v in counts.items()}}
    return suite


def _add(
    case: ElementTree.Element,
    test: unittest.TestCase,
    failed: Mapping[str, Mapping[str, Any]],
    skipped: str,
) -> None:
    tags = {'failures': 'failure', 'errors': 'error', 'skipped': 'skipped'}
    for kind, tag in tags.items():
        if test.id() in failed[kind]:
            text = str(failed[kind][test.id()]).strip()
            message = text if kind == 'skipped' else text.splitlines()[-1]
            ElementTree.SubElement(case, tag, {'message': message}).text = text
            return
    if skipped:
        ElementTree.SubElement(case, 'skipped', {'message': skipped})
