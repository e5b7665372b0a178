# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/stacks.md: its stack comes up, its other code runs, its words are true."""

import ast
import os
import re
import signal

from fixtures.bringup.running import Bringup
import pytest
from support.doc_pages import Page, ROOT

from amr_description import bringup
from amr_description.bringup import Exited, exited_cleanly, Shutdown, topic
from amr_description.bringup.conditions import walk
from amr_description.bringup.description import DEFAULT_TIMEOUT, nodes_of
from amr_description.bringup.placement import Placement
from amr_description.bringup.scheduler import TIMED_OUT
from amr_description.bringup.stack_files import make_stack

PAGE = Page('stacks.md')
MY_ARM, MY_DRIVER, MY_LAB = PAGE.blocks('python')
ARM_YAML = Page('test_your_robot.md').blocks('yaml')[0]


@pytest.fixture
def folder(tmp_path):
    """The reader's folder."""
    (tmp_path / 'arm.urdf').write_text((ROOT / 'test/fixtures/sim/arm.urdf').read_text())
    (tmp_path / 'arm.yaml').write_text(ARM_YAML)
    for name, text in (('my_arm', MY_ARM), ('my_driver', MY_DRIVER), ('my_lab', MY_LAB)):
        (tmp_path / f'{name}.py').write_text(text)
    return tmp_path


def test_a_stack_for_another_robot_takes_ten_lines():
    (function,) = (node for node in ast.parse(MY_ARM).body if isinstance(node, ast.FunctionDef))
    assert function.end_lineno - function.lineno <= 10


def test_the_other_robot_comes_up_and_what_stands_beside_it(folder):
    prefixes = {'AMENT_PREFIX_PATH': os.environ['AMENT_PREFIX_PATH']}
    with Bringup(folder, str(folder / 'my_lab.py'), 'rtf:=0', **prefixes) as up:
        for step in ('create-3', 'spawner-4'):
            up.expect(rf'\[{step}\]: process has finished cleanly')
        up.expect('ready in')
        up.expect(r'\[listener-6\].* I heard: "Hello World')
        assert up.end(signal.SIGINT) == 0
        assert up.left() == []


def test_the_driver_has_its_fallback(folder):
    stack = make_stack(str(folder / 'my_driver.py'), {})
    driver, fallback = nodes_of(stack.nodes)
    assert driver.on_exit(Exited(driver, 0)) is None
    assert driver.on_exit(Exited(driver, 1)) is fallback
    assert driver.on_exit(Exited(driver, 3)) == Shutdown('the battery is empty')


@pytest.mark.parametrize(('listen', 'count'), [('true', 2), ('false', 1)])
def test_the_lab_is_in_its_namespace(folder, listen, count):
    stack = make_stack(str(folder / 'my_lab.py'), {'listen': listen})
    *arm, _ = nodes = Placement(stack).nodes
    assert [each.namespace for each in nodes] == 4 * [None] + count * ['/lab']
    waits = {leaf for each in nodes[4:] for leaf in walk(each.start_when)}
    assert exited_cleanly(arm[3].node) in waits
    assert (topic('/lab/topic') in waits) == (count == 2)


def test_what_the_page_names_is_there():
    assert PAGE.is_sound()
    table = re.findall(r'^\| (.*?) \|', PAGE.text, re.MULTILINE)[1:]
    names = {name for row in table for name in re.findall(r'`(\w+)\(', row)}
    assert len(names) == 14
    assert names <= set(bringup.__all__)
    assert f'After {DEFAULT_TIMEOUT:.0f} seconds' in PAGE.text
    assert f'exit code {TIMED_OUT}' in PAGE.text
