# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 interface``: the expansion of definitions, and what the index tells."""

import re
import signal

from fixtures.cli.commands import ros2, shell, started
import pytest
from support.paths import ROOT

from amr_description.cli.interface.definition import (
    Comments,
    expand,
    InterfaceText,
    message_type_of,
)
from amr_description.cli.interface.index import all_interfaces, interfaces_of, read_definition
from amr_description.errors import AmrError

OUTER = """\
# An outer one.

Inner  inner  # what it holds
other_msgs/Leaf[<=3] leaves
             # and the note goes on
int8 LIMIT=3 # a constant

#
string<=5 name "x" # a default"""
INNER = '# An inner one.\nLeaf leaf\n\nbool[2] flags # both\n'
LEAF = 'float64 x # m'
DEFINITIONS = {
    'toy_msgs/msg/Outer': OUTER,
    'toy_msgs/msg/Inner': INNER,
    'toy_msgs/msg/Leaf': 'char c\n',
    'other_msgs/msg/Leaf': LEAF,
    'toy_msgs/srv/Ask': 'Leaf question\n---\nuint8 YES=1\nuint8 answer',
    'toy_msgs/msg/Ring': 'Ring[] next',
}


def expanded(name, **comments):
    def read(name):
        return InterfaceText(DEFINITIONS[name])

    return list(expand(name, read, Comments(**comments)))


def test_comments_are_shown_at_the_top_only():
    assert expanded('toy_msgs/msg/Outer') == [
        '# An outer one.',
        '',
        'Inner  inner  # what it holds',
        '\tLeaf leaf',
        '\t\tchar c',
        '\tbool[2] flags',
        'other_msgs/Leaf[<=3] leaves',
        '\tfloat64 x',
        '             # and the note goes on',
        'int8 LIMIT=3 # a constant',
        '',
        '#',
        'string<=5 name "x" # a default',
    ]


def test_comments_can_be_shown_nowhere():
    assert expanded('toy_msgs/msg/Outer', at_top=False) == [
        'Inner  inner',
        '\tLeaf leaf',
        '\t\tchar c',
        '\tbool[2] flags',
        'other_msgs/Leaf[<=3] leaves',
        '\tfloat64 x',
        'int8 LIMIT=3',
        'string<=5 name "x"',
    ]


def test_comments_can_be_shown_everywhere():
    assert expanded('toy_msgs/msg/Inner', below=True) == [
        '# An inner one.',
        'Leaf leaf',
        '\tchar c',
        '',
        'bool[2] flags # both',
    ]
    lines = expanded('toy_msgs/msg/Outer', below=True)
    assert [line for line in lines if line.startswith('\t')] == [
        '\t# An inner one.',
        '\tLeaf leaf',
        '\t\tchar c',
        '\tbool[2] flags # both',
        '\tfloat64 x # m',
    ]


def test_both_parts_of_a_service_are_expanded():
    assert expanded('toy_msgs/srv/Ask') == [
        'Leaf question',
        '\tchar c',
        '---',
        'uint8 YES=1',
        'uint8 answer',
    ]


def test_a_message_in_itself_is_an_error_and_no_loop():
    with pytest.raises(AmrError, match='The definition of toy_msgs/msg/Ring contains itself'):
        expanded('toy_msgs/msg/Ring')


def test_idl_is_shown_as_it_stands():
    text = 'module toy_msgs {\n  // comment\n#include "x.idl"\nLeaf leaf;\n};'
    lines = list(
        expand('toy_msgs/msg/X', lambda _: InterfaceText(text, idl=True), Comments(False))
    )
    assert lines == text.splitlines()


@pytest.mark.parametrize(
    ('line', 'found'),
    [
        ('Pose pose', 'toy_msgs/msg/Pose'),
        ('std_msgs/Header header', 'std_msgs/msg/Header'),
        ('Pose[] poses', 'toy_msgs/msg/Pose'),
        ('Pose[<=4] poses', 'toy_msgs/msg/Pose'),
        ('Pose[4]\tposes', 'toy_msgs/msg/Pose'),
        ('float64 x', None),
        ('string<=5 s', None),
        ('uint8 LIMIT=3', None),
        ('# Pose pose', None),
        ('---', None),
        ('', None),
        ('Pose', None),
    ],
)
def test_fields_of_messages_are_recognised(line, found):
    assert message_type_of(line, 'toy_msgs') == found


@pytest.mark.long
def test_every_definition_that_is_installed_can_be_shown():
    shown = 0
    for package, names in all_interfaces().items():
        for name in names:
            lines = list(expand(f'{package}/{name}', read_definition, Comments(at_top=False)))
            assert not any('#' in line or not line for line in lines)
            shown += bool(lines)
    assert shown > 150


