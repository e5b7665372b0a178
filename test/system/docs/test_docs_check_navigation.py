# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/nav2.md, "What Nav2 and slam_toolbox demand": typed, and the tables are true."""

import re

import pytest
from support import shells
from support.doc_pages import Page
from support.shells import line_of

from amr_description.navigation.contract.rules import RULES
from amr_description.nodes.check_navigation import parser

CHAPTERS = dict(
    re.findall(r'^## (.*?)\n(.*?)(?=^## |\Z)', Page('nav2.md').text, re.DOTALL | re.MULTILINE)
)
STACK = re.search(
    r'^## The stack `navigation`$.*?(?=^## )', Page('navigation.md').text, re.DOTALL | re.MULTILINE
)[0]
DEMANDS = CHAPTERS['What Nav2 and slam_toolbox demand']
LINES = re.search(r'^```bash\n(.*?)^```$', DEMANDS, re.DOTALL | re.MULTILINE)[1].splitlines()


@pytest.mark.long  # as system/navigation/test_check_navigation.py, but typed
def test_what_is_typed_beside_the_stack(tmp_path):
    """Whether real time is kept, the machine says; so its exit code may be 1."""
    book = 'source scripts/activate\n'
    plain, driving = LINES
    with (
        shells.newcomer(f'{book}{STACK}', tmp_path) as robot,
        shells.newcomer(f'{book}{DEMANDS}', tmp_path) as shell,
    ):
        robot.type(line_of(STACK, 'scripts/run navigation'))
        robot.see(r'ready in \d+\.\d s')
        shell.type(plain)
        shell.see(r'passed +scan\.length')
        shell.see(rf'{len(RULES)} demands in')
        shell.see(re.escape(shells.PROMPT))
        shell.type(driving)
        shell.see('driving: about a metre ahead at 0.5 m/s')
        shell.see('"name": "drive.linear",\\s+"verdict": "passed"')
        shell.see(re.escape(shells.PROMPT))
        robot.interrupt()


def test_every_option_is_in_the_table():
    options = {word for action in parser()._actions for word in action.option_strings}
    assert {*re.findall(r'`(--[a-z-]+)`', DEMANDS)} >= {
        each for each in options if each.startswith('--') and each not in ('--help', '--duration')
    }
    assert '`--duration` (10 s)' in DEMANDS
