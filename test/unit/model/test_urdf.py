# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""URDF text -> Robot: what is read, where it stands in the file, and what is refused how."""

import dataclasses
import math
from pathlib import Path

import pytest
from support.paths import ROOT

from amr_description.errors import DescriptionError
from amr_description.model import frames, kinematics, urdf
from amr_description.model.plain_xml import plain_xml
from amr_description.model.robot import (
    Box,
    Cylinder,
    Dynamics,
    JointType,
    Limit,
    Material,
    Mesh,
    Mimic,
    Sphere,
)
from amr_description.model.xml_reader import MAX_BYTES, MAX_LINES, read_file

AMR = ROOT / 'urdf/amr.urdf'
TUTORIAL = ROOT / 'test/fixtures/tutorial/amr.urdf'
ARM = ROOT / 'test/fixtures/urdf/arm.urdf'
WHEELS = ('front_left', 'front_right', 'back_left', 'back_right')


def robot_text(body):
    return f'<robot name="r">\n{body}\n</robot>'


def joint_text(inside='', kind='continuous', name='j'):
    """Return two links and the joint between them, which stands on line 3."""
    ends = '<parent link="a"/><child link="b"/>'
    joint = f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'
    return robot_text(f'<link name="a"/><link name="b"/>\n{joint}')


def link_text(inside):
    return robot_text(f'<link name="a">\n{inside}\n</link>')


@pytest.mark.parametrize(
    'head',
    [
        '<?xml version="0.0" ?>',
        '\n\n<?xml version="1.0"?>',
        ' <?xml version="2.0" encoding="utf-8"?>',
    ],
)
def test_the_declaration_of_xml_is_read_as_urdfdom_reads_it(head, tmp_path):
    """Its parser does not look at the version, and lets blanks stand before it."""
    robot = urdf.parse(head + '\n' + robot_text('<link name="a"/>'))
    assert robot.link('a').line == head.count('\n') + 3
    file = tmp_path / 'r.urdf'
    file.write_text(head + '\n' + robot_text('<link name="a"/>'))
    assert '<?xml' not in read_file(file)  # for those who read it after us, such as a browser


def test_what_stands_behind_a_nul_is_left_out_if_it_is_blank():
    text = robot_text('<link name="a"/>')
    assert urdf.parse(f'{text}\r\n\0').link('a').line == 2
    with pytest.raises(DescriptionError, match='not well-formed XML'):
        urdf.parse(f'{text}\0<robot/>')


def test_prefixes_of_other_programs_need_no_declaration():
    inside = '<drake:joint_filter group="a"/>'
    text = robot_text(f'<link name="a"/>\n{inside}')
    assert urdf.parse(text).link('a').line == 2
    for known in (
        text.replace('<robot', '<robot xmlns:drake="http://drake"'),
        text.replace(inside, '<gazebo><a b="c:d=e"/></gazebo>'),
        text.replace(inside, '<link name="b" xml:base="c"/>'),
    ):
        assert plain_xml(known) is known
    assert urdf.parse(robot_text('<link name="a"\tsdf:version = "1.7"/>')).link('a')
    with pytest.raises(DescriptionError, match='Namespace prefix xacro'):
        urdf.parse(text.replace('drake', 'xacro'))


def test_a_plain_declaration_stays():
    text = '<?xml version="1.0" encoding="utf-8"?>\n' + robot_text('<link name="a"/>')
    assert plain_xml(text) is text


def test_shipped_robot():
    amr = urdf.load(AMR)
    assert amr.name == 'amr'
    assert amr.root.name == 'base_footprint'
    assert amr.root.inertial is None
    assert amr.joint('base_joint').origin.translation == (0.0, 0.0, 0.1)
    base = amr.link('base_link')
    assert base.visuals[0].geometry == base.collisions[0].geometry == Box((0.5, 0.3, 0.1))
    assert base.visuals[0].material == Material('blue', (0.0, 0.0, 1.0, 1.0))
    assert base.inertial.mass == 5.0
    for place in WHEELS:
        wheel, joint = amr.link(f'wheel_{place}'), amr.joint(f'joint_wheel_{place}')
        assert wheel.collisions[0].geometry == Cylinder(0.1, 0.04)
        assert wheel.visuals[0].material.name == 'black'
        assert wheel.inertial.mass == 0.5
        assert joint.type is JointType.CONTINUOUS
        x, y, z = joint.origin.translation
        assert (x > 0, y > 0, z) == ('front' in place, 'left' in place, 0.0)
        assert (abs(x), abs(y)) == (0.2, 0.15)


