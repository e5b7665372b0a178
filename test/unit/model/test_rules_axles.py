# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Wrong axles and angles in degrees: one line each, with the direction found and what would do."""

import json
import re

import pytest
from support.paths import ROOT

from amr_description.cli import check_urdf

CART = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()
TURNED = ' rpy="-1.5707963267948966 0 0"'
ALONG_Z = '<axis xyz="0 0 1"/>'
CYLINDER = '<cylinder radius="0.1" length="0.04"/>'
DRIVE = (ROOT / 'test/fixtures/urdf_good/cart.yaml').read_text()
BOTH = 'wheel joints "left_joint", "right_joint" of drive: '
LEVEL = 'in the frame of "base_footprint", expected (0, 1, 0): level, to the left; write '
AHEAD = 'the axle points ahead, so that the wheel rolls sideways: found (1, 0, 0) '
ASKEW = 'the axle is askew, so that the wheel does not roll straight ahead'
FLAT = 'the axle is vertical, so that the wheel cannot roll'


def cart(*, rpy=TURNED, axis='0 0 1', wheels=2, shape=CYLINDER):
    """The cart with other wheels: ``rpy`` with its attribute, or '' for none."""
    text = CART.replace(TURNED, rpy, wheels).replace(CYLINDER, shape)
    return text.replace(ALONG_Z, f'<axis xyz="{axis}"/>', wheels)


