# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf --controllers``: what the controllers believe of the robot, and what it is."""

import pytest
from support.paths import ROOT

from amr_description.cli import check_urdf

AMR = ROOT / 'urdf/amr.urdf'
CART = ROOT / 'test/fixtures/urdf_good/cart.urdf'
SHIPPED = (ROOT / 'config/controllers.yaml').read_text()
TUTORIAL = ROOT / 'test/fixtures/tutorial'
CART_DRIVE = CART.with_suffix('.yaml').read_text()


@pytest.fixture
def check(tmp_path, capsys):
    """Check a robot against the text of a parameter file; give (exit code, lines on stderr)."""

    def run(urdf, text, *options):
        path = tmp_path / 'c.yaml'
        path.write_text(text)
        code = check_urdf.main([str(urdf), '--controllers', str(path), *options])
        return code, capsys.readouterr().err.replace(str(path), 'c.yaml').splitlines()

    return run


def test_shipped_files_agree(check):
    assert check(AMR, SHIPPED, '--strict') == (0, [])


def test_two_wheels_and_a_caster_need_no_multiplier(check):
    assert check(CART, CART_DRIVE, '--strict') == (0, [])


def test_each_fault_of_the_tutorial_is_named_once(capsys):
    arguments = [str(TUTORIAL / 'amr.urdf'), '--controllers', str(TUTORIAL / 'controllers.yaml')]
    assert check_urdf.main(arguments) == 0
    lines = capsys.readouterr().err.splitlines()
    for line, (file, number, fault, fix) in zip(
        lines,
        (
            ('amr.urdf', 145, 'has a path of this machine only', 'let xacro find the file'),
            ('amr.urdf', 43, 'drives the robot backwards', 'write <axis xyz="0 0 -1"/>'),
            ('controllers.yaml', 20, 'two parents in TF', 'write base_frame_id: base_footprint'),
            ('controllers.yaml', 16, 'scrub', 'write wheel_separation_multiplier: 2.78'),
        ),
        strict=True,
    ):
        assert line.startswith(f'warning: {TUTORIAL / file}:{number}: ')
        assert fault in line
        assert f'; {fix}' in line
    assert check_urdf.main([*arguments, '--strict']) == 1


BOTH = '\n    left_wheel_radius_multiplier: {0}\n    right_wheel_radius_multiplier: {0}'
FAULTS = {
    'multipliers that are too many': (
        'wheel_radius: 0.1',
        f'wheel_radius: 0.1{BOTH.format(0.8)}',
        0,
        'warning: c.yaml:11: drive: wheel_radius is not that of "left_joint": found 0.08 m, 0.1 m '
        'times 0.8, expected 0.1 m, the radius of its collision shape; write '
        'left_wheel_radius_multiplier: 1.0',
    ),
    'a multiplier of one side': (
        'wheel_radius: 0.1',
        'wheel_radius: 0.2\n    left_wheel_radius_multiplier: 0.5',
        0,
        'warning: c.yaml:10: drive: wheel_radius is not that of "right_joint": found 0.2 m, '
        'expected 0.1 m',
    ),
    'unknown wheel': (
        '[right_joint]',
        '[rigth_joint]',
        1,
        'error: c.yaml:8: drive: right_wheel_names holds "rigth_joint", which is no joint of the '
        'robot: expected joints of {}: "left_joint", "right_joint", "lift_joint"; '
        'write "right_joint"',
    ),
    'not commanded': (
        '[right_joint]',
        '[right_joint, lift_joint]',
        1,
        'error: c.yaml:8: drive: right_wheel_names holds "lift_joint", which has no command '
        'interface "velocity": found none; add <command_interface name="velocity"/>',
    ),
    'swapped': (
        '[left_joint]\n    right_wheel_names: [right_joint]',
        '[right_joint]\n    right_wheel_names: [left_joint]',
        0,
        'warning: c.yaml:7: drive: left and right wheels are swapped: turns are inverted: found '
        'the left wheels at y = -0.15 m, the right ones at y = 0.15 m',
    ),
    'radius': (
        'wheel_radius: 0.1',
        'wheel_radius: 0.2',
        0,
        'warning: c.yaml:10: drive: wheel_radius is not that of "left_joint": found 0.2 m, '
        'expected 0.1 m, the radius of its collision shape; write wheel_radius: 0.1',
    ),
    'separation': (
        'wheel_separation: 0.3',
        'wheel_separation: 0.15',
        0,
        'warning: c.yaml:9: drive: wheel_separation is not that of the wheels: found 0.15 m, '
        'expected 0.3 m between the joints on the left and on the right; '
        'write wheel_separation: 0.3',
    ),
    'base frame': (
        'base_frame_id: base_footprint',
        'base_frame_id: base_link',
        0,
        'warning: c.yaml:11: drive: "base_link" gets two parents in TF: found "odom" from '
        'odometry, "base_footprint" from the URDF, expected the root of the URDF, '
        '"base_footprint"; write base_frame_id: base_footprint',
    ),
    'no base frame': (
        'base_frame_id: base_footprint',
        'base_frame_id: base',
        0,
        'warning: c.yaml:11: drive: base_frame_id is no link of the robot: found "base"',
    ),
}


