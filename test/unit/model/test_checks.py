# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The checker: each rule with a good and a bad robot, and what holds for all findings."""

import math
import random
import re

import mujoco
import pytest
from support.paths import ROOT

from amr_description.errors import DescriptionError
from amr_description.model import checks
from amr_description.model.checks.context import CheckInputs
from amr_description.model.findings import NO_SHAPE
from amr_description.model.mended_inertials import principal_moments
from amr_description.model.robot import Inertia

AMR = (ROOT / 'urdf/amr.urdf').read_text()
TUTORIAL = (ROOT / 'test/fixtures/tutorial/amr.urdf').read_text()
ARM = (ROOT / 'test/fixtures/urdf/arm.urdf').read_text()

BALL = '<geometry><sphere radius="0.1"/></geometry>'
SOLID = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>'
)


def solid_link(*changed):
    return f'<link name="a">\n{SOLID.replace(*changed)}</link>'


def robot_text(body):
    return f'<robot name="r">\n{body}\n</robot>'


def joint_text(parent, child, kind='continuous', inside=''):
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{parent}_{child}" type="{kind}">{ends}{inside}</joint>'


def findings(text):
    return [str(finding) for finding in checks.check(text, 'f')]


def told_of(word, text):
    return [line for line in findings(text) if word in line]


def errors(text):
    return [str(finding) for finding in checks.examine(text, 'f').errors]


def test_shipped_robot_is_faultless():
    assert findings(AMR) == []


def test_arm_is_faultless():
    assert findings(ARM) == []


def test_the_two_faults_of_the_tutorial_robot_are_reported_once():
    beside = CheckInputs(file_exists=lambda uri: False)
    path, warning = map(str, checks.examine(TUTORIAL, 'f', beside).findings)
    line = TUTORIAL.splitlines().index(
        '      <parameters>/absolute/path/to/config/controllers.yaml</parameters>'
    )
    assert path == (
        f'warning: f:{line + 1}: gazebo plugin "gz_ros2_control::GazeboSimROS2ControlPlugin": '
        '<parameters> has a path of this machine only: found '
        '"/absolute/path/to/config/controllers.yaml"; let xacro find the file: '
        '$(find <package>)/config/<file>.yaml'
    )
    names = ', '.join(
        f'"joint_wheel_{place}"'
        for place in ('front_left', 'front_right', 'back_left', 'back_right')
    )
    line = TUTORIAL.splitlines().index('  <joint name="joint_wheel_front_left" type="continuous">')
    assert warning == (
        f'warning: f:{line + 1}: wheel joints {names}: a positive speed drives the robot '
        'backwards: found the axle along -y of the root frame, expected +y; '
        'write <axis xyz="0 0 -1"/>'
    )


def test_a_path_that_xacro_found_is_no_path_of_one_machine():
    """$(find package) becomes the absolute path of a share folder."""
    text = AMR.replace('<box size="0.5 0.3 0.1"/>', '<mesh filename="{}"/>', 1)
    there = CheckInputs(file_exists=lambda uri: uri.startswith('/opt/ws'))
    for path, count in (
        ('/opt/ws/share/amr/base.stl', 0),
        ('/opt/ws/src/amr/base.stl', 1),
        ('/home/me/share/amr/base.stl', 1),
        ('file:///opt/base.stl', 1),
        ('C:\\base.stl', 1),
        ('package://amr/base.stl', 1),
    ):
        found = checks.examine(text.format(path), 'f', there).findings
        assert len(found) == count, path
    assert findings(text.format('/home/me/base.stl')) == [], 'nobody can look'


def test_a_file_that_its_package_does_not_have_is_named_whole():
    share = f'/home/me/{"a_long_name/" * 9}install/amr/share/amr/'
    wrong = f'{share}config/controlers.yaml'
    text = TUTORIAL.replace('/absolute/path/to/config/controllers.yaml', wrong)
    beside = CheckInputs(file_exists=lambda uri: uri == f'{share}package.xml')
    found = str(checks.examine(text, 'f', beside).findings[0])
    assert f'<parameters> names a file that is not there: found "{wrong}"; write' in found


def test_the_fix_of_the_axles_is_the_right_one():
    fixed = TUTORIAL.replace('<axis   xyz="0 0 1"/>', '<axis xyz="0 0 -1"/>')
    assert findings(fixed) == []


