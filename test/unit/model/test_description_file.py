# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A URDF is read as it stands, a xacro file expanded; whatever is wrong with it is one line."""

import os
from pathlib import Path
import subprocess
import sys

from ament_index_python.packages import get_package_share_directory
import pytest
from support.paths import ROOT

from amr_description.errors import DescriptionError, UsageError
from amr_description.model.checks import check, require_sound
from amr_description.model.description_file import (
    description_at,
    description_text,
    located_text,
    mappings_of,
    takes_arguments,
)
from amr_description.model.origins import (
    files_in,
    line_from,
    Origin,
    origin_of,
    with_file,
    with_origins,
)
from amr_description.model.urdf import load, parse
from amr_description.model.xacro_markup import is_xacro

GRIPPER = ROOT / 'test/fixtures/urdf/gripper.urdf.xacro'


def robot(*words):
    return parse(description_text(GRIPPER, mappings_of(words)))


def load_robot(path):
    return parse(description_text(path))


def text_of(folder, body, name='robot.urdf.xacro', **mappings):
    """Expand a robot with this in it."""
    path = folder / name
    namespace = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    path.write_text(f'<robot name="test" {namespace}>{body}</robot>')
    return description_text(path, mappings)


def test_a_urdf_is_read_as_it_stands():
    path = ROOT / 'urdf/amr.urdf'
    assert description_text(path) == path.read_text() == load(path).text


@pytest.mark.parametrize(
    ('inside', 'expected'),
    [
        ('', False),
        ('<link name="a"/>', False),
        ('<!-- <xacro:wheel/> $(find a) -->', False),
        ('<a b="$(var x) $(find-pkg-share y) $x"/>', False),
        ('<xacro:wheel xmlns:xacro="x"/>', True),
        ('<link name="$(arg prefix)a"/>', True),
        ('<parameters>$(find amr_description)/config/x.yaml</parameters>', True),
    ],
)
def test_what_is_in_a_file_says_whether_it_is_xacro(tmp_path, inside, expected):
    path = tmp_path / 'robot.urdf'
    path.write_text(f'<robot name="r">{inside}</robot>')
    assert is_xacro(path) is expected
    path.write_text(f'<robot name="r"\nxmlns:xacro="http://ros.org/wiki/xacro">{inside}</robot>')
    assert is_xacro(path)
    assert not is_xacro(tmp_path / 'nowhere.urdf')


def test_xacro_in_a_file_called_urdf_is_expanded(tmp_path):
    body = '<xacro:arg name="a" default="1"/><link name="link$(arg a)"/>'
    assert 'link2' in text_of(tmp_path, body, 'robot.urdf', a='2')
    uri = f'{tmp_path / "robot.urdf"}?a=3'
    assert 'link3' in description_at(uri, warn=pytest.fail)
    assert takes_arguments(uri)
    assert not takes_arguments(str(ROOT / 'urdf/amr.urdf'))
    assert not takes_arguments('package://no_such_package/a.urdf')


def test_a_plain_urdf_may_be_called_xacro(tmp_path):
    path = tmp_path / 'robot.xacro'
    path.write_text((ROOT / 'urdf/amr.urdf').read_text())
    found, plain = load_robot(path), load(ROOT / 'urdf/amr.urdf')
    assert [link.name for link in found.links] == [link.name for link in plain.links]
    assert [joint.origin for joint in found.joints] == [joint.origin for joint in plain.joints]


def test_a_package_that_is_not_there_is_left_to_who_needs_it(tmp_path):
    path = tmp_path / 'robot.urdf'
    path.write_text('<robot name="r"><gazebo>$(find no_such_package)/a</gazebo></robot>')
    said = []
    assert description_text(path, warn=said.append) == path.read_text()
    assert len(said) == 1
    assert "package 'no_such_package' not found" in said[0]
    assert said[0].endswith('; what it stands in is left as it is')


