# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Stacks in files of users, in other stacks, and printed."""

import re

from fixtures.bringup.running import install_toys, STACKS
import pytest

from amr_description.bringup import (
    exited_cleanly,
    Group,
    include,
    Node,
    ready,
    Respawn,
    Stack,
)
from amr_description.bringup.command_line import process_specs
from amr_description.bringup.main import listing
from amr_description.bringup.placement import Placement
from amr_description.errors import BringupError, ResourceError, UsageError

CHATTY = STACKS / 'chatty.py'


@pytest.fixture(autouse=True)
def toys(tmp_path, monkeypatch):
    install_toys(tmp_path)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))


def test_arguments_of_an_included_file_are_values_or_as_typed():
    for code, leave in ((3, True), ('3', 'true')):
        stack = include(CHATTY, text='hello', code=code, leave_child=leave)
        assert stack.nodes[0].arguments == [
            '--code', 3, 'hello', '--unfinished', '', '--leave-child',
        ]  # fmt: skip


@pytest.mark.parametrize(
    ('values', 'text'),
    [
        ({'text': 'x', 'cod': 3}, "unknown argument 'cod'; did you mean 'code'"),
        ({'text': 'x', 'code': 1.5}, "code:=1.5: '1.5' is not an integer"),
    ],
)
def test_wrong_arguments_are_refused_by_name(values, text):
    with pytest.raises(UsageError, match=text):
        include(CHATTY, **values)


def test_a_return_value_that_is_no_stack_is_refused(tmp_path):
    with pytest.raises(BringupError, match="missing required argument 'text'"):
        include(CHATTY)
    with pytest.raises(ResourceError, match="'simulaton': no such file: /"):
        include('simulaton')
    (tmp_path / 'nothing.py').write_text('def nothing(): pass')
    with pytest.raises(BringupError, match=r"nothing.py' returned None; a stack's function"):
        include(tmp_path / 'nothing.py')


@pytest.mark.parametrize(
    ('lines', 'text'),
    [
        (['import nomodule'], "ModuleNotFoundError: No module named 'nomodule' (arm.py, line 1)"),
        (['def arm(:'], 'SyntaxError: invalid syntax (arm.py, line 1)'),
        (['def arm():', '    raise ValueError("a\\nb")'], 'ValueError: a b (arm.py, line 2)'),
        (['def arm():', '    return arm()'], 'RecursionError: maximum recursion depth exceeded'),
        (['class arm: pass'], "has no function 'arm' that returns a Stack; known: none"),
        (['def amr(): pass'], "that returns a Stack; did you mean 'amr'? known: amr"),
        (
            ['from amr_description.bringup import Node', 'def arm():', '    Node("a", name=3)'],
            "Node('a', name=3): it takes a name of letters, digits and _ (arm.py, line 3)",
        ),
        (
            ['from amr_description.bringup import include', 'include("mock", viewer=None)'],
            "include('mock', viewer=None): it takes a text, a number, True, False or a path",
        ),
    ],
)
def test_an_error_in_a_file_is_reported_with_its_location(tmp_path, lines, text):
    (tmp_path / 'arm.py').write_text('\n'.join(lines))
    with pytest.raises(BringupError, match=re.escape(text)) as caught:
        include(tmp_path / 'arm.py')
    assert str(caught.value).count('\n') == 0


def test_an_error_is_reported_with_its_innermost_location_only(tmp_path):
    words = 'from amr_description.bringup import include, Stack\n'
    outer = f'{words}\ndef outer():\n    return include({str(tmp_path / "inner.py")!r})\n'
    (tmp_path / 'outer.py').write_text(outer)
    (tmp_path / 'inner.py').write_text(f'{words}def inner():\n    return Stack([])\n')
    with pytest.raises(BringupError, match=r'at least one node \(inner.py, line 3\)$'):
        include(tmp_path / 'outer.py')


def test_a_path_may_have_any_characters(tmp_path):
    with pytest.raises(BringupError, match=r"100%d/arm.py', arm=None\): it takes a text, a num"):
        include(_copy(tmp_path / '100%d'), arm=None)
    assert include(_copy(tmp_path / 'a b'), text='x').nodes[0].executable == 'step'


def _copy(folder):
    folder.mkdir()
    (folder / 'arm.py').write_text(CHATTY.read_text().replace('def chatty', 'def arm'))
    return folder / 'arm.py'


def test_a_file_that_can_have_no_function_of_its_name_is_refused(tmp_path):
    (tmp_path / 'my-arm.py').touch()
    with pytest.raises(BringupError, match="my-arm.py': a stack's file is called as its function"):
        include(tmp_path / 'my-arm.py')


def test_a_stack_that_includes_itself_is_refused(tmp_path):
    for one, other in (('egg', 'hen'), ('hen', 'egg')):
        (tmp_path / f'{one}.py').write_text(
            'from amr_description.bringup import include\n'
            f'def {one}():\n    return include({str(tmp_path / f"{other}.py")!r})\n'
        )
    with pytest.raises(BringupError, match=r"stand in itself: '\S+egg.py' includes '\S+hen.py'"):
        include(tmp_path / 'egg.py')


def test_notes_and_next_steps_of_included_stacks():
    inner = Stack([Node('a')], notes=[('INFO', 'using x')], next_steps='drive')
    other = Stack([Node('b')], notes=[('INFO', 'using x'), ('INFO', 'using y')])
    stack = Stack([Group([inner]), other])
    assert stack.all_notes == [('INFO', 'using x'), ('INFO', 'using y')]
    assert stack.all_next_steps == 'drive'
    assert Stack([stack], next_steps='look').all_next_steps == 'look'


def test_the_tree_is_printed_with_full_names_and_in_words(tmp_path):
    chatty = include(CHATTY, text='hi')
    worker = Node(
        'worker',
        package='toys',
        start_when=ready(chatty),
        required=False,
        respawn=Respawn(limit=2),
        environment={'A': '1'},
    )
    robot = Group([Stack([chatty]), worker], namespace='robot1')
    stack = Stack([robot], ready_when=exited_cleanly(chatty.nodes[0]))
    folder = f'{tmp_path}/lib/toys'
    assert listing(stack, process_specs(stack, tmp_path)).splitlines() == [
        'group robot1:',
        '    stack:',
        '        stack:',
        '            step-1: at once',
        f"                {folder}/step --code 0 hi --unfinished '' --ros-args -r __ns:=/robot1",
        '    worker-2: when step-1 was started, optional, started again up to 2 times',
        f'        {folder}/worker --ros-args -r __ns:=/robot1',
        '        A=1',
        'ready: when step-1 exited with code 0',
    ]


def test_ready_made_stacks_can_be_included(tmp_path):
    (tmp_path / 'share/ament_index/resource_index/packages/amr_description').touch()
    root = STACKS.parents[3]
    files = {'urdf': root / 'urdf/amr.urdf', 'controllers': root / 'config/controllers.yaml'}
    stack = Stack([Group([include('mock', **files)], namespace='robot1')])
    assert {resolved.namespace for resolved in Placement(stack).nodes} == {'/robot1'}