def test_only_wheels_that_turn_backwards_are_named():
    """A left side mounted by mirroring, a frequent slip: the robot would spin on the spot."""
    place = AMR.index('<axis xyz="0 0 -1"/>', AMR.index('"joint_wheel_back_left" type'))
    text = AMR[:place] + AMR[place:].replace('0 0 -1', '0 0 1', 1)
    (warning,) = findings(text)
    assert 'wheel joint "joint_wheel_back_left": a positive speed' in warning


def test_differently_written_axles_get_a_fix_that_suits_all():
    first = '<origin xyz="0.2 0.15 0" rpy="1.5708 0 0"/>\n    <axis xyz="0 0 -1"/>'
    assert first in AMR
    turned = AMR.replace(first, '<origin xyz="0.2 0.15 0"/>\n    <axis xyz="0 -1 0"/>')
    place = turned.index('<axis xyz="0 0 -1"/>')
    found = findings(turned[:place] + turned[place:].replace('0 0 -1', '0 0 1', 1))
    (warning,) = [each for each in found if 'drives the robot backwards' in each]
    assert warning.endswith('; turn each <axis> round')


@pytest.mark.parametrize('axis', ['1 0 0', '0 0 1', '0 -0.8 0.6'])
def test_what_does_not_roll_along_x_is_no_wheel(axis):
    """A lidar that turns about z takes a velocity command, too."""
    hardware = (
        '<ros2_control name="s" type="system"><hardware><plugin>p</plugin></hardware>'
        '<joint name="a_b"><command_interface name="velocity"/>'
        '<state_interface name="position"/></joint></ros2_control>'
    )
    spinning = joint_text('a', 'b', inside=f'<axis xyz="{axis}"/>')
    links = f'<link name="f"/><link name="a">{SOLID}</link><link name="b">{SOLID}</link>'
    links += joint_text('f', 'a', 'fixed')
    assert findings(robot_text(links + spinning + hardware)) == []
    assert findings(robot_text(links + spinning.replace(axis, '0 -1 0') + hardware))


def test_broken_block_is_found_together_with_the_rest():
    text = TUTORIAL.replace('<joint name="joint_wheel_back_left">', '<joint name="wheel">')
    error, warning = findings(text)
    assert "Joint 'wheel' not found in URDF" in error
    assert 'joint_wheel_back_left' not in warning, 'it takes no command now'


MASS = {
    'collision': (
        f'<link name="a"><collision>{BALL}</collision></link>',
        'f:2: link "a" has a collision shape and no <inertial>; it is given 0.001 kg with '
        'moments of 4e-08 kg·m²; add <inertial> with <mass',
    ),
    'moving': (
        f'<link name="a">{SOLID}</link>\n<link name="b"/>' + joint_text('a', 'b'),
        'f:3: link "b" moves with "a_b" and has no <inertial>; it is .*; add <inertial>',
    ),
    'moving chain': (
        f'<link name="a">{SOLID}</link>\n<link name="b"/>\n<link name="c">{SOLID}</link>'
        + joint_text('a', 'b')
        + joint_text('b', 'c'),
        'f:3: link "b" moves with "a_b" and has no <inertial>',
    ),
    'base': (
        f'<link name="a"/>\n<link name="b">{SOLID}</link>' + joint_text('a', 'b'),
        'f:2: nothing that is rigidly joined to the root "a" has mass; .* a root link "world"',
    ),
    'zero': (
        solid_link('value="1"', 'value="0"'),
        'f:3: link "a": mass: found 0 kg, expected more than 0 and',
    ),
    'indefinite': (
        solid_link('ixy="0"', 'ixy="0.2"'),
        'f:3: link "a": the inertia is not positive definite: found principal moments -0.1, 0.1,',
    ),
    'zero inertia': (
        f'<link name="a">\n{SOLID.replace("0.1", "0")}</link>',
        'f:3: link "a": the inertia is not positive definite: found principal moments 0, 0, 0 kg',
    ),
    'tiny': (
        solid_link('value="1"', 'value="1e-15"'),
        'f:3: link "a": mass: found 1e-15 kg, expected more than 1e-14 and',
    ),
    'tiny inertia': (
        f'<link name="a">\n{SOLID.replace("0.1", "1e-15")}</link>',
        'f:3: link "a": the inertia is too small for any solver: found principal moments 1e-15,',
    ),
    'triangle': (
        solid_link('izz="0.1"', 'izz="0.3"'),
        'f:3: link "a": no body has this inertia: found principal moments 0.1, 0.1, 0.3 kg',
    ),
}