@pytest.mark.parametrize(
    'name',
    [
        'tf2_msgs/msg/TFMessage',
        'controller_manager_msgs/srv/SwitchController',
        'simulation_interfaces/action/SimulateSteps',
    ],
)
def test_packages_that_we_compile_are_shown_too(name):
    source = ROOT / 'interfaces' / f'{name}.{name.split("/")[1]}'
    assert read_definition(name) == InterfaceText(source.read_text())
    assert name.partition('/')[2] in interfaces_of(name.partition('/')[0])


@pytest.mark.parametrize('kind', ['msg', 'srv', 'action'])
def test_each_kind_is_listed_by_its_flag(kind):
    flag = f'-{kind[0]}'
    listed = ros2('interface', 'list', flag).stdout.splitlines()[1:]
    assert listed == sorted(listed)
    assert all(line.split('/')[1] == kind for line in listed)
    packages = ros2('interface', 'packages', flag).stdout.splitlines()
    assert packages == sorted({line.strip().partition('/')[0] for line in listed})
    lines = ros2('interface', 'package', 'tf2_msgs', flag).stdout.splitlines()
    assert lines == [line.strip() for line in listed if line.startswith('    tf2_msgs/')] != []


def test_a_package_without_interfaces_has_none():
    result = ros2('interface', 'package', 'rclpy')
    assert (result.returncode, result.stdout, result.stderr) == (0, '', '')


@pytest.mark.parametrize(
    ('name', 'said'),
    [
        ('std_msgs/String', "separated by '/'; did you mean std_msgs/msg/String?"),
        ('std_msgs/msg/Sting', "Sting.idl'; did you mean std_msgs/msg/String?"),
        ('std_msg/msg/String', "Unknown package 'std_msg'; did you mean std_msgs"),
        ('std_msgs/mgs/String', 'Expected its second part to be one of msg, srv, action'),
        ('../std_msgs/msg/String', 'Expected three parts'),
        ('../msg/String', "Unknown package '..'"),
        ('two words', 'Expected three parts'),
        ('\udcff/msg/\udcff', r"Unknown package '\udcff'"),
        ('{' * 100_000, 'Expected three parts'),
    ],
)
def test_what_is_not_there_is_told_in_one_line(name, said):
    with pytest.raises(AmrError, match=re.escape(said)) as error:
        list(expand(name, read_definition))
    assert len(str(error.value)) < 500
    assert '\n' not in str(error.value)


@pytest.mark.parametrize(
    ('source', 'code', 'said'),
    [
        ('printf "std_msgs/msg/Bool\\nmore\\n"', 0, 'bool data'),
        ('true', 2, 'the passed value is empty'),
        ("printf '\\xff\\n'", 1, 'Invalid name'),
    ],
)
def test_the_name_may_come_from_a_pipe(source, code, said, tmp_path):
    result = shell(f'{source} | ros2 interface show -', tmp_path)
    assert result.returncode == code
    assert said in result.stdout + result.stderr
    assert result.stderr.count('\n') == (1 if code else 0)


def test_a_terminal_is_no_pipe():
    with started('interface', 'show', '-', terminal=True) as program:
        program.expect('expected stdin pipe')
        assert program.end() == 2


def test_the_prototype_of_an_action_is_its_goal():
    result = ros2('interface', 'proto', 'simulation_interfaces/action/SimulateSteps')
    assert (result.returncode, result.stdout) == (0, '"steps: 0\n"\n')


@pytest.mark.parametrize(
    ('name', 'said'),
    [
        ('std_msgs/String', 'did you mean std_msgs/msg/String?'),
        ('std_msgs/msg/Sting', 'did you mean String?'),
        ('std_srvs/srv/Trigge', 'did you mean Trigger?'),
        ('std_msgs/foo/String', 'one of msg, srv, action'),
    ],
)
def test_a_prototype_of_nothing_is_told_in_one_line(name, said):
    result = ros2('interface', 'proto', name)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.endswith(f'{said}\n')
    assert result.stderr.count('\n') == 1


def test_a_reader_may_leave(tmp_path):
    result = shell('ros2 interface list | head -1; echo ${PIPESTATUS[0]}', tmp_path)
    first, status = result.stdout.splitlines()
    assert (first, result.stderr) == ('Messages:', '')
    assert int(status) in (0, 128 + signal.SIGPIPE)  # 0: it was done before head left


def test_an_index_that_is_not_there_is_told():
    result = ros2('interface', 'show', 'std_msgs/msg/Bool', AMENT_PREFIX_PATH='')
    assert result.returncode == 1
    assert result.stderr == "Unknown package 'std_msgs'; source scripts/activate first\n"
    assert ros2('interface', 'packages', AMENT_PREFIX_PATH='').stdout == ''