@pytest.mark.parametrize('fault', FAULTS)
def test_a_fault_is_named_with_its_line_and_the_fix(check, fault):
    old, new, code, message = FAULTS[fault]
    assert old in CART_DRIVE
    found, lines = check(CART, CART_DRIVE.replace(old, new))
    assert found == code
    assert any(line.startswith(message.format(CART)) for line in lines), lines


@pytest.mark.parametrize(
    ('old', 'new'),
    [
        ('wheel_radius: 0.1', 'wheel_radius: 0.1005'),
        ('wheel_separation: 0.3', 'wheel_separation: 0.302'),
        ('wheel_radius: 0.1', f'wheel_radius: 0.125{BOTH.format(0.8)}'),
        ('wheel_radius: 0.1', f'wheel_radius: 0.1{BOTH.format(1.015)}'),
        ('base_frame_id: base_footprint', 'base_frame_id: base_link\n    enable_odom_tf: false'),
    ],
)
def test_small_deviations_pass(check, old, new):
    assert check(CART, CART_DRIVE.replace(old, new), '--strict') == (0, [])


def test_without_feedback_only_an_open_loop_can_do(check, tmp_path):
    blind = tmp_path / 'blind.urdf'
    blind.write_text(CART.read_text().replace('<state_interface name="position"/>', ''))
    code, lines = check(blind, CART_DRIVE)
    assert code == 1
    assert len(lines) == 2, 'one a wheel'
    assert 'has no state interface "position": found "velocity"' in lines[0]
    by_velocity = CART_DRIVE + '    position_feedback: false\n'
    assert check(blind, by_velocity, '--strict') == (0, [])
    assert check(blind, CART_DRIVE + '    open_loop: true\n', '--strict') == (0, [])


def test_a_file_that_cannot_be_used_is_one_line(check):
    code, lines = check(CART, 'controller_manager: 7\n')
    assert code == 1
    assert len(lines) == 1
    assert lines[0].startswith("error: c.yaml:1: below 'controller_manager' stands 7, and no ")


@pytest.mark.parametrize(
    ('multiplier', 'said'),
    [
        (2.82, []),  # measured
        (2.65, []),  # of another ground
        (
            2.0,
            'the robot turns 72 % of what is told: found 0.6 m, expected 0.8333 m, that of the '
            'wheels times 1 + (L/W)² = 2.78; write wheel_separation_multiplier: 2.78, unless it '
            'was measured on the ground that the robot drives on',
        ),
        (3.2, 'the robot turns 115 % of what is told'),
    ],
)
def test_a_multiplier_that_does_not_fit_wheels_that_scrub_is_told(check, multiplier, said):
    text = SHIPPED.replace(
        'wheel_separation_multiplier: 2.82', f'wheel_separation_multiplier: {multiplier}'
    )
    assert (text == SHIPPED) == (multiplier == 2.82)
    code, lines = check(AMR, text)
    assert code == 0
    if said:
        (line,) = lines
        assert line.startswith('warning: c.yaml:') and said in line
    else:
        assert lines == []


def test_wheels_with_rollers_are_not_told_that_they_scrub(check, tmp_path):
    friction = '<mu1>1.0</mu1><mu2>0.0</mu2><fdir1>1 {} 0</fdir1>'
    blocks = ''.join(
        f'<gazebo reference="wheel_{row}_{side}">{friction.format(sign)}</gazebo>'
        for row, front in (('front', 1), ('back', -1))
        for side, sign in (('left', -front), ('right', front))
    )
    rolling = tmp_path / 'rolling.urdf'
    rolling.write_text(AMR.read_text().replace('</robot>', f'{blocks}</robot>'))
    text = SHIPPED.replace('multiplier: 2.82', 'multiplier: 2.0')
    assert not [line for line in check(rolling, text)[1] if 'scrub' in line]
