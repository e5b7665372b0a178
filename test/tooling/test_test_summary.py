# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The last line of scripts/test and its exit code, which nothing that went wrong may pass."""

from environment.test_summary import main
import pytest


@pytest.fixture
def results(tmp_path):
    def write(tests, failures=0, errors=0, skipped=0):
        file = tmp_path / 'pytest.xml'
        file.write_text(
            f'<testsuites><testsuite tests="{tests}" failures="{failures}" errors="{errors}"'
            f' skipped="{skipped}"/></testsuites>'
        )
        return file

    return write


@pytest.mark.parametrize(
    ('counts', 'line', 'code'),
    [
        ({'tests': 3}, '3 passed, 0 failed', 0),
        ({'tests': 3, 'skipped': 1}, '2 passed, 0 failed, 1 skipped', 0),
        ({'tests': 3, 'failures': 1}, '2 passed, 1 failed', 1),
        ({'tests': 3, 'failures': 1, 'errors': 1}, '1 passed, 2 failed', 1),
        ({'tests': 1, 'errors': 1}, '0 passed, 1 failed', 1),
        ({'tests': 0}, '0 passed, 0 failed', 1),
        ({'tests': 2, 'skipped': 2}, '0 passed, 0 failed, 2 skipped', 1),
    ],
)
def test_line_and_exit_code(results, capsys, counts, line, code):
    assert main(results(**counts), 0) == code
    assert capsys.readouterr().out == f'{line}\n'


def test_why_tests_were_skipped_is_said(tmp_path, capsys):
    file = tmp_path / 'pytest.xml'
    case = '<testcase><skipped type="pytest.skip" message="no chromium"/></testcase>'
    file.write_text(f'<testsuite tests="3" failures="0" errors="0" skipped="2">{case * 2}'
                    '<testcase/></testsuite>')  # fmt: skip
    assert main(file, 0) == 0
    assert capsys.readouterr().out == ('2 not run: no chromium\n1 passed, 0 failed, 2 skipped\n')


def test_flaky_tests_are_named_and_counted_apart(tmp_path, capsys):
    file = tmp_path / 'pytest.xml'
    flaky = '<properties><property name="flaky" value="test/a.py"/></properties>'
    file.write_text(
        '<testsuite tests="3" failures="1"><testcase/>'
        f'<testcase classname="test.a" name="test_it">{flaky}</testcase>'
        f'<testcase>{flaky}<failure/></testcase></testsuite>'
    )
    assert main(file, 0) == 1
    assert capsys.readouterr().out == (
        'flaky, its two logs are in build/tests/flaky/: test.a.test_it\n'
        '1 passed, 1 failed, 1 flaky\n'
    )


def test_failing_colcon_fails(results, capsys):
    assert main(results(3), 1) == 1
    assert capsys.readouterr().out == '3 passed, 0 failed\n'


@pytest.mark.parametrize('text', [None, '<testsuites>'])
def test_no_readable_result_fails(tmp_path, capsys, text):
    file = tmp_path / 'pytest.xml'
    if text:
        file.write_text(text)
    assert main(file, 0) == 1
    first, last = capsys.readouterr().out.splitlines()
    assert first.startswith('scripts/test: no test result: ')
    assert last == '0 passed, 0 failed'
