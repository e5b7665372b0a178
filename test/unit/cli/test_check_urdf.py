# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf``: urdfdom's texts and exit codes, and our findings beside them."""

import io
import json
from pathlib import Path
import re
import sys

import pytest
from support.paths import ROOT

from amr_description.cli import check_urdf
from amr_description.errors import UsageError

AMR = ROOT / 'urdf/amr.urdf'
TUTORIAL = ROOT / 'test/fixtures/tutorial/amr.urdf'

# As urdfdom 4.0.2 prints it.
AMR_TREE = """\
robot name is: amr
---------- Successfully Parsed XML ---------------
root Link: base_footprint has 1 child(ren)
    child(1):  base_link
        child(1):  wheel_back_left
        child(2):  wheel_back_right
        child(3):  wheel_front_left
        child(4):  wheel_front_right
"""


@pytest.fixture
def run(capsys, monkeypatch):
    """Run the command on arguments, or on a text as stdin; give (exit code, stdout, stderr)."""

    def run_command(*arguments, stdin=None):
        if stdin is not None:
            data = stdin if isinstance(stdin, bytes) else stdin.encode()
            monkeypatch.setattr(sys, 'stdin', io.TextIOWrapper(io.BytesIO(data)))
            arguments = (*arguments, '-')
        code = check_urdf.main([str(argument) for argument in arguments])
        return (code, *capsys.readouterr())

    return run_command


def joint_text(kind='fixed', parent='a', child='b', inside=''):
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return (
        '<robot name="r">\n<link name="a"/><link name="b"/>\n'
        f'<joint name="j1" type="{kind}">{ends}{inside}</joint>\n</robot>'
    )


def test_shipped_robot(run):
    assert run(AMR) == (0, AMR_TREE, '')


def test_stdin(run):
    assert run(stdin=AMR.read_bytes()) == (0, AMR_TREE, '')


def test_tutorial_robot_passes_with_a_line_for_each_of_its_faults(run):
    code, out, err = run(TUTORIAL)
    assert (code, out) == (0, AMR_TREE)
    path, axles = err.splitlines()
    assert path.startswith(f'warning: {TUTORIAL}:145: gazebo plugin ')
    assert axles.startswith(f'warning: {TUTORIAL}:43: wheel joints "joint_wheel_front_left"')


def test_children_come_by_the_names_of_their_joints(run):
    joint = '<joint name="{}" type="fixed"><parent link="r"/><child link="{}"/></joint>'
    text = (
        '<robot name="r"><link name="r"/><link name="a"/><link name="b"/>'
        f'{joint.format("z", "a")}{joint.format("y", "b")}</robot>'
    )
    code, out, _ = run(stdin=text)
    assert code == 0
    assert out.endswith('root Link: r has 2 child(ren)\n    child(1):  b\n    child(2):  a\n')


def test_no_argument(run):
    assert run() == (255, '', 'Expect URDF xml file to parse. Use - for stdin\n')


UNKNOWN_PARENT = (
    'Failed to build tree: parent link [zz] of joint [j1] not found.  This is not valid according '
    'to the URDF spec. Every link you refer to from a joint needs to be explicitly defined in the '
    'robot description. To fix this problem you can either remove this joint [j1] from your urdf '
    'file, or add "<link name="zz" />" to your urdf file.'
)
ENDS = '<parent link="a"/><child link="b"/>'