@pytest.mark.parametrize(('body', 'message'), MASS.values(), ids=MASS)
def test_mass_and_inertia_that_the_simulator_takes_as_others(body, message):
    text = robot_text(body)
    (found,) = (each for each in checks.examine(text, 'f').findings if each.taken)
    assert re.match(f'warning: {message}', str(found))
    assert errors(text) == []
    with pytest.raises(DescriptionError) as refusal:
        checks.require_sound(text, 'f', strict=True)
    assert found.what in str(refusal.value) and found.taken not in str(refusal.value)


NO_SHAPES = {
    'no geometry': (
        '<collision/>',
        'f:3: link "a": <collision> has no shape: expected <geometry>',
    ),
    'empty geometry': ('<visual><geometry/></visual>', 'f:3: link "a": <visual> has no shape'),
    'unknown': (
        '<visual><geometry><cone/></geometry></visual>',
        'f:3: link "a": unknown geometry: found <cone>, expected <box>, <cylinder>, <sphere>',
    ),
    'flat': (
        '<collision><geometry><cylinder radius="0.1" length="0"/></geometry></collision>',
        'f:3: link "a": the cylinder of its collision has no volume: found 0.1 0',
    ),
}


@pytest.mark.parametrize(('part', 'message'), NO_SHAPES.values(), ids=NO_SHAPES)
def test_a_shape_that_is_none_is_left_out(part, message):
    text = robot_text(f'<link name="a">{SOLID}\n{part}</link>')
    (found,) = (each for each in checks.examine(text, 'f').findings if each.taken)
    assert str(found).startswith(f'warning: {message}') and found.taken == NO_SHAPE
    assert errors(text) == []


@pytest.mark.parametrize('mass', ['-2.5', '1e10'])
def test_a_mass_that_means_nothing_is_an_error(mass):
    heavy = SOLID.replace('value="1"', f'value="{mass}"')
    (error,) = errors(robot_text(f'<link name="a">\n{heavy}</link>'))
    assert error.startswith(f'error: f:3: link "a": mass: found {float(mass):g} kg, expected')


WITHOUT_MASS_AND_RIGHT = {
    'frames only': '<link name="a"/><link name="b"/>' + joint_text('a', 'b', 'fixed'),
    'footprint': f'<link name="a"/><link name="b">{SOLID}</link>' + joint_text('a', 'b', 'fixed'),
    'dummy': (
        f'<link name="f"/><link name="a">{SOLID}</link><link name="b"/>'
        f'<link name="c">{SOLID}</link>'
        + joint_text('f', 'a', 'fixed')
        + joint_text('a', 'b')
        + joint_text('b', 'c', 'fixed')
    ),
    'wall': (
        f'<link name="world"/><link name="b"><collision>{BALL}</collision></link>'
        + joint_text('world', 'b', 'fixed')
    ),
    'bolted down': (
        f'<link name="world"/><link name="a"/><link name="b">{SOLID}</link>'
        + joint_text('world', 'a', 'fixed')
        + joint_text('a', 'b')
    ),
}


def test_a_grain_of_dust_is_a_robot():
    dust = SOLID.replace('value="1"', 'value="1e-11"').replace('0.1', '1e-13')
    assert errors(robot_text(f'<link name="a">{dust}</link>')) == []


@pytest.mark.parametrize('body', WITHOUT_MASS_AND_RIGHT.values(), ids=WITHOUT_MASS_AND_RIGHT)
def test_links_that_need_no_mass(body):
    assert findings(robot_text(body)) == []


def test_a_bolted_part_without_mass_is_a_warning():
    """Published robots have such cameras."""
    camera = f'<link name="b"><collision>{BALL}</collision></link>'
    text = robot_text(f'<link name="a">{SOLID}</link>{camera}' + joint_text('a', 'b', 'fixed'))
    assert errors(text) == []
    assert any('"b" has a collision shape and no <inertial>' in line for line in findings(text))
    moving = checks.examine(text.replace('"fixed"', '"continuous"'))
    assert any(each.is_refused(strict=True) for each in moving.findings)


XACRO = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{}<link name="{}"/></robot>'


@pytest.mark.parametrize(
    ('inside', 'name', 'count'),
    [
        ('', 'a', 0),
        ('<xacro:arg name="prefix" default=""/>', 'a', 0),
        ('<xacro:property name="p" value=""/>', 'a', 0),
        ('<xacro:property name="p" value=""/>', '${p}a', 1),
        ('<xacro:arg name="p" default=""/>', '$(arg p)a', 1),
        ('<xacro:include filename="x"/>', 'a', 1),
        ('<xacro:wheel/>', 'a', 1),
    ],
)
def test_xacro_that_would_make_something_is_an_error(inside, name, count):
    found = errors(XACRO.format(inside, name))
    assert len(found) == count
    assert all('this is a xacro file, not yet a URDF' in line for line in found)