def test_shipped_wheels_roll_to_plus_x():
    """Speed of the hub over the ground = ω × (up from contact): axle +y gives +x."""
    amr = urdf.load(AMR)
    poses = kinematics.link_poses(amr)
    for place in WHEELS:
        joint = amr.joint(f'joint_wheel_{place}')
        _, axle_y, _ = frames.rotate(poses[joint.child].rotation, joint.axis)
        assert axle_y == pytest.approx(1.0, abs=1e-6)


def test_shipped_inertia_is_that_of_the_solid_shapes():
    amr = urdf.load(AMR)
    x, y, z = amr.link('base_link').collisions[0].geometry.size
    box = [5.0 * sides / 12.0 for sides in (y * y + z * z, x * x + z * z, x * x + y * y)]
    shape = amr.link('wheel_front_left').collisions[0].geometry
    r, h = shape.radius, shape.length
    across = 0.5 * (3.0 * r * r + h * h) / 12.0
    cylinder = [across, across, 0.5 * r * r / 2.0]
    for link in amr.links[1:]:
        expected = box if link.name == 'base_link' else cylinder
        inertia = link.inertial.inertia
        # The file gives four digits after the point.
        diagonal = [inertia.ixx, inertia.iyy, inertia.izz]
        assert diagonal == pytest.approx(expected, abs=0.5e-4)
        assert (inertia.ixy, inertia.ixz, inertia.iyz) == (0.0, 0.0, 0.0)


def without_lines(part):
    """Return a link or joint as a dictionary without the lines it came from."""
    if isinstance(part, dict):
        return {key: without_lines(value) for key, value in part.items() if key != 'line'}
    if isinstance(part, list | tuple):
        return [without_lines(item) for item in part]
    return part


def test_tutorial_robot_differs_from_the_shipped_one_in_its_axes_only():
    ours, theirs = urdf.load(AMR), urdf.load(TUTORIAL)
    assert theirs.joint('joint_wheel_back_left').axis == (0.0, 0.0, 1.0)
    turned = [
        dataclasses.replace(joint, axis=(0.0, 0.0, -1.0)) if joint.name != 'base_joint' else joint
        for joint in theirs.joints
    ]
    for our_parts, their_parts in ((ours.links, theirs.links), (ours.joints, turned)):
        pairs = zip(our_parts, their_parts, strict=True)
        for a, b in pairs:
            assert without_lines(dataclasses.asdict(a)) == without_lines(dataclasses.asdict(b))


def test_everything_that_urdf_can_say():
    arm = urdf.load(ARM)
    grey, orange = Material('grey', (0.5, 0.5, 0.5, 1.0)), Material('orange', (1.0, 0.5, 0.0, 1.0))
    pedestal, carriage = arm.link('pedestal'), arm.link('carriage')
    assert pedestal.visuals[0].material == grey
    assert (pedestal.visuals[0].name, pedestal.collisions[0].name) == ('column', 'column_shape')
    assert pedestal.visuals[0].origin.translation == (0.0, 0.0, 0.2)
    assert frames.yaw_of(pedestal.collisions[0].origin.rotation) == pytest.approx(0.5)
    assert [visual.material for visual in carriage.visuals] == [orange, orange]
    assert carriage.visuals[1].geometry == Mesh('package://arm/meshes/cover.stl', (0.001,) * 3)
    assert carriage.inertial.origin.translation == (0.0, 0.0, 0.05)
    assert carriage.inertial.inertia.ixy == 0.001
    assert arm.link('upper').collisions[0].geometry == Sphere(0.05)
    assert set(arm.materials) == {grey, orange}
    lift = arm.joint('lift')
    assert lift.type is JointType.PRISMATIC
    assert lift.limit == Limit(lower=-0.1, upper=0.5, effort=100.0, velocity=0.5)
    assert lift.dynamics == Dynamics(damping=2.0, friction=0.5)
    assert arm.joint('right_finger').mimic == Mimic('left_finger', -1.5, 0.002)
    assert arm.joint('roll').axis == (1.0, 0.0, 0.0), "URDF's default"