def test_includes_macros_properties_and_defaults_are_expanded():
    found = robot()
    assert [link.name for link in found.links] == [
        'base', 'hand', 'palm', 'left_finger', 'left_tip', 'right_finger', 'right_tip',
    ]  # fmt: skip
    joints = {joint.name: joint for joint in found.joints}
    assert joints['left_tip'].origin.translation == (0.0, 0.0, 0.08)
    assert joints['right_knuckle'].mimic.joint == 'left_knuckle'
    assert joints['left_knuckle'].mimic is None
    assert joints['left_knuckle'].limit.lower == pytest.approx(-0.1)


def test_arguments_decide_values_and_conditions():
    found = robot('finger_length:=0.2', 'palm:=true', 'palm:=false')
    assert 'palm' not in [link.name for link in found.links]
    (tip,) = [joint for joint in found.joints if joint.name == 'right_tip']
    assert tip.origin.translation == (0.0, 0.0, 0.2)


def test_one_expansion_leaves_nothing_to_the_next(tmp_path):
    body = '<xacro:arg name="a" default="1"/><link name="link$(arg a)"/>'
    assert 'link2' in text_of(tmp_path, body, a='2')
    with pytest.raises(DescriptionError, match='Undefined substitution argument b'):
        text_of(tmp_path, body + '<link name="$(arg b)"/>', a='3')
    assert 'link1' in text_of(tmp_path, body)


def test_find_looks_into_the_ament_index(tmp_path):
    share = get_package_share_directory('amr_description')
    text = text_of(tmp_path, '<xacro:include filename="$(find amr_description)/urdf/amr.urdf"/>')
    assert parse(text).root.name == 'base_footprint'
    assert share in text_of(tmp_path, '<link name="$(find amr_description)"/>')


@pytest.mark.parametrize(
    ('body', 'words'),
    [
        (
            '\n<link\nname="${nope}"/>',
            "robot.urdf.xacro:2: NameError: name 'nope' is not defined when",
        ),
        ('<link name="${1/0}"/>', "division by zero when evaluating expression '1/0'"),
        (
            '\n\n<link name="$(find no_such_package)"/>',
            "robot.urdf.xacro:3: package 'no_such_package' not found in AMENT_PREFIX_PATH; build "
            'it and source install/setup.bash of its workspace, or correct the name',
        ),
        (
            '<link name="$(find amr_descripton)"/>',
            "package 'amr_descripton' not found .*; did you mean amr_description",
        ),
        ('\n<xacro:nope/>', 'robot.urdf.xacro:2: unknown macro name: xacro:nope'),
        ('\n<xacro:if value="maybe"/>', 'robot.urdf.xacro:2: .* is not a boolean expression'),
        ('<xacro:include filename="nowhere.xacro"/>', r'No such file or directory: \S+nowhere'),
        ('<xacro:include filename="robot.urdf.xacro"/>', 'does a macro or an include contain'),
        (
            '\n<link>',
            'robot.urdf.xacro:2: not well-formed XML: </robot> stands where <link> of line 2 is '
            'still open; write </link> before it, or <link …/>',
        ),
        (
            '<xacro:property name="wheel_radius" value="1"/><link name="${weel_radius}"/>',
            "name 'weel_radius' is not defined .*; did you mean wheel_radius",
        ),
        (
            '<xacro:macro name="wheel" params="side"/><xacro:weel/>',
            'unknown macro name: xacro:weel; did you mean xacro:wheel',
        ),
        (
            '<xacro:macro name="wheel" params="side"/>\n<xacro:wheel/>',
            r'robot.urdf.xacro:2: Undefined parameters \[side\]; give side="…" where the macro is',
        ),
        (
            '<xacro:macro name="wheel" params="side"/>\n<xacro:wheel sid="a"/>',
            'robot.urdf.xacro:2: Invalid parameter "sid"; did you mean side',
        ),
        (
            "<!-- none -->\n<link>\n ${xacro.load_yaml('no.yaml')}</link>",
            r'robot.urdf.xacro:2: FileNotFoundError: .*no.yaml',
        ),
        ('${__import__}', r'Use of invalid name\(s\): __import__'),
    ],
)
def test_what_cannot_be_expanded_is_one_line_with_the_file(tmp_path, body, words):
    with pytest.raises(DescriptionError, match=words) as caught:
        text_of(tmp_path, body)
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 400 + 8 * len(str(tmp_path))