def test_materials_without_names_are_those_of_an_exporter():
    visual = f'<visual>{BALL}<material name=""><color rgba="1 0 0 1"/></material></visual>'
    assert findings(robot_text(f'<link name="a">{visual}{visual}</link>')) == []
    nameless = visual.replace(' name=""', '')
    error = errors(robot_text(f'<link name="a">{nameless}</link>'))[0]
    assert 'has no attribute "name"' in error


def test_a_number_that_is_none_is_reported_once():
    text = robot_text(solid_link('value="1"', 'value="heavy"'))
    (error,) = findings(text)
    assert 'found "heavy", expected a number' in error
    assert len(findings(robot_text('<link name="a"><inertial/></link>'))) == 2, 'mass and inertia'


def random_inertia(chance):
    """Return the inertia of some point masses: by construction that of a body."""
    points = [[chance.gauss() for _ in range(3)] for _ in range(4)]
    xx, yy, zz = (sum(p[i] ** 2 for p in points) for i in range(3))
    xy, xz, yz = (-sum(p[i] * p[j] for p in points) for i, j in ((0, 1), (0, 2), (1, 2)))
    return Inertia(yy + zz, xy, xz, xx + zz, yz, xx + yy)


@pytest.mark.parametrize('seed', range(10))
def test_every_real_body_passes_and_mujoco_agrees(seed):
    inertia = random_inertia(random.Random(seed))
    low, middle, high = principal_moments(inertia)
    assert low + middle + high == pytest.approx(inertia.ixx + inertia.iyy + inertia.izz)
    assert 0.0 < low <= middle <= high <= low + middle + 1e-9
    names = ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')
    values = ' '.join(f'{name}="{getattr(inertia, name)!r}"' for name in names)
    body = f'<link name="a"><inertial><mass value="1"/><inertia {values}/></inertial></link>'
    turning = robot_text(f'<link name="world"/>{body}' + joint_text('world', 'a'))
    assert findings(turning) == []
    theirs = mujoco.MjModel.from_xml_string(turning).body('a').inertia
    assert sorted(theirs) == pytest.approx([low, middle, high])


def test_moments_rounded_to_few_digits_pass():
    """A thin plate has Ixx + Iyy = Izz; each rounded to two digits may break it by a little."""
    plate = SOLID
    for name, moment in (('ixx', 0.0417), ('iyy', 0.1083), ('izz', 0.1502)):
        plate = plate.replace(f'{name}="0.1"', f'{name}="{moment}"')
    assert findings(robot_text(f'<link name="a">{plate}</link>')) == []


def limited(lower, upper):
    return f'<limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/>'


@pytest.mark.parametrize(
    ('axis', 'severity'),
    [
        ('0 0 1', None),
        ('0.577 0.577 0.577', None),
        ('0 0 2', 'warning'),
        ('0 0 0.01', 'warning'),
        ('0 0 1e7', 'error'),
        ('1e300 1e300 0', 'error'),
        ('0 1e-7 0', 'error'),
    ],
)
def test_axis_is_a_unit_vector(axis, severity):
    found = findings(two_links(joint_text('a', 'b', inside=f'<axis xyz="{axis}"/>')))
    told = [line.partition(':')[0] for line in found if 'the axis is no unit vector' in line]
    assert told == ([severity] if severity else [])


def two_links(joint):
    return robot_text(f'<link name="a">{SOLID}</link><link name="b">{SOLID}</link>\n{joint}')


def test_limits_in_the_wrong_order_are_swapped():
    assert not told_of('limit', two_links(joint_text('a', 'b', 'revolute', limited(-1, 1))))
    text = two_links(joint_text('a', 'b', 'revolute', limited(2, -1)))
    assert told_of('limit', text) == [
        'warning: f:3: joint "a_b": the lower limit is above the upper one: '
        'found lower 2, upper -1; they are swapped'
    ]
    robot, _ = checks.require_sound(text, strict=False)
    assert (robot.joints[0].limit.lower, robot.joints[0].limit.upper) == (-1.0, 2.0)
    assert not told_of('limit', two_links(joint_text('a', 'b', 'continuous', limited(1, -1))))