# Words of urdfdom, and the line at which we find the fault.
REFUSED = {
    'two roots': (
        '<robot name="r">\n<link name="a"/>\n<link name="b"/></robot>',
        ['Failed to find root link: Two root links found: [a] and [b]'],
        3,
    ),
    'no root': (
        '<robot name="r">\n<link name="a"/><link name="b"/>'
        f'<joint name="j" type="fixed">{ENDS}</joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>',
        ['Failed to find root link: No root link found. The robot xml is not a valid tree.'],
        2,
    ),
    'unknown child': (
        joint_text(child='zz'),
        ['Failed to build tree: child link [zz] of joint [j1] not found'],
        3,
    ),
    'unknown parent': (joint_text(parent='zz'), [UNKNOWN_PARENT], 3),
    'no child': (
        joint_text().replace('<child link="b"/>', ''),
        ['Failed to build tree: Joint [j1] is missing a parent and/or child link specification.'],
        3,
    ),
    'type': (joint_text('hinge'), ['Joint [j1] has no known type [hinge]'], 3),
    'no type': (
        joint_text().replace(' type="fixed"', ''),
        ["joint [j1] has no type, check to see if it's a reference."],
        3,
    ),
    'revolute': (
        joint_text('revolute'),
        ['Joint [j1] is of type REVOLUTE but it does not specify limits'],
        3,
    ),
    'prismatic': (
        joint_text('prismatic'), ['Joint [j1] is of type PRISMATIC without limits'], 3
    ),
    'effort': (
        joint_text(inside='<limit velocity="1"/>'),
        ['joint limit: no effort', 'Could not parse limit element for joint [j1]'],
        3,
    ),
    'velocity': (
        joint_text(inside='<limit effort="1"/>'),
        ['joint limit: no velocity', 'Could not parse limit element for joint [j1]'],
        3,
    ),
    'dynamics': (
        joint_text(inside='\n<dynamics/>'),
        [
            'joint dynamics element specified with no damping and no friction',
            'Could not parse joint_dynamics element for joint [j1]',
        ],
        4,
    ),
    'origin': (
        joint_text(inside='\n<origin xyz="1 2"/>'),
        [
            'Parser found 2 elements but 3 expected while parsing vector [1 2]',
            'Malformed parent origin element for joint [j1]',
        ],
        4,
    ),
    'unnamed joint': (joint_text().replace(' name="j1"', ''), ['unnamed joint found'], 3),
    'link twice': (
        '<robot name="r">\n<link name="a"/>\n<link name="a"/></robot>',
        ["link 'a' is not unique."],
        3,
    ),
    'joint twice': (
        joint_text().replace('</robot>', f'<joint name="j1" type="fixed">{ENDS}</joint></robot>'),
        ["joint 'j1' is not unique."],
        4,
    ),
    'no link': ('<robot name="r"/>', ['No link elements found in urdf file'], 1),
    'no name': ('<robot><link name="a"/></robot>', ['No name given for the robot.'], 1),
    'not a robot': ('\n<sdf/>', ["Could not find the 'robot' element in the xml file"], 2),
    'version': (
        '<robot name="r" version="3"><link name="a"/></robot>',
        ["Invalid 'version' specified; only version 1.0 is currently supported"],
        1,
    ),
    'empty': ('', ['Error=XML_ERROR_EMPTY_DOCUMENT ErrorID=13 (0xd) Line number=1'], 1),
    'truncated': (
        '<robot name="r">\n<link name="a"/>',
        ['Error=XML_ERROR_PARSING ErrorID=15 (0xf) Line number=2'],
        2,
    ),
    'mismatch': (
        '<robot name="r">\n</link>',
        ['Error=XML_ERROR_MISMATCHED_ELEMENT ErrorID=14 (0xe) Line number=2'],
        2,
    ),
}  # fmt: skip
JOINT_ELEMENT = (
    'type', 'no type', 'revolute', 'prismatic', 'effort', 'velocity', 'dynamics', 'origin',
    'unnamed joint',
)  # fmt: skip


@pytest.mark.parametrize('case', REFUSED)
def test_refuses_in_the_words_of_urdfdom(run, case):
    text, words, line = REFUSED[case]
    code, out, err = run(stdin=text)
    assert (code, out) == (255, '')
    if case in JOINT_ELEMENT:
        words = [*words, 'joint xml is not initialized correctly']
    expected = [f'Error:   {word}\n         at line {line} in <stdin>\n' for word in words]
    refusal = ''.join(expected) + 'ERROR: Model Parsing the xml failed\n'
    assert err.startswith(refusal)
    ours = err.removeprefix(refusal).splitlines()
    assert any(text.startswith(f'error: <stdin>:{line}: ') for text in ours)


UNUSABLE = {
    'circle': (
        '<robot name="r">\n<link name="r"/><link name="a"/><link name="b"/>'
        f'<joint name="j" type="fixed">{ENDS}</joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>',
        0,
        'error: <stdin>:2: joints form a circle that hangs on nothing: found "k", "j"; remove',
    ),
    'circle under the root': (
        '<robot name="r">\n<link name="r"/><link name="a"/><link name="b"/>'
        '<joint name="i" type="fixed"><parent link="r"/><child link="a"/></joint>'
        f'<joint name="j" type="fixed">{ENDS}</joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>',
        2,
        'error: <stdin>:2: link "a" has two parents: found joints "i" and "k", expected one joint',
    ),
    'hardware': (
        joint_text().replace('</robot>', '<ros2_control name="s" type="system"/></robot>'),
        1,
        'error: <stdin>:4: ros2_control "s": no <hardware>; add <hardware>',
    ),
}  # fmt: skip