def test_axis_is_made_a_unit_vector():
    joint = urdf.parse(joint_text('<axis xyz="0 3 -4"/>')).joint('j')
    assert joint.axis == pytest.approx((0.0, 0.6, -0.8))


@pytest.mark.parametrize('path', [AMR, TUTORIAL, ARM], ids=['amr', 'tutorial', 'arm'])
def test_agrees_with_yourdfpy(path):
    import yourdfpy

    ours = urdf.load(path)
    theirs = yourdfpy.URDF.load(path, build_scene_graph=False, load_meshes=False).robot
    assert [link.name for link in ours.links] == [link.name for link in theirs.links]
    assert [(j.name, j.type, j.parent, j.child) for j in ours.joints] == [
        (j.name, j.type, j.parent, j.child) for j in theirs.joints
    ]
    assert [link.inertial and link.inertial.mass for link in ours.links] == [
        link.inertial and link.inertial.mass for link in theirs.links
    ]


@pytest.mark.parametrize('path', [AMR, TUTORIAL, ARM], ids=['amr', 'tutorial', 'arm'])
def test_lines_are_true(path):
    robot = urdf.load(path)
    lines = path.read_text().splitlines()
    for part in (*robot.links, *robot.joints):
        assert f'name="{part.name}"' in lines[part.line - 1]
    inertial = next(link.inertial for link in robot.links if link.inertial is not None)
    assert '<inertial>' in lines[inertial.line - 1]


def test_lines_are_true_to_the_last_one_that_is_read():
    """A line beyond what the parser can count would be named wrongly, so the file is refused."""
    sphere = '<visual><geometry><sphere radius="x"/></geometry></visual>'

    def text(lines):
        return '<robot name="r">' + '\n' * (lines - 1) + f'<link name="b">{sphere}</link></robot>'

    with pytest.raises(DescriptionError, match=f'^f:{MAX_LINES}: link "b": radius of <sphere>'):
        urdf.parse(text(MAX_LINES), 'f')
    with pytest.raises(DescriptionError, match=f'^f:1: more than {MAX_LINES} lines'):
        urdf.parse(text(MAX_LINES + 1), 'f')


def test_tree_order_and_lookups():
    arm = urdf.load(ARM)
    walked = [(depth, joint.name) for depth, joint in arm.walk()]
    assert walked == [
        (1, 'mount'),
        (2, 'lift'),
        (3, 'shoulder'),
        (4, 'roll'),
        (5, 'left_finger'),
        (5, 'right_finger'),
    ]
    assert [joint.name for joint in arm.child_joints('hand')] == ['left_finger', 'right_finger']
    assert arm.parent_joint('hand').name == 'roll'
    assert arm.parent_joint('world') is None
    assert arm.child_joints('finger_left') == ()


def test_the_root_has_no_parent_wherever_it_is_in_the_file():
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    assert urdf.parse(robot_text(f'<link name="b"/><link name="a"/>{joint}')).root.name == 'a'


def test_lookup_names_what_there_is():
    amr = urdf.load(AMR)
    known = 'there are: "base_footprint", "base_link", "wheel_front_left"'
    with pytest.raises(DescriptionError, match=f'there is no link "wheel"; {known}'):
        amr.link('wheel')
    with pytest.raises(DescriptionError, match='there is no joint "x"; there are: "base_joint"'):
        amr.joint('x')


def test_robot_cannot_be_changed():
    amr = urdf.load(AMR)
    with pytest.raises(dataclasses.FrozenInstanceError, match='cannot assign'):
        amr.name = 'other'
    with pytest.raises(dataclasses.FrozenInstanceError, match='cannot assign'):
        amr.root.line = 0


def test_text_is_kept_for_robot_description():
    assert urdf.load(AMR).text == AMR.read_text()


