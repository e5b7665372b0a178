# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The differential drives of a parameter file: as rcl finds them, with their lines."""

import pytest
from support.paths import ROOT

from amr_description.controllers.checks.drive_files import DIFF_DRIVE, drive_warnings, read_drives
from amr_description.errors import ParameterError
from amr_description.model import urdf

WHEELS = """\
    left_wheel_names: [l]
    right_wheel_names: [r]
    wheel_separation: 0.3
    wheel_radius: 0.1
"""
MANAGER = f"""\
controller_manager:
  ros__parameters:
    drive:
      type: {DIFF_DRIVE}
"""


@pytest.fixture
def read(tmp_path):
    """Read the drives of a text."""

    def read_text(text):
        path = tmp_path / 'controllers.yaml'
        path.write_text(text)
        return read_drives(str(path))

    return read_text


def test_shipped_file_with_its_lines():
    path = ROOT / 'config/controllers.yaml'
    (drive,) = read_drives(str(path))
    lines = path.read_text().splitlines()
    assert drive.name == 'diff_drive_controller'
    assert drive.location.source == str(path)
    assert (drive.separation, drive.radius, drive.separation_multiplier) == (0.30, 0.10, 2.82)
    assert (drive.base_frame, drive.publishes_transform) == ('base_footprint', True)
    assert lines[drive.location.line - 1] == '/**/diff_drive_controller:'
    for name in ('wheel_separation', 'wheel_radius', 'base_frame_id', 'left_wheel_names'):
        assert lines[drive.location_of(name).line - 1].strip().startswith(f'{name}: ')
    assert drive.location_of('open_loop') == drive.location, 'the file does not set it'


def test_defaults_are_those_of_the_controller(read):
    (drive,) = read(f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS}')
    assert drive.base_frame == 'base_link'
    assert drive.separation_multiplier == 1.0
    assert drive.publishes_transform
    assert drive.position_feedback


def test_every_drive_of_a_file_is_found(read):
    text = MANAGER + f'    other:\n      type: {DIFF_DRIVE}\n    arm:\n      type: a/Arm\n'
    text += f'drive:\n  ros__parameters:\n{WHEELS}other:\n  ros__parameters:\n{WHEELS}'
    assert [drive.name for drive in read(text)] == ['drive', 'other']


@pytest.mark.parametrize(
    'head',
    [
        'drive:\n  ros__parameters:\n',
        '/drive:\n  ros__parameters:\n',
        '"/**":\n  ros__parameters:\n',
        '"/*":\n  ros__parameters:\n',
        '"/**/drive":\n  ros__parameters:\n',
        '"**":\n  drive:\n    ros__parameters:\n',
    ],
)
def test_a_node_is_named_as_rcl_takes_it(read, head):
    wheels = WHEELS.replace('    ', '      ') if head.startswith('"**"') else WHEELS
    (drive,) = read(MANAGER + head + wheels)
    assert (drive.left_wheels, drive.radius) == (('l',), 0.1)


@pytest.mark.parametrize('nested', [False, True])
def test_a_robot_in_a_namespace(read, nested):
    manager = MANAGER.replace('controller_manager', 'NAME')
    blocks = manager + f'NAME2:\n  ros__parameters:\n{WHEELS}'
    if nested:
        inner = blocks.replace('NAME2', 'drive').replace('NAME', 'controller_manager')
        text = '/robot:\n' + ''.join(f'  {line}\n' for line in inner.splitlines())
    else:
        text = blocks.replace('NAME2', '/robot/drive').replace('NAME', '/robot/controller_manager')
    (drive,) = read(text)
    assert drive.radius == 0.1


def test_a_file_for_a_spawner_may_hold_the_controller_alone(read):
    (drive,) = read(f'drive:\n  ros__parameters:\n    type: {DIFF_DRIVE}\n{WHEELS}')
    assert drive.name == 'drive'


def test_the_last_of_two_counts_and_gives_the_line(read):
    text = f'{MANAGER}"/**":\n  ros__parameters:\n{WHEELS}drive:\n  ros__parameters:\n'
    (drive,) = read(f'{text}    wheel_radius: 0.2\n')
    assert drive.radius == 0.2
    assert drive.location_of('wheel_radius').line == (text + '.').count('\n') + 1
    assert drive.separation == 0.3