def test_the_macros_above_a_fault_are_reported(tmp_path):
    inner = (
        '<xacro:macro name="outer" params=""><xacro:inner/></xacro:macro>'
        '<xacro:macro name="inner" params=""><link name="${gone}"/></xacro:macro>'
        '<xacro:outer/>'
    )
    with pytest.raises(DescriptionError):
        text_of(tmp_path, inner, 'parts.xacro')
    with pytest.raises(DescriptionError, match=r'parts.xacro:1: NameError: .*gone') as caught:
        text_of(tmp_path, '<xacro:include filename="parts.xacro"/>')
    way = (
        f'(in macro "inner", called by "outer", called at {tmp_path}/parts.xacro:1, '
        f'included from {tmp_path}/robot.urdf.xacro)'
    )
    assert str(caught.value).endswith(way)


def test_entity_bombs_and_missing_and_binary_files_end(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a long path would be shortened in the message
    bomb = '<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa">'
    for one, next_one in zip('abcdefgh', 'bcdefghi', strict=True):
        bomb += f'<!ENTITY {next_one} "{f"&{one};" * 20}">'
    path = tmp_path / 'bomb.xacro'
    path.write_text(f'{bomb}]><robot name="&i;"/>')
    with pytest.raises(DescriptionError, match=r'bomb.xacro:1: .*amplification'):
        description_text(path)
    with pytest.raises(DescriptionError, match='cannot read the description .*gone.xacro'):
        description_text('gone.xacro')
    path.write_bytes(b'\xff\xfe')
    with pytest.raises(DescriptionError, match=r'bomb.xacro:1: byte 0 is not UTF-8'):
        description_text(path)


def test_unused_arguments_are_reported():
    said = []
    description_text(GRIPPER, {'finger_lenght': '1', 'palm': 'true'}, warn=said.append)
    assert said == [
        f'{GRIPPER}: nothing asks for "finger_lenght"; its arguments: "finger_length", "palm"'
    ]


def test_arguments_that_are_declared_but_not_used_are_none_of_these(tmp_path):
    said = []
    path = tmp_path / 'cart.xacro'
    arg = '<xacro:arg name="later" default="1"/>'
    path.write_text(f'<robot name="x" xmlns:xacro="http://ros.org/wiki/xacro">{arg}</robot>')
    description_text(path, {'later': '2'}, warn=said.append)
    assert said == []


def test_arguments_of_a_plain_urdf_are_refused():
    with pytest.raises(DescriptionError, match=r'amr.urdf: takes no arguments \(a:=…\)'):
        description_text(ROOT / 'urdf/amr.urdf', {'a': '1'})


@pytest.mark.parametrize('word', ['a', ':=1', 'a=1', ' :=1'])
def test_words_that_are_no_arguments_are_refused(word):
    with pytest.raises(UsageError, match='write name:=value'):
        mappings_of([word])


def test_values_may_be_empty_and_hold_anything():
    assert mappings_of(['a:=', 'b:=x:=y', 'c:= z ']) == {'a': '', 'b': 'x:=y', 'c': 'z'}


WHEEL = """\
<robot name="parts" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <!-- Lines of comments, properties and macros are not in the expanded text. -->
  <xacro:property name="radius" value="0.1"/>
  <xacro:macro name="wheel" params="side">
    <link name="wheel_${side}"/>
    <joint name="joint_${side}"
           type="continous">
      <parent link="base"/>
      <child link="wheel_${side}"/>
    </joint>
  </xacro:macro>
</robot>
"""


def test_findings_name_lines_of_the_files_that_a_person_edits(tmp_path):
    parts, main = tmp_path / 'parts.xacro', tmp_path / 'robot.urdf.xacro'
    parts.write_text(WHEEL)
    main.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '<xacro:include filename="parts.xacro"/>\n'
        '<link name="base"/>\n\n\n'
        '<xacro:wheel side="left"/> <xacro:wheel side="right"/>\n'
        '<joint name="arm" type="revolut"><parent link="base"/><child link="base"/></joint>\n'
        '</robot>\n'
    )
    findings = [str(each) for each in check(located_text(main), str(main))]
    wheels = [each for each in findings if each.startswith(f'error: {parts}:6: joint "joint_')]
    assert len(wheels) == 2
    assert all(each.endswith(f'(in macro "wheel", called at {main}:6)') for each in wheels)
    assert any(each.startswith(f'error: {main}:7: joint "arm"') for each in findings)
    assert not any('expanded' in each for each in findings)
    with pytest.raises(DescriptionError, match=f'^{parts}:6: joint "joint_left"'):
        parse(located_text(main), 'robot_description')