NOT_TREES = {
    'no XML': ('<robot', r'^f:1: not well-formed XML'),
    'truncated': ('<robot name="r">\n<link name="a"/>\n', r'^f:3: not well-formed XML: Premature'),
    'mismatch': ('<robot name="r">\n<link name="a">\n</robot>', r'^f:3: not .*mismatch: link'),
    'empty': ('', r'^f:1: the description is empty: expected a URDF'),
    'blank': (' \n', r'^f:1: the description is empty'),
    'not a robot': ('\n<sdf/>', r'^f:2: this is no URDF: .* <sdf>.*; give the URDF of the robot'),
    'no name': ('<robot><link name="a"/></robot>', r'^f:1: <robot> has no attribute "name"'),
    'version': (
        '<robot name="r" version="2.0"><link name="a"/></robot>',
        r'^f:1: version of <robot>: found "2.0", expected 1.0',
    ),
    'no link': (robot_text(''), r'^f:1: the robot has no <link>'),
    'unnamed link': (robot_text('<link/>'), r'^f:2: .*<link> has no attribute "name"'),
    'link twice': (
        robot_text('<link name="a"/>\n<link name="a"/>'),
        r'^f:3: link "a" is not unique: found the first on line 2; give every link a name',
    ),
    'two roots': (
        robot_text('<link name="a"/>\n<link name="b"/>'),
        r'^f:3: the robot has 2 roots: found "a", "b", expected one .* join "b" to the others',
    ),
    'unknown child': (
        robot_text(
            '<link name="a"/>\n'
            '<joint name="j" type="fixed"><parent link="a"/><child link="zz"/></joint>'
        ),
        r'^f:3: joint "j": its child link is not defined: found "zz", expected one of "a"; add',
    ),
    'unknown parent': (
        robot_text(
            '<link name="a"/>\n'
            '<joint name="j" type="fixed"><parent link="zz"/><child link="a"/></joint>'
        ),
        r'^f:3: joint "j": its parent link is not defined: found "zz", expected one of "a"; add',
    ),
    'no child': (
        robot_text('<link name="a"/>\n<joint name="j" type="fixed"><parent link="a"/></joint>'),
        r'^f:3: joint "j" has no child link; add <child',
    ),
    'two parents': (
        robot_text(
            '<link name="a"/><link name="b"/><link name="c"/>'
            '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
            '<joint name="k" type="fixed"><parent link="a"/><child link="c"/></joint>\n'
            '<joint name="l" type="fixed"><parent link="c"/><child link="b"/></joint>'
        ),
        r'^f:3: link "b" has two parents: found joints "j" and "l"',
    ),
    'no root': (
        robot_text(
            '<link name="a"/><link name="b"/>'
            '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
            '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>'
        ),
        r'^f:2: the robot has no root',
    ),
    'detached circle': (
        robot_text(
            '<link name="r"/>\n<link name="a"/><link name="b"/>'
            '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
            '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>'
        ),
        r'^f:3: joints form a circle that hangs on nothing: found "k", "j"',
    ),
    'circle under the root': (
        robot_text(
            '<link name="r"/><link name="a"/><link name="b"/>'
            '<joint name="i" type="fixed"><parent link="r"/><child link="a"/></joint>'
            '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>\n'
            '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>'
        ),
        r'^f:3: link "a" has two parents: found joints "i" and "k"',
    ),
}

