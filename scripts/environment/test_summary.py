# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``test_summary.py RESULTS CODE``: the last lines of ``scripts/test``, and its exit code.

Why tests were skipped, and which are flaky, stands before the line that counts. A flaky test has
failed, and has passed when it was run once more, alone (``test/support/second_look.py``).

RESULTS is pytest's JUnit file, CODE what ``colcon test`` ended with. An error (a test that could
not be collected, a fixture that raised) counts as failed; so does a run without a result.
"""

from collections import Counter
from pathlib import Path
import sys
import xml.etree.ElementTree as ElementTree


def count(results: Path) -> tuple[int, int, int]:
    """Return how many passed, failed and were skipped."""
    suites = list(ElementTree.parse(results).getroot().iter('testsuite'))
    total, failures, errors, skipped = (
        sum(int(suite.get(name, '0')) for suite in suites)
        for name in ('tests', 'failures', 'errors', 'skipped')
    )
    failed = failures + errors
    return total - failed - skipped, failed, skipped


def reasons_to_skip(results: Path) -> Counter[str]:
    """Return how many tests were skipped for each reason."""
    skipped = ElementTree.parse(results).getroot().iter('skipped')
    return Counter(element.get('message', 'no reason given') for element in skipped)


def flaky_tests(results: Path) -> list[str]:
    """Return the names of the tests that passed at the second look, and are not counted failed."""
    return [
        f'{case.get("classname", "")}.{case.get("name", "")}'
        for case in ElementTree.parse(results).getroot().iter('testcase')
        if case.find('properties/property[@name="flaky"]') is not None
        and case.find('failure') is None
        and case.find('error') is None
    ]


def main(results: Path, colcon_code: int) -> int:
    """Print the lines; return the exit code."""
    try:
        passed, failed, skipped = count(results)
        for reason, number in reasons_to_skip(results).items():
            print(f'{number} not run: {reason}')
        flaky = flaky_tests(results)
        for name in flaky:
            print(f'flaky, its two logs are in build/tests/flaky/: {name}')
    except (OSError, ElementTree.ParseError) as error:
        print(f'scripts/test: no test result: {error}')
        passed, failed, skipped, flaky = 0, 0, 0, []
    counts = ((skipped, 'skipped'), (len(flaky), 'flaky'))
    others = ''.join(f', {number} {word}' for number, word in counts if number)
    print(f'{passed - len(flaky)} passed, {failed} failed{others}')
    return 0 if passed and not failed and colcon_code == 0 else 1


if __name__ == '__main__':
    sys.exit(main(Path(sys.argv[1]), int(sys.argv[2])))