def test_dotted_and_nested_names_are_the_same(read):
    text = f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS}'
    (nested,) = read(f'{text}    linear:\n      x:\n        max_velocity: 1.0\n')
    (dotted,) = read(f'{text}    linear.x.max_velocity: 1.0\n')
    name = 'linear.x.max_velocity'
    assert nested.location_of(name).line == dotted.location_of(name).line + 2


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('', 'holds no node'),
        ('a: [', r'controllers.yaml:1:\d+: '),
        (
            'controller_manager:\n  ros__parameters:\n    update_rate: 100\n',
            f'names no controller of type {DIFF_DRIVE}; it is written as',
        ),
        (
            f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS.replace("0.1", "big")}',
            r"controllers.yaml:10: drive: parameter 'wheel_radius' must be of type double, found "
            "'big', a string$",
        ),
        (
            f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS.replace("0.3", "-0.3")}',
            r"controllers.yaml:9: drive: parameter 'wheel_separation' must be greater than 0",
        ),
        (
            MANAGER,
            'controllers.yaml:4: drive: no section has its parameters, of which it needs '
            '"left_wheel_names", "right_wheel_names", "wheel_separation", "wheel_radius"; write '
            'them below drive:',
        ),
        (
            f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS.replace("wheel_radius: 0.1", "")}',
            r"controllers.yaml:5: drive: parameter 'wheel_radius' is not set, and must be greater "
            r'than 0; add wheel_radius: \(Radius of a wheel, m\)$',
        ),
        (
            'controller_manager:\n  ros__parameters:\n    arm:\n      type: a/Arm\n',
            f'names no controller of type {DIFF_DRIVE}, but "a/Arm"; it is written as',
        ),
    ],
)
def test_what_cannot_be_used_is_named_with_its_line(read, text, message):
    with pytest.raises(ParameterError, match=message):
        read(text)


def test_what_rcl_does_not_read_is_named_with_its_line(read):
    text = f'{MANAGER}base: &base\n  ros__parameters: &p\n{WHEELS}drive:\n  ros__parameters:'
    with pytest.raises(ParameterError, match=r'controllers.yaml:12:20: ROS reads no aliases'):
        read(f'{text} *p\n')
    with pytest.raises(ParameterError, match=r'controllers.yaml:13:5: ROS merges no tables'):
        read(f'{text}\n    <<: {{a: 1}}\n    base_frame_id: base\n')


def test_files_are_read_one_over_the_other(tmp_path):
    first, second = tmp_path / 'a.yaml', tmp_path / 'b.yaml'
    first.write_text(f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS}')
    second.write_text('drive:\n  ros__parameters:\n    wheel_radius: 0.2\n')
    (drive,) = read_drives(str(first), str(second))
    assert drive.radius == 0.2
    assert drive.location_of('wheel_radius') == (str(second), 3)
    assert drive.location_of('wheel_separation') == (str(first), 9)


@pytest.mark.parametrize('as_list', [False, True])
def test_files_that_the_manager_hands_over_are_read(tmp_path, as_list):
    own = tmp_path / 'own.yaml'
    own.write_text(f'drive:\n  ros__parameters:\n{WHEELS}')
    path = tmp_path / 'manager.yaml'
    path.write_text(f'{MANAGER}      params_file: {[str(own)] if as_list else own}\n')
    (drive,) = read_drives(str(path))
    assert drive.radius == 0.1
    assert drive.location_of('wheel_radius') == (str(own), 6)


def test_drives_that_run_with_wrong_parameters_are_warned_of():
    robot = urdf.load(ROOT / 'urdf/amr.urdf')
    assert drive_warnings(robot, [str(ROOT / 'config/controllers.yaml')]) == ()
    base, multiplier = drive_warnings(
        robot, [str(ROOT / 'test/fixtures/tutorial/controllers.yaml')]
    )
    assert '"base_link" gets two parents in TF' in base.text
    assert 'wheel_separation_multiplier' in multiplier.text


def test_a_wheel_with_a_wrong_axle_is_warned_of(tmp_path):
    """It keeps no controller from running, so that nobody else would tell."""
    text = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()
    path = tmp_path / 'c.yaml'
    names = WHEELS.replace('[l]', '[left_joint]').replace('[r]', '[right_joint]')
    path.write_text(f'{MANAGER}drive:\n  ros__parameters:\n{names}    base_frame_id: base_link\n')
    frames = drive_warnings(urdf.parse(text, 'r.urdf'), [str(path)])
    robot = urdf.parse(text.replace('<axis xyz="0 0 1"/>', '<axis xyz="1 0 0"/>', 2), 'r.urdf')
    axles, *others = drive_warnings(robot, [str(path)])
    assert axles.text.startswith(
        'r.urdf:18: wheel joints "left_joint", "right_joint" of drive: the axle points ahead, so '
        'that the wheel rolls sideways: found (1, 0, 0) in the frame of "base_link"'
    )
    assert tuple(others) == frames


def test_what_the_manager_will_refuse_is_left_to_it(tmp_path):
    robot = urdf.load(ROOT / 'urdf/amr.urdf')
    path = tmp_path / 'c.yaml'
    assert drive_warnings(robot, [str(path)]) == ()
    path.write_text(f'{MANAGER}drive:\n  ros__parameters:\n{WHEELS}')
    assert drive_warnings(robot, [str(path)]) == (), 'no such wheels: those of another robot'