BAD_JOINTS = {
    'type': (joint_text(kind='hinge'), r'unknown joint type: found "hinge", expected one'),
    'name': (joint_text(name=''), r'<joint> has no attribute "name"'),
    'limits': (joint_text(kind='revolute'), r'a revolute joint needs limits; add <limit'),
    'slide': (joint_text(kind='prismatic'), r'a prismatic joint needs limits; add <limit'),
    'effort': (joint_text('<limit velocity="1"/>'), r'<limit> has no attribute "effort"'),
    'velocity': (joint_text('<limit effort="1"/>'), r'<limit> has no attribute "velocity"'),
    'axis': (joint_text('<axis xyz="0 0 0"/>'), r'the axis has no direction: found "0 0 0"'),
    'huge axis': (joint_text('<axis xyz="1.7e308 1.7e308 0"/>'), r'the axis has no direction'),
    'short': (joint_text('<axis xyz="1 2"/>'), r'xyz of <axis>: found "1 2", expected 3 numbers'),
    'word': (joint_text('<axis xyz="x y z"/>'), r'xyz of <axis>: found "x y z", expected 3 num'),
    'empty': (joint_text('<origin rpy=""/>'), r'rpy of <origin>: found "", expected 3 numbers'),
    'nan': (joint_text('<origin xyz="0 nan 0"/>'), r'found "0 nan 0", expected 3 numbers, finite'),
    'inf': (joint_text('<origin xyz="0 -inf 0"/>'), r'expected 3 numbers, finite'),
    'overflow': (joint_text('<origin xyz="0 1e999 0"/>'), r'expected 3 numbers, finite'),
    'underscore': (joint_text('<origin xyz="1_0 0 0"/>'), r'found "1_0 0 0", expected 3 numbers'),
    'foreign digits': (joint_text('<origin xyz="٣ 0 0"/>'), r'expected 3 numbers'),
    'mimic': (joint_text('<mimic multiplier="2"/>'), r'<mimic> has no attribute "joint"'),
    'dynamics': (joint_text('<dynamics/>'), r'<dynamics> says nothing: expected damping or fric'),
    'bad damping': (joint_text('<dynamics damping="x"/>'), r'damping of <dynamics>: found "x", e'),
    'template': (joint_text('<origin xyz="${x} 0 0"/>'), r'found "\${x} 0 0", expected 3 numbers'),
}

BAD_LINKS = {
    'heavy': (
        '<inertial><mass value="heavy"/><inertia/></inertial>',
        r'^f:3: link "a": value of <mass>: found "heavy", expected a number',
    ),
    'box': (
        '<visual><geometry><box size="1 2"/></geometry></visual>',
        r'size of <box>: found "1 2", expected 3 numbers',
    ),
    'sphere': (
        '<visual><geometry><sphere/></geometry></visual>',
        r'<sphere> has no attribute "radius": expected a number',
    ),
    'mesh': (
        '<visual><geometry><mesh filename=""/></geometry></visual>',
        r'<mesh> has no attribute "filename"',
    ),
    'colour': (
        '<visual><geometry><sphere radius="1"/></geometry>'
        '<material name="m"><color rgba="red"/></material></visual>',
        r'rgba of <color>: found "red", expected 4 numbers',
    ),
}


@pytest.mark.parametrize(('text', 'message'), NOT_TREES.values(), ids=NOT_TREES)
def test_a_robot_that_is_not_a_tree_is_refused(text, message):
    with pytest.raises(DescriptionError, match=message):
        urdf.parse(text, 'f')


@pytest.mark.parametrize(('text', 'message'), BAD_JOINTS.values(), ids=BAD_JOINTS)
def test_refuses_bad_joints(text, message):
    with pytest.raises(DescriptionError, match=rf'^f:3: joint ".?": .*{message}'):
        urdf.parse(text, 'f')


@pytest.mark.parametrize(('inside', 'message'), BAD_LINKS.values(), ids=BAD_LINKS)
def test_refuses_bad_links(inside, message):
    with pytest.raises(DescriptionError, match=message):
        urdf.parse(link_text(inside), 'f')


def test_duplicate_joint_is_refused():
    text = joint_text().replace('\n</robot>', '\n<joint name="j" type="fixed"/></robot>')
    with pytest.raises(DescriptionError, match='^f:4: joint "j" is not unique: found the first'):
        urdf.parse(text, 'f')


def test_an_error_is_one_line_and_paints_nothing():
    with pytest.raises(DescriptionError, match='found') as caught:
        urdf.parse(joint_text(kind='a&#10;b' + 'c' * 1000), 'f')
    assert '\n' not in str(caught.value)
    assert len(str(caught.value)) < 300
    assert 'a\\nb' in str(caught.value)


@pytest.mark.parametrize(
    'data',
    [
        '<?xml version="1.0" encoding="UTF-8"?><robot name="é"><link name="a"/></robot>',
        '<?xml version="1.0" encoding="latin1"?><robot name="é"><link name="a"/></robot>',
        '<?xml version="1.0" encoding="latin1"?><robot name="é"><link name="a"/></robot>'.encode(
            'latin1'
        ),
        b'\xef\xbb\xbf<robot name="\xc3\xa9"><link name="a"/></robot>',
    ],
    ids=['text, declared', 'text, declared otherwise', 'latin1', 'byte order mark'],
)
def test_encodings(data):
    assert urdf.parse(data).name == 'é'