@pytest.mark.parametrize(('source', 'found'), [('nobody', '"nobody"'), ('a_b', 'itself')])
def test_a_joint_that_mimics_nothing_moves_by_itself(source, found):
    text = two_links(joint_text('a', 'b', inside=f'<mimic joint="{source}"/>'))
    assert told_of('mimic', text) == [
        f'warning: f:3: joint "a_b" mimics a joint that is not there: found {found}, '
        'expected another one of "a_b"; it moves by itself'
    ]
    robot, _ = checks.require_sound(text, strict=False)
    assert robot.joints[0].mimic is None


def test_a_fixed_joint_that_mimics_stays_as_it_is():
    """As robots have them whose grippers somebody has made rigid."""
    text = robot_text(
        f'<link name="a">{SOLID}</link><link name="b">{SOLID}</link><link name="c">{SOLID}</link>'
        + joint_text('a', 'b') + joint_text('a', 'c', 'fixed', '<mimic joint="a_b"/>')
    )  # fmt: skip
    (line,) = told_of('mimic', text)
    assert line.endswith('found "a_c" of type fixed, expected two joints of type revolute, '
                         'continuous or prismatic; it stays as it is')  # fmt: skip


def test_commas_between_numbers_are_read_as_blanks():
    text = two_links(joint_text('a', 'b', inside='<origin rpy="0.5, 0 0"/>'))
    robot, (warning, *_) = checks.require_sound(text, strict=False)
    assert warning.text.endswith('expected 3 numbers without commas; it is read as "0.5 0 0"')
    assert robot.joints[0].origin.rotation[0] == pytest.approx(math.sin(0.25))
    for wrong in ('0.5, 0', '0.5, 0, x'):
        (error,) = told_of('rpy', text.replace('0.5, 0 0', wrong))
        assert error.startswith(f'error: f:3: joint "a_b": rpy of <origin>: found "{wrong}"')
        assert 'it is read' not in error


def test_of_too_many_numbers_the_first_are_taken():
    """As urdfdom refuses them, and other simulators take them."""
    text = two_links(joint_text('a', 'b', inside='<origin rpy="0.5 0 0 0"/>'))
    (error,) = told_of('rpy', text)
    assert error.startswith('error: f:3: joint "a_b": rpy of <origin>: found "0.5 0 0 0"')
    robot, (warning, *_) = checks.require_sound(text, strict=False)
    assert warning.text.endswith('expected 3 numbers; it is read as "0.5 0 0"')
    assert robot.joints[0].origin.rotation[0] == pytest.approx(math.sin(0.25))
    with pytest.raises(DescriptionError, match='rpy of <origin>'):
        checks.require_sound(text, strict=True)


def test_a_texture_without_a_file_is_left_out():
    visual = '<visual><geometry><sphere radius="1"/></geometry>{}</visual>'
    material = '<material name="m"><color rgba="1 1 1 1"/><texture/></material>'
    text = robot_text(f'<link name="a">{visual.format(material)}</link>')
    (line,) = told_of('texture', text)
    assert line.endswith('<texture> has no attribute "filename"; it is left out')
    assert line.startswith('warning')


def test_all_faults_are_found_in_one_go():
    text = robot_text(
        '<link name="a"/><link name="b"/><link name="c"/>\n'
        '<joint name="j" type="hinge"><parent link="a"/><child link="b"/></joint>\n'
        '<joint name="k" type="fixed"><parent link="zz"/><child link="c"/></joint>\n'
        '<ros2_control name="s" type="system"/>\n'
        '<gazebo><plugin filename="" name="x"/></gazebo>'
    )
    lines = [finding.line for finding in checks.check(text, 'f')]
    assert sorted(lines) == [3, 4, 5, 6]


def test_require_sound_gives_the_robot_and_the_warnings():
    robot, warnings = checks.require_sound(TUTORIAL, 'f')
    assert robot.name == 'amr'
    assert [warning.severity for warning in warnings] == ['warning']
    assert checks.require_sound(AMR)[1] == ()


def test_what_concerns_the_robot_state_publisher_alone_is_not_told_by_a_simulator():
    inertial = re.search(r'<inertial>.*?</inertial>', AMR, re.DOTALL)
    assert inertial is not None
    text = AMR.replace(
        '<link name="base_footprint"/>',
        f'<link name="base_footprint">{inertial[0]}</link>',
    )
    assert ['KDL' in each.what for each in checks.examine(text, 'f').warnings].count(True) == 1
    assert not any('KDL' in each.what for each in checks.require_sound(text, 'f')[1])


