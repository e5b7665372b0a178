# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Regular expressions as grep -E has them, which is asked for its verdict."""

import subprocess

import pytest

from amr_description.errors import UsageError
from amr_description.sim.ros.entity_services import PosixRegex

NAMES = ['amr', 'amr_1', 'amr_12', 'arm-2', 'Box.3', 'd', 'größe', '']
EXPRESSIONS = [
    'amr', '^amr$', '^a.*[[:digit:]]$', '_[0-9]{2}', '(amr|arm)[-_]', 'a+', '^[[:upper:]]', r'\.',
    '[^a-z_]', 'x*', '^$', 'r|x', '(a)(m)?r',
]  # fmt: skip


@pytest.mark.parametrize('expression', EXPRESSIONS)
def test_it_matches_what_grep_matches(expression):
    grep = subprocess.run(
        ['grep', '-E', '--', expression],
        input=''.join(f'{name}\n' for name in NAMES),
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )
    with PosixRegex(expression) as regex:
        found = [name for name in NAMES if regex.is_in(name)]
    assert found == grep.stdout.split('\n')[:-1]


@pytest.mark.parametrize('expression', ['(', '[a', 'a{2,1}', 'a\\'])
def test_an_invalid_expression_is_rejected_with_the_reason(expression):
    with pytest.raises(UsageError, match='is no POSIX extended regular expression: [A-Z]'):
        PosixRegex(expression)


def test_a_nul_would_end_it_unseen():
    with pytest.raises(UsageError, match='holds a NUL'):
        PosixRegex('a\0b')