def test_origins_travel_with_the_text():
    text = '<robot name="r">\n<link name="a"/>\n<!-- -->\n</robot>'
    named = with_file(text, '/a b/--r.urdf')
    assert named.startswith(text)
    assert parse(named).name == 'r'
    assert origin_of(named, 3) == Origin('/a b/--r.urdf', 3)
    assert origin_of(text, 3) is None
    origins = {
        1: Origin('r.xacro', 1),
        2: Origin('a|b.xacro', 7, 'wheel', ('c.xacro', 20)),
        3: Origin('r.xacro', 9),
    }
    located = with_origins(with_file(text, 'other'), origins)
    assert parse(located).name == 'r'
    assert [origin_of(located, line) for line in (1, 2, 3, 4)] == [*origins.values(), origins[3]]
    assert located.count('<!-- from') == 1
    assert [line_from(named, '/a b/--r.urdf', 3), line_from(named, 'other', 3)] == [3, None]
    assert [line_from(located, each.file, each.line) for each in origins.values()] == [1, 2, 3]
    assert line_from(located, 'r.xacro', 2) is None
    assert files_in(located) == ['r.xacro', 'a|b.xacro', 'c.xacro']


@pytest.mark.parametrize('rows', ['1', '1:2:3:4:5:6', '::::: 1', 'x'])
def test_a_comment_that_only_looks_like_it_is_none(rows):
    assert origin_of(f'<robot/>\n<!-- from: a.xacro | | {rows} -->\n', 1) is None


def test_descriptions_that_are_passed_on_name_their_file(tmp_path):
    path = tmp_path / 'r.urdf'
    path.write_text('<robot name="r">\n<link name="a"/>\n<link name="a"/>\n</robot>\n')
    text = description_at(str(path), warn=print)
    with pytest.raises(DescriptionError, match=f'^{path}:3: link "a" is not unique'):
        parse(text, 'amr')
    with pytest.raises(DescriptionError, match=f'^{path}:3: link "a" is not unique'):
        require_sound(text, 'amr')


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def test_as_a_program_it_prints_text_or_one_line():
    program = (sys.executable, '-m', 'amr_description.model.description_file')
    done = run(*program, GRIPPER, 'palm:=false')
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout == located_text(GRIPPER, {'palm': 'false'})
    assert done.stdout.startswith(description_text(GRIPPER, {'palm': 'false'}))
    done = run(*program, GRIPPER, 'palm:=perhaps')
    assert done.returncode == 1
    assert len(done.stderr.splitlines()) == 1
    assert 'perhaps' in done.stderr


def test_the_command_xacro_prints_the_same():
    xacro = Path(sys.prefix, 'bin/xacro')
    if not xacro.exists():  # the distribution's ROS
        xacro = Path(os.environ['AMENT_PREFIX_PATH'].split(os.pathsep)[-1], 'bin/xacro')
    done = run(xacro, GRIPPER, 'finger_length:=0.3')
    assert done.returncode == 0
    assert done.stdout == description_text(GRIPPER, {'finger_length': '0.3'})


def test_a_package_that_is_not_installed_is_found_around_a_xacro_file(tmp_path, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path / 'nothing'))
    folder = tmp_path / 'my_robot' / 'urdf'
    folder.mkdir(parents=True)
    (folder / 'parts.xacro').write_text('<robot><link name="part"/></robot>')
    include = '<xacro:include filename="$(find my_robot)/urdf/parts.xacro"/>'
    assert 'name="part"' in text_of(folder, include)
    with pytest.raises(DescriptionError, match="package 'other' not found"):
        text_of(folder, include.replace('my_robot', 'other'))
