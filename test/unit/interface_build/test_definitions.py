# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of .msg, .srv and .action files: where they are, what was found, what would do."""

from pathlib import Path

import pytest

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build.definitions import check_package, read_definition
from amr_description.interface_build.packages import InterfacePackage

MESSAGE, SERVICE, ACTION = Path('msg/A.msg'), Path('srv/A.srv'), Path('action/A.action')
KNOWN = {'std_msgs': {'Header', 'String'}, 'geometry_msgs': {'Point', 'Pose'}}
GOOD = """\
# A comment, with letters of anywhere: …
int32 a
uint8 FIRST=1   # a constant
string<=5 text "abc"
float64[3] three [1, 2, 3]
int32[<=4] most
byte[]\tblob  # a tab
Point2 other
geometry_msgs/Point[] points
string NAME="a b"
"""


def faults(text, path=MESSAGE):
    return [tuple(each) for each in read_definition(text, path).faults]


def test_a_good_file_has_no_faults():
    definition = read_definition(GOOD, MESSAGE)
    assert definition.faults == []
    found = [(each.line, each.package, each.name) for each in definition.references]
    assert found == [(8, '', 'Point2'), (9, 'geometry_msgs', 'Point')]
    assert faults('int8 a\n---\n---\n', ACTION) == faults('---\n', SERVICE) == []


@pytest.mark.parametrize(
    ('text', 'line', 'column', 'said'),
    [
        ('int8 a\nflaot64 b\n', 2, 1, "unknown type 'flaot64'; did you mean float64?"),
        ('int b\n', 1, 1, "no type 'int'; its name is int32 here"),
        ('time b\n', 1, 1, "no type 'time'; its name is builtin_interfaces/Time here"),
        ('std_msgs/msg/String b\n', 1, 1, "'std_msgs/msg/String' is written std_msgs/String"),
        ('a/b/c b\n', 1, 1, "'a/b/c' is no type"),
        ('int8[0] b\n', 1, 1, "'int8[0]' is no array: want int8[], [3] or [<=3]"),
        ('int8] b\n', 1, 1, "'int8]' ends with ] and has no ["),
        ('string<=x b\n', 1, 1, "'string<=x' is no bounded type"),
        ('\nint8\n', 2, 5, "'int8' without a name"),
        ('int8  myValue\n', 1, 7, "'myValue' is no name of a field"),
        ('int8 myValue\n', 1, 6, ', my_value'),
        ('int8 class\n', 1, 6, "'class' is a word of Python"),
        ('int8 a\nint16 a # again\n', 2, 7, "'a' stands here twice"),
        ('int8 a=1\n', 1, 6, "'a' is no name of a constant"),
        ('Pose A=1\n', 1, 6, "a constant is of a primitive type, not of 'Pose'"),
        ('uint8 A = 256\n', 1, 11, "value '256' can not be converted"),
        ('uint8 a   1.5\n', 1, 11, "value '1.5' can not be converted"),
        ('int8[2] a [1]\n', 1, 11, 'exactly 2 elements, not 1'),
        (' int8 a\n', 1, 1, 'a line may not begin with a space'),
        ('int8 a\n---\n', 2, 1, '--- is for .srv and .action files'),
        ('int8 a # C:\\users\n', 1, 12, 'rosidl cannot read the backslash'),
    ],
)
def test_a_fault_has_its_place_and_the_way_out(text, line, column, said):
    ((at, place, found),) = faults(text)
    assert (at, place) == (line, column)
    assert said in found
    assert '\n' not in found


@pytest.mark.parametrize(
    ('text', 'path', 'line', 'said'),
    [
        (
            'int8 a\n',
            SERVICE,
            1,
            'between request and response there must be a line ---, got none',
        ),
        ('int8 a\n--- \nint8 b\n', SERVICE, 2, "is '---' alone, got '--- '"),
        ('---\n---\n', SERVICE, 2, 'one --- too many: a .srv file has request and response only'),
        ('int8 a\n---\n', ACTION, 2, 'there must be 2 lines ---, got 1'),
        ('int8 a\n', Path('msg/my_type.msg'), 1, 'call it MyType.msg'),
    ],
)
def test_parts_and_names_of_files(text, path, line, said):
    found = [each for each in faults(text, path) if said in each[2]]
    assert [each[0] for each in found] == [line]


@pytest.fixture
def package(tmp_path):
    """A function that writes definitions and checks them: faults as text, and what they use."""

    def check(listed=None, **texts):
        for name, text in texts.items():
            (tmp_path / 'msg').mkdir(exist_ok=True)
            (tmp_path / f'msg/{name}.msg').write_text(text)
        paths = tuple(Path(f'msg/{name}.msg') for name in listed or texts)
        found = check_package(InterfacePackage('my_msgs', tmp_path, frozenset(), paths), KNOWN)
        return [str(each) for each in found.faults], found

    return check


def test_messages_of_others_are_looked_up(package):
    said, check = package(A='std_msgs/Header h\nB b\nmy_msgs/B c\n', B='geometry_msgs/Point p\n')
    assert said == []
    assert check.used == {('std_msgs', 'Header'), ('geometry_msgs', 'Point')}


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('std_msgs/Headr h', "msg/A.msg:1:1: std_msgs has no message 'Headr'; did you mean "
         'Header?'),
        ('std_msg/Header h', "msg/A.msg:1:1: no package 'std_msg' with messages is installed; "
         'did you mean std_msgs?'),
        ('foo/Bar h', "msg/A.msg:1:1: no package 'foo' with messages is installed; if it is in "
         'this workspace, package.xml needs <depend>foo</depend>'),
        ('Bb b', "msg/A.msg:1:1: this package has no message 'Bb'"),
        ('A a', 'msg/A.msg:1:1: messages contain each other: A -> A'),
    ],
)  # fmt: skip
def test_messages_that_are_not_there(package, text, said):
    (found,), check = package(A=f'{text}\n')
    assert found == said
    with pytest.raises(InterfaceBuildError, match='^/src/msg/A.msg:1:1: '):
        check.raise_faults(Path('/src'))


def test_a_file_that_the_rules_do_not_name(package):
    (said,), _ = package(['A'], A='B b\n', B='int8 b\n')
    assert 'msg/B.msg is there, and CMakeLists.txt does not name it' in said


def test_bytes_that_are_no_text(package, tmp_path):
    package(A='')
    (tmp_path / 'msg/A.msg').write_bytes(b'int8 a\n# \xff\n')
    (said,), _ = package(['A'])
    assert said.startswith("msg/A.msg:2:3: 'utf-8' codec can't decode byte 0xff")