@pytest.mark.parametrize(
    ('data', 'message'),
    [
        (b'<robot name="r">\n<link name="\xff"/></robot>', r'^f:2: byte 29 is not UTF-8; save'),
        (b'<?xml version="1.0" encoding="zip"?><robot/>', r'^f:1: unknown encoding "zip"; save'),
        ('<robot name="\ud800"/>', r'^f:1: the text is not valid Unicode'),
        ('<robot name="r">\x00</robot>', r'^f:1: not well-formed XML'),
    ],
    ids=['not UTF-8', 'unknown', 'surrogate', 'NUL'],
)
def test_refuses_broken_encodings(data, message):
    with pytest.raises(DescriptionError, match=message):
        urdf.parse(data, 'f')


LEVELS = ''.join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 9))
BOMB = f'<!DOCTYPE r [<!ENTITY e0 "xxxxxxxxxx">{LEVELS}]>'


@pytest.mark.parametrize(
    'text',
    [
        f'{BOMB}<robot name="&e8;"/>',
        '<?xml version="1.0"?>\n<!-- c --><!doctype r SYSTEM "file:///etc/passwd"><robot/>',
        '<!DOCTYPE r [<!ENTITY e SYSTEM "http://localhost:1/">]><robot name="r">&e;</robot>',
    ],
    ids=['bomb', 'file', 'network'],
)
def test_refuses_document_types(text):
    with pytest.raises(DescriptionError, match='^f:1: a document type declaration is refused'):
        urdf.parse(text, 'f')


def test_refuses_size_and_depth():
    with pytest.raises(DescriptionError, match=r'^f.*: larger than 4 MiB'):
        urdf.parse(' ' * (MAX_BYTES + 1), 'f')
    with pytest.raises(DescriptionError, match=r'^f.*: larger than 4 MiB'):
        urdf.parse(b' ' * (MAX_BYTES + 1), 'f')
    with pytest.raises(DescriptionError, match=r'^f:1: not .*: Excessive depth in document: 256$'):
        urdf.parse('<a>' * 100_000, 'f')


def test_a_hostile_prolog_takes_linear_time():
    """With a backtracking expression this would not end."""
    with pytest.raises(DescriptionError, match='not well-formed XML'):
        urdf.parse('<!-- a -->' * 100_000 + '<', 'f')


@pytest.mark.parametrize('count', [5_000, pytest.param(20_000, marks=pytest.mark.long)])
def test_long_chains_and_wide_trees_are_read(count):
    """No recursion, and nothing quadratic, over the links of a file."""
    names = range(count)
    links = ''.join(f'<link name="l{i}"/>' for i in names)
    ends = '<joint name="j{0}" type="fixed"><parent link="l{1}"/><child link="l{0}"/></joint>'
    for parent_of in (lambda i: i - 1, lambda i: 0):
        joints = ''.join(ends.format(i, parent_of(i)) for i in names[1:])
        robot = urdf.parse(robot_text(links + joints))
        assert sum(1 for _ in robot.walk()) == len(names) - 1


@pytest.mark.parametrize(
    ('name', 'message'),
    [('missing.urdf', 'No such file or directory'), ('', 'Is a directory')],
    ids=['missing', 'directory'],
)
def test_unreadable_files(tmp_path, monkeypatch, name, message):
    monkeypatch.chdir(tmp_path)
    path = Path(name)  # short: a message shows the beginning of a long one
    with pytest.raises(DescriptionError, match=f'cannot read the description "{path}": {message}'):
        read_file(path)


def test_a_finite_number_is_needed_everywhere_it_counts():
    """Readers give no NaN to whoever uses parse: it raises first."""
    for path in (AMR, TUTORIAL, ARM):
        robot = urdf.load(path)
        inertials = [link.inertial for link in robot.links if link.inertial is not None]
        assert all(math.isfinite(inertial.mass) for inertial in inertials)