def test_require_sound_raises_the_first_error_and_counts_the_rest():
    with pytest.raises(DescriptionError, match=r'^f:1: the description is empty: .*</robot>$'):
        checks.require_sound('', 'f')
    text = AMR.replace('<mass value="0.5"/>', '<mass value="-1"/>')
    message = r'^f:\d+: link "wheel_front_left": mass: .*\(and 3 more; check_urdf lists them\)$'
    with pytest.raises(DescriptionError, match=message):
        checks.require_sound(text, 'f')


def test_require_sound_takes_what_the_simulator_can_live_with():
    text = AMR.replace(
        '</ros2_control>', '<joint name="lidar_tilt"/></ros2_control>'
    )  # a joint of another variant of the robot
    with pytest.raises(DescriptionError, match="Joint 'lidar_tilt' not found in URDF: exp"):
        checks.require_sound(text, 'f')
    _, (warning,) = checks.require_sound(text, 'f', strict=False)
    assert warning.severity == 'warning'
    assert re.search(r"^f:\d+: .*Joint 'lidar_tilt' not found .*; it is left out$", warning.text)
    broken = text.replace('<mass value="0.5"/>', '<mass value="-1"/>')
    with pytest.raises(DescriptionError, match=r'mass: .*\(and 3 more; check_urdf lists them\)$'):
        checks.require_sound(broken, 'f', strict=False)


def test_rules_are_documented_functions():
    rules = (*checks.RULES, *checks.RULES_OF_THE_WHOLE)
    assert len(set(rules)) == len(rules)
    assert all(rule.__doc__ for rule in rules)


def wheeled(between, wheel=''):
    """A box with a wheel inside, ``between`` them a link that carries it."""
    box = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
    return robot_text(
        f'<link name="a">{SOLID}{box}</link><link name="k">{SOLID}{between}</link>'
        f'<link name="w">{SOLID}<collision>{BALL}</collision>{wheel}</link>'
        + joint_text('a', 'k')
        + joint_text('k', 'w')
    )


def test_a_wheel_on_a_suspension_may_reach_into_the_chassis():
    assert not any('overlap' in line for line in findings(wheeled('')))
    touching = wheeled(f'<collision>{BALL}</collision>')
    assert any('"a" and "w" overlap' in line for line in findings(touching))


def test_what_is_fixed_to_a_body_that_touches_or_carries_one_needs_no_collision():
    visual = f'<visual>{BALL}</visual>'

    def is_told(text):
        return any('passes through' in line for line in findings(robot_text(text)))

    assert not any('no <collision>' in line for line in findings(wheeled(visual)))
    links = f'<link name="a">{SOLID}<collision>{BALL}</collision></link>'
    links += f'<link name="b">{SOLID}{visual}</link>'
    assert not is_told(links + joint_text('a', 'b', 'fixed'))
    assert is_told(links + joint_text('a', 'b'))


def test_a_link_of_its_own_may_stand_for_the_mass_of_a_body():
    shapes = f'<link name="a"><collision>{BALL}</collision></link>'
    text = robot_text(f'{shapes}<link name="m">{SOLID}</link>' + joint_text('a', 'm', 'fixed'))
    assert not any('no <inertial>' in line for line in findings(text))


def test_a_joint_that_a_spring_moves_may_have_no_effort():
    limit = '<limit lower="0" upper="1" effort="0" velocity="0"/>'
    text = f'<link name="a">{SOLID}</link><link name="b">{SOLID}</link>'
    text += joint_text('a', 'b', 'prismatic', limit)
    spring = '<gazebo reference="a_b"><springStiffness>9</springStiffness></gazebo>'
    assert any('leaves nothing' in line for line in findings(robot_text(text)))
    assert not any('leaves nothing' in line for line in findings(robot_text(text + spring)))


@pytest.mark.parametrize(
    ('path', 'is_told'),
    [
        ('file://meshes/a.stl', False),
        ('file:///home/me/a.stl', True),
        ('file:/home/me/a.stl', True),
    ],
)
def test_a_relative_file_uri_is_no_path_of_this_machine(path, is_told):
    part = f'<visual><geometry><mesh filename="{path}"/></geometry></visual>'
    text = robot_text(f'<link name="a">{SOLID}{part}</link>')
    found = checks.examine(text, 'f', CheckInputs(file_exists=lambda uri: True)).findings
    assert any('this machine only' in str(each) for each in found) == is_told