@pytest.mark.parametrize(('text', 'children', 'message'), UNUSABLE.values(), ids=UNUSABLE)
def test_what_urdfdom_passes_and_cannot_be_used_exits_1(run, text, children, message):
    code, out, err = run(stdin=text)
    assert code == 1
    assert out.count('    child(') == children
    assert message in err
    assert 'ERROR' not in err


def test_a_model_without_mass_is_told_and_passes_unless_strict(run):
    """As urdfdom; the simulator says what it takes it as, and with strict it refuses it."""
    code, out, err = run(stdin=joint_text('continuous'))
    assert (code, out.count('    child(')) == (0, 1)
    assert (
        'warning: <stdin>:2: link "b" moves with "j1" and has no <inertial>; it is given 0.' in err
    )
    assert run('--strict', stdin=joint_text('continuous'))[0] == 1


@pytest.mark.parametrize(
    ('name', 'content', 'message'),
    [
        ('missing.urdf', None, 'cannot read the description "{}": No such file or directory'),
        ('', None, 'cannot read the description "{}": Is a directory'),
        ('latin.urdf', b'<robot name="\xe9"/>', '{}:1: byte 13 is not UTF-8; save the file as'),
    ],
    ids=['missing', 'directory', 'not UTF-8'],
)
def test_unreadable_files_give_one_line(run, tmp_path, monkeypatch, name, content, message):
    monkeypatch.chdir(tmp_path)
    path = Path(name)  # short: a message shows the beginning of a long one
    if content is not None:
        path.write_bytes(content)
    code, out, err = run(path)
    assert (code, out) == (255, '')
    assert err.startswith(f'error: {message.format(path)}')
    assert err.count('\n') == 1


def test_a_file_is_named_by_its_package_too(run):
    uri = 'package://amr_description/urdf/{}.urdf'
    assert run(uri.format('amr'))[0] == 0
    code, out, err = run(uri.format('amt'))
    assert (code, out) == (255, '')
    assert err.startswith(f"error: '{uri.format('amt')}': no such file: ")
    assert err.endswith('; did you mean amr.urdf?\n')


def test_of_another_language_nothing_else_is_said(run):
    code, _, err = run(stdin='<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>')
    (line,) = [each for each in err.splitlines() if each.startswith(('error: ', 'warning: '))]
    assert (code, line.partition('; ')[2][:25]) == (255, 'give the URDF of the robo')


def test_a_file_that_is_wrong_all_over_is_not_read_to_the_end(run):
    links = '\n'.join('<link/>' for _ in range(10_000))
    code, _, err = run(stdin=f'<robot name="r">{links}</robot>')
    assert code == 255
    assert err.splitlines()[-1] == '… and 901 more'
    assert err.count('\n') < 150


def test_a_chain_of_links_is_not_indented_for_ever(run):
    size = 3000
    links = ''.join(f'<link name="l{i}"/>' for i in range(size))
    ends = '<joint name="j{0}" type="fixed"><parent link="l{1}"/><child link="l{0}"/></joint>'
    joints = ''.join(ends.format(i, i - 1) for i in range(1, size))
    code, out, _ = run(stdin=f'<robot name="r">{links}{joints}</robot>')
    assert code == 0
    assert out.endswith(f'child(1):  l{size - 1}\n')
    assert len(out) < 500 * size


def test_names_of_the_file_do_not_paint_on_the_terminal(run):
    code, out, err = run(stdin='<robot name="a&#10;b"><link name="c&#9;d"/></robot>')
    assert code == 0
    assert err.splitlines() == [
        'warning: <stdin>:1: the link has a name that ROS tools trip over: found "c\\td", '
        'expected letters, digits and _, such as "c_d"'
    ]
    assert out.splitlines()[0] == 'robot name is: a\\nb'
    assert out.splitlines()[2] == 'root Link: c\\td has 0 child(ren)'
    code, out, err = run(stdin='<robot name="r"><link name="a"/><link name="b&#x9b;2J"/></robot>')
    assert (code, out) == (255, '')
    assert 'Two root links found: [a] and [b\\x9b2J]' in err


def test_usage_error_and_help(run, capsys):
    with pytest.raises(SystemExit, match='2'):
        check_urdf.main(['a', '--fall'])
    assert 'unrecognized arguments: --fall' in capsys.readouterr().err
    with pytest.raises(UsageError, match="^'b' is no argument of a xacro file; write name:=value"):
        check_urdf.main(['a', 'b'])
    with pytest.raises(SystemExit, match='0'):
        check_urdf.main(['--help'])
    assert '255' in capsys.readouterr().out