@pytest.fixture
def check(tmp_path, monkeypatch, capsys):
    """Check a text, with or without the drive; give (exit code, lines on stderr)."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'c.yaml').write_text(DRIVE)

    def run(text, *options):
        (tmp_path / 'r.urdf').write_text(text)
        code = check_urdf.main(['r.urdf', *options])
        return code, capsys.readouterr().err.splitlines()

    return run


# How the cart is changed, and what its line says after ``r.urdf:18: ``.
MISTAKES = {
    'axis along x': (cart(axis='1 0 0'), f'{BOTH}{AHEAD}{LEVEL}<axis xyz="0 0 1"/>'),
    'axis of another tutorial': (
        cart(axis='0 1 0'),
        f'{BOTH}{FLAT}: found (0, 0, -1) {LEVEL}<axis xyz="0 0 1"/>',
    ),
    'one axis': (
        cart(axis='1 0 0', wheels=1),
        f'wheel joint "left_joint" of drive: {AHEAD}{LEVEL}<axis xyz="0 0 1"/>',
    ),
    'no rpy': (
        cart(rpy=''),
        f'{BOTH}{FLAT}: found (0, 0, 1) {LEVEL}rpy="-1.5708 0 0" in its <origin>',
    ),
    'rpy about y': (
        cart(rpy=' rpy="0 1.5708 0"'),
        f'{BOTH}{AHEAD}{LEVEL}rpy="-1.5708 0 0" in its <origin>',
    ),
    'half of the angle': (
        cart(rpy=' rpy="-0.785 0 0"'),
        f'{BOTH}{ASKEW}: found (0, 0.71, 0.71) {LEVEL}rpy="-1.5708 0 0" in its <origin>',
    ),
    'no rpy, and the axis along x': (
        cart(rpy='', axis='1 0 0'),
        f'{BOTH}{AHEAD}{LEVEL}rpy="-1.5708 0 0" in its <origin>, and <axis xyz="0 0 1"/>',
    ),
    'degrees': (
        cart(rpy=' rpy="-90 0 0"'),
        f'{BOTH}{ASKEW}, as the rpy="-90 0 0" of its <origin> looks like degrees: '
        f'found (0, 0.89, -0.45) {LEVEL}rpy="-1.5708 0 0" in its <origin>',
    ),
    'degrees of the body': (
        cart().replace(' rpy="0 0 0"', ' rpy="0 0 90"'),
        f'{BOTH}{ASKEW}, as the rpy="0 0 90" of joint "base_joint" looks like degrees: '
        f'found (-0.89, -0.45, 0) {LEVEL}rpy="0 0 1.5708" in joint "base_joint"',
    ),
    'wheels of spheres': (
        cart(axis='1 0 0', shape='<sphere radius="0.1"/>'),
        f'{BOTH}{AHEAD}{LEVEL}<axis xyz="0 0 1"/>',
    ),
    'wheels of boxes': (
        cart(axis='1 0 0', shape='<box size="0.2 0.2 0.04"/>'),
        f'{BOTH}{AHEAD}{LEVEL}<axis xyz="0 0 1"/>',
    ),
    'cylinder on end': (
        cart(rpy='', axis='0 1 0'),
        f'{BOTH}the cylinder of its <collision> does not turn about the axle, so that it cannot '
        f'roll: found (0, 0, 1) {LEVEL}rpy="-1.5708 0 0" in the <origin> of its shapes',
    ),
    'sides against each other': (
        cart(axis='0 0 -1', wheels=1),
        'wheel joint "left_joint": a positive speed drives the robot backwards, and its other '
        'wheels drive it forward: it turns where it should roll: found the axle along -y of the '
        'root frame, expected +y; write <axis xyz="0 0 1"/>',
    ),
}


@pytest.mark.parametrize('mistake', MISTAKES)
def test_a_wrong_axle_of_a_named_wheel_is_one_line(check, mistake):
    text, words = MISTAKES[mistake]
    assert check(text, '--controllers', 'c.yaml') == (1, [f'error: r.urdf:18: {words}'])


@pytest.mark.parametrize(
    'wheels',
    [
        {'rpy': ' rpy="-1.57 0 0"'},
        {'rpy': ' rpy="-1.3 0 0"'},
        {'rpy': ' rpy="-1.5708 0 0.2"'},
        {'rpy': '', 'axis': '0 1 0', 'shape': '<sphere radius="0.1"/>'},
    ],
    ids=['three digits', 'camber', 'toe', 'spheres'],
)
def test_a_right_axle_passes(check, wheels):
    code, lines = check(cart(**wheels), '--controllers', 'c.yaml')
    assert (code, [line for line in lines if 'error' in line or 'axle' in line]) == (0, [])


@pytest.mark.parametrize(
    'wheels',
    [
        {'axis': '1 0 0'},
        {'axis': '0 1 0'},
        {'axis': '0.6 0 0.8'},
        {'rpy': ''},
        {'rpy': ' rpy="0 1.5708 0"'},
        {'rpy': ' rpy="0.3 -0.8 2.2"'},
        {'rpy': '', 'axis': '1 0 0'},
        {'rpy': ' rpy="-90 0 0"'},
        {'rpy': ' rpy="0.5 0.6 0"', 'shape': '<sphere radius="0.1"/>'},
        {'axis': '1 0 0', 'wheels': 1},
    ],
    ids=str,
)
def test_what_a_line_says_would_do_does(check, wheels):
    code, (line,) = check(cart(**wheels), '--controllers', 'c.yaml')
    assert code == 1
    remedy = line.partition('; write ')[2]
    for name in ('rpy', 'axis'):
        value = re.search(f'{name}( xyz)?="([^"]*)"', remedy)
        if value is not None:
            wheels[name] = value[2] if name == 'axis' else f' rpy="{value[2]}"'
    code, lines = check(cart(**wheels), '--controllers', 'c.yaml')
    assert (code, [line for line in lines if 'error' in line or 'axle' in line]) == (0, [])


def test_a_tree_without_a_root_has_no_axles(check):
    code, lines = check(
        cart(axis='1 0 0').replace('<link name="base_footprint"/>', '<link name="lift"/>'),
        '--controllers',
        'c.yaml',
    )
    assert code == 255
    assert not any('axle' in line for line in lines)


def test_across_means_the_frame_that_the_controller_drives(check, tmp_path):
    """The body looks to the left of the root: for odometry of base_link its wheels are right."""
    text = cart().replace(' rpy="0 0 0"', ' rpy="0 0 1.5708"')
    code, (line,) = check(text, '--controllers', 'c.yaml')
    assert code == 1
    assert f'{BOTH}the axle points ahead' in line
    own = DRIVE.replace('base_frame_id: base_footprint', 'base_frame_id: base_link')
    (tmp_path / 'c.yaml').write_text(own)
    code, lines = check(text, '--controllers', 'c.yaml')
    assert (code, [line for line in lines if 'axle' in line]) == (0, [])


def test_the_file_that_the_urdf_names_counts_without_an_option(check, tmp_path):
    plugin = (
        '<gazebo><plugin filename="gz_ros2_control-system" '
        'name="gz_ros2_control::GazeboSimROS2ControlPlugin"><parameters>{}</parameters>'
        '</plugin></gazebo></robot>'
    )
    wrong = cart(axis='1 0 0')
    named = wrong.replace('</robot>', plugin.format('c.yaml'))
    assert check(wrong) == (0, [])
    assert check(named) == (1, [f'error: r.urdf:18: {MISTAKES["axis along x"][1]}'])
    assert check(named.replace('c.yaml', 'gone.yaml')) == (0, [])
    assert check(cart().replace('</robot>', plugin.format('c.yaml')), '--strict') == (0, [])
    (tmp_path / 'other.yaml').write_text(DRIVE.replace('left_joint', 'its_joint'))
    assert check(named.replace('c.yaml', 'other.yaml')) == (0, []), 'the wheels of another robot'
    (tmp_path / 'arm.yaml').write_text('arm:\n  ros__parameters:\n    rate: 1\n')
    assert check(named.replace('c.yaml', 'arm.yaml')) == (0, []), 'it has no wheels'
    (tmp_path / 'bad.yaml').write_text(DRIVE.replace('0.1', "'1'"))
    code, (line,) = check(named.replace('c.yaml', 'bad.yaml'))
    assert code == 0
    assert line.startswith("warning: bad.yaml:10: drive: parameter 'wheel_radius' must be of type")


DEGREES = {
    'wheels': (
        cart(rpy=' rpy="90 0 0"'),
        21,
        'joint "left_joint", joint "right_joint" looks like degrees: found rpy="90 0 0", up to '
        '14.3 turns, expected radians; write rpy="1.5708 0 0"',
    ),
    'upside down': (
        cart(rpy=' rpy="180 0 0"'),
        21,
        'joint "left_joint", joint "right_joint" looks like degrees: found rpy="180 0 0", up to '
        '28.6 turns, expected radians; write rpy="3.1416 0 0"',
    ),
    'one of three': (
        CART.replace(' rpy="0 0 0"', ' rpy="0 -1.57 45"'),
        8,
        'joint "base_joint" looks like degrees: found rpy="0 -1.57 45", up to 7.2 turns, expected '
        'radians; write rpy="0 -1.57 0.7854"',
    ),
    'a shape': (
        CART.replace('<visual><geometry><box', '<visual><origin rpy="0 0 22.5"/><geometry><box'),
        11,
        'the visual of link "base_link" looks like degrees: found rpy="0 0 22.5", up to 3.6 '
        'turns, expected radians; write rpy="0 0 0.3927"',
    ),
}


@pytest.mark.parametrize('case', DEGREES)
def test_degrees_are_named_also_without_a_controller(check, case):
    text, number, words = DEGREES[case]
    code, lines = check(text)
    assert code == 0
    assert lines[0] == f'warning: r.urdf:{number}: the rpy of {words}'
    assert not any('looks like degrees' in line for line in lines[1:])


@pytest.mark.parametrize('rpy', ['6.2832 0 0', '-6.283185307179586 3.14159 0', '0 1 2', '7.1 0 0'])
def test_what_may_be_radians_is_left_alone(check, rpy):
    _, lines = check(CART.replace(' rpy="0 0 0"', f' rpy="{rpy}"'))
    assert not any('degrees' in line for line in lines)


def test_wheels_that_lie_flat_are_the_cause_of_tipping_over(check):
    code, (line,) = check(cart(rpy=''))
    assert code == 0
    assert line == (
        f'warning: r.urdf:18: wheel joints "left_joint", "right_joint": {FLAT}, and the robot '
        f'tips over: found (0, 0, 1) {LEVEL}rpy="-1.5708 0 0" in its <origin>'
    )


def test_the_drop_finds_what_no_controller_names(check):
    for wheels, verb, cause in (
        ({'axis': '1 0 0'}, 'it goes sideways: ', 'the axle points ahead'),
        ({'axis': '0 1 0'}, 'it does not drive: ', FLAT),
        ({'rpy': ''}, 'it does not drive: it stands on none of the joints', FLAT),
        ({'rpy': '', 'axis': '0 1 0'}, 'it does not drive: it stands on none', 'the cylinder of'),
        ({'axis': '1 0 0', 'shape': '<sphere radius="0.1"/>'}, 'it goes sideways: ', 'the axle'),
    ):
        code, lines = check(cart(**wheels), '--drop')
        (failure,) = [line for line in lines if line.startswith('error: dropped: ')]
        assert code == 1
        assert failure.startswith(f'error: dropped: {verb}')
        assert f'; "left_joint", "right_joint": {cause}' in failure
        assert '; write ' in failure


def test_what_is_not_driven_is_no_pass(tmp_path, capsys):
    still = CART[: CART.index('  <ros2_control')] + '</robot>\n'
    (tmp_path / 'r.urdf').write_text(still)
    assert check_urdf.main([str(tmp_path / 'r.urdf'), '--drop']) == 0
    lines = capsys.readouterr().out.splitlines()
    reason = 'not driven: no continuous joint takes a velocity or an effort command'
    assert lines[-1] == f'    {reason}'
    assert not any('passed' in line for line in lines)
    assert check_urdf.main([str(tmp_path / 'r.urdf'), '--drop', '--json']) == 0
    told = json.loads(capsys.readouterr().out)
    assert told['drop']['left_out'] == [reason]


def test_it_is_said_how_far_outside_the_centre_of_mass_is(check):
    # 5.5 kg, of which 1 kg is at x = 0.1 m, where the axle stands, and 0.2 kg at 0.12 m.
    code, lines = check((ROOT / 'test/fixtures/urdf_broken/tips_over.urdf').read_text())
    assert code == 0
    assert any('found x 0.0225, y 0 m, 77 mm outside, ' in line for line in lines), lines