def test_strict_turns_warnings_into_exit_1(run):
    assert run(AMR, '--strict') == (0, AMR_TREE, '')
    code, out, err = run(TUTORIAL, '--strict')
    assert (code, out) == (1, AMR_TREE)
    assert err.count('\n') == 2


def test_drop_reports_in_numbers(run):
    code, out, err = run(AMR, '--drop')
    assert (code, err) == (0, '')
    assert out.startswith(AMR_TREE + 'dropped from 20 cm:\n    comes to rest in ')
    assert re.search(r'^    drift in 1 s at rest +0\.00 mm$', out, re.MULTILINE)
    assert re.search(r'^    0\.5 s forward: x +1[34]\d\.\d\d mm$', out, re.MULTILINE)
    assert out.endswith('    passed\n')


def test_drop_that_fails_exits_1(run):
    code, out, err = run(TUTORIAL, '--drop')
    assert code == 1
    assert out.endswith('    failed\n')
    (failure,) = [line for line in err.splitlines() if line.startswith('error: ')]
    assert failure.startswith('error: dropped: it drives backwards: ')


def test_a_broken_robot_is_not_dropped(run):
    text = UNUSABLE['circle'][0]
    code, out, err = run(stdin=text)
    assert code == 1
    file_code, file_out, file_err = run('--drop', stdin=text)
    assert (file_code, file_out) == (code, out)
    assert file_err == err + 'not dropped: the description has errors\n'


def test_a_robot_that_the_simulator_refuses_fails_the_drop(run, tmp_path):
    path = tmp_path / 'r.urdf'
    link = AMR.read_text().replace('<box size="0.5 0.3 0.1"/>', '<mesh filename="a.msh"/>')
    path.write_text(link)
    (tmp_path / 'a.msh').write_text('')
    code, out, err = run(path, '--drop')
    assert code == 1
    assert out.endswith('    failed\n')
    assert err.splitlines()[-1].startswith('error: dropped: ')
    assert 'MuJoCo refuses the model' in err


def test_json_holds_the_drop(run):
    code, out, err = run(AMR, '--json', '--drop')
    assert (code, err) == (0, '')
    told = json.loads(out)
    assert told['robot'] == {
        'name': 'amr', 'root': 'base_footprint', 'links': 6, 'joints': 5, 'mass': 7.0
    }  # fmt: skip
    assert told['findings'] == []
    assert told['urdfdom'] == {'accepts': True, 'errors': []}
    assert told['drop']['failures'] == []
    assert 0.2 < told['drop']['rest_time'] < 1.0
    assert json.loads(run(AMR, '--json')[1])['drop'] is None


def test_json_is_strict_json_whatever_the_numbers(run):
    text = joint_text('revolute', inside='<limit effort="1" velocity="1" lower="1e400"/>')
    out = run('--json', stdin=text)[1]

    def refuse(constant):
        raise AssertionError(f'{constant} is no JSON')

    assert json.loads(out, parse_constant=refuse)['exit_code'] == 255


def test_xacro_is_expanded_first(run, tmp_path):
    path = tmp_path / 'r.urdf.xacro'
    path.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="root" default="a"/><link name="$(arg root)"/></robot>'
    )
    assert run(path)[1].endswith('root Link: a has 0 child(ren)\n')
    assert run(path, 'root:=b')[1].endswith('root Link: b has 0 child(ren)\n')
    code, _, err = run(path, 'rot:=b')
    assert code == 0
    assert err.startswith(f'warning: {path}: nothing asks for "rot"')
    path.write_text('<robot name="r"><xacro:x/></robot>')
    code, out, err = run(path)
    assert (code, out) == (255, '')
    assert err.count('\n') == 1


def test_json_says_why_nothing_was_checked(run, tmp_path):
    code, out, err = run('no.urdf', '--json')
    assert (code, err) == (255, '')
    assert json.loads(out) == {
        'file': 'no.urdf',
        'exit_code': 255,
        'error': 'cannot read the description "no.urdf": No such file or directory',
    }
    code, out, err = run(AMR, '--json', '--controllers', str(tmp_path / 'no.yaml'))
    assert (code, err) == (1, '')
    assert json.loads(out)['error'].endswith('No such file or directory')


def test_a_huge_file_is_refused_unread(run, tmp_path):
    path = tmp_path / 'huge.urdf'
    with path.open('wb') as file:
        file.truncate(100 * 10**6)
    code, out, err = run(path)
    assert (code, out) == (255, '')
    assert err == f'error: {path}: larger than 4 MiB, which no robot description is\n'
